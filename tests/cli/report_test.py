"""rpf report and rpf --report as a user runs them, and what is in their page. Usage: report_test.py RPF PROJECT"""
import re
import subprocess
import sys
import unittest

import numpy as np

import small_files
from command_case import RPF, CommandCase
from report_page import ReportPage, exr_values

SIZE = "40x24"


def run(*arguments):
    return subprocess.run([RPF, *map(str, arguments)], capture_output=True, text=True)


class ReportTest(CommandCase):
    def setUp(self):
        super().setUp()
        self.samples, self.output, self.reference, self.page = (
            self.folder / name for name in ("in <1>.samples.exr", "out.exr", "reference.exr", "page.html"))
        self.expect(run("scene", "combined", "--size", SIZE, "-o", self.samples, "-q"), 0)
        self.expect(run(self.samples, "-o", self.output, "--preset", "fast", "-q"), 0)

    def report(self, *files, page=None):
        return run("report", *(files or (self.samples, self.output)), "-o", page or self.page)

    def expect_in(self, html, text):
        self.assertTrue(text in html, f"{text!r} is not in the page")

    def render_reference(self):
        self.expect(run("scene", "combined", "--size", SIZE, "--reference", "16", "-o", self.reference, "-q"), 0)

    def test_the_page_is_whole_and_needs_nothing_else(self):
        self.expect(self.report(), 0, "page.html", "attributing the noise")
        html = self.page.read_text()
        self.assertTrue(html.startswith("<!DOCTYPE html>") and html.endswith("</html>\n"))
        self.expect_in(html, "<title>in &lt;1&gt;.samples.exr, before and after</title>")
        self.assertFalse(re.findall(r"https?:|<link|<img|@import|\bsrc=|\bhref=|url\(", html))
        for chapter in ("Errors", "Where the noise comes from", "Settings", "The run", "The data"):
            self.expect_in(html, f"<h2>{chapter}</h2>")
        for text in ("modelHash", "<td class=\"text\">fast</td>", "--report page.html", "lens.U", "4</td>"):
            self.expect_in(html, text)

    def test_values_are_those_of_the_files_to_the_last_bit(self):
        self.render_reference()
        mean = self.folder / "mean.exr"
        self.expect(run(self.samples, "-o", mean, "--boxes", "none", "-q"), 0)
        self.expect(self.report(self.samples, self.output, self.reference), 0)
        page = ReportPage(self.page)
        for name, file in (("plain mean", mean), ("filtered", self.output), ("reference", self.reference)):
            np.testing.assert_array_equal(page.values(name), exr_values(file), name)

    def test_errors_are_those_of_compare(self):
        self.render_reference()
        self.expect(self.report(self.samples, self.output, self.reference), 0)
        page = ReportPage(self.page)
        a, b = (page.values(name).astype(float) for name in ("filtered", "reference"))
        errors = ((a - b) ** 2 / (b ** 2 + 0.01)).mean(axis=2, keepdims=True)
        np.testing.assert_allclose(page.values("error after"), errors, rtol=0.003)  # eight bits of mantissa
        self.expect_in(page.html, f"<td>{errors.mean():.4g}</td>")

    def test_noise_is_attributed_as_explain_does(self):
        explained = self.folder / "explained"
        self.expect(run("explain", self.samples, "-o", explained, "-q"), 0)
        self.expect(self.report(), 0)
        page = ReportPage(self.page)
        channels = subprocess.run(["oiiotool", str(explained / "explain.exr"), "--ch", "share.lens,share.light,share.time", "-o",
                                   str(self.folder / "shares.exr")], check=False)
        self.assertEqual(channels.returncode, 0)
        layer = page.frame["layers"][page.names.index("where the noise comes from")]
        self.assertEqual(layer["channels"][3:], ["lens", "light", "time"])
        shares = page.values("where the noise comes from")[:, :, 3:]
        np.testing.assert_allclose(shares, exr_values(self.folder / "shares.exr"), rtol=0.002)
        self.expect_in(page.html, "others, or several together")

    def test_says_where_there_is_nothing_to_tell(self):
        bare = self.folder / "bare.samples.exr"
        self.expect(run("convert", self.samples, "-o", bare, *(f"--map=random.{slot}=" for slot in (
            "lens.U", "lens.V", "light.U", "light.V", "time"))), 0)
        png = self.folder / "out.png"
        self.expect(run(bare, "-o", png, "--preset", "fast", "-q"), 0)
        self.expect(self.report(bare, png), 0)
        html = self.page.read_text()
        for text in ("no random numbers", "Without a reference", "does not say how it was made"):
            self.expect_in(html, text)
        self.assertNotIn("where the noise comes from", ReportPage(self.page).names)

    def test_the_run_that_filters_writes_the_page_with_its_times(self):
        self.expect(run(self.samples, "-o", self.output, "--report", self.page, "--profile", "thesis", "--boxes", "7,5"), 0)
        html = self.page.read_text()
        for text in (">acceptance<", "memory, the process at most", "seconds of filtering", "<th>pass 2</th>"):
            self.expect_in(html, text)
        self.expect_in(html, ">box width</td><td>7</td><td>5</td>")
        np.testing.assert_array_equal(ReportPage(self.page).values("filtered"), exr_values(self.output))

    def test_a_crop_is_compared_with_its_own_place(self):
        self.expect(run(self.samples, "-o", self.output, "--report", self.page, "--crop", "10x6+7+5", "--preset", "fast", "-q"), 0)
        whole = self.folder / "mean.exr"
        self.expect(run(self.samples, "-o", whole, "--boxes", "none", "-q"), 0)
        page = ReportPage(self.page)
        self.assertEqual([page.frame[key] for key in ("x", "y", "width", "height")], [7, 5, 10, 6])
        np.testing.assert_array_equal(page.values("plain mean"), exr_values(whole)[5:11, 7:17])

    def test_random_parameters_that_never_change_tell_nothing(self):
        raw = self.folder / "constant.rpf"
        channels = small_files.frame()
        for slot in ("random.lens.U", "random.lens.V"):
            channels[slot][:] = 0.5
        small_files.write_raw(raw, channels)
        self.expect(run(raw, "-o", self.output, "--preset", "fast", "--report", self.page, "-q"), 0)
        self.expect_in(self.page.read_text(), "the same for all samples")

    def test_images_have_a_page_too(self):
        filtered = self.folder / "smooth.exr"
        self.expect(run("--method", "bilateral", self.output, "-o", filtered, "--report", self.page, "-q"), 0)
        page = ReportPage(self.page)
        np.testing.assert_array_equal(page.values("plain mean"), exr_values(self.output))
        np.testing.assert_array_equal(page.values("filtered"), exr_values(filtered))
        self.expect_in(page.html, "it has no samples")

    def test_every_frame_of_a_sequence_has_its_page(self):
        for number in (1, 2):
            self.samples.replace(self.folder / f"in.{number}.exr")
            self.expect(run("scene", "combined", "--size", SIZE, "--seed", number, "-o", self.samples, "-q"), 0)
        arguments = [self.folder / "in.#.exr", "-o", self.folder / "out.#.exr", "--preset", "fast", "--report"]
        self.expect(run(*arguments, self.folder / "page.#.html"), 0)
        for number in (1, 2):
            page = ReportPage(self.folder / f"page.{number}.html")
            np.testing.assert_array_equal(page.values("filtered"), exr_values(self.folder / f"out.{number}.exr"))
        self.expect(run(*arguments, self.page), 2, "--report")

    def test_without_the_memory_for_it_attribution_is_left_out(self):
        large = self.folder / "many.samples.exr"
        self.expect(run("scene", "combined", "--size", "64x36", "--spp", 128, "-o", large, "-q"), 0)
        self.expect(run(large, "-o", self.output, "--boxes", "none", "-q"), 0)
        self.expect(run("report", large, self.output, "-o", self.page, "--max-memory", 13), 0)
        self.expect_in(self.page.read_text(), "Left out: it would take")

    def test_large_frames_have_four_digits(self):
        large = self.folder / "large.samples.exr"
        self.expect(run("scene", "dof", "--size", "640x411", "--spp", 1, "-o", large, "-q"), 0)
        self.expect(run(large, "-o", self.output, "--method", "gaussian", "--boxes", 1, "-q"), 0)
        self.expect(self.report(large, self.output), 0)
        page = ReportPage(self.page)
        values = exr_values(self.output)
        np.testing.assert_allclose(page.values("filtered"), values, rtol=2.0 ** -13)
        self.assertFalse((page.values("filtered") == values).all())
        self.expect_in(page.html, "with four digits")
        endless = self.folder / "endless.exr"
        subprocess.run(["oiiotool", self.output, *(["--mulc", "1e30,1e-30,1"] * 2), "-o", endless], check=True)
        self.expect(self.report(large, endless), 0)
        values = exr_values(endless)
        self.assertTrue(np.isinf(values).any())
        np.testing.assert_allclose(ReportPage(self.page).values("filtered"), values, rtol=2.0 ** -13, atol=1e-38)

    def test_images_that_do_not_fit_are_refused_before_the_noise_is_measured(self):
        small, narrow = self.folder / "small.exr", self.folder / "narrow.exr"
        gray = np.full((24, 40), 0.5, np.float32)
        small_files.write_exr(small, {name: gray[:10, :10] for name in "RGB"})
        small_files.write_exr(narrow, {"Y": gray})
        for files, text in (((self.output, small), "small.exr"), ((narrow,), "narrow.exr"), ((self.output, narrow), "narrow.exr")):
            result = run("report", self.samples, *files, "-o", self.page, "--progress", "always")
            self.expect(result, 3, text)
            self.assertNotIn("attributing", result.stderr)
            self.assertFalse(self.page.exists())

    def test_display_windows_that_differ_are_told(self):
        shown = self.folder / "shown.exr"
        gray = {name: np.full((24, 40), 0.5, np.float32) for name in "RGB"}
        small_files.write_exr(shown, gray, display=(0, 0, 79, 59))
        for files, texts in (((shown,), ["its input 40x24+0+0"]), ((self.output, shown), ["its reference 80x60+0+0"]),
                             ((shown, shown), ["its input 40x24+0+0"])):
            result = self.report(self.samples, *files)
            self.expect(result, 0)
            notes = [line for line in result.stderr.splitlines() if "display window" in line]
            self.assertEqual(len(notes), len(texts), result.stderr)
            for note, text in zip(notes, texts):
                self.assertTrue(note.startswith("rpf: note: ") and note.endswith(text), note)
        self.assertNotIn("display window", self.report().stderr)
        self.assertEqual(run("report", self.samples, shown, "-o", self.page, "-q").stderr, "")

    def test_errors_name_the_file_and_leave_nothing(self):
        other = self.folder / "other.exr"
        self.expect(run("scene", "dof", "--size", "44x24", "--reference", 2, "-o", other, "-q"), 0)
        for files, code, text in (((self.samples,), 2, "rpf report"), ((self.samples, other), 3, "other.exr"),
                                  ((self.samples, self.output, other), 3, "other.exr"),
                                  ((self.samples, self.folder / "none.exr"), 3, "none.exr")):
            with self.subTest(files):
                self.expect(self.report(*files), code, text)
                self.assertFalse(self.page.exists())
        self.expect(self.report(page=self.folder / "none" / "page.html"), 4, "none")
        self.expect(self.report(page=self.output), 2)
        self.expect(run("report", self.samples, self.output, "-o", self.page, "--backend", "opencl"), 2, "--backend")
        self.expect(run(self.samples, "-o", self.output, "--report", self.output), 2)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
