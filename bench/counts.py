"""Do more samples help? Error of the presets and of the plain mean against the number of samples a pixel, on four scenes.

Usage: counts.py [--build BUILD] [--presets fast,balanced,high] [--page docs/trade.md] [--scenes ...] [--counts ...]

Files and errors are kept in BUILD/counts; a run that was stopped goes on where it was. --page replaces the table between
<!-- counts --> and <!-- end --> there, and writes docs/images/counts.png. Exit code 1: somewhere a preset is above the plain mean.
"""
import argparse
import hashlib
import json
import subprocess
import sys
from pathlib import Path

from marked_page import write_table

PROJECT = Path(__file__).resolve().parent.parent
SIZE, REFERENCE_SAMPLES = "240x135", 2048
MEASURES = ("relMSE", "FLIP")
MEAN = ("--method", "rpf", "--boxes", "none")


def hash_of(program):
    """Of the program, which has the presets' networks in it: errors of another are no errors of this."""
    return hashlib.sha256(program.read_bytes()).hexdigest()[:16]


class Counts:
    def __init__(self, options):
        build = Path(options.build).resolve()
        self.rpf, self.work, self.presets = build / "rpf", build / "counts", options.presets.split(",")
        self.work.mkdir(exist_ok=True)
        self.book = self.work / f"errors-{hash_of(self.rpf)}.json"
        self.errors = json.loads(self.book.read_text()) if self.book.exists() else {}

    def run(self, *arguments):
        return subprocess.run([self.rpf, *map(str, arguments)], check=True, stdout=subprocess.PIPE, text=True).stdout

    def reference(self, scene):
        path = self.work / f"{scene}.reference.exr"
        if not path.exists():
            self.run("scene", scene, "--size", SIZE, "--reference", REFERENCE_SAMPLES, "--sampler", "sobol", "--seed", 77, "-o", path, "-q")
        return path

    def measure(self, scene, count):
        """{method: {measure: error}}"""
        samples = self.work / "samples.exr"
        self.run("scene", scene, "--size", SIZE, "--spp", count, "-o", samples, "-q")
        images = {name: self.work / f"{name}.exr" for name in ("mean", *self.presets)}
        for name, image in images.items():
            self.run(samples, *(MEAN if name == "mean" else ("--preset", name)), "-o", image, "-q")
        errors = json.loads(self.run("compare", "--json", *images.values(), self.reference(scene)))["images"]
        samples.unlink()
        return {name: {m: e[m] for m in MEASURES} for name, e in zip(images, errors)}

    def row(self, scene, count):
        key = f"{scene} {count}"
        if key not in self.errors:
            self.errors[key] = self.measure(scene, count)
            self.book.write_text(json.dumps(self.errors, indent=1))
            print(key, {n: round(e["relMSE"], 5) for n, e in self.errors[key].items()}, flush=True)
        return self.errors[key]


def table(rows, presets):
    """rows: {(scene, count): errors}. Each cell: relMSE / FLIP; parts of the mean's for the presets, in bold where above it."""
    head = ["scene, samples a pixel", "mean"] + [f"{p}: parts of the mean's" for p in presets]
    lines = ["| " + " | ".join(head) + " |", "|---" * len(head) + "|"]
    part = lambda p: f"**{p:.2f}**" if p > 1 else f"{p:.2f}"
    for (scene, count), errors in rows.items():
        mean = errors["mean"]
        cells = [" / ".join(part(errors[p][m] / mean[m]) for m in MEASURES) for p in presets]
        lines.append(f"| {scene}, {count} | {mean['relMSE']:.3g} / {mean['FLIP']:.3f} | " + " | ".join(cells) + " |")
    return lines


def plot(rows, methods, path):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    scenes = list(dict.fromkeys(scene for scene, _ in rows))
    figure, axes = plt.subplots(len(MEASURES), len(scenes), figsize=(3 * len(scenes), 5), squeeze=False)
    for column, scene in enumerate(scenes):
        counts = [c for s, c in rows if s == scene]
        for panel, measure in zip(axes[:, column], MEASURES):
            for method in methods:
                style = dict(color="0.5", linestyle="--") if method == "mean" else {}
                panel.loglog(counts, [rows[scene, c][method][measure] for c in counts], marker=".", label=method, **style)
            panel.set_xticks(counts, [str(c) for c in counts], minor=False)
            panel.set_title(f"{scene}: {measure}", fontsize=9)
            panel.grid(True, linewidth=0.3)
    axes[0, 0].legend(fontsize=7)
    figure.supxlabel("samples a pixel", fontsize=9)
    figure.tight_layout()
    figure.savefig(path, dpi=80)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", default=PROJECT / "build/release")
    parser.add_argument("--presets", default="fast,balanced,high")
    parser.add_argument("--page")
    parser.add_argument("--scenes", default="dof,motion,soft-shadow,glossy")
    parser.add_argument("--counts", default="1,2,4,8,16,64,256")
    options = parser.parse_args()
    counts = Counts(options)
    rows = {(scene, count): counts.row(scene, count) for scene in options.scenes.split(",") for count in map(int, options.counts.split(","))}
    lines = table(rows, counts.presets)
    print("\n".join(lines))
    if options.page:
        write_table(options.page, "counts", lines)
        plot(rows, ["mean", *counts.presets], PROJECT / "docs/images/counts.png")
    return int(any(e[p][m] > e["mean"][m] for e in rows.values() for p in counts.presets for m in MEASURES))


if __name__ == "__main__":
    sys.exit(main())
