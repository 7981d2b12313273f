"""From nothing to a picture, as training/README.md says: a fresh virtual environment, scenes, training, export, use.

Usage: training_test.py RPF RPF_NETWORK PROJECT WORK [--minutes 10] [--python PYTHON]
WORK is emptied first. --python: an interpreter that has training/requirements.txt, in place of a fresh environment.
"""
import argparse
import json
import shutil
import subprocess
import sys
from pathlib import Path

parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
for name in ("rpf", "tool", "project", "work"):
    parser.add_argument(name, type=lambda a: Path(a).resolve())
parser.add_argument("--minutes", type=float, default=10)
parser.add_argument("--python")
options = parser.parse_args()
TRAINING = options.project / "training"
SCENES, HELD_OUT = 8, 2
SMALL_NETWORK = ["--channels", "16,24,32", "--sample-features", "16"]
FRAME = ["scene", "dof", "--size", "128x96"]


def run(*command):
    print("+", *command, flush=True)
    subprocess.run([str(c) for c in command], check=True)


def fresh_python():
    if options.python:
        return options.python
    run(sys.executable, "-m", "venv", options.work / "venv")
    python = options.work / "venv/bin/python"
    run(python, "-m", "pip", "install", "-q", "-r", TRAINING / "requirements.txt")
    return python


def make_frames(python):
    for part, first, count in (("scenes", 1, SCENES), ("held-out", 1001, HELD_OUT)):
        run(python, TRAINING / "scenes/generate.py", "--out", options.work / part, "--first", first, "--count", count, "--size", "64x64",
            "--reference-spp", "72")
        run(python, TRAINING / "scenes/to_frames.py", options.work / part, options.work / f"{part}-frames")


def train(python, name, minutes, *start):
    """-> the exported network"""
    run_folder, network = options.work / name, options.work / f"{name}.rpfnet"
    run(python, TRAINING / "train.py", "--run", run_folder, "--frames", options.work / "scenes-frames", "--validation",
        options.work / "held-out-frames", "--hours", minutes / 60, *SMALL_NETWORK, *start)
    run(python, TRAINING / "export.py", run_folder / "checkpoint.pt", network, "--name", name)
    return network


def errors(model):
    """relMSE of the plain mean and of the network's picture, of a scene that it has never seen."""
    rpf, work = options.rpf, options.work
    samples, reference, mean, result = (work / f"{n}.exr" for n in ("samples", "reference", "mean", "result"))
    run(rpf, *FRAME, "--spp", 4, "-o", samples, "-q")
    run(rpf, *FRAME, "--reference", 256, "-o", reference, "-q")
    run(rpf, samples, "--method", "rpf", "--boxes", "none", "-o", mean, "-q")
    run(rpf, samples, "--model", model, "-o", result, "-q")
    output = subprocess.run([rpf, "compare", "--json", mean, result, reference], check=True, stdout=subprocess.PIPE, text=True).stdout
    return [image["relMSE"] for image in json.loads(output)["images"]]


def main():
    shutil.rmtree(options.work, ignore_errors=True)
    options.work.mkdir(parents=True)
    python = fresh_python()
    make_frames(python)
    small = train(python, "small", options.minutes)
    further = train(python, "further", options.minutes / 10, "--start", small, "--rate", 1e-4)
    mean, result = errors(further)
    print(f"relMSE {mean:.4f} -> {result:.4f}")
    if result > mean / 2:
        print("FAIL: a network of some minutes has at most half the error of the plain mean")
        return 1
    run(python, options.project / "tests/learned/framework_test.py", options.rpf, options.tool, options.project)
    return 0


sys.exit(main())
