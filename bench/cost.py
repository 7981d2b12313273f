"""What presets cost beside Open Image Denoise: CPU and wall seconds from samples (from the mean) in memory to an image in memory.

Usage: cost.py [--build BUILD] [--rounds 5] [--sizes 480x270,1920x1080] [--presets fast,balanced,high] [--page docs/quality.md]

Both are measured in turns, so that what disturbs the machine disturbs both; kernels are compiled and weights loaded before. Published are
ratios of medians, with the least and largest of the rounds. --page replaces the table between <!-- cost --> and <!-- end -->.
"""
import argparse
import json
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

import oidn
from marked_page import write_table

PROJECT = Path(__file__).resolve().parent.parent
SCENE, SAMPLES = "combined", 4
TURNS = 3  # of a program before the other has its turn


def processor():
    lines = [l for l in Path("/proc/cpuinfo").read_text().splitlines() if l.startswith("model name")]
    return f"{lines[0].split(':')[1].strip()}, {len(lines)} threads" if lines else "unknown processor"


def ours(rpf, samples, presets):
    """{preset: {"cpu": [...], "wall": [...]}}"""
    sets = [f"--set={p}=--backend opencl --preset {p}" for p in presets]
    output = subprocess.run([rpf, "bench", "frames", samples, "--rounds", str(TURNS), "--json", *sets], check=True,
                            stdout=subprocess.PIPE, text=True).stdout
    return {f["setting"]: {kind: f[f"filter_{kind}"]["rounds"] for kind in ("cpu", "wall")} for f in json.loads(output)["frames"]}


def measured(rpf, python, samples, presets, rounds, work):
    """{method: {"cpu": [...], "wall": [...]}}"""
    total = {name: {"cpu": [], "wall": []} for name in (*presets, oidn.NOISY, oidn.CLEAN)}
    for _ in range(rounds):
        theirs = oidn.denoise(rpf, python, samples, work, TURNS)
        for name, cost in {**ours(rpf, samples, presets), oidn.NOISY: theirs[oidn.NOISY], oidn.CLEAN: theirs[oidn.CLEAN]}.items():
            for kind in ("cpu", "wall"):
                total[name][kind] += cost[kind]
    return total


def rows_of(size, total):
    base = statistics.median(total[oidn.NOISY]["cpu"])
    for name, cost in total.items():
        cpu, wall = (statistics.median(cost[kind]) for kind in ("cpu", "wall"))
        yield (f"| {size} | {name} | **{cpu / base:.2f}** ({min(cost['cpu']) / base:.2f} .. {max(cost['cpu']) / base:.2f}) | {cpu:.3f} | "
               f"{wall:.3f} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", default=PROJECT / "build/release")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--sizes", default="480x270,1920x1080")
    parser.add_argument("--presets", default="fast,balanced,high")
    parser.add_argument("--page")
    options = parser.parse_args()
    build = Path(options.build).resolve()
    python = oidn.python_with_oidn(build / "oidn")
    if not python:
        return 1
    rows = [f"| {processor()} | | CPU seconds over OIDN's | CPU s | wall s |", "|---|---|---|---|---|"]
    with tempfile.TemporaryDirectory() as folder:
        work = Path(folder)
        for size in options.sizes.split(","):
            samples = work / f"{size}.exr"
            subprocess.run([build / "rpf", "scene", SCENE, "--size", size, "--spp", str(SAMPLES), "-o", samples, "-q"], check=True)
            rows += rows_of(size, measured(build / "rpf", python, samples, options.presets.split(","), options.rounds, work))
    print("\n".join(rows))
    if options.page:
        write_table(options.page, "cost", rows)
    return 0


if __name__ == "__main__":
    sys.exit(main())
