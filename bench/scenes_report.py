"""Measures every scene and writes the tables, pictures and plot of docs/scenes.md. Usage: scenes_report.py [BUILD]

BUILD is a release build with tests (default build/release). Needs numpy, matplotlib and Pillow. Everything measured is
kept in BUILD/scenes-report; a run that was stopped goes on where it was, and what is deleted there is measured again.
"""
import json
import resource
import subprocess
import sys
from pathlib import Path

import matplotlib
import numpy as np
from PIL import Image

matplotlib.use("Agg")
import matplotlib.pyplot as plt

from marked_page import write_table

PROJECT = Path(__file__).resolve().parent.parent
BUILD = Path(sys.argv[1] if len(sys.argv) > 1 else PROJECT / "build/release").resolve()
RPF, TO_FLOATS = BUILD / "rpf", BUILD / "tests/image_to_floats"
WORK, PICTURES, PAGE = BUILD / "scenes-report", PROJECT / "docs/images/scenes", PROJECT / "docs/scenes.md"

SIZE, REFERENCE = "192x108", ["--reference", 1024, "--sampler", "sobol"]
PLOT_SIZE, PLOT_REFERENCE, SEEDS = "96x54", ["--reference", 2048, "--sampler", "sobol"], 32
SMALL_BOXES = ["--profile", "paper", "--boxes", "21,11,5", "--samples-factor", "2", "--noise", "0.002"]
FILTERS = {"thesis": ["--profile", "thesis"], "paper": ["--profile", "paper"], "small": SMALL_BOXES}
FILES = "-t 1 -q".split()


def run(*arguments):
    """Runs rpf; returns its CPU seconds."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run([RPF, *map(str, arguments)], check=True, stdout=subprocess.DEVNULL)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def error(image, reference):
    output = subprocess.run([RPF, "compare", "--json", image, reference], check=True, capture_output=True, text=True).stdout
    measured = json.loads(output)["images"][0]
    return {"relMSE": measured["relMSE"], "energy": measured["energy"]}


class Notebook:
    """Measurements by name, kept in a file: each is made once."""

    def __init__(self, path):
        self.path = path
        self.pages = json.loads(path.read_text()) if path.exists() else {}

    def get(self, scene, name, measure):
        page = self.pages.setdefault(scene, {})
        if name not in page:
            print(scene, name, flush=True)
            page[name] = measure()
            self.path.write_text(json.dumps(self.pages, indent=1))
        return page[name]


def make(path, *arguments):
    """Has rpf write a file unless it is there; returns its path."""
    if not path.exists():
        run(*arguments, "-o", path, *FILES)
    return path


def measure_scene(scene, book):
    folder = WORK / scene
    folder.mkdir(parents=True, exist_ok=True)
    book.get(scene, "seconds", lambda: run("scene", scene, "-o", folder / "time.exr", *FILES))
    (folder / "time.exr").unlink(missing_ok=True)
    reference = make(folder / "reference.exr", "scene", scene, "--size", SIZE, *REFERENCE)
    for spp in (4, 8):
        samples = make(folder / f"{spp}.samples.exr", "scene", scene, "--size", SIZE, "--spp", spp)
        mean = make(folder / f"{spp}.mean.exr", samples, "--boxes", "none")
        book.get(scene, f"mean {spp}", lambda: error(mean, reference))
    samples = folder / "4.samples.exr"
    for name, options in FILTERS.items():
        image = folder / f"{name}.exr"
        book.get(scene, f"{name} seconds", lambda: run(samples, *options, "-o", image, *FILES))
        book.get(scene, name, lambda: error(image, reference))


def floats(image):
    out = WORK / "floats"
    width, height = map(int, subprocess.run([TO_FLOATS, image, out], check=True, capture_output=True).stdout.split())
    return np.fromfile(out, np.float32).reshape(height, width, 3).astype(float)


def seed_means(scene):
    """The plain means of 4 samples a pixel, [seed][y][x][channel]."""
    samples, mean, means = WORK / "seed.samples.exr", WORK / "seed.exr", []
    for seed in range(1001, 1001 + SEEDS):
        run("scene", scene, "--size", PLOT_SIZE, "--seed", seed, "-o", samples, *FILES)
        run(samples, "--boxes", "none", "-o", mean, *FILES)
        means.append(floats(mean))
    return np.array(means)


def converge(scene):
    """relMSE of the mean over 1, 2, 4, ... seeds, averaged over all groups of so many."""
    reference = floats(make(WORK / scene / "plot.reference.exr", "scene", scene, "--size", PLOT_SIZE, *PLOT_REFERENCE))
    means, errors = seed_means(scene), []
    while len(means) > 0:
        errors.append(float(np.mean((means - reference) ** 2 / (reference ** 2 + 0.01))))
        means = (means[0::2] + means[1::2]) / 2 if len(means) > 1 else []
    return errors


def picture(scene):
    """4 samples a pixel | thesis | reference, as a small JPEG."""
    folder = WORK / scene
    run("compare", folder / "4.mean.exr", folder / "thesis.exr", folder / "reference.exr", "--side-by-side", folder / "picture.png")
    PICTURES.mkdir(parents=True, exist_ok=True)
    doubled = Image.open(folder / "picture.png").convert("RGB")  # compare doubles the pixels of small images
    doubled.resize((doubled.width // 2, doubled.height // 2), Image.Resampling.BOX).save(PICTURES / f"{scene}.jpg", quality=80, optimize=True)


def slope(errors):
    return float(np.polyfit(np.log(2.0 ** np.arange(len(errors))), np.log(errors), 1)[0])


def plot(book, scenes):
    figure, axes = plt.subplots(figsize=(7.2, 4.6))
    seeds = 2 ** np.arange(SEEDS.bit_length())
    for number, scene in enumerate(scenes):
        errors = book.pages[scene]["converge"]
        if min(errors) > 0:
            axes.loglog(seeds, errors, marker="osv^D"[number % 5], markersize=3, linewidth=1,
                        color=plt.get_cmap("tab20")(number), label=f"{scene} ({slope(errors):.2f})")
    axes.loglog(seeds, 0.02 / seeds, "k--", linewidth=1, label="1/N (-1)")
    axes.set_xticks(seeds, seeds)
    axes.set_xlabel("seeds N, 4 samples a pixel each")
    axes.set_ylabel("relMSE of their mean, averaged over all groups of N of 32")
    axes.legend(fontsize=7, loc="center left", bbox_to_anchor=(1, 0.5), title="slope")
    figure.tight_layout()
    figure.savefig(PICTURES / "convergence.png", dpi=90)


def scene_table(book, purposes):
    rows = ["| scene: 4 samples a pixel, `thesis`, reference | for | relMSE at 4 | at 8 | seconds |", "|---|---|---|---|---|"]
    for scene, purpose in purposes.items():
        page = book.pages[scene]
        rows.append(f"| `{scene}`<br>![{scene}](images/scenes/{scene}.jpg) | {purpose} | {page['mean 4']['relMSE']:.3g} | "
                    f"{page['mean 8']['relMSE']:.3g} | {page['seconds']:.1f} |")
    return rows


def filter_cell(page, name):
    before, after = page["mean 4"]["relMSE"], page[name]
    worse = after["relMSE"] > before
    text = f"{after['relMSE']:.3g}, {after['energy']:.3f}"
    return f"**{text}, worse**" if worse else text


def filter_table(book, purposes):
    rows = ["| scene | plain mean | `thesis` | `paper` | small boxes | CPU seconds |", "|---|---|---|---|---|---|"]
    for scene in purposes:
        page = book.pages[scene]
        seconds = " / ".join(f"{page[name + ' seconds']:.0f}" for name in FILTERS)
        rows.append(f"| `{scene}` | {page['mean 4']['relMSE']:.3g}, {page['mean 4']['energy']:.3f} | "
                    f"{' | '.join(filter_cell(page, name) for name in FILTERS)} | {seconds} |")
    return rows


def main():
    listed = subprocess.run([RPF, "scene", "--list"], check=True, capture_output=True, text=True).stdout
    purposes = dict(line.split(maxsplit=1) for line in listed.splitlines())
    WORK.mkdir(parents=True, exist_ok=True)
    book = Notebook(WORK / "measured.json")
    for scene in purposes:
        measure_scene(scene, book)
        picture(scene)
    for scene in purposes:
        book.get(scene, "converge", lambda: converge(scene))
    plot(book, purposes)
    write_table(PAGE, "scenes", scene_table(book, purposes))
    write_table(PAGE, "filters", filter_table(book, purposes))


main()
