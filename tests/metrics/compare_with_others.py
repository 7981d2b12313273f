"""What `rpf compare --json` says of real pictures, against numpy, scikit-image and NVIDIA's flip-evaluator.

Usage: compare_with_others.py RPF IMAGE_TO_FLOATS PROJECT
Exit code 77 (skipped) where one of those packages is missing:
    python3 -m venv --system-site-packages VENV && VENV/bin/pip install scikit-image flip-evaluator
    cmake --preset release -DRPF_METRICS_PYTHON=VENV/bin/python && ctest --preset release -L metrics
"""
import json
import subprocess
import sys
import tempfile
from pathlib import Path

try:
    import flip_evaluator
    import numpy as np
    from skimage.metrics import mean_squared_error, peak_signal_noise_ratio, structural_similarity
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

RPF, IMAGE_TO_FLOATS, PROJECT = sys.argv[1], sys.argv[2], Path(sys.argv[3])
SAMPLES, REFERENCE = (PROJECT / "examples" / f"dof-spheres.{kind}.exr" for kind in ("samples", "reference"))
TOLERANCE = 1e-4  # absolute; PSNR too, in decibels. flip-evaluator computes in single precision.
CROP = ["--crop", "67x41+20+31"]
FILTER = ["--profile", "paper", "--boxes", "9,5", "--samples-factor", "1", "--noise", "0.002"]


def pixels(file):
    with tempfile.NamedTemporaryFile() as floats:
        size = subprocess.run([IMAGE_TO_FLOATS, file, floats.name], check=True, capture_output=True, text=True).stdout
        width, height = map(int, size.split())
        return np.fromfile(floats.name, np.float32).reshape(height, width, 3).astype(np.float64)


def displayed(linear):
    light = np.clip(linear, 0, 1)
    return np.where(light <= 0.0031308, 12.92 * light, 1.055 * light ** (1 / 2.4) - 0.055)


def expected(a, b):
    relative = (a - b) ** 2 / (b**2 + 0.01)
    by_pixel = np.sort(relative.mean(axis=2).ravel())
    sa, sb = displayed(a), displayed(b)
    _, flip, _ = flip_evaluator.evaluate(sb.astype(np.float32), sa.astype(np.float32), "LDR")
    # Negative light counts as 0 here, and is not allowed there.
    _, hdr_flip, _ = flip_evaluator.evaluate(*(np.maximum(x, 0).astype(np.float32) for x in (b, a)), "HDR")
    return {"relMSE": relative.mean(), "MSE": mean_squared_error(a, b), "energy": a.sum() / b.sum(),
            "trimmed_relMSE": by_pixel[:len(by_pixel) - len(by_pixel) // 1000].mean(), "MAE": np.abs(a - b).mean(),
            "PSNR": peak_signal_noise_ratio(sb, sa, data_range=1),
            "SSIM": structural_similarity(sa, sb, gaussian_weights=True, sigma=1.5, use_sample_covariance=False,
                                          data_range=1, channel_axis=-1),
            "FLIP": flip, "HDR_FLIP": hdr_flip}


def largest_differences(a, b):
    """value, x and y of each channel, from numpy."""
    difference = np.abs(a - b)
    for channel, name in enumerate("RGB"):
        y, x = np.unravel_index(np.argmax(difference[:, :, channel]), difference.shape[:2])
        yield name, difference[y, x, channel], int(x), int(y)


def check(title, image, reference, corner=(0, 0)):
    """Prints both sides of every metric; returns how many differ."""
    run = subprocess.run([RPF, "compare", "--json", image, reference], check=True, capture_output=True, text=True)
    ours = json.loads(run.stdout)["images"][0]
    a, b = pixels(image), pixels(reference)
    failures = 0
    print(f"{title}: {a.shape[1]}x{a.shape[0]}")
    for name, value in expected(a, b).items():
        good = abs(ours[name] - value) <= TOLERANCE
        failures += not good
        print(f"  {name:15} {ours[name]:14.8f} {value:14.8f} {ours[name] - value:10.1e} {'' if good else 'DIFFERS'}")
    for name, value, x, y in largest_differences(a, b):
        found = ours["largest_difference"][name]
        good = abs(found["difference"] - value) <= TOLERANCE and (found["x"], found["y"]) == (x + corner[0], y + corner[1])
        failures += not good
        print(f"  largest {name:7} {found} {'' if good else f'DIFFERS from {value} at {x}, {y}'}")
    return failures


def main():
    failures = 0
    with tempfile.TemporaryDirectory() as folder:
        files = {}
        for name, options in (("before", ["--boxes", "none"]), ("after", FILTER), ("before crop", ["--boxes", "none", *CROP]),
                              ("after crop", [*FILTER, *CROP])):
            files[name] = str(Path(folder) / f"{name}.exr")
            subprocess.run([RPF, SAMPLES, "-o", files[name], "-q", *options], check=True)
        failures += check("before | reference", files["before"], str(REFERENCE))
        failures += check("after | reference", files["after"], str(REFERENCE))
        failures += check("before | after", files["before"], files["after"])
        failures += check("crops of before | after", files["before crop"], files["after crop"], corner=(20, 31))
    print(f"{failures} numbers differ by more than {TOLERANCE}" if failures else "all numbers agree")
    return 1 if failures else 0


sys.exit(main())
