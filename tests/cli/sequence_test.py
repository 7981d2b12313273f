"""Sequences: patterns, ranges, chunks, bad frames, what is skipped, what is told. Usage: sequence_test.py RPF PROJECT"""
import json
import os
import re
import shutil
import signal
import subprocess
import tempfile
import time
import unittest
from pathlib import Path

from command_case import RPF, CommandCase

FRAMES = 6


def run(*arguments, env=None, **keywords):
    return subprocess.run([RPF, *map(str, arguments)], capture_output=True, text=True, timeout=300, check=False, env={**os.environ, **(env or {})}, **keywords)


class SequenceTest(CommandCase):
    @classmethod
    def setUpClass(cls):
        cls.store = Path(tempfile.mkdtemp(prefix="rpf frames "))
        cls.files, cls.singles = {}, {}
        for number in range(1, FRAMES + 1):
            file, image = cls.store / f"in.{number:04}.exr", cls.store / f"single.{number:04}.exr"
            run("scene", "motion", "--size", "24x16", "--spp", 2, "--seed", number, "-o", file)
            run(file, "-o", image, "-q")
            cls.files[number], cls.singles[number] = file.read_bytes(), image.read_bytes()

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.store)

    def setUp(self):
        super().setUp()
        self.input, self.output = self.folder / "in.####.exr", self.folder / "out.####.exr"
        for number, content in self.files.items():
            self.frame(number, "in").write_bytes(content)

    def frame(self, number, name="out"):
        return self.folder / f"{name}.{number:04}.exr"

    def made(self):
        return sorted(int(path.name.split(".")[1]) for path in self.folder.glob("out.*.exr"))

    def filter(self, *arguments, env=None):
        return run(self.input, "-o", self.output, *arguments, env=env)

    def expect_as_single_runs(self, numbers):
        self.assertEqual(self.made(), sorted(numbers))
        for number in numbers:
            self.assertEqual(self.frame(number).read_bytes(), self.singles[number], number)

    # ---- which frames

    def test_files_are_those_of_single_runs(self):
        result = self.filter()
        self.expect(result, 0)
        self.expect_as_single_runs(range(1, FRAMES + 1))
        lines = result.stdout.splitlines()
        self.assertEqual([line.split(":")[0] for line in lines], [f"frame {n}" for n in range(1, FRAMES + 1)] + ["frames"])
        self.assertEqual(lines[-1], f"frames: {FRAMES} done")

    def test_ranges_steps_and_single_frames_in_their_order(self):
        result = self.filter("--frames", "5,1-4x2,5")
        self.expect(result, 0, "frames: 3 done")
        self.assertEqual(re.findall(r"^frame (\d+)", result.stdout, re.M), ["5", "1", "3"])
        self.expect_as_single_runs([1, 3, 5])

    def test_the_pattern_of_c(self):
        self.expect(run(self.folder / "in.%04d.exr", "-o", self.folder / "out.%04d.exr", "--frames", "2"), 0)
        self.expect_as_single_runs([2])

    def test_chunks_have_every_frame_once(self):
        for part in range(1, 5):
            before = len(self.made())
            self.expect(self.filter("--chunk", f"{part}/4", "-q"), 0)
            self.assertIn(len(self.made()) - before, (FRAMES // 4, FRAMES // 4 + 1))
        self.expect_as_single_runs(range(1, FRAMES + 1))

    def test_a_file_of_that_very_name_is_no_pattern(self):
        odd = self.folder / "odd#.exr"
        odd.write_bytes(self.files[1])
        self.expect(run(odd, "-o", self.frame(1), "-q"), 0)
        self.expect_as_single_runs([1])

    def test_what_cannot_be_meant_is_refused(self):
        for arguments, text in ((["--frames", "5-1"], "1-100x2,105"), (["--frames", "1-9x0"], "1-100x2,105"), (["--frames", "a"], "1-100x2,105"),
                                (["--frames", "1-99999999"], "at most"), (["--chunk", "0/3"], "2/10"), (["--chunk", "4/3"], "2/10"), (["--time-budget", "1s"], "--preset")):
            self.expect(self.filter(*arguments), 2, text)
        self.expect(run(self.input, "-o", self.folder / "one.exr"), 2, "out.####.exr")
        self.expect(run(self.frame(1, "in"), "-o", self.frame(1), "--frames", "1"), 2, "in.####.exr")
        self.expect(run(self.frame(1, "in"), "-o", self.output), 2, "-o", "is one file")
        for option in ("--aov", "--report"):
            self.expect(run(self.frame(1, "in"), "-o", self.frame(1), option, self.output), 2, option, "is one file")
        self.expect(run(self.folder / "in.##.##.exr", "-o", self.output), 2, "2 places")
        self.expect(run(self.folder / "none.####.exr", "-o", self.output), 3, "none.####.exr", "--frames")
        self.expect(self.filter("--log-json", self.folder / "no" / "log"), 4, "/no/log", "make the folder first")
        self.assertEqual(self.made(), [])

    def test_no_result_is_a_file_of_another_frame(self):
        for number in (10, 11, 12):
            shutil.copy(self.frame(1, "in"), self.folder / f"s.{number}.exr")
        shutil.copy(self.frame(1, "in"), self.folder / "s.0.exr")
        before = {path: path.read_bytes() for path in self.folder.iterdir()}
        pattern, shifted = self.folder / "s.%d.exr", self.folder / "s.1%d.exr"
        for frames in ("0,10", "0"):  # s.10.exr is a frame of the sequence, whether it is filtered now or not
            for dry_run in ([], ["--dry-run"]):
                self.expect(run(*dry_run, pattern, "-o", shifted, "--frames", frames), 2, "-o of frame 0", "s.10.exr", "would be lost")
        result = self.folder / "o.%d.exr"
        for option in ("--aov", "--report"):
            self.expect(run(pattern, "-o", result, option, self.folder / "o.1%d.exr", "--frames", "0,10"), 2, "o.10.exr", "is written by", "too")
        self.expect(run(pattern, "-o", self.folder / "w.%d.exr", "--aov", self.folder / "w.%02d.exr", "--frames", "0,10"), 2, "w.10.exr", "is written by", "too")
        self.expect(run(pattern, "-o", result, "--frames", "0", "--log-json", self.folder / "s.11.exr"), 2, "--log-json", "another frame")
        self.assertEqual({path: path.read_bytes() for path in self.folder.iterdir()}, before)

    def test_a_log_is_no_result_of_a_frame_that_is_not_filtered_now(self):
        self.expect(self.filter("-q"), 0)
        for log in (self.frame(2), self.frame(99), self.folder / "other.png", self.folder / "other.rpf"):
            self.expect(self.filter("--frames", "1", "--log-json", log), 2, "--log-json" if "other" not in log.name else "has the name", log.name)
        self.assertEqual(self.frame(2).read_bytes(), self.singles[2])

    def test_a_log_is_a_file_that_may_be_written_to(self):
        pipe, kept = self.folder / "pipe", self.folder / "kept.log"
        os.mkfifo(pipe)
        kept.write_text("")
        kept.chmod(0o444)
        for log, text in ((pipe, "a pipe"), (kept, "write-protected"), (self.folder, "a folder")):
            self.expect(self.filter("--log-json", log), 4, str(log), text)
        self.assertEqual(self.made(), [])

    # ---- frames that fail

    def test_a_damaged_frame_is_named_and_the_others_are_there(self):
        self.frame(3, "in").write_bytes(self.files[3][:len(self.files[3]) // 2])
        self.frame(5, "in").unlink()
        result = self.filter("--frames", f"1-{FRAMES}", "--skip-bad-frames")
        self.expect(result, 3, "frame 3:", "in.0003.exr", "in.0005.exr")
        self.assertEqual(result.stdout.splitlines()[-1], f"frames: {FRAMES - 2} done, 2 failed (3,5)")
        self.expect_as_single_runs([1, 2, 4, 6])

    def test_a_frame_that_is_missing_is_found_before_others_are_filtered(self):
        self.frame(5, "in").unlink()
        for dry in ([], ["--dry-run"]):
            self.expect(self.filter("--frames", f"1-{FRAMES}", *dry), 3, "in.0005.exr", f"1 of {FRAMES} frames are missing (5)", "--skip-bad-frames")
        self.assertEqual(self.made(), [])

    def test_without_being_told_to_go_on_it_stops_there(self):
        self.frame(3, "in").write_bytes(b"nothing")
        result = self.filter()
        self.expect(result, 3)
        self.assertEqual(result.stdout.splitlines()[-1], f"frames: 2 done, 1 failed (3), {FRAMES - 3} not begun")
        self.expect_as_single_runs([1, 2])

    # ---- what is there already

    def test_skips_what_is_whole_and_of_this_input_with_these_settings(self):
        self.expect(self.filter("--skip-existing", "-q"), 0)
        result = self.filter("--skip-existing")
        self.expect(result, 0)
        self.assertEqual(result.stdout.splitlines()[-1], f"frames: {FRAMES} skipped")
        self.frame(1).unlink()
        self.frame(2).write_bytes(self.singles[2][:-200])  # cut
        self.frame(3).write_bytes(self.singles[4])         # another frame's
        self.expect(self.filter("--skip-existing", "-t", "1", "--backend", "cpu"), 0, f"frames: 3 done, {FRAMES - 3} skipped")
        self.expect_as_single_runs(range(1, FRAMES + 1))
        self.frame(5, "in").write_bytes(self.files[6])
        self.expect(self.filter("--skip-existing"), 0, "frame 5: ", f"frames: 1 done, {FRAMES - 1} skipped")
        self.expect(self.filter("--skip-existing", "--preset", "fast"), 0, f"frames: {FRAMES} done")
        self.expect(self.filter("--skip-existing", "--preset", "fast", "--features", "N"), 0, f"frames: {FRAMES} done")

    def test_killed_and_run_again_it_does_what_is_missing(self):
        with subprocess.Popen([RPF, str(self.input), "-o", str(self.output), "-q"]) as process:
            while len(self.made()) < 2 and process.poll() is None:
                time.sleep(0.01)
            process.send_signal(signal.SIGKILL)
        done = self.made()
        result = self.filter("--skip-existing")
        self.expect(result, 0)
        self.assertEqual(re.findall(r"^frame (\d+): .* skipped", result.stdout, re.M), [str(number) for number in done])
        self.expect_as_single_runs(range(1, FRAMES + 1))

    def test_a_signal_stops_it_between_whole_files(self):
        with subprocess.Popen([RPF, str(self.input), "-o", str(self.output)], stdout=subprocess.PIPE, text=True) as process:
            process.stdout.readline()
            process.send_signal(signal.SIGTERM)
            rest = process.stdout.read()
        self.assertIn(process.returncode, (0, 128 + signal.SIGTERM, -signal.SIGTERM), rest)
        for number in self.made():
            self.assertEqual(self.frame(number).read_bytes(), self.singles[number])

    # ---- what is told

    def test_the_log_has_a_line_of_json_for_every_frame(self):
        log = self.folder / "log.jsonl"
        self.frame(2, "in").write_bytes(b"nothing")
        self.expect(self.filter("--frames", "1-3", "--skip-bad-frames", "--log-json", log, "-q"), 3)
        self.expect(self.filter("--frames", "1", "--skip-existing", "--log-json", log, "-q"), 0)
        lines = [json.loads(line) for line in log.read_text().splitlines()]
        self.assertEqual([(line["frame"], line["status"], line["exit_code"]) for line in lines],
                         [("1", "done", 0), ("2", "failed", 3), ("3", "done", 0), ("1", "skipped", 0)])
        self.assertIn("in.0002.exr", lines[1]["error"])
        self.assertEqual(lines[0]["output"], str(self.frame(1)))

    def test_nothing_is_written_by_a_dry_run(self):
        self.expect(self.filter("--dry-run"), 0, f"frames: {FRAMES} checked")
        self.assertEqual(self.made(), [])

    # ---- schedulers

    def test_schedulers_say_how_much_there_is(self):
        def told(**env):
            unset = {name: "" for name in ("SLURM_CPUS_PER_TASK", "CUE_THREADS", "NSLOTS", "SLURM_MEM_PER_NODE", "CUE_MEMORY")}
            result = run(self.frame(1, "in"), "--dry-run", "-v", env={**unset, **env})
            self.expect(result, 0)
            return tuple(int(number) for number in re.search(r"at most (\d+) MB, (\d+) threads", result.stdout).groups())
        self.assertEqual(told(NSLOTS="3")[1], 3)
        self.assertEqual(told(SLURM_CPUS_PER_TASK="5", NSLOTS="3")[1], 5)
        self.assertEqual(told(RPF_NUM_THREADS="7", SLURM_CPUS_PER_TASK="5")[1], 7)
        self.assertEqual(told(SLURM_MEM_PER_NODE="500")[0], 450)
        self.assertEqual(told(CUE_MEMORY="512000")[0], 450)
        self.assertEqual(told(RPF_MAX_MEMORY_MB="200", SLURM_MEM_PER_NODE="500")[0], 200)
        self.expect(run(self.frame(1, "in"), "--dry-run", env={"SLURM_MEM_PER_NODE": "4G"}), 2, "SLURM_MEM_PER_NODE", "--max-memory")


if __name__ == "__main__":
    unittest.main(argv=["sequence_test.py"])
