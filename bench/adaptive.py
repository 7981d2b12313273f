"""What adaptive sampling is worth: `rpf adapt` against as many samples everywhere, for the plain mean and for a filtered frame.

Usage: adaptive.py [--build BUILD] [--scenes dof,soft-shadow] [--counts 8,16,32] [--seeds 2] [--preset balanced] [--page docs/explain.md]

Trimmed relMSE against a reference, means over the seeds. "Possible": what the best counts would save of the plain mean's error if each
pixel's variance were known, from 256 samples a pixel. Errors are kept in BUILD/adaptive; a run that was stopped goes on where it was.
--page replaces the table between <!-- adaptive --> and <!-- end --> there.
"""
import argparse
import json
import subprocess
from pathlib import Path

import numpy as np

from marked_page import write_table
from raw_samples import read_samples  # pylint: disable=no-name-in-module

PROJECT = Path(__file__).resolve().parent.parent
SIZE, REFERENCE_SAMPLES, VARIANCE_SAMPLES, FIRST = "240x135", 1024, 256, 4
MEAN = ("--boxes", "none")


class Adaptive:
    def __init__(self, options):
        build = Path(options.build).resolve()
        self.rpf, self.work, self.preset, self.seeds = build / "rpf", build / "adaptive", options.preset, range(1, options.seeds + 1)
        self.work.mkdir(exist_ok=True)
        self.book = self.work / "errors.json"
        self.errors = json.loads(self.book.read_text()) if self.book.exists() else {}

    def run(self, *arguments):
        return subprocess.run([self.rpf, *map(str, arguments)], check=True, stdout=subprocess.PIPE, text=True).stdout

    def scene(self, scene, output, *options):
        self.run("scene", scene, "--size", SIZE, "-q", "-o", output, *options)
        return output

    def reference(self, scene):
        path = self.work / f"{scene}.reference.exr"
        return path if path.exists() else self.scene(scene, path, "--reference", REFERENCE_SAMPLES, "--sampler", "sobol", "--seed", 77)

    def measure(self, scene, samples):
        """[trimmed relMSE of the plain mean, of the preset], and relMSE of the plain mean"""
        images = [self.work / "mean.exr", self.work / "filtered.exr"]
        for image, how in zip(images, (MEAN, ("--preset", self.preset))):
            self.run(samples, *how, "-o", image, "-q")
        told = json.loads(self.run("compare", "--json", *images, self.reference(scene)))["images"]
        return [e["trimmed_relMSE"] for e in told], told[0]["relMSE"]

    def adapted(self, scene, seed, counts):
        """{count: {adapted: errors, even: errors, estimated over true relMSE}}"""
        grown, found = self.scene(scene, self.work / "grown.exr", "--spp", FIRST, "--seed", 100 * seed), {}
        for count in counts:
            told = self.run("adapt", grown, "--spp", count, "--", self.rpf, "scene", scene, "--size", SIZE, "-q", "--spp", 1,
                            "--density", "{density}", "--seed", "{seed}", "-o", "{output}")
            adapted, true = self.measure(scene, grown)
            even, _ = self.measure(scene, self.scene(scene, self.work / "even.exr", "--spp", count, "--seed", 100 * seed + 50))
            found[str(count)] = {"adapted": adapted, "even": even, "estimated": float(told.split()[-1]) / true}
        return found

    def possible(self, scene):
        """Part of the plain mean's trimmed error that is saved where counts follow the root of the true variance."""
        raw = self.work / "many.rpf"
        _, counts, channels = read_samples(self.scene(scene, raw, "--spp", VARIANCE_SAMPLES, "--seed", 9))
        raw.unlink()
        colors = np.stack([channels[c].reshape(counts.size, -1) for c in "RGB"]).astype(float)
        variance = (colors.var(-1, ddof=1) / (colors.mean(-1) ** 2 + 0.01)).mean(0)
        variance = np.sort(variance)[: counts.size - counts.size // 1000]
        return 1 - np.sqrt(variance).mean() ** 2 / variance.mean()

    def known(self, key, make):
        if key not in self.errors:
            self.errors[key] = make()
            self.book.write_text(json.dumps(self.errors, indent=1))
            print(key, self.errors[key], flush=True)
        return self.errors[key]

    def rows(self, scene, counts):
        runs = [self.known(f"{scene} {seed} {counts}", lambda seed=seed: self.adapted(scene, seed, counts)) for seed in self.seeds]
        possible = self.known(f"{scene} possible", lambda: self.possible(scene))
        for count in map(str, counts):
            even, adapted = (np.mean([run[count][kind] for run in runs], 0) for kind in ("even", "adapted"))
            estimated = np.mean([run[count]["estimated"] for run in runs])
            cells = [f"{e:.3g}, {a:.3g} | {100 * (a / e - 1):+.0f} %" for e, a in zip(even, adapted)]
            yield f"| `{scene}`, {count} | {cells[0]} | {-100 * possible:.0f} % | {cells[1]} | {estimated:.2f} |"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", default=PROJECT / "build/release")
    parser.add_argument("--scenes", default="dof,soft-shadow")
    parser.add_argument("--counts", default="8,16,32")
    parser.add_argument("--seeds", type=int, default=2)
    parser.add_argument("--preset", default="balanced")
    parser.add_argument("--page")
    options = parser.parse_args()
    adaptive = Adaptive(options)
    lines = [f"| scene, samples a pixel | plain mean: even, adapted | | possible | `{options.preset}`: even, adapted | | estimated / true |", "|---" * 7 + "|"]
    for scene in options.scenes.split(","):
        lines += adaptive.rows(scene, [int(count) for count in options.counts.split(",")])
    print("\n".join(lines))
    if options.page:
        write_table(options.page, "adaptive", lines)


if __name__ == "__main__":
    main()
