"""python3 with_dask.py IN.####.exr OUT.####.exr PARTS [SCHEDULER]: on this machine, or on a cluster of dask.

A task is a part of the frames; its process compiles kernels once. Workers need rpf in their PATH and the frames' folder.
A task that was killed is given to a worker again, three times at most; --skip-existing leaves it what it had finished.
Parts run one a worker, with the threads that a worker has. An exit code that is not 0 names the part and ends here.
"""
import os
import subprocess
import sys

from dask.distributed import Client, LocalCluster


def filter_part(source, target, part, parts, threads):
    command = [os.environ.get("RPF", "rpf"), source, "-o", target, "--chunk", f"{part}/{parts}", "--skip-existing", "--threads", str(threads)]
    subprocess.run(command, check=True)  # raises, also where a signal ended it: dask tries again
    return part


def main():
    source, target, parts = sys.argv[1], sys.argv[2], int(sys.argv[3])
    cluster = sys.argv[4] if len(sys.argv) > 4 else LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None)
    with Client(cluster) as client:
        tasks = [client.submit(filter_part, source, target, part, parts, 1, retries=3, pure=False) for part in range(1, parts + 1)]
        print("parts done:", *client.gather(tasks))


if __name__ == "__main__":
    main()
