"""Values that contradict the convention of docs/file-format.md, and those that are none: what is said about them, by
`rpf info` and by the filter. Usage: conventions_test.py RPF PROJECT"""
import re
import subprocess
import sys
import unittest

import numpy as np

from command_case import EXAMPLE, RPF, CommandCase
from small_files import frame, write_exr, write_raw

FAST = ["--backend", "cpu", "--boxes", "3", "--max-samples", "20"]
W, H, SPP = 8, 6, 4


def run(*arguments):
    return subprocess.run([RPF, *map(str, arguments)], capture_output=True, text=True, timeout=300, check=False)


class ConventionsTest(CommandCase):
    def setUp(self):
        super().setUp()
        self.samples, self.output = self.folder / "s.rpf", self.folder / "out.exr"

    def notes(self, channels, **shape):
        """What both say: the notes without the sentences around them."""
        write_raw(self.samples, channels, **shape)
        info = run("info", self.samples)
        self.expect(info, 0)
        filtered = run(*FAST, self.samples, "-o", self.output)
        self.expect(filtered, 0)
        said = re.findall(r"note: (.*)", info.stdout)
        for note in said:
            self.assertIn(note, filtered.stderr)
        return said

    def expect_note(self, channels, *texts, **shape):
        notes = self.notes(channels, **shape)
        self.assertEqual(len(notes), 1, notes)
        for text in texts:
            self.assertIn(text, notes[0])

    def test_frames_that_keep_it_are_not_spoken_of(self):
        self.assertEqual(self.notes(frame()), [])
        self.assertEqual(self.notes(frame(x0=-37, y0=-12), x0=-37, y0=-12), [])
        self.assertEqual(self.notes(frame(x0=100000), x0=100000), [])
        self.assertNotIn("note:", run("info", EXAMPLE).stdout)

    def test_pixels_that_weigh_nothing_are_told(self):
        weights = np.ones(W * H * SPP, np.float32)
        weights[2 * SPP:4 * SPP + 1] = 0  # of pixels 2 and 3, and a sample of the next
        write_raw(self.samples, {**frame(), "weight": weights})
        for preset in ([], ["--profile", "thesis"]):
            result = run("--backend", "cpu", *preset, "--crop", "2x2+0+0", self.samples, "-o", self.output)
            self.expect(result, 0, "pixels whose samples all have weight 0: 2 (first at pixel 2,0)")

    def test_no_scene_of_ours_contradicts_it(self):
        for line in run("scene", "--list").stdout.splitlines():
            path = self.folder / "scene.exr"
            self.expect(run("scene", line.split()[0], "--size", "24x16", "--spp", "4", "-o", path, "-q"), 0)
            said = run("info", path).stdout
            if line.split()[0] == "noise":  # of which nothing is meant to be what its name says
                self.assertIn("note: normals", said)
            else:
                self.assertNotIn("note:", said, line)

    # ---- film positions: count, first pixel, what they look like

    def test_film_positions_in_other_conventions(self):
        y, x = (v.repeat(SPP) for v in np.mgrid[0:H, 0:W].reshape(2, -1))

        def changed(to_x, to_y):
            channels = frame()
            fx, fy = channels["film.X"].astype(float), channels["film.Y"].astype(float)
            channels["film.X"], channels["film.Y"] = to_x(fx, fy), to_y(fx, fy)
            return channels
        outside = W * H * SPP
        cases = {"places inside the pixel": (lambda a, b: a - x, lambda a, b: b - y), "parts of the frame": (lambda a, b: a / W, lambda a, b: b / H),
                 "distances from the pixel's center": (lambda a, b: a - x - 0.5, lambda a, b: b - y - 0.5), "count y from the top": (lambda a, b: a, lambda a, b: H - b),
                 "exchange": (lambda a, b: b, lambda a, b: a), "equally far away": (lambda a, b: a + 1000, lambda a, b: b + 1000)}
        for text, how in cases.items():
            notes = self.notes(changed(*how))
            note = next(n for n in notes if "film positions outside their pixel" in n)
            self.assertIn(text, note)
            count = int(re.search(r": (\d+) \(first at pixel \d+,\d+\)", note).group(1))
            self.assertGreater(count, outside * 0.7, text)
            self.assertLessEqual(count, outside)

    def test_one_film_position_outside(self):
        channels = frame()
        channels["film.X"][SPP * (2 * W + 3) + 1] = 7.5
        self.expect_note(channels, "film positions outside their pixel", ": 1 (first at pixel 3,2)", "plus the place inside it")

    # ---- random numbers, normals, reflectances, positions, copies

    def test_random_numbers(self):
        channels = frame()
        channels["random.lens.U"] = 2 * channels["random.lens.U"] - 1
        self.expect_note(channels, "random numbers outside 0 to 1 (random.lens.U)", "-1 to 1", "(r + 1) / 2")
        channels["random.lens.U"] = 7 * channels["random.lens.V"] + 2
        self.expect_note(channels, "random numbers outside 0 to 1 (random.lens.U)", f": {W * H * SPP} (first at pixel 0,0)", "in [0,1)")

    def test_vectors_that_are_not_whole(self):
        for left_out, text in (("feature.N.Z", "pixels of N without Z"), ("feature.albedo.R", "pixels of albedo without R")):
            channels = {name: values for name, values in frame().items() if name != left_out}
            self.expect_note(channels, text, "write all of", f": {W * H} (first at pixel 0,0)")
        gray = {name: values for name, values in frame().items() if name not in ("feature.albedo.G", "feature.albedo.B")}
        self.assertEqual(self.notes(gray), [])

    def test_hits(self):
        channels = {**frame(), "feature.hit": np.ones(W * H * SPP, np.float32)}
        self.assertEqual(self.notes(channels), [])
        channels["feature.hit"][SPP * (2 * W + 3)] = 0.5
        self.expect_note(channels, "values of hit that are neither 0 nor 1", ": 1 (first at pixel 3,2)")

    def test_alpha(self):
        channels = {**frame(), "A": np.ones(W * H * SPP, np.float32)}
        self.assertEqual(self.notes(channels), [])
        channels["A"][SPP * (2 * W + 3)] = 1.5
        self.expect_note(channels, "values of alpha outside 0 to 1; write the part", ": 1 (first at pixel 3,2)")
        channels["A"][:] = 255
        self.expect_note(channels, "values of alpha outside 0 to 1, which look like 0 to 255", f": {W * H * SPP} (first at pixel 0,0)")

    def test_hits_without_a_normal(self):
        channels = {**frame(), "feature.hit": np.ones(W * H * SPP, np.float32)}
        for c in "XYZ":
            channels[f"feature.N.{c}"][:SPP] = 0
        self.expect_note(channels, "normals N that are 0,0,0 where a surface was hit", "or hit 0", f": {SPP} (first at pixel 0,0)")
        channels["feature.hit"][:SPP] = 0
        self.assertEqual(self.notes(channels), [])
        del channels["feature.hit"]  # what was hit is not known
        self.assertEqual(self.notes(channels), [])

    def test_normals(self):
        for text, change in {"2 N - 1": lambda n: (n + 1) / 2, "unit vectors": lambda n: 3 * n}.items():
            channels = frame()
            for c in "XYZ":
                channels[f"feature.N.{c}"] = change(channels[f"feature.N.{c}"])
            self.expect_note(channels, "normals N whose length is not 1", text, f": {W * H * SPP} (first at pixel 0,0)")

    def test_reflectances(self):
        for text, change in {"divide by 255": lambda a: np.round(255 * a), "part of the light": lambda a: 7.3 * a + 0.1}.items():
            channels = frame()
            for c in "RGB":
                channels[f"feature.albedo.{c}"] = change(channels[f"feature.albedo.{c}"])
            self.expect_note(channels, "values of albedo far from 0 to 1", text)

    def test_positions_in_camera_space(self):
        channels = frame()
        y, z = channels["feature.P.Y"].copy(), channels["feature.P.Z"].copy()
        channels["feature.P.Y"], channels["feature.P.Z"] = 0.6 * y - 0.8 * z, 0.8 * y + 0.6 * z  # turned; the normals are not
        self.expect_note(channels, "positions P that do not lie on surfaces with the normals N", "world space")

    def test_copies(self):
        channels = {name: values.reshape(-1, SPP).copy() for name, values in frame().items()}
        for values in channels.values():
            values[5] = values[5, 0]
        self.expect_note({name: values.ravel() for name, values in channels.items()}, "samples are all the same", ": 1 (first at pixel 5,0)")

    # ---- values that are missing: only where they should be there, in one line

    def test_a_sky_is_no_fault(self):
        for with_hit in (False, True):
            channels = frame()
            sky = np.arange(W * H * SPP) < 3 * W * SPP
            for name in channels:
                if name.startswith("feature."):
                    channels[name][sky] = np.nan
            if with_hit:
                channels["feature.hit"] = np.where(sky, 0, 1)
            write_raw(self.samples, channels)
            result = run(*FAST, self.samples, "-o", self.output)
            self.expect(result, 0)
            self.assertNotIn("missing", result.stderr)

    def test_info_says_of_samples_what_the_filter_says(self):
        at = slice(SPP * (W + 2), SPP * (W + 2) + 2)
        for name, value, text in (("feature.N.X", np.nan, "missing values of feature.N.X"), ("weight", -1, "weight not a number from 0"), ("A", np.nan, "values of alpha not finite"),
                                  ("R", np.nan, "R, G or B not finite"), ("R", -1, "negative radiance values"), ("film.X", np.nan, "missing values of film.X")):
            channels = {**frame(), "weight": np.ones(W * H * SPP, "<f4"), "A": np.ones(W * H * SPP, "<f4")}
            channels[name][at] = value
            self.expect_note(channels, text, ": 2 (first at pixel 2,1)")

    def test_a_frame_that_lost_all_its_samples_is_called_so(self):
        channels = frame()
        channels["G"][:] = np.nan
        notes = self.notes(channels)
        self.assertEqual(len(notes), 2, notes)
        self.assertIn(f"pixels that lost all their samples, black: no pixel has any left: {W * H} (first at pixel 0,0)", notes[1])

    def test_missing_values_at_hits_are_one_line(self):
        channels = frame()
        at = SPP * (W + 2)
        for name in ("feature.N.X", "feature.N.Y", "feature.albedo.R", "random.lens.U"):
            channels[name][at:at + 2] = np.nan
        write_raw(self.samples, channels)
        result = run(*FAST, self.samples, "-o", self.output)
        lines = [line for line in result.stderr.splitlines() if "missing" in line]
        self.assertEqual(len(lines), 1, result.stderr)
        for text in ("feature.N.X", "feature.albedo.R", "random.lens.U", ": 2 (first at pixel 2,1)"):
            self.assertIn(text, lines[0])

    # ---- radiance that overflowed

    def filtered(self, path, *options, filtering=FAST):
        result = run(*filtering, *options, path, "-o", self.output)
        self.expect(result, 0)
        black = self.folder / "black.exr"
        write_exr(black, {c: np.zeros((H, W), np.float32) for c in "RGB"})
        compared = run("compare", "--json", self.output, black)
        return result.stderr, compared.stdout

    def half_copy(self, channels):
        """The frame as a deep file with half radiance."""
        image = self.folder / "half.exr"
        write_exr(image, {c: channels[c].reshape(-1, SPP)[:, 0].reshape(H, W).astype(np.float16) for c in "RGB"})
        return image

    def test_half_that_overflowed_is_the_largest_half(self):
        channels = frame()
        sun = slice(SPP * (2 * W + 3), SPP * (2 * W + 4))
        for c in "RGB":
            channels[c][sun] = np.inf
        stderr, compared = self.filtered(self.half_copy(channels), "--method", "gaussian", filtering=["--boxes", "1"])
        self.assertIn("infinite radiance values, taken for the largest of their type: 3 (first at pixel 3,2)", stderr)
        self.assertIn("65504", compared)

    def test_float_that_is_infinite_is_left_out_or_the_largest_float(self):
        channels = frame()
        channels["R"][SPP * (2 * W + 3)] = np.inf
        write_raw(self.samples, channels)
        self.assertIn("samples left out: R, G or B not finite: 1 (first at pixel 3,2)", self.filtered(self.samples)[0])
        stderr, _ = self.filtered(self.samples, "--clamp-infinite")
        self.assertIn("taken for the largest of their type: 1 (first at pixel 3,2)", stderr)

    def test_a_pixel_that_lost_all_its_samples_is_filled(self):
        channels = frame()
        for c in "RGB":
            channels[c][:] = 2
            channels[c][SPP * (2 * W + 3):SPP * (2 * W + 4)] = np.nan
        write_raw(self.samples, channels)
        stderr, compared = self.filtered(self.samples)
        self.assertIn("pixels that lost all their samples, filled from their neighbors: 1 (first at pixel 3,2)", stderr)
        self.assertRegex(compared, r'"MSE": (4\.0|3\.9999)')  # every pixel is 2

    # ---- images that are not of one place

    def test_compare_refuses_windows_and_views_that_differ(self):
        a, b = self.folder / "a.exr", self.folder / "b.exr"
        picture = {c: np.full((H, W), 0.5, np.float32) for c in "RGB"}
        write_exr(a, picture)
        write_exr(b, picture, x0=100, y0=-60, display=(0, 0, 199, 99))
        self.expect(run("compare", a, b), 3, "8x6+0+0", "8x6+100-60", str(a), str(b))
        self.expect(run("compare", b, b), 0)
        write_exr(b, picture, display=(0, 0, 199, 99))
        shown = run("compare", a, b)
        self.expect(shown, 0, "display window 8x6+0+0", "200x100+0+0")
        eyes = [self.folder / f"{eye}.exr" for eye in ("left", "right")]
        for path in eyes:
            write_exr(path, picture, attributes=[("view", "string", path.stem.encode())])
        self.expect(run("compare", *eyes), 3, '"left"', '"right"')
        write_exr(b, {f"left.{c}": v for c, v in picture.items()})
        self.expect(run("compare", b, a), 3, "no channel R", "left.R")

    def test_integers_are_no_colors(self):
        """OpenEXR's: OpenImageIO takes them for fractions of 2^32."""
        whole, mixed = self.folder / "whole.exr", self.folder / "mixed.exr"
        write_exr(whole, {name: np.full((6, 8), 3, np.uint32) for name in "RGB"})
        write_exr(mixed, {**{name: np.full((6, 8), 0.5, np.float32) for name in "RGB"}, "id": np.full((6, 8), 3, np.uint32)})
        before = whole.read_bytes()
        self.expect(run("--method", "gaussian", whole, "-o", whole), 3, "integers", "channel", "float or half")
        self.expect(run("compare", whole, whole), 3, "integers")
        self.expect(run("scene", "dof", "--size", "8x6", "--density", whole, "-o", self.output), 3, "integers")
        self.expect(run("compare", mixed, mixed), 0)
        self.assertEqual(whole.read_bytes(), before)

    def test_metrics_of_one_place_are_as_before(self):
        picture = {c: np.full((H, W), 0.5, np.float32) for c in "RGB"}
        for name in "ab":
            write_exr(self.folder / f"{name}.exr", picture, x0=-3, y0=7)
        result = run("compare", self.folder / "a.exr", self.folder / "b.exr")
        self.expect(result, 0, "0.000000")
        self.assertEqual(result.stderr, "")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
