"""rpf adapt as a user runs it: rounds of rpf scene, and of commands that do it wrong. Usage: adapt_test.py RPF PROJECT"""
import json
import signal
import subprocess
import sys
import time
import unittest

import numpy as np

from command_case import RPF, CommandCase
from small_files import frame, write_exr, write_raw

SIZE = ["--size", "64x36"]
SCENE = [RPF, "scene", "dof", *SIZE, "-q", "--spp", "1", "--density", "{density}", "--seed", "{seed}", "-o", "{output}"]
ALL_WORDS = "# {density} {seed} {output}"  # for a shell's script that does not use them
for number in (signal.SIGINT, signal.SIGTERM):  # a shell ignores them for what it starts in the background
    signal.signal(number, signal.SIG_DFL)


def run(*arguments):
    return subprocess.run([RPF, *map(str, arguments)], capture_output=True, text=True, check=False)


class AdaptTest(CommandCase):
    def setUp(self):
        super().setUp()
        self.file = self.folder / "all.exr"
        self.expect(run("scene", "dof", *SIZE, "-q", "-o", self.file), 0)
        self.before = self.file.read_bytes()

    def adapt(self, *options, command=SCENE):
        return run("adapt", self.file, *options, "--", *command)

    def shell(self, script):
        return self.adapt(command=["sh", "-c", f"{script} {ALL_WORDS}"])

    def expect_nothing_else(self):
        self.assertEqual([file.name for file in self.folder.iterdir()], [self.file.name])

    def samples(self):
        raw = self.folder / "raw.rpf"
        self.expect(run("convert", self.file, "-o", raw), 0)
        with open(raw, "rb") as file:
            header = json.loads(file.readline())
            counts = np.fromfile(file, "<u4", 64 * 36).astype(int)
            values = np.fromfile(file, "<f4").reshape(len(header["channels"]), -1)
        raw.unlink()
        return header, counts, values

    def error(self, samples, reference):
        mean = self.folder / "mean.exr"
        self.expect(run(samples, "-o", mean, "--boxes", "none", "-q"), 0)
        return json.loads(run("compare", mean, reference, "--json").stdout)["images"][0]["trimmed_relMSE"]

    # ---- rounds

    def test_rounds_double_the_samples_until_the_budget(self):
        _, _, first = self.samples()
        self.expect(self.adapt("--spp", "13"), 0, "round 0: 4.00 samples", "round 1: 8.00 samples", "round 2: 13.00 samples")
        header, counts, values = self.samples()
        self.assertEqual(counts.sum(), 13 * 64 * 36)
        self.assertGreaterEqual(counts.min(), 6)  # 4, and one in each round
        self.assertGreater(counts.max(), 26)
        self.assertEqual(header["metadata"]["rpf:seeds"], "1 2 3")
        begin = np.concatenate([[0], np.cumsum(counts)[:-1]])
        kept = (begin[:, None] + np.arange(4)).ravel()
        self.assertTrue(np.array_equal(values[:, kept], first, equal_nan=True), "the samples before are the first of their pixels")
        self.expect_nothing_else()

    def test_it_goes_on_where_it_was_stopped(self):
        self.expect(self.adapt("--spp", "16"), 0, "round 2: 16.00")
        whole = self.file.read_bytes()
        self.file.write_bytes(self.before)
        self.expect(self.adapt("--spp", "8"), 0)
        self.expect(self.adapt("--spp", "16"), 0, "round 0: 8.00", "round 1: 16.00")
        self.assertEqual(self.file.read_bytes(), whole)
        self.expect(self.adapt("--spp", "16"), 0, "round 0: 16.00")
        self.assertEqual(self.file.read_bytes(), whole)

    def test_an_error_ends_it(self):
        told = self.adapt("--spp", "64", "--until", "0.02").stdout.splitlines()
        errors = [float(line.split()[-1]) for line in told]
        self.assertEqual(errors, sorted(errors, reverse=True))
        self.assertTrue(errors[-1] <= 0.02 < errors[-2], told)

    def test_there_is_less_error_than_of_even_samples(self):
        reference, even = self.folder / "reference.exr", self.folder / "even.exr"
        self.expect(run("scene", "dof", *SIZE, "-q", "--reference", "512", "--sampler", "sobol", "-o", reference), 0)
        self.expect(run("scene", "dof", *SIZE, "-q", "--spp", "16", "-o", even), 0)
        self.expect(self.adapt("--spp", "16"), 0)
        self.assertLess(self.error(self.file, reference), 0.85 * self.error(even, reference))

    # ---- commands that do it wrong

    def expect_refused(self, result, code, *texts):
        self.expect(result, code, *texts)
        self.assertEqual(self.file.read_bytes(), self.before)
        self.expect_nothing_else()

    def test_a_command_that_leaves_out_a_word_is_refused(self):
        for word in ("{density}", "{seed}", "{output}"):
            self.expect_refused(self.adapt(command=[w.replace(word, "1") for w in SCENE]), 2, f"the command has no {word}", "rpf adapt all.exr --")
        self.expect_refused(run("adapt", self.file), 2, "COMMAND")

    def test_a_renderer_that_fails_is_told(self):
        self.expect_refused(self.shell("exit 3"), 3, "round 1", '"sh" ended with exit code 3', "has what was rendered before")
        self.expect_refused(self.shell("kill -9 $$"), 1, "exit code 137")
        self.expect_refused(self.adapt(command=["/no/renderer", ALL_WORDS]), 2, "cannot be started")

    def test_a_renderer_that_does_not_do_as_it_is_told_is_refused(self):
        self.expect_refused(self.shell("true"), 3, '"sh" has written no file {output}')
        self.expect_refused(self.shell(f"cp '{self.file}' '{{output}}'"), 3, "repeats samples", "another seed")
        low = self.folder / "low.exr"
        write_exr(low, {"Y": np.eye(36, 64, dtype=np.float32)})
        few = self.shell(f"'{RPF}' scene dof {' '.join(SIZE)} --spp 1 --density '{low}' --seed {{seed}} -o '{{output}}'")
        low.unlink()
        self.expect_refused(few, 3, "has rendered 36 samples, fewer than one a pixel")

    def test_a_file_without_noise_is_refused(self):
        self.expect(run("scene", "dof", *SIZE, "-q", "--spp", "1", "-o", self.file), 0)
        self.before = self.file.read_bytes()
        self.expect_refused(self.adapt(), 3, "no pixel has two samples")

    def test_samples_without_a_finite_color_tell_no_noise(self):
        channels, damaged = frame(), self.folder / "damaged.rpf"
        samples = channels["G"].size
        for lost, code, text in ((1, 0, "left out: R, G or B not finite: 1"), (samples, 3, "no pixel has two samples")):
            channels["G"][:lost] = np.nan
            write_raw(damaged, channels)
            self.expect(run("density", damaged, "-o", self.folder / "density.exr"), code, text)
            self.expect(run("adapt", damaged, "--until", "1e9", "--", *SCENE), code, text)

    def test_a_signal_ends_the_renderer_and_leaves_what_was_there(self):
        begun = f"touch '{self.folder}/started';"
        for script in (f"{begun} exec sleep 60 {ALL_WORDS}", f"{begun} sleep 60 {ALL_WORDS}; true", f"trap '' TERM; {begun} sleep 60; : {ALL_WORDS}",
                       f"exec >/dev/null; {begun} sleep 60; : {ALL_WORDS}"):
            with self.subTest(script):
                self.expect_to_end(script)

    def expect_to_end(self, script):
        process = subprocess.Popen([RPF, "adapt", self.file, "--", "sh", "-c", script], stderr=subprocess.PIPE, stdout=subprocess.DEVNULL)
        while not (self.folder / "started").exists():
            self.assertIsNone(process.poll())
            time.sleep(0.01)
        process.send_signal(signal.SIGINT)
        self.assertIn(b"cancelled", process.communicate(timeout=30)[1])  # the renderer holds the pipe while it lives
        self.assertEqual(process.returncode, 130)
        (self.folder / "started").unlink()
        self.assertEqual(self.file.read_bytes(), self.before)
        self.expect_nothing_else()


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
