"""Numbers, windows and attributes that cannot be, in one line that says what can. Usage: messages_test.py RPF PROJECT"""
import os
import re
import shutil
import struct
import subprocess
import sys
import unittest

import numpy as np  # noqa: F401

from command_case import EXAMPLE, PROJECT, RPF, CommandCase
from small_files import frame, write_raw

sys.path.insert(0, str(PROJECT / "tests" / "fuzz"))
from exr_file import ExrFile  # noqa: E402

CORPUS = PROJECT / "tests" / "fuzz" / "corpus" / "samples"
FAST = ["--backend", "cpu", "--boxes", "3", "--max-samples", "20"]


def run(*arguments, **variables):
    return subprocess.run([RPF, *map(str, arguments)], capture_output=True, text=True, timeout=300, check=False, env={**os.environ, **variables})


class MessagesTest(CommandCase):
    def setUp(self):
        super().setUp()
        self.samples, self.output = self.folder / "s.rpf", self.folder / "out.exr"
        write_raw(self.samples, frame())

    def expect_line(self, result, *texts):
        self.expect(result, 2)
        lines = result.stderr.splitlines()
        self.assertEqual(len(lines), 1, result.stderr)
        self.assertLess(len(lines[0]), 300, lines[0])
        for text in texts:
            self.assertIn(text, lines[0])

    def test_an_image_in_place_of_samples_leads_to_what_filters_images(self):
        self.output = self.folder / "a.png"
        self.expect(run(*FAST, self.samples, "-o", self.output), 0)
        for arguments in ([], ["--preset", "fast"], ["--profile", "paper"]):
            self.expect(run(*arguments, self.output, "-o", self.folder / "b.png"), 3, "--method bilateral")
        self.expect(run("--method", "bilateral", self.output, "-o", self.folder / "b.png"), 0)
        shutil.copy(PROJECT / "examples" / "dof-spheres.reference.exr", self.folder / "flat.exr")
        self.expect(run(self.folder / "flat.exr", "-o", self.folder / "b.png"), 3, "a flat OpenEXR image", "--method bilateral")

    def test_samples_in_place_of_an_image_are_named_as_such(self):
        for samples, kind in ((self.samples, "raw sample file"), (EXAMPLE, "deep file")):
            self.expect(run("compare", samples, samples), 3, samples.name, kind, "filter the samples first")

    # ---- numbers

    RANGES = {"--threads": ("1", "4096"), "--max-memory": ("1", "1073741824"), "--noise": ("1e-12", "1e+12"), "--bins": ("3", "31"), "--redraws": ("0", "15"),
              "--samples-factor": ("1e-09", "1000000"), "--max-samples": ("1", "4294967295"),
              "--alpha-factor": ("0", "1000000"), "--position-scale": ("1e-06", "1000000"), "--seed": ("0", "4294967295"),
              "--sigma-color": ("1e-30", "1e+30"), "--sigma-feature": ("1e-06", "1000000"), "--boxes": ("1", "255"),
              "--damping": ("0.001", "1000"), "--window": ("1", "255"), "--gamma": ("0.01", "0.5"),
              "--bandwidth": ("0.001", "1000"), "--views": ("1", "65536")}

    def test_every_number_of_the_filter(self):
        for option, (least, most) in self.RANGES.items():
            known_by = {"--damping": "nlm", "--window": "nlm", "--gamma": "gem", "--bandwidth": "axis-aligned", "--views": "lightfield"}.get(option, "cross-bilateral" if "sigma" in option else "")
            method = ["--method", known_by] if known_by else []
            for value in ("-1", "1e40", "all", "nan", "inf", "0x8", "1,5", "9" * 300):
                if option == "--boxes" and value == "1,5":
                    continue
                self.expect_line(run(*method, self.samples, "-o", self.output, f"{option}={value}"), option, least, most, "such as")
        for option, value in (("--bins", "4"), ("--boxes", "4"), ("--threads", "0"), ("--threads", "1.5"), ("--boxes", "3,,5")):
            self.expect_line(run(self.samples, "-o", self.output, option, value), option, "such as")
        self.assertFalse(self.output.exists())

    def test_a_dry_run_knows_them_too(self):
        self.expect_line(run("--dry-run", "--noise", "0", self.samples), "--noise", "1e-12")

    def test_numbers_of_the_environment_name_their_variable(self):
        for value in ("all", "0", "-4", "9" * 300):
            self.expect_line(run(self.samples, "-o", self.output, RPF_NUM_THREADS=value), "RPF_NUM_THREADS", "4096", "such as 8")
            self.expect_line(run(self.samples, "-o", self.output, RPF_MAX_MEMORY_MB=value), "RPF_MAX_MEMORY_MB", "such as")
            for variable in ("SLURM_CPUS_PER_TASK", "CUE_THREADS"):
                self.expect_line(run(self.samples, "-o", self.output, **{variable: value}), variable, "4096", "--threads")
            self.expect_line(run("scene", "dof", "-o", self.folder / "x.exr", RPF_NUM_THREADS=value), "RPF_NUM_THREADS", "such as 8")

    def test_names_of_the_environment_and_of_options_name_where_they_come_from(self):
        self.expect_line(run(self.samples, "-o", self.output, RPF_BACKEND="gpu"), "RPF_BACKEND='gpu'", "cpu, opencl, auto")
        by_option = run(self.samples, "-o", self.output, "--backend", "gpu", RPF_BACKEND="cpu")
        self.expect_line(by_option, "--backend: 'gpu'", "cpu, opencl, auto")
        self.assertNotIn("RPF_BACKEND", by_option.stderr)

    def test_numbers_of_the_other_commands(self):
        scene = ["scene", "dof", "-o", self.folder / "x.exr"]
        for arguments, texts in (([*scene, "--spp", "0"], ("--spp", "1048576")), ([*scene, "--reference", "1"], ("--reference", "2", "1048576")), ([*scene, "--seed", "-1"], ("--seed", "4294967295")),
                                 ([*scene, "--world-scale", "0"], ("--world-scale", "1e-12")), ([*scene, "--size", "0x5"], ("--size", "1048576")), ([*scene, "--size", "9999999999x5"], ("--size", "1048576")),
                                 (["explain", self.samples, "-o", self.folder / "e", "--box", "4"], ("--box", "odd", "255")), (["compare", "--max-error", "-1", "a", "b"], ("--max-error", "1e+30")),
                                 (["bench", "frames", "--rounds", "0"], ("--rounds", "1048576")), (["convert", self.samples, "-o", self.output, "--max-memory", "0"], ("--max-memory", "1073741824"))):
            self.expect_line(run(*arguments), *texts)

    def test_leading_zeros_mean_nothing(self):
        """A farm's frame numbers have them; they are not octal."""
        for seed in ("10", "0010", "+10"):
            self.expect(run("scene", "dof", "--size", "8x6", "--spp", "010", "--seed", seed, "-o", self.folder / f"{seed}.exr"), 0, "480 samples")
            self.assertEqual((self.folder / f"{seed}.exr").read_bytes(), (self.folder / "10.exr").read_bytes())
        self.expect(run(self.samples, "-o", self.output, "--threads", "010", "-v"), 0, ", 10 threads")
        self.expect(run(self.samples, "-o", self.output, "-v", RPF_NUM_THREADS="08"), 0, ", 8 threads")
        self.expect(run(self.samples, "-o", self.output, "--boxes", "011,007", "--redraws", "00"), 0)
        self.expect(run(self.samples, "-o", self.output, "--seed", "08", "--boxes", "7"), 0)

    def test_an_option_without_its_value_is_a_usage_error(self):
        for option in ("--preset", "--method", "--threads"):
            self.expect_line(run(self.samples, "-o", self.output, option), option)
        self.expect_line(run(self.samples, "-o", self.output, "--no-such-option"), "--no-such-option", "rpf --help")

    def test_an_empty_value_is_no_missing_option(self):
        """A variable of a script that is not set."""
        for option in ("--frames", "--chunk", "--aov", "--crop", "--report", "--log-json", "--features", "-d"):
            self.expect_line(run(self.samples, "-o", self.output, option, ""), option if option != "-d" else "--device", "leave the option out")
        self.expect_line(run("convert", self.samples, "-o", self.output, "--map", ""), "--map", "leave the option out")
        self.expect_line(run("report", self.samples, self.samples, "-o", ""), "-o", "leave the option out")
        self.assertFalse(self.output.exists())

    def test_a_channel_that_is_mapped_away_is_no_missing_one(self):
        for arguments in ([], ["--preset", "fast"]):
            self.expect(run(*arguments, self.samples, "-o", self.output, "--map", "R=G"), 3, "its channel G is read as R", "--map G=CHANNEL")

    def test_options_before_a_command_are_refused(self):
        for stray in (["--max-memory", "1"], ["-q"], ["--backend", "cpu"], ["--map", "feature.N.X="], [self.samples]):
            self.expect_line(run(*stray, "convert", self.samples, "-o", self.output), "convert", str(stray[0]), "comes first")
        self.assertFalse(self.output.exists())
        self.expect(run("convert", self.samples, "-o", self.output, RPF_BACKEND="cpu", RPF_NUM_THREADS="1"), 0)

    def test_a_word_that_is_no_command(self):
        for word in ("frobnicate", "help"):
            self.expect_line(run(word), word, "rpf --help")
        self.expect_line(run(self.samples), "no output", "-o")

    # ---- windows: what is printed is what is taken

    def test_windows_are_printed_as_they_are_taken(self):
        write_raw(self.samples, frame(x0=-37, y0=-12), x0=-37, y0=-12)
        self.assertIn("data window 8x6-37-12,", run("info", self.samples).stdout)
        refused = run(*FAST, self.samples, "-o", self.output, "--crop", "8x6+0+0")
        self.expect(refused, 2, "8x6+0+0", "8x6-37-12")
        self.assertNotIn("+-", refused.stderr)
        pictures = []
        for crop in ("4x3-36-11", "4x3+-36+-11"):
            self.expect(run(*FAST, "-q", self.samples, "-o", self.output, "--crop", crop), 0)
            pictures.append(self.output.read_bytes())
        self.assertEqual(*pictures)
        for wrong in ("4x3", "4x3+1", "4x3--1-1", "4x3+1+1x", "0x3+1+1", "x3+1+1", "4x3++1+1", " 4x3+1+1", "99999999999x3+1+1"):
            self.expect_line(run(self.samples, "-o", self.output, "--crop", wrong), "--crop", "WIDTHxHEIGHT+X+Y")

    # ---- attributes of another type

    def deep(self, name, kind, value):
        file = ExrFile((CORPUS / "zips.exr").read_bytes())
        file.attributes = [a for a in file.attributes if a[0] != name] + [[name, kind, value, None]]
        path = self.folder / "typed.exr"
        path.write_bytes(b"".join(file.parts()))
        return path

    def test_a_version_may_be_any_number_that_is_whole(self):
        for kind, value in (("int", struct.pack("<i", 1)), ("float", struct.pack("<f", 1)), ("double", struct.pack("<d", 1))):
            self.expect(run("info", self.deep("rpf:version", kind, value)), 0)
        self.expect(run("info", self.deep("rpf:version", "float", struct.pack("<f", 1.5))), 3, "rpf:version", "1.5")
        self.expect(run("info", self.deep("rpf:version", "float", struct.pack("<f", 2))), 3, "rpf:version 2")

    def test_attributes_of_the_wrong_type_are_named_with_the_one_expected(self):
        for name, kind, value, expected in (("rpf:version", "string", b"1", "int"), ("rpf:format", "int", b"\1\0\0\0", "string"), ("dataWindow", "v4f", b"\0" * 16, "box2i"),
                                            ("pixelAspectRatio", "int", b"\1\0\0\0", "float"), ("lineOrder", "int", b"\0" * 4, "lineOrder"), ("compression", "string", b"zips", "compression")):
            result = run("info", self.deep(name, kind, value))
            self.expect(result, 3, f"attribute {name} of type {kind}", f"expected {expected}" if name != "rpf:version" else "int")

    def test_attributes_that_no_result_can_hold_are_named(self):
        path = self.deep("shot", "v2i", b"\0" * 8)
        for arguments in (["info", path], ["convert", path, "-o", self.folder / "c.exr"], ["--boxes", "3", path, "-o", self.output]):
            self.expect(run(*arguments), 0, "shot (v2i)")
        self.expect(run("convert", path, "-o", path), 2, "shot", "would replace its input")

    def test_a_seed_that_python_wrote_is_a_seed(self):
        parts = []
        for seed in (1, 2):
            path = self.folder / f"{seed}.rpf"
            write_raw(path, frame(seed=seed))
            path.write_bytes(path.read_bytes().replace(b'"metadata": {}', b'"metadata": {"rpf:seed": %d.0}' % seed))
            parts.append(path)
        self.expect(run("merge", *parts, "-o", self.folder / "m.rpf"), 0)
        self.assertIn(b'"rpf:seeds":"1 2"', (self.folder / "m.rpf").read_bytes())

    # ---- silence

    def test_quiet_is_quiet_on_a_device_too(self):
        backends = run("--help").stdout
        if "opencl" not in backends or run("--backend=opencl", *FAST[2:], "-q", EXAMPLE, "-o", self.output).returncode == 5:
            self.skipTest("no OpenCL device")
        cold = {"RPF_CACHE_DIR": str(self.folder / "cache")}
        result = run("--backend=opencl", "--boxes", "3", "--max-samples", "20", "--crop", "8x8+20+20", "-q", EXAMPLE, "-o", self.output, **cold)
        self.expect(result, 0)
        self.assertEqual(result.stderr, "")
        self.assertIsNone(re.search(r"warning", run("devices", **cold).stderr))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
