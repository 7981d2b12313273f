"""How far the error that `--aov FILE --error` tells is to be trusted: against the true error of the filtered frame, on three scenes.

Usage: error_estimates.py [--build BUILD] [--scenes ...] [--counts 4,16] [--page docs/explain.md]

Rank correlation (Spearman) of the estimated with the true error, pixel by pixel, and of their means over 9x9 pixels; and estimated over
true relMSE. The error of one pixel is itself a random number: even its exact expectation would not have a correlation of 1.
--page replaces the table between <!-- errors --> and <!-- end --> there.
"""
import argparse
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

from marked_page import write_table

PROJECT = Path(__file__).resolve().parent.parent
SIZE, REFERENCE_SAMPLES = "240x135", 1024
METHODS = {"`--preset balanced`": "", "`nlm`": "nlm", "`gem`": "gem", "`sbf`": "sbf", "`gaussian`": "gaussian"}


def ranks(values):
    order = np.empty(values.size)
    order[np.argsort(values, axis=None)] = np.arange(values.size)
    return order


def correlation(a, b):
    return np.corrcoef(ranks(a), ranks(b))[0, 1]


def means_around(values, reach=4):
    """Of squares of 9x9 pixels, inside the picture."""
    sums = np.pad(np.cumsum(np.cumsum(values, 0), 1), ((1, 0), (1, 0)))
    side = 2 * reach + 1
    return (sums[side:, side:] - sums[:-side, side:] - sums[side:, :-side] + sums[:-side, :-side]) / side**2


class Scenes:
    def __init__(self, command, folder):
        self.command, self.folder = command, Path(folder)

    def _file(self, name, *options):
        path = self.folder / name
        if not path.exists():
            subprocess.run([self.command, "scene", *map(str, options), "--size", SIZE, "-q", "-o", path], check=True)
        return path

    def samples(self, scene, count):
        return self._file(f"{scene}-{count}.exr", scene, "--spp", count, "--seed", 5)

    def reference(self, scene):
        return self._file(f"{scene}-reference.exr", scene, "--reference", REFERENCE_SAMPLES, "--sampler", "sobol", "--seed", 77)


def measured(rpf, samples, reference, method):
    """-> correlation of pixels, of means, estimated over true relMSE"""
    settings = rpf.method_settings(method) if method else rpf.preset_settings("balanced")
    settings.backend, settings.estimate_error = "auto", True
    image = rpf.filter(rpf.read(samples), settings=settings)
    color, truth = (np.asarray(i.pixels[..., :3], float) for i in (image, rpf.read_image(reference)))
    true = (np.square(color - truth) / (np.square(truth) + 0.01)).mean(-1)
    estimated = np.square(np.asarray(image.features.pixels[..., -1], float))
    means = correlation(means_around(estimated), means_around(true))
    return correlation(estimated, true), means, estimated.sum() / true.sum()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", default=PROJECT / "build/release")
    parser.add_argument("--scenes", default="dof,soft-shadow,combined")
    parser.add_argument("--counts", default="4,16")
    parser.add_argument("--page")
    options = parser.parse_args()
    build = Path(options.build).resolve()
    sys.path.insert(0, str(build / "python/package"))
    import rpf  # pylint: disable=import-outside-toplevel
    scenes = options.scenes.split(",")
    lines = ["| | samples a pixel | " + " | ".join(f"`{scene}`" for scene in scenes) + " |", "|---" * (2 + len(scenes)) + "|"]
    with tempfile.TemporaryDirectory() as folder:
        files = Scenes(build / "rpf", folder)
        for name, method in METHODS.items():
            for count in map(int, options.counts.split(",")):
                cells = ["{:.2f}, {:.2f}; {:.2f}".format(*measured(rpf, files.samples(s, count), files.reference(s), method)) for s in scenes]
                lines.append(f"| {name} | {count} | " + " | ".join(cells) + " |")
                print(lines[-1], flush=True)
    if options.page:
        write_table(options.page, "errors", lines)


if __name__ == "__main__":
    main()
