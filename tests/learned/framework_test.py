"""The estimator in C++ against PyTorch (training/), on frames of `rpf scene`: what the network sees, and the result.

Usage: framework_test.py RPF RPF_NETWORK PROJECT   (by a Python that has training/requirements.txt; exit code 77 without)
"""
import json
import subprocess
import sys
import tempfile
from pathlib import Path

RPF, TOOL, PROJECT = (Path(a).resolve() for a in sys.argv[1:4])
sys.path.insert(0, str(PROJECT / "training"))
try:
    import numpy as np
    import torch

    import export
    import frames
    from estimator import albedo_base, sample_inputs
except ImportError as missing:
    print("skipped:", missing)
    sys.exit(77)

# Bounds: the same formulas in float on both sides, sums in another order; log and exp differ by some units in the last place.
INPUTS_ABSOLUTE = 1e-6   # an input's magnitude is of order 1
RESULT_RELATIVE = 1e-4   # of the pixel's magnitude and the frame's mean
FIRST_SPARED = 16        # inputs from here on are not computed for a network without weights for them
SCENES = ("dof", "motion", "soft-shadow", "glossy")
DARK = 1e-2              # of the frame's mean: what differences are relative to at least


def frame_file(folder, scene):
    path = folder / f"{scene}.rpf"
    exr = folder / f"{scene}.exr"
    subprocess.run([RPF, "scene", scene, "--size", "77x50", "--spp", "4", "-o", exr, "-q"], check=True)
    subprocess.run([RPF, "convert", exr, "-o", path], check=True, stdout=subprocess.DEVNULL)
    return path


def stages_of(path, model, folder):
    """{stage: [items, channels]} of the C++ estimator, and what it says of the frame."""
    subprocess.run([TOOL, "stages", path, model, folder], check=True)
    facts = json.loads((folder / "stages.json").read_text())
    read = lambda s: np.fromfile(folder / f"{s['name']}.f32", "<f4").reshape(-1, s["channels"])
    return {s["name"]: read(s) for s in facts["stages"]}, facts


def compare(path, model, folder):
    """Largest differences -> (inputs, result)"""
    stages, facts = stages_of(path, model, folder)
    file = frames.raw_samples.read_samples(path)
    samples, groups = frames.frame_channels(file)
    samples = torch.from_numpy(samples)
    has_albedo = "albedo" in groups
    network = export.read(model)
    inputs = sample_inputs(samples, albedo_base(samples, has_albedo))  # [30, n, y, x]
    seen = network.layers["sample1"].weight.abs().sum((0, 2, 3)) > 0  # the others rpf does not even read
    seen[:FIRST_SPARED] = True
    inputs = inputs * seen[:, None, None, None]
    ours = inputs.permute(2, 3, 1, 0).reshape(-1, inputs.shape[0]).numpy()
    with torch.no_grad():
        result = network(samples, has_albedo).permute(1, 2, 0).reshape(-1, 3).numpy()
    scale = facts["exposure"]  # stages are in scaled radiance
    theirs = stages["result"][:, :3] * scale
    least = np.abs(result).mean() * DARK
    return np.abs(ours - stages["inputs"]).max(), (np.abs(theirs - result) / np.maximum(np.abs(result), least)).max()


def main():
    failures = 0
    models = sorted((PROJECT / "networks").glob("*.rpfnet"))
    with tempfile.TemporaryDirectory() as work:
        folder = Path(work)
        for scene in SCENES:
            path = frame_file(folder, scene)
            for model in models:
                inputs, result = compare(path, model, folder)
                fine = inputs <= INPUTS_ABSOLUTE and result <= RESULT_RELATIVE
                failures += not fine
                print(f"{'ok  ' if fine else 'FAIL'} {scene}, {model.stem}: inputs differ by {inputs:.2g}, result by {result:.2g} of itself")
    return 1 if failures else 0


sys.exit(main())
