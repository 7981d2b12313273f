"""rpf bench as a user runs it. No test looks at how long anything took, but for a signal. Usage: bench_test.py RPF PROJECT"""
import json
import os
import signal
import subprocess
import sys
import time
import unittest

from command_case import EXAMPLE, REFERENCE, RPF, CommandCase

QUICK = "--boxes 5,3 --crop 16x12+20+20"


def run(*arguments):
    return subprocess.run([RPF, "bench", *map(str, arguments)], capture_output=True, text=True, check=False)


class BenchTest(CommandCase):
    def setUp(self):
        super().setUp()
        self.results = self.folder / "results.jsonl"

    def plan(self, **changes):
        plan = {"rounds": 2, "settings": {"mean": "--boxes none", "five": "--boxes 5"},
                "frames": [{"name": "tiny", "scene": "dof", "size": "24x16", "reference_spp": 4},
                           {"name": "more", "scene": "dof", "size": "24x16", "spp": 8, "settings": ["mean"]}]}
        path = self.folder / "plan.json"
        path.write_text(json.dumps({**plan, **changes}))
        return path

    def sweep(self, **changes):
        return run("sweep", self.plan(**changes), "-o", self.results)

    def lines(self):
        return [json.loads(line) for line in self.results.read_text().splitlines()]

    # ---- frames

    def test_frames_measures_every_setting_in_every_round(self):
        whole = "--boxes 5,3"
        result = run("frames", EXAMPLE, "--reference", REFERENCE, "--set", "mean=--boxes none", "--set", f"small={whole}",
                     "--rounds", "3", "--json")
        self.expect(result, 0)
        mean, small = json.loads(result.stdout)["frames"]
        self.assertEqual((mean["setting"], small["setting"], small["options"]), ("mean", "small", whole))
        for series in (mean, small):
            for cost in (series["cpu"], series["wall"]):
                self.assertEqual(len(cost["rounds"]), 3)
                self.assertEqual(cost["median"], sorted(cost["rounds"])[1])
        image = self.folder / "small.exr"
        subprocess.run([RPF, EXAMPLE, "-o", image, "-q", *whole.split()], check=True)
        compared = subprocess.run([RPF, "compare", "--json", image, REFERENCE], check=True, capture_output=True, text=True)
        self.assertEqual(small["error"]["FLIP"], json.loads(compared.stdout)["images"][0]["FLIP"])
        self.assertEqual([p["box"] for p in small["passes"]], [5, 3])
        self.assertTrue(0 < small["acceptance"] <= 1)

    def test_frames_prints_a_table(self):
        self.expect(run("frames", EXAMPLE, "--set", QUICK, "--rounds", "1"), 0, "CPU seconds", QUICK, EXAMPLE.name)

    def test_frames_renders_a_scene_where_no_file_is_named(self):
        self.expect(run("frames", "--size", "24x16", "--rounds", "1", "--set", "x=--boxes 3"), 0, "dof 24x16")

    def test_frames_stops_while_its_scene_is_made(self):
        for command, delay in (("frames", 0.5), ("frames", 4), ("ab", 4)):
            process = subprocess.Popen([RPF, "bench", command, "--size", "1920x1080"], stderr=subprocess.PIPE,
                                       env={**os.environ, "TMPDIR": str(self.folder)})
            time.sleep(delay)
            start = time.monotonic()
            process.send_signal(signal.SIGTERM)
            process.communicate()
            self.assertLess(time.monotonic() - start, 20)  # 2 s where the machine is not busy, 40 where nobody looks
            self.assertEqual(process.returncode, 143)
            self.assertEqual(list(self.folder.iterdir()), [])

    def test_memory_is_compared_before_a_scene_is_rendered(self):
        little = {**os.environ, "RPF_MAX_MEMORY_MB": "20", "TMPDIR": str(self.folder)}
        for size, doing in (("480x270", "filtering needs"), ("4000x3000", "rendering takes")):
            for command in ("frames", "ab"):
                result = subprocess.run([RPF, "bench", command, "--size", size], env=little, capture_output=True, text=True, check=False)
                self.expect(result, 6, f"dof {size}: {doing}", "the limit is 20 MB", "smaller --size")
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_wrong_settings_are_named(self):
        self.expect(run("frames", EXAMPLE, "--set", "wrong=--boxen 5"), 2, "wrong", "--boxen")
        self.expect(run("frames", EXAMPLE, "--set", "even=--boxes 4"), 2, "--boxes 4")
        self.expect(run("frames", EXAMPLE, "--set", "out=-o x.exr"), 2, "out", "files")
        self.expect(run("frames", EXAMPLE, EXAMPLE, "--reference", REFERENCE), 2, "2 files and 1 references")

    def test_what_measuring_would_end_with_is_found_before(self):
        for setting in ("--facts none.json", "--report x.html", "--rows 0-3"):
            self.expect(run("frames", EXAMPLE, "--set", "x=" + setting), 2, "no place here")
            self.expect(run("ab", EXAMPLE, "--b", setting), 2, "no place here")
        small = self.folder / "small.exr"
        subprocess.run([RPF, EXAMPLE, "-o", small, "-q", "--boxes", "none", "--crop", "8x6+2+3"], check=True)
        self.expect(run("frames", EXAMPLE, "--reference", small, "--set", QUICK), 3, "16x12+20+20", "8x6+2+3", str(small))
        self.expect(run("frames", EXAMPLE, "--reference", self.folder / "none.exr"), 3, "none.exr")
        self.expect(run("frames", EXAMPLE, "--reference", small, "--set", "--boxes none --crop 8x6+2+3", "--rounds", "1"), 0)
        pale = self.folder / "pale.exr"
        subprocess.run(["oiiotool", REFERENCE, "--ch", "G,B", "-o", pale], check=True)
        self.expect(run("frames", EXAMPLE, "--reference", pale, "--set", "--boxes none"), 3, "no channel R", str(pale))

    # ---- ab

    def test_ab_needs_six_rounds_for_a_verdict(self):
        few = run("ab", EXAMPLE, "--a", QUICK, "--b", QUICK, "--rounds", "5")
        self.expect(few, 0, "no verdict: at least 6 rounds")

    def test_ab_finds_a_large_difference_between_settings(self):
        result = run("ab", EXAMPLE, "--a", "--boxes none", "--b", "--boxes 15 --crop 40x40+20+20", "--rounds", "6", "--json")
        self.expect(result, 0)
        cpu = json.loads(result.stdout)["frames"][0]["cpu"]
        self.assertEqual(cpu["verdict"], "B takes more")
        self.assertGreater(cpu["low"], 1)

    def test_ab_measures_binaries(self):
        result = run("ab", EXAMPLE, "--a", QUICK, "--b", QUICK, "--binary-b", RPF, "--rounds", "2", "--json")
        self.expect(result, 0)
        self.assertEqual(len(json.loads(result.stdout)["frames"][0]["wall"]["b"]["rounds"]), 2)
        self.expect(run("ab", EXAMPLE, "--binary-b", self.folder / "none"), 2, "cannot be started")
        self.expect(run("ab", "missing.exr", "--binary-b", RPF), 3, "missing.exr")

    # ---- sweep

    def test_sweep_measures_the_plan(self):
        self.expect(self.sweep(), 0, "6 measured, 0 were there")
        lines = self.lines()
        self.assertEqual([(l["round"], l["frame"], l["setting"]) for l in lines],
                         [(r, *pair) for r in (0, 1) for pair in (("tiny", "mean"), ("tiny", "five"), ("more", "mean"))])
        self.assertGreater(lines[0]["error"]["relMSE"], 0)
        self.assertNotIn("error", lines[3], "the image is the same in every round")

    def test_sweep_goes_on_where_it_was_stopped(self):
        self.expect(self.sweep(), 0)
        whole = self.results.read_bytes()
        lines = whole.splitlines(keepends=True)
        self.results.write_bytes(lines[0] + lines[1] + lines[2][:-9])  # killed while it wrote the third line
        self.expect(self.sweep(), 0, "4 measured, 2 were there")
        self.assertEqual(self.results.read_bytes().splitlines(keepends=True)[:2], lines[:2])
        self.assertEqual({l["key"] for l in self.lines()}, {json.loads(l)["key"] for l in lines})
        self.expect(self.sweep(), 0, "0 measured, 6 were there")

    def test_sweep_measures_what_is_new_in_a_plan(self):
        self.expect(self.sweep(), 0)
        settings = {"renamed": "--boxes none", "five": "--boxes 5", "three": "--boxes 3"}
        self.expect(self.sweep(settings=settings), 0, "2 measured")
        self.assertEqual({l["setting"] for l in self.lines()[6:]}, {"three"})

    def test_sweep_stops_on_a_signal_and_loses_nothing(self):
        plan = self.plan(rounds=1000)
        process = subprocess.Popen([RPF, "bench", "sweep", plan, "-o", self.results], stderr=subprocess.PIPE)
        while not self.results.exists() or self.results.read_bytes().count(b"\n") < 3:
            time.sleep(0.01)
        process.send_signal(signal.SIGTERM)
        process.communicate()
        self.assertEqual(process.returncode, 143)
        self.assertGreaterEqual(len(self.lines()), 3)  # every line is whole

    def test_sweep_checks_all_settings_before_it_measures(self):
        self.expect(self.sweep(settings={"good": "--boxes 3", "bad": "--boxes x"}), 2, "--boxes")
        self.assertFalse(self.results.exists(), "a wrong option shows before anything is made")
        self.expect(self.sweep(settings={"no lens": "--random no-such"}), 2, "tiny, no lens: ", "no-such")
        self.expect(run("sweep", self.folder / "none.json", "-o", self.results), 3, "none.json")

    def test_sweep_checks_all_frames_before_it_renders(self):
        good = {"name": "good", "scene": "dof", "size": "24x16"}
        for bad, code, text in (({"scene": "nope"}, 2, "no such scene"), ({"scene": "dof", "reference_spp": 1}, 2, "reference_spp 1"),
                                ({"scene": "dof", "spp": 0}, 2, "samples a pixel is 0"), ({"samples": "none.exr"}, 3, "none.exr"),
                                ({"samples": str(EXAMPLE), "reference": "none.exr"}, 3, "none.exr"),
                                ({"scene": "dof", "size": "9000x9000", "spp": 4000}, 2, "choose a smaller")):
            self.expect(self.sweep(frames=[good, {"name": "bad", **bad}]), code, "bad, mean: ", text)
            self.assertFalse(self.results.exists())
            self.assertFalse((self.folder / "results.jsonl.scenes").exists())

    def test_sweep_leaves_alone_what_is_not_its_results(self):
        for text in ("my notes", '{"a": 1}', "{", '{"key":"mine"}\nand more'):
            self.results.write_text(text)
            self.expect(self.sweep(), 3, "no result of rpf bench sweep", "another file")
            self.assertEqual(self.results.read_text(), text)
        pipe = self.folder / "pipe"
        os.mkfifo(pipe)
        for path, kind in ((self.folder, "a folder"), (pipe, "a pipe")):
            self.expect(run("sweep", self.plan(), "-o", path), 4, kind)
            self.expect(run("sweep", path, "-o", self.folder / "other"), 3, kind)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
