"""One frame in parts: facts, rows, join; the file of the parts is that of the whole. Usage: parts_test.py RPF PROJECT"""
import json
import subprocess
import unittest

import numpy as np

from command_case import RPF, CommandCase
from small_files import write_exr

PRESET = ["--preset", "fast"]
PUBLISHED = ["--profile", "thesis", "--boxes", "7,5"]
METHODS = {
    "fast": PRESET,
    "thesis": PUBLISHED,
    "paper": ["--profile", "paper", "--boxes", "5"],
    "informative": ["--boxes", "5", "--drop-uninformative"],
    "cross-bilateral": ["--method", "cross-bilateral", "--boxes", "9"],
    "gaussian": ["--method", "gaussian", "--boxes", "9"],
}


def run(*arguments):
    return subprocess.run([RPF, *map(str, arguments)], capture_output=True, text=True, timeout=300, check=False)


class PartsTest(CommandCase):
    def setUp(self):
        super().setUp()
        self.frame, self.facts = self.folder / "in.exr", self.folder / "facts.json"
        self.expect(run("scene", "motion", "--size", "40x56", "--spp", 3, "-o", self.frame), 0)

    def find(self, *options):
        self.expect(run("facts", self.frame, "-o", self.facts, *options), 0, "facts of 40x56 pixels")

    def part(self, rows, *options, name=None):
        path = self.folder / (name or f"part.{rows.replace('/', '.')}.exr")
        self.expect(run(self.frame, "-o", path, "--rows", rows, *options, "-q"), 0)
        return path

    def parts(self, count, *options):
        return [self.part(f"{number}/{count}", *options) for number in range(1, count + 1)]

    def expect_whole(self, parts, *options, output="whole.exr"):
        single, whole = self.folder / f"single.{output}", self.folder / output
        self.expect(run(self.frame, "-o", single, *options, "-q"), 0)
        self.expect(run("join", *parts, "-o", whole), 0, f"40x56 pixels of {len(parts)} parts")
        self.assertEqual(whole.read_bytes(), single.read_bytes())

    # ---- the same file

    def test_parts_make_the_file_of_the_whole(self):
        for name, options in METHODS.items():
            with self.subTest(name):
                self.find(*options)
                self.expect_whole(self.parts(3, *options, "--facts", self.facts)[::-1], *options, output=f"{name}.exr")

    def test_without_facts_too(self):
        self.expect_whole(self.parts(2, *PRESET), *PRESET)

    def test_raw_files_too(self):
        raw = self.folder / "in.rpf"
        self.expect(run("convert", self.frame, "-o", raw), 0)
        self.frame = raw
        self.find(*PUBLISHED)
        self.expect_whole(self.parts(4, *PUBLISHED, "--facts", self.facts), *PUBLISHED)

    def test_features_have_parts_of_their_own(self):
        self.find(*PRESET, "--aov", "any")
        parts = []
        for number in (1, 2):
            parts.append(self.folder / f"features.{number}.exr")
            self.part(f"{number}/2", *PRESET, "--facts", self.facts, "--aov", parts[-1])
        single, whole = self.folder / "single.exr", self.folder / "whole.exr"
        self.expect(run(self.frame, "-o", self.folder / "image.exr", *PRESET, "--aov", single, "-q"), 0)
        self.expect(run("join", *parts, "-o", whole), 0)
        self.assertEqual(whole.read_bytes(), single.read_bytes())

    def test_crops_take_facts(self):
        self.find(*PRESET)
        images = []
        for options in ([], ["--facts", self.facts]):
            images.append(self.folder / f"{len(images)}.exr")
            self.expect(run(self.frame, "-o", images[-1], *PRESET, "--crop", "9x7+20+30", *options, "-q"), 0)
        self.assertEqual(images[0].read_bytes()[-500:], images[1].read_bytes()[-500:])

    def test_a_whole_frame_takes_facts(self):
        self.find(*PRESET)
        for name, options in (("a", []), ("b", ["--facts", self.facts])):
            self.expect(run(self.frame, "-o", self.folder / f"{name}.exr", *PRESET, *options, "-q"), 0)
        self.assertEqual((self.folder / "a.exr").read_bytes(), (self.folder / "b.exr").read_bytes())

    # ---- what is read

    def test_only_rows_that_are_needed_are_read(self):
        """Bytes in the middle of a big file are damaged: where the ends do not show it, nor does what is not read."""
        self.expect(run("scene", "motion", "--size", "300x200", "--spp", 8, "-o", self.frame), 0)
        self.expect(run("facts", self.frame, "-o", self.facts, *PUBLISHED), 0)
        before = self.part("0-9", *PUBLISHED, "--facts", self.facts).read_bytes()
        content = bytearray(self.frame.read_bytes())
        self.assertGreater(len(content), 5 << 20)
        middle = slice(len(content) // 2, len(content) // 2 + 50000)
        content[middle] = bytes(byte ^ 0x55 for byte in content[middle])
        self.frame.write_bytes(content)
        self.expect(run(self.frame, "-o", self.folder / "whole.exr", *PUBLISHED), 3, "damaged")
        self.assertEqual(self.part("0-9", *PUBLISHED, "--facts", self.facts).read_bytes(), before)

    # ---- what is refused

    def test_facts_of_other_settings_or_files_are_refused(self):
        self.find(*PRESET)
        other = self.folder / "other.exr"
        self.expect(run("scene", "motion", "--size", "40x56", "--spp", 3, "--seed", 2, "-o", other), 0)
        for frame, options, text in ((self.frame, PUBLISHED, "with other settings"), (self.frame, [*PRESET, "--features", "N"], "with other settings"),
                                     (other, PRESET, "is of another file")):
            self.expect(run(frame, "-o", self.folder / "out.exr", *options, "--facts", self.facts, "--rows", "0-9"), 3, text)
        facts = json.loads(self.facts.read_text())
        facts["facts"]["most_samples"] = 2
        for text in ("{}", "[" * 100000, " " * (2 << 20), "", json.dumps(facts)):
            self.facts.write_text(text)
            self.expect(run(self.frame, "-o", self.folder / "out.exr", *PRESET, "--facts", self.facts), 3, "--facts", "rpf facts")
        self.facts.write_text("{}")
        self.expect(run(self.frame, "-o", self.folder / "out.exr", *PRESET, "--facts", self.facts), 3, "is none that rpf facts wrote")
        self.assertFalse((self.folder / "out.exr").exists())

    def test_parts_that_could_not_be_joined_are_refused(self):
        for name in ("out.png", "out.tif", "out"):
            for dry_run in ([], ["--dry-run"]):
                self.expect(run(self.frame, "-o", self.folder / name, *PRESET, "--rows", "1/2", *dry_run), 2, "--rows", name, ".exr")
            self.assertFalse((self.folder / name).exists())
        self.expect(run(self.frame, "-o", self.folder / "out.Exr", *PRESET, "--rows", "1/2", "--dry-run"), 0)

    def test_methods_that_need_the_whole_frame_refuse_parts(self):
        for method in ("nlm", "gem", "sbf", "axis-aligned", "lightfield", "multidim"):
            self.expect(run(self.frame, "-o", self.folder / "out.exr", "--method", method, "--rows", "1/2"), 2, "the whole frame at once")
            if method not in ("axis-aligned", "lightfield"):  # which refuse this frame before, for want of what they need of it
                self.expect(run("facts", self.frame, "-o", self.facts, "--method", method), 2, "the whole frame at once")

    def test_rows_outside_the_frame_are_refused(self):
        for rows in ("0-56", "-1-3", "9-8", "5", "0/4", "5/4", "57/57x"):
            self.expect(run(self.frame, "-o", self.folder / "out.exr", "--rows=" + rows), 2, "--rows", "0-55")

    def test_parts_that_do_not_fit_are_refused(self):
        parts = self.parts(4, *PUBLISHED)
        whole = self.folder / "whole.exr"

        def expect_refused(files, text):
            self.expect(run("join", *files, "-o", whole), 3, text)
            self.assertFalse(whole.exists())

        expect_refused([parts[0], parts[2], parts[3]], "rows 14-27 are missing")
        expect_refused([parts[1], parts[2]], "rows 0-13, 42-55 are missing")
        expect_refused([*parts, parts[1]], "both hold row 14")
        settings = self.part("2/4", *PUBLISHED, "--seed", 2, name="settings.exr")
        expect_refused([parts[0], settings, *parts[2:]], "other settings")
        self.expect(run("scene", "motion", "--size", "40x56", "--spp", 3, "--seed", 2, "-o", self.frame), 0)
        expect_refused([parts[0], self.part("2/4", *PUBLISHED, name="input.exr"), *parts[2:]], "another input")
        self.expect(run(self.frame, "-o", self.folder / "image.exr", *PUBLISHED, "-q"), 0)
        expect_refused([self.folder / "image.exr"], "is no part of a frame")

    def test_a_part_of_other_columns_than_its_frame_is_none(self):
        path, zeros = self.folder / "odd.exr", np.zeros((6, 8), np.float32)
        for frame in ("900x6+0+0", "8x6+3+0", "some", ""):
            marks = [("rpf:rows", "string", b"0-5"), ("rpf:frameWindow", "string", frame.encode())]
            write_exr(path, {channel: zeros for channel in "RGB"}, attributes=marks)
            self.expect(run("join", path, "-o", self.folder / "whole.exr"), 3, "odd.exr", "is no part of a frame")

    def test_parts_that_are_there_are_skipped(self):
        first = self.part("1/2", *PRESET)
        again = [self.frame, "-o", first, *PRESET, "--skip-existing"]
        self.expect(run(*again, "--rows", "1/2"), 0, "skipped")
        self.expect(run(*again, "--rows", "2/2"), 0, "1 done")


if __name__ == "__main__":
    unittest.main(argv=["parts_test"])
