"""Presets beside Open Image Denoise with noisy features, frame by frame, on the same samples.

Usage: quality.py FOLDER... [--build BUILD] [--presets fast,balanced,high] [--samples N [--page PAGE]] [--json OUT.json]
                  [--pictures DIR --of NAME,NAME]

A FOLDER holds NAME.samples.exr or .rpf and NAME.reference.exr or .rpf (NAME-4spp.samples.exr and NAME.ref.exr are found too).
Ratios are to Open Image Denoise, of trimmed relMSE and of FLIP: below 1 is better than it. --samples takes the first N samples of
every pixel and leaves out, and says so, frames that have fewer. --page replaces the table between <!-- quality N --> and
<!-- end --> there. --pictures writes DIR/NAME.png of these frames: plain mean, presets, Open Image Denoise and
reference in a row, and below the part where the mean is worst, enlarged.
"""
import argparse
import json
import math
import subprocess
import sys
import tempfile
from pathlib import Path

import oidn
import raw_samples
from marked_page import write_table

PROJECT = Path(__file__).resolve().parent.parent


def frames_of(folders):
    """[(name, samples, reference)]: by the names of the samples' files, under those of the references."""
    frames = []
    for folder in map(Path, folders):
        for samples in sorted(folder.glob("*.samples.*")):
            name = samples.name.split(".samples.")[0]
            stems = [name, name.rsplit("-", 1)[0]]
            found = [(s, p) for s in stems for kind in ("reference", "ref") for p in folder.glob(f"{s}.{kind}.*")]
            if found:
                stem, reference = found[0]
                frames.append((stem, samples, reference))
            else:
                print(f"quality: {samples} has no reference beside it", file=sys.stderr)
    return frames


class Measurement:
    def __init__(self, rpf, python, presets, work, pictures=None, pictured=()):
        self.rpf, self.python, self.presets, self.work, self.pictures, self.pictured = rpf, python, presets, work, pictures, pictured

    def run(self, *arguments):
        return subprocess.run([self.rpf, *map(str, arguments)], check=True, stdout=subprocess.PIPE, text=True).stdout

    def as_image(self, path):
        """References may be sample files of one sample a pixel."""
        if path.suffix != ".rpf":
            return path
        image = self.work / "reference.exr"
        self.run(path, "--method", "rpf", "--boxes", "none", "-o", image, "-q")
        return image

    def first_samples(self, samples, n):
        """The file of the first n samples of every pixel; None where there are fewer."""
        raw, some = self.work / "all.rpf", self.work / "some.rpf"
        self.run("convert", samples, "-o", raw)
        header, counts, channels = raw_samples.first_samples(raw_samples.read_samples(raw), n)
        if counts.min() < n:
            return None
        raw_samples.write_samples(some, header["dataWindow"], counts, channels, header["metadata"])
        return some

    def frame(self, name, samples, reference):
        """{method: errors} of one frame."""
        images = {"mean": self.work / "mean.exr"}
        self.run(samples, "--method", "rpf", "--boxes", "none", "-o", images["mean"], "-q")
        for preset in self.presets:
            images[preset] = self.work / f"{preset}.exr"
            self.run(samples, "--preset", preset, "-o", images[preset], "-q")
        if self.python:
            images[oidn.NOISY] = oidn.denoise(self.rpf, self.python, samples, self.work, 1)[oidn.NOISY]["image"]
        picture = ("--side-by-side", self.pictures / f"{name}.png") if name in self.pictured else ()
        errors = json.loads(self.run("compare", "--json", *images.values(), self.as_image(reference), *picture))["images"]
        measured = dict(zip(images, errors))
        for error in measured.values():
            error["relative_energy"] = error["energy"] / measured["mean"]["energy"]
        return measured


def geometric(values):
    return math.exp(sum(map(math.log, values)) / len(values))


def table(results, presets):
    """A frame each, then geometric means."""
    ratio = lambda errors, name, key: errors[name][key] / errors[oidn.NOISY][key]
    head = ["frame", "mean", "OIDN"] + [f"{p}: relMSE, ratio, FLIP ratio, energy" for p in presets]
    rows = ["| " + " | ".join(head) + " |", "|---" * len(head) + "|"]
    for name, errors in results.items():
        cells = [name] + [f"{errors[m]['trimmed_relMSE']:.4f}" for m in ("mean", oidn.NOISY)]
        for p in presets:
            e = errors[p]
            cells.append(f"{e['trimmed_relMSE']:.4f}, **{ratio(errors, p, 'trimmed_relMSE'):.2f}**, {ratio(errors, p, 'FLIP'):.2f}, {e['relative_energy']:.3f}")
        rows.append("| " + " | ".join(cells) + " |")
    means = [f"{geometric([e[m]['trimmed_relMSE'] for e in results.values()]):.4f}" for m in ("mean", oidn.NOISY)]
    for p in presets:
        both = [geometric([ratio(e, p, key) for e in results.values()]) for key in ("trimmed_relMSE", "FLIP")]
        worst = max(ratio(e, p, "trimmed_relMSE") for e in results.values())
        means.append(f"**{both[0]:.3f}**, FLIP {both[1]:.3f}, worst {worst:.2f}")
    return rows + ["| " + " | ".join([f"**{len(results)} frames**"] + means) + " |"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folders", nargs="+")
    parser.add_argument("--build", default=PROJECT / "build/release")
    parser.add_argument("--presets", default="fast,balanced,high")
    parser.add_argument("--samples", type=int)
    parser.add_argument("--page")
    parser.add_argument("--json")
    parser.add_argument("--pictures", type=Path)
    parser.add_argument("--of", default="")
    options = parser.parse_args()
    if options.page and not options.samples:
        parser.error("--page has a table for each number of samples: give --samples too")
    build, presets = Path(options.build).resolve(), options.presets.split(",")
    python = oidn.python_with_oidn(build / "oidn")
    if not python:
        return 1
    results = {}
    with tempfile.TemporaryDirectory() as work:
        measurement = Measurement(build / "rpf", python, presets, Path(work), options.pictures, options.of.split(","))
        for name, samples, reference in frames_of(options.folders):
            if options.samples:
                samples = measurement.first_samples(samples, options.samples)
                if not samples:
                    print(f"quality: {name} has fewer than {options.samples} samples in a pixel, and is left out", file=sys.stderr)
                    continue
            results[name] = measurement.frame(name, samples, reference)
            print(table({name: results[name]}, presets)[2], flush=True)
    rows = table(results, presets)
    print("\n".join(rows))
    if options.json:
        Path(options.json).write_text(json.dumps(results, indent=1))
    if options.page:
        write_table(options.page, f"quality {options.samples}", rows)
    return 0


if __name__ == "__main__":
    sys.exit(main())
