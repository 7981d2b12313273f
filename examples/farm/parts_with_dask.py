"""python3 parts_with_dask.py IN.samples.exr OUT.exr PARTS [SCHEDULER]: one frame by several workers of dask.

Facts of the whole frame are found once; each part reads only the rows that it needs. Workers need rpf in their PATH and
the files' folder. A task that was killed is given to a worker again, three times at most. An exit code that is not 0 ends here.
"""
import os
import subprocess
import sys

from dask.distributed import Client, LocalCluster

RPF = os.environ.get("RPF", "rpf")


def run(*arguments):
    subprocess.run([RPF, *arguments], check=True)  # raises, also where a signal ended it: dask tries again


def filter_part(source, target, part, parts, facts):
    run(source, "-o", target, "--rows", f"{part}/{parts}", "--facts", facts, "--skip-existing", "--threads", "1")
    return target


def main():
    source, target, parts = sys.argv[1], sys.argv[2], int(sys.argv[3])
    cluster = sys.argv[4] if len(sys.argv) > 4 else LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None)
    facts = target + ".facts.json"
    run("facts", source, "-o", facts)
    with Client(cluster) as client:
        tasks = [client.submit(filter_part, source, f"{target}.{part}.part.exr", part, parts, facts, retries=3, pure=False) for part in range(1, parts + 1)]
        run("join", *client.gather(tasks), "-o", target)


if __name__ == "__main__":
    main()
