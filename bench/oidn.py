"""Open Image Denoise beside `rpf`, on the same samples. It comes from PyPI into a virtual environment."""
import json
import subprocess
import sys
from pathlib import Path

PACKAGE = "pyoidn==2.5.1.0"
NOISY, CLEAN = "OIDN", "OIDN, prefiltered features"


def python_with_oidn(folder):
    """A Python in `folder` that has the package; None, and a word why, where it cannot be had."""
    python = folder / "bin/python"
    try:
        if not python.exists():
            subprocess.run([sys.executable, "-m", "venv", folder], check=True)
        subprocess.run([python, "-m", "pip", "install", "-q", PACKAGE], check=True)
    except (OSError, subprocess.CalledProcessError) as failure:
        print("Open Image Denoise is left out:", failure, file=sys.stderr)
        return None
    return python


def denoise(rpf, python, samples, work, rounds):
    """Denoises the plain mean of a sample file -> {NOISY: {"cpu": [...], "wall": [...], "image": path}, CLEAN: ...}."""
    raw, noisy, clean = (work / name for name in ("oidn.rpf", "noisy.rpf", "clean.rpf"))
    subprocess.run([rpf, "convert", samples, "-o", raw], check=True)
    script = Path(__file__).with_name("oidn_point.py")
    output = subprocess.run([python, script, raw, noisy, clean, str(rounds)], check=True, stdout=subprocess.PIPE, text=True).stdout
    measured = json.loads(output)
    for name, file in ((NOISY, noisy), (CLEAN, clean)):
        measured[name]["image"] = file.with_suffix(".exr")
        subprocess.run([rpf, file, "--method", "rpf", "--boxes", "none", "-o", measured[name]["image"], "-q"], check=True)
    for path in (raw, noisy, clean):
        path.unlink()
    return measured
