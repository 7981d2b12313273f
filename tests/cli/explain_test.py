"""rpf explain as a user runs it. Usage: explain_test.py RPF PROJECT"""
import os
import re
import shutil
import signal
import subprocess
import sys
import time
import unittest

import numpy as np

import small_files
from command_case import EXAMPLE, RPF, CommandCase

signal.signal(signal.SIGINT, signal.SIG_DFL)  # a shell ignores it for what it starts in the background
WIDTH, HEIGHT = 64, 36


def run(*arguments):
    return subprocess.run([RPF, *map(str, arguments)], capture_output=True, text=True)


class ExplainTest(CommandCase):
    def setUp(self):
        super().setUp()
        self.output = self.folder / "explained"
        self.samples = self.folder / "combined.samples.exr"
        self.expect(run("scene", "combined", "--size", f"{WIDTH}x{HEIGHT}", "-o", self.samples, "-q"), 0)

    def explain(self, *arguments, box=9):
        return run("explain", self.samples, "-o", self.output, "--box", box, *arguments)

    def channels(self):
        told = subprocess.run(["oiiotool", "--info", "-v", str(self.output / "explain.exr")], capture_output=True, text=True)
        return set(re.search(r"channel list: (.*)", told.stdout).group(1).split(", "))

    def expect_nothing_written(self):
        self.assertEqual(list(self.folder.iterdir()), [self.samples])

    def test_writes_layers_pictures_and_a_page_that_needs_nothing_else(self):
        self.expect(self.explain(), 0, "index.html", f"{WIDTH}x{HEIGHT} pixels")
        self.assertLessEqual({"R", "filtered.G", "normal.X", "position.Z", "W.mean", "alpha.B", "beta.N.X", "share.lens",
                              "share.time", "share.light", "share.explained", "information.lens", "neighborhood.size",
                              "neighborhood.acceptance", "neighborhood.effective", "noise.remaining", "density"},
                             self.channels())
        page = (self.output / "index.html").read_text()
        pictures = list(self.output.glob("*.png"))
        self.assertEqual(page.count("<img"), len(pictures))
        self.assertEqual(page.count("<img"), page.count('src="data:image/png;base64,'))
        self.assertEqual(page.count('class="bar"'), len(pictures) - 6)  # all but colors, alpha and the groups' shares
        for name in ("lens", "time", "light", "no noise that these explain"):
            self.assertIn(f"</i>{name}</span>", page)
        self.assertNotIn("http", page)

    def test_explains_a_pixel(self):
        self.expect(self.explain("--pixel", "20,15"), 0)
        self.assertIn("pixel-20-15.html", (self.output / "index.html").read_text())
        page = (self.output / "pixel-20-15.html").read_text()
        for text in ("neighbors N", "W_c^r", "alpha", "beta", "lens.U", "<svg", "times drawn", "in the picture of balanced",
                     "effective samples", "albedo here"):
            self.assertIn(text, page)
        self.assertEqual(page.count("<img"), len(list((self.output / "pixel-20-15").glob("*.png"))))

    def test_explains_the_picture_of_the_preset_that_is_asked_for(self):
        self.expect(self.explain("--pixel", "20,15", "--preset", "fast", "-q"), 0)
        self.assertIn("in the picture of fast", (self.output / "pixel-20-15.html").read_text())
        self.expect(self.explain("--pixel", "20,15", "--preset", "slow"), 2, "slow")

    def test_the_density_is_one_to_render_with(self):
        self.expect(self.explain("-q"), 0)
        more = self.folder / "more.samples.exr"
        told = run("scene", "combined", "--size", f"{WIDTH}x{HEIGHT}", "--spp", 1, "--density", self.output / "density.exr",
                   "-o", more)
        self.expect(told, 0)
        samples = int(re.search(r"(\d+) samples", told.stdout).group(1))
        self.assertAlmostEqual(samples, 4 * WIDTH * HEIGHT, delta=0.02 * 4 * WIDTH * HEIGHT)

    def test_random_parameters_and_features_are_those_asked_for(self):
        self.expect(self.explain("--random", "bsdf,time", "--features", "none"), 0)
        layers = self.channels()
        self.assertLessEqual({"share.bsdf", "share.time"}, layers)
        self.assertFalse({name for name in layers if name.startswith("beta.")} | {"share.lens"} & layers)
        self.expect(self.explain("--random", "none"), 0)

    def test_replaces_what_an_earlier_run_wrote(self):
        for _ in range(2):
            self.expect(self.explain("-q"), 0)

    def test_errors(self):
        blocked = self.folder / "a file"
        for arguments, code, text in (
                (["--pixel", "64,0"], 2, "not inside the data window"),
                (["--pixel", "3"], 2, "X,Y is expected"),
                (["--features", "Nope"], 2, "Nope"),
                (["--max-memory", "1"], 6, "explaining needs")):
            with self.subTest(arguments):
                self.expect(self.explain(*arguments), code, text)
                self.expect_nothing_written()
        self.expect(self.explain(box=8), 2, "odd number")
        self.expect(run("explain", self.samples), 2, "a folder")
        self.expect(run("explain", self.folder / "none.exr", "-o", self.output), 3)
        self.expect(run("explain", self.samples, "-o", self.folder / "none" / "deeper"), 4)
        self.expect_nothing_written()
        blocked.write_text("")
        self.expect(run("explain", self.samples, "-o", blocked), 4, "Not a directory")

    def test_a_pixel_that_lost_all_its_samples_cannot_be_explained(self):
        for value in (np.nan, np.inf):
            channels = small_files.frame()
            channels["R"][:] = value
            small_files.write_raw(self.samples, channels)
            self.expect(run("explain", self.samples, "-o", self.output, "-q", "--pixel", "0,0"), 3, "pixel 0,0 has no samples")
            self.expect_nothing_written()

    def write_crowded_frame(self, samples):
        """The first pixel has so many, all others one."""
        frame, crowd = small_files.frame(spp=1), small_files.frame(1, 1, samples)
        small_files.write_raw(self.samples, {name: np.concatenate([crowd[name], values[1:]]) for name, values in frame.items()},
                              spp=[samples] + 47 * [1])

    def test_a_pixel_that_takes_too_much_memory_is_refused_before(self):
        self.write_crowded_frame(20000)
        result = run("explain", self.samples, "-o", self.output, "-q", "--pixel", "0,0", "--max-memory", "4000", "--backend", "cpu")
        self.expect(result, 6, "pixel 0,0", "the limit is 4000 MB", "fewer samples")
        self.assertRegex(result.stderr, r"needs 8\d\d\d MB")
        self.expect_nothing_written()

    def test_a_pixel_of_one_sample_is_told_in_silence(self):
        small_files.write_raw(self.samples, small_files.frame(spp=1), spp=1)
        result = run("explain", self.samples, "-o", self.output, "-q", "--pixel", "0,0")
        self.expect(result, 0)
        self.assertEqual(result.stdout + result.stderr, "")

    def test_a_crowded_neighborhood_makes_no_large_page(self):
        self.write_crowded_frame(20000)
        self.expect(run("explain", self.samples, "-o", self.output, "-q", "--pixel", "1,1"), 0)
        self.assertLess((self.output / "pixel-1-1.html").stat().st_size, 1 << 20)

    def test_a_signal_that_finds_gnuplot_at_work_cancels(self):
        """In place of gnuplot, a program that never ends."""
        tools = self.folder / "tools"
        tools.mkdir()
        begun = tools / "begun"
        (tools / "gnuplot").write_text(f'#!/bin/sh\n[ "$2" = --version ] && exit\n: > "{begun}"\nexec sleep 60\n')
        (tools / "gnuplot").chmod(0o755)
        process = subprocess.Popen([RPF, "explain", self.samples, "-o", self.output, "--box", "3", "-q", "--pixel", "1,1"],
                                   env={**os.environ, "PATH": f"{tools}:{os.environ['PATH']}"}, stderr=subprocess.PIPE, text=True)
        while not begun.exists():
            self.assertIsNone(process.poll())
            time.sleep(0.01)
        time.sleep(0.1)  # the script has become the program that is ended
        process.send_signal(signal.SIGTERM)
        self.assertEqual(process.communicate(timeout=60)[1], "rpf: error: cancelled\n")
        self.assertEqual(process.returncode, 143)
        self.assertFalse(self.output.exists())

    def test_what_cannot_be_replaced_is_told_before_the_work(self):
        page, pictures = self.output / "pixel-1-1.html", self.output / "pixel-1-1"
        protected = (self.output / "alpha.png", self.output / "beta-N-X.png", self.output / "information-lens.png", pictures / "histogram-lens.U.png")
        for path, made in ((self.output / "alpha.png", os.mkfifo), (page, os.mkdir), (pictures, lambda path: path.touch()),
                           *((path, lambda path: path.touch(0o444)) for path in protected)):
            with self.subTest(path=path.name):
                path.parent.mkdir(parents=True, exist_ok=True)
                made(path)
                before = sorted(self.output.rglob("*"))
                result = self.explain("--pixel", "1,1", "--progress", "always")
                self.expect(result, 4, path.name)
                self.assertNotIn("pass 1", result.stderr)
                self.assertEqual(sorted(self.output.rglob("*")), before)
                shutil.rmtree(self.output)

    def test_other_files_of_its_folder_are_none_of_its_business(self):
        self.output.mkdir()
        for name in ("photo.png", "page.html", "other.exr"):
            (self.output / name).touch(0o444)
        self.expect(self.explain("-q", "--pixel", "1,1"), 0)
        self.assertEqual((self.output / "photo.png").stat().st_size, 0)

    def test_a_signal_stops_it_and_leaves_nothing(self):
        process = subprocess.Popen([RPF, "explain", EXAMPLE, "-o", self.output, "--box", "55", "--progress", "always"],
                                   stderr=subprocess.PIPE)
        process.stderr.read(1)  # it has begun
        start = time.monotonic()
        process.send_signal(signal.SIGINT)
        process.communicate()
        self.assertEqual(process.returncode, 130)
        self.assertLess(time.monotonic() - start, 10)  # two seconds on a machine that has nothing else to do
        self.expect_nothing_written()


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
