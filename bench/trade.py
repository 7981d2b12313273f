"""Speed against accuracy: measures bench/trade_plan.json and writes the tables and plots of docs/trade.md.

Usage: trade.py [--build BUILD] [--plan PLAN] [--rounds N] [--only-plots]

BUILD is a release build (default build/release). Needs numpy and matplotlib. Everything measured is kept in BUILD/trade; a run
that was stopped goes on where it was, and what is deleted there is measured again. Files of the plan that are not there
are left out. Open Image Denoise comes from PyPI into a virtual environment and is left out where that is impossible.
"""
import argparse
import json
import os
import subprocess
import sys
from pathlib import Path

import oidn
from marked_page import replace
from trade_plots import plot_frame, plot_summary
from trade_tables import chosen_table, frames_table, settings_table

PROJECT = Path(__file__).resolve().parent.parent
PAGE, PICTURES = PROJECT / "docs/trade.md", PROJECT / "docs/images"
MEANS, MEAN_SEED = (8, 16, 32, 64), 1001  # samples a pixel; a seed that is not the sample files'


class Trade:
    def __init__(self, options):
        build = Path(options.build).resolve()
        self.rpf, self.work = build / "rpf", build / "trade"
        self.work.mkdir(exist_ok=True)
        self.plan = present_frames(Path(options.plan).resolve())
        self.rounds = options.rounds or self.plan["rounds"]
        self.results = self.work / "results.jsonl"
        book = self.work / "others.json"
        self.others = json.loads(book.read_text()) if book.exists() else {}

    def keep(self, key, measure):
        """What was measured under this name, or is now."""
        if key not in self.others:
            print("trade:", key, flush=True)
            self.others[key] = measure()
            (self.work / "others.json").write_text(json.dumps(self.others, indent=1))
        return self.others[key]

    def run(self, *arguments):
        return subprocess.run([self.rpf, *map(str, arguments)], check=True, stdout=subprocess.PIPE, text=True).stdout

    def sweep(self):
        plan = self.work / "plan.json"
        plan.write_text(json.dumps(self.plan))
        subprocess.run([self.rpf, "bench", "sweep", plan, "-o", self.results, "--rounds", str(self.rounds)], check=True)

    def files(self, frame):
        """Samples and reference, as the sweep names those of scenes."""
        if "samples" in frame:
            return Path(frame["samples"]), Path(frame["reference"])
        stem = f"{self.results}.scenes/{frame['scene']}-{frame['size']}"
        return Path(f"{stem}-{frame['spp']}spp.samples.exr"), Path(f"{stem}-{frame['reference_spp']}spp.reference.exr")

    def error(self, image, reference):
        return json.loads(self.run("compare", "--json", image, reference))["images"][0]

    def mean_error(self, frame, spp):
        """Of the plain mean of more samples a pixel."""
        image = self.work / "mean.exr"
        self.run("scene", frame["scene"], "--size", frame["size"], "--reference", spp, "--sampler", "random", "--seed",
                 MEAN_SEED, "-o", image, "-q")
        return self.error(image, self.files(frame)[1])

    def oidn(self, python, frame):
        """Cost and error of Open Image Denoise. Its rounds are not those of the sweep: it is no setting of rpf."""
        samples, reference = self.files(frame)
        measured = oidn.denoise(self.rpf, python, samples, self.work, self.rounds)
        for name in (oidn.NOISY, oidn.CLEAN):
            measured[name]["error"] = self.error(measured[name].pop("image"), reference)
        return measured

    def measure(self):
        self.sweep()
        for frame in self.plan["frames"]:
            if "scene" in frame:
                for spp in MEANS:
                    self.keep(f"{frame['name']}: mean of {spp}", lambda: self.mean_error(frame, spp))
        python = oidn.python_with_oidn(self.work / "venv")
        if python:
            for frame in self.plan["frames"]:
                self.keep(f"{frame['name']}: OIDN", lambda: self.oidn(python, frame))

    def points(self):
        """{frame: {setting: {"cpu", "wall", "relMSE", "FLIP", "energy"}}}, medians over the rounds, in the plan's order."""
        lines = [json.loads(line) for line in self.results.read_text().splitlines()]
        table = {}
        for frame in self.plan["frames"]:
            row = table[frame["name"]] = {}
            for name, options in self.plan["settings"].items():
                mine = [l for l in lines if l["frame"] == frame["name"] and l["options"] == options]
                if mine:
                    row[name] = point(mine[0]["error"], [l["cpu"] for l in mine], [l["wall"] for l in mine])
            self.add_others(frame["name"], row)
        return table

    def add_others(self, frame, row):
        for spp in MEANS:
            if f"{frame}: mean of {spp}" in self.others:
                row[f"mean of {spp}"] = point(self.others[f"{frame}: mean of {spp}"], [], [])
        for name in (oidn.NOISY, oidn.CLEAN):
            measured = self.others.get(f"{frame}: OIDN", {}).get(name)
            if measured:  # it needs the mean of the samples first, which is read and averaged by rpf
                start = row["mean"]
                row[name] = point(measured["error"], [start["cpu"] + s for s in measured["cpu"]],
                                  [start["wall"] + s for s in measured["wall"]])


def point(error, cpu, wall):
    def median(values):
        middle = sorted(values)
        return (middle[(len(middle) - 1) // 2] + middle[len(middle) // 2]) / 2 if middle else None
    return {"cpu": median(cpu), "wall": median(wall), "relMSE": error["relMSE"], "FLIP": error["FLIP"], "energy": error["energy"],
            "cpu_range": [min(cpu), max(cpu)] if cpu else None}


def present_frames(path):
    """The plan without the frames whose files are not there, its paths made absolute."""
    plan = json.loads(path.read_text())
    frames = []
    for frame in plan["frames"]:
        for name in ("samples", "reference"):
            if name in frame:
                frame[name] = str((path.parent / os.path.expandvars(frame[name])).resolve())
        if "samples" in frame and not Path(frame["samples"]).exists():
            print(f"trade: {frame['name']} is left out: {frame['samples']} is not there")
        else:
            frames.append(frame)
    plan["frames"] = frames
    return plan


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--build", default=PROJECT / "build/release")
    parser.add_argument("--plan", default=PROJECT / "bench/trade_plan.json")
    parser.add_argument("--rounds", type=int)
    parser.add_argument("--only-plots", action="store_true", help="from what is measured already")
    options = parser.parse_args()
    trade = Trade(options)
    if not options.only_plots:
        trade.measure()
    points = trade.points()
    PICTURES.mkdir(exist_ok=True)
    for frame, row in points.items():
        plot_frame(frame, row, PICTURES)
    plot_summary(points, PICTURES)
    page = PAGE.read_text(encoding="utf-8")
    page = replace(page, "summary", chosen_table(points))
    page = replace(page, "settings", settings_table(trade.plan["settings"], points))
    page = replace(page, "frames", frames_table(points))
    PAGE.write_text(page, encoding="utf-8")


if __name__ == "__main__":
    main()
