"""The command as a user runs it: exit codes, texts, files. Usage: command_test.py RPF PROJECT"""
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import time
import unittest

from command_case import EXAMPLE, PROJECT, REFERENCE, RPF, CommandCase

SHARED = PROJECT.parent / "shared" / "data"
BACKEND = os.environ.get("RPF_BACKEND", "cpu")  # CMake runs this file once for each
QUICK = ["--boxes", "5,3", "--crop", "16x12+20+20"]
for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):  # a shell ignores them for what it starts in the background
    signal.signal(number, signal.SIG_DFL)


def run(*arguments, env=None, **keywords):
    environment = {**os.environ, **(env or {})}
    return subprocess.run([RPF, *map(str, arguments)], capture_output=True, text=True, env=environment, **keywords)


def error_of(run_):
    """What compare printed for its first image: relMSE, MSE, energy."""
    return [float(word) for word in run_.stdout.splitlines()[1].split()[:3]]


class CommandTest(CommandCase):
    def setUp(self):
        super().setUp()
        self.output = self.folder / "out.exr"

    def expect_nothing_written(self):
        self.assertEqual(list(self.folder.iterdir()), [])

    # ---- the main job

    def test_filters_the_example_and_lowers_its_error(self):
        before, after = self.folder / "before.exr", self.output
        self.expect(run(EXAMPLE, "-o", before, "--boxes", "none"), 0)
        self.expect(run(EXAMPLE, "-o", after, "-v", "--profile", "paper", "--boxes", "21,11,5", "--samples-factor", "1",
                        "--noise", "0.002"), 0, "acceptance", "backend " + BACKEND)
        error_before, error_after = (error_of(run("compare", image, REFERENCE))[0] for image in (before, after))
        self.assertLess(error_after, error_before / 4)
        energy = error_of(run("compare", after, before))[2]
        self.assertAlmostEqual(energy, 1, delta=0.05)

    def test_the_error_of_each_pixel_is_a_layer(self):
        aov, folder = self.folder / "aov.exr", self.folder / "aov"
        self.expect(run(EXAMPLE, "-o", self.output, "--aov", aov, "--error", *QUICK), 0)
        self.assertIn(b"\0error\0", aov.read_bytes())  # in the list of channels
        plain = self.folder / "plain.exr"
        self.expect(run(EXAMPLE, "-o", plain, "--aov", f"{folder}/", "--error", *QUICK), 0)
        self.assertIn("error.exr", [file.name for file in folder.iterdir()])
        self.assertEqual(error_of(run("compare", plain, self.output))[0], 0)

    def test_an_error_that_cannot_be_told_is_refused(self):
        aov = ["--aov", self.folder / "aov.exr", "--error"]
        self.expect(run(EXAMPLE, "-o", self.output, "--error"), 2, "--aov")
        self.expect(run(EXAMPLE, "-o", self.output, *aov, "--rows", "1/2"), 2, "--rows", "--error needs the whole frame")
        self.expect(run(REFERENCE, "-o", self.output, "--method", "gaussian", *aov), 3, "no pixel has 2 samples", "--error")
        self.expect_nothing_written()

    def test_compare_in_json_is_the_table(self):
        self.expect(run(EXAMPLE, "-o", self.output, "--boxes", "none", "-q"), 0)
        image = json.loads(run("compare", "--json", self.output, REFERENCE).stdout)["images"][0]
        for number, name in zip(error_of(run("compare", self.output, REFERENCE)), ("relMSE", "MSE", "energy")):
            self.assertAlmostEqual(number, image[name], delta=1e-4)
        self.assertEqual(set(image["largest_difference"]), set("RGB"))
        same = json.loads(run("compare", "--json", REFERENCE, REFERENCE).stdout)["images"][0]
        self.assertIsNone(same["PSNR"])  # infinite

    def test_compare_fails_above_the_largest_error_allowed(self):
        self.expect(run(EXAMPLE, "-o", self.output, "--boxes", "none", "-q"), 0)
        self.expect(run("compare", REFERENCE, self.output, REFERENCE, "--max-error", "0.1"), 1, "out.exr", "above --max-error 0.1")
        self.expect(run("compare", self.output, REFERENCE, "--max-error", "10"), 0)
        self.expect(run("compare", REFERENCE, REFERENCE, "--max-error", "0"), 0)
        self.expect(run("compare", self.output, REFERENCE, "--max-error", "-1"), 2)

    def test_heat_map_is_dark_without_error_and_has_all_colors_in_its_legend(self):
        map_ = self.folder / "diff.ppm"
        self.expect(run("compare", REFERENCE, REFERENCE, "--diff", map_), 0, "from 0.0001 (dark) to 1 (bright)")
        magic, width, height, _, pixels = re.match(rb"(P6)\s(\d+)\s(\d+)\s(\d+)\s(.*)", map_.read_bytes(), re.S).groups()
        width, height = int(width), int(height)
        rows = [pixels[3 * width * y:3 * width * (y + 1)] for y in range(height)]
        legend = slice(-3 * 7, -3 * 6)  # the bar's last column; six columns of ticks follow
        darkest, brightest = bytes.fromhex("000004"), bytes.fromhex("fcfdbf")
        self.assertEqual((rows[0][legend], rows[-1][legend]), (brightest, darkest))
        self.assertEqual({row[:3] for row in rows}, {darkest})
        self.assertEqual(sum(row[-3:] == bytes(3) for row in rows), 5)  # 1, 0.1, 0.01, 0.001, 0.0001

    def test_two_runs_and_threads_write_the_same_bytes(self):
        images = []
        for threads in (1, 2, 2):
            self.expect(run(EXAMPLE, "-o", self.output, "-t", threads, "-q", *QUICK), 0)
            images.append(self.output.read_bytes())
        self.assertEqual(images[0], images[1])
        self.assertEqual(images[1], images[2])

    def test_quiet_says_nothing_and_progress_says_how_far(self):
        quiet = run(EXAMPLE, "-o", self.output, "-q", *QUICK)
        self.assertEqual(quiet.stdout + quiet.stderr, "")
        self.expect(run(EXAMPLE, "-o", self.output, "--progress", "always", *QUICK), 0, "pass 1/2", "100 %")

    def test_writes_png_and_features(self):
        png, layers, folder = self.folder / "a.png", self.folder / "layers.exr", self.folder / "aov"
        self.expect(run(EXAMPLE, "-o", png, "--aov", layers, *QUICK), 0)
        self.assertEqual(png.read_bytes()[:8], b"\x89PNG\r\n\x1a\n")
        self.assertTrue(layers.exists())
        self.expect(run(EXAMPLE, "-o", self.output, "--aov", f"{folder}/", *QUICK), 0)
        self.assertEqual(sorted(p.name for p in folder.iterdir()), ["N.exr", "P.exr", "albedo.exr"])

    def test_features_that_are_not_there_are_refused(self):
        samples = self.folder / "few.exr"
        slots = ("N.X", "N.Y", "N.Z", "P.X", "P.Y", "P.Z", "albedo.R", "albedo.G", "albedo.B")
        self.expect(run("convert", EXAMPLE, "-o", samples, *(f"--map=feature.{slot}=" for slot in slots)), 0)
        self.expect(run(samples, "-o", self.output, "--aov", self.folder / "layers.exr", *QUICK), 2, "--aov", "no features")

    def test_a_preset_is_its_network(self):
        other, crop = self.folder / "other.exr", ["-q", "--crop", "9x9+20+20"]
        for name in ("fast", "balanced", "high"):
            self.expect(run(EXAMPLE, "-o", self.output, "--preset", name, *crop), 0)
            self.assertIn(b"rpf:modelHash", self.output.read_bytes())
            self.expect(run(EXAMPLE, "-o", other, "--model", PROJECT / "networks" / f"{name}.rpfnet", *crop), 0)
            self.assertEqual(self.output.read_bytes(), other.read_bytes())

    def test_balanced_is_what_filters_where_nothing_else_is_asked_for(self):
        other, crop = self.folder / "other.exr", ["-q", "--crop", "9x9+20+20"]
        self.expect(run(EXAMPLE, "-o", self.output, *crop), 0)
        for arguments in (["--preset", "balanced"], ["--method", "learned"], ["--preset=balanced", "--method=learned"]):
            self.expect(run(EXAMPLE, "-o", other, *arguments, *crop), 0)
            self.assertEqual(self.output.read_bytes(), other.read_bytes())

    def test_an_option_of_the_published_algorithm_asks_for_it(self):
        for arguments in (["--profile", "paper"], ["--noise=0.5"], ["--boxes", "5"], ["--seed", "3"]):
            self.expect(run(EXAMPLE, "-o", self.output, "-q", "--crop", "4x4+20+20", *arguments), 0)
            self.assertIn(b"rpf:method\0string\0\x03\0\0\0rpf", self.output.read_bytes())
            self.expect(run(EXAMPLE, "-o", self.output, "--preset", "fast", *arguments), 2, "means nothing to --method learned")

    def test_a_model_that_is_no_network_is_refused(self):
        junk = self.folder / "junk.rpfnet"
        junk.write_bytes(b"junk")
        self.expect(run(EXAMPLE, "-o", self.output, "--model", junk), 3, "junk.rpfnet", "not a network file")
        self.expect(run(EXAMPLE, "-o", self.output, "--model", "absent"), 2, "'absent'", "balanced, fast")
        self.expect(run(EXAMPLE, "-o", self.output, "--model", junk, "--preset", "fast"), 2, "excludes")
        junk.unlink()
        self.expect_nothing_written()

    def test_time_budget_takes_the_best_preset_that_fits(self):
        crop = ["--crop", "4x4+20+20"]
        self.expect(run(EXAMPLE, "-o", self.output, "--time-budget", "10h", *crop), 0, "preset high: predicted to take")
        self.expect(run(EXAMPLE, "-o", self.output, "--time-budget", "1ms", *crop), 0, "preset fast", "none is faster")
        for wrong in ("0", "-3s", "10 parsecs", "soon", "0x10", "1e3s", "inf", ".s", "0.0h"):
            self.expect(run(EXAMPLE, "-o", self.output, "--time-budget=" + wrong), 2, "--time-budget", "10s")
        self.expect(run(EXAMPLE, "-o", self.output, "--time-budget", "3s", "--preset", "fast"), 2, "excludes")

    def test_records_how_an_image_was_made(self):
        self.expect(run(EXAMPLE, "-o", self.output, "--seed", "7", "--bias-correction", *QUICK), 0)
        header = self.output.read_bytes()[:4096]
        for name in (b"rpf:software", b"rpf:profile", b"rpf:boxes", b"rpf:noise", b"rpf:drawSeed", b"rpf:choices",
                     b"bias-correction=true"):
            self.assertIn(name, header)

    def test_methods_filter_samples_and_say_so(self):
        self.expect(run(EXAMPLE, "-o", self.output, "-v", "--method", "cross-bilateral", "--sigma-feature", "0.25"), 0,
                    "method: cross-bilateral", "features: N.X")
        header = self.output.read_bytes()[:4096]
        for name in (b"rpf:method", b"cross-bilateral", b"rpf:sigmaFeature\0float\0\x04\0\0\0\0\0\x80\x3e"):  # 0.25
            self.assertIn(name, header)
        self.assertNotIn(b"rpf:noise", header)

    def test_gaussian_and_bilateral_filter_any_image(self):
        image, gray, flat = self.folder / "in.png", self.folder / "out.jpg", self.folder / "flat.exr"
        self.expect(run(EXAMPLE, "-o", image, "--boxes", "none"), 0)
        before = error_of(run("compare", image, REFERENCE))[0]
        for method, output in (("gaussian", self.output), ("bilateral", self.folder / "out.png"), ("gaussian", gray)):
            self.expect(run(image, "-o", output, "--method", method, "--boxes", "5", "-v"), 0, f"method: {method}")
            self.assertLess(error_of(run("compare", output, REFERENCE))[0], before)
        self.expect(run(EXAMPLE, "-o", flat, "--boxes", "none"), 0)
        self.expect(run(flat, "-o", self.output, "--method", "gaussian", "--boxes", "none"), 0)
        self.assertEqual(error_of(run("compare", self.output, flat))[1], 0)
        for method in ("cross-bilateral", "rpf"):
            for file in (image, flat):
                self.expect(run(file, "-o", self.output, "--method", method), 3, "one list entry for every Monte Carlo sample")
        self.expect(run(image, "-o", self.output, "--method", "gaussian", "--map", "R=G"), 2, "is an image")

    def test_refuses_options_that_mean_nothing_to_the_method(self):
        for method, option in (("gaussian", ["--noise", "1"]), ("bilateral", ["--preset", "fast"]), ("rpf", ["--preset", "fast"]),
                               ("learned", ["--noise", "1"]), ("rpf", ["--model", "fast"]),
                               ("cross-bilateral", ["--profile", "paper"]), ("gaussian", ["--features", "N"]),
                               ("gaussian", ["--sigma-color", "1"]), ("bilateral", ["--sigma-feature", "1"]),
                               ("rpf", ["--sigma-color", "1"]), ("gem", ["--damping", "1"]), ("nlm", ["--gamma", "0.1"]), ("sbf", ["--boxes", "3"]), ("sbf", ["--bandwidth", "1"]), ("gem", ["--views", "9"]), ("lightfield", ["--features", "P"]), ("multidim", ["--random", "lens"]), ("gaussian", ["--time-budget", "1s"])):
            self.expect(run(EXAMPLE, "-o", self.output, "--method", method, *option), 2, option[0], "means nothing to")
        self.expect(run(EXAMPLE, "-o", self.output, "--method", "median"), 2, "median", "cross-bilateral")
        self.expect_nothing_written()

    def test_starts_without_the_libraries_of_other_image_formats(self):
        libraries = subprocess.run(["ldd", RPF], capture_output=True, text=True, check=True).stdout
        self.assertIn("libOpenEXR", libraries)
        self.assertNotIn("libOpenImageIO", libraries)  # 250 libraries, 0.2 CPU seconds

    def test_info_names_slots_and_memory(self):
        self.expect(run("info", EXAMPLE), 0, "random.lens.U", "feature.albedo.R", "4 to 4 a pixel")

    def test_info_predicts_memory_as_the_filter_does(self):
        told = run("info", EXAMPLE).stdout
        for kind, names in (("preset", ("fast", "balanced", "high")), ("profile", ("thesis", "paper"))):
            for name in names:
                need = re.search(f"predicted peak memory, {name} {kind}, .*: (\\d+) MB", told)
                self.assertIsNotNone(need, told)
                result = run(f"--{kind}", name, "--dry-run", EXAMPLE, "-o", self.output)
                self.expect(result, 0, f"peak memory: {need[1]} MB")

    def test_dry_run_writes_nothing(self):
        self.expect(run(EXAMPLE, "-o", self.output, "--dry-run"), 0, "peak memory")
        self.expect_nothing_written()

    def test_version_and_help(self):
        self.assertRegex(run("--version").stdout, r"^rpf \d+\.\d+\.\d+\n$")
        self.expect(run("--help"), 0, "--profile", "--boxes", "Examples", "Exit codes")

    def test_the_default_backend_is_auto_whatever_the_settings_start_from(self):
        for start in ([], ["--preset", "fast"], ["--method", "gaussian"], ["explain"]):
            self.expect(run(*start, "--help"), 0, "--backend TEXT:{cpu,opencl,auto}=auto")

    def test_environment_sets_defaults_and_options_beat_it(self):
        self.expect(run(EXAMPLE, "--dry-run", env={"RPF_NUM_THREADS": "3"}), 0, "3 threads")
        self.expect(run(EXAMPLE, "--dry-run", env={"SLURM_CPUS_PER_TASK": "5"}), 0, "5 threads")
        self.expect(run(EXAMPLE, "--dry-run", "-t", "2", env={"RPF_NUM_THREADS": "3"}), 0, "2 threads")
        self.expect(run(EXAMPLE, "--dry-run", env={"RPF_BACKEND": "abacus"}), 2, "abacus")

    # ---- scenes

    def test_scene_writes_samples_that_info_and_oiiotool_read(self):
        listed = run("scene", "--list").stdout.splitlines()
        names = [line.split()[0] for line in listed]
        self.assertEqual(len(names), 14)
        for name in names:
            with self.subTest(scene=name):
                self.expect(run("scene", name, "-o", self.output, "--size", "32x18", "--spp", "2"), 0, "1152 samples")
                self.expect(run("info", self.output), 0, "2 to 2 a pixel", "random.lens.U", "feature.P2.X", "feature.hit")
                self.expect(run(self.output, "-o", self.folder / "filtered.exr", "--boxes", "3", "-q"), 0)
                if shutil.which("oiiotool"):
                    seen = subprocess.run(["oiiotool", "--info", "-v", self.output], capture_output=True, text=True)
                    self.assertEqual(seen.returncode, 0, seen.stderr)
                    for text in ("32 x   18", "33 channel, deep", f'rpf:scene: "{name}"', "random.time"):
                        self.assertIn(text, seen.stdout)

    def test_scene_writes_the_same_bytes_twice_and_with_any_threads(self):
        for options in ([], ["--adaptive"], ["--sampler", "sobol"], ["--sampler", "stratified"], ["--reference", "8"]):
            with self.subTest(options=options):
                files = []
                for threads in (1, 2, 2):
                    self.expect(run("scene", "combined", "-o", self.output, "--size", "64x36", "-t", threads, "-q", *options), 0)
                    files.append(self.output.read_bytes())
                self.assertEqual(files[0], files[1])
                self.assertEqual(files[1], files[2])

    def test_scene_says_nothing_when_quiet_also_with_more_threads_than_cores(self):
        result = run("scene", "dof", "-o", self.output, "--size", "16x9", "-q", "-t", 64)
        self.assertEqual(result.stdout + result.stderr, "")

    def test_scene_mean_tends_to_its_reference(self):
        samples, reference = self.folder / "samples.exr", self.folder / "reference.exr"
        self.expect(run("scene", "dof", "-o", reference, "--size", "48x27", "--reference", "512"), 0, "residual relMSE")
        errors = []
        for spp in (4, 64):
            self.expect(run("scene", "dof", "-o", samples, "--size", "48x27", "--spp", spp), 0)
            self.expect(run(samples, "-o", self.output, "--boxes", "none", "-q"), 0)
            errors.append(error_of(run("compare", self.output, reference))[0])
        self.assertAlmostEqual(errors[1] / errors[0], 4 / 64, delta=0.03)

    def test_scene_counts_follow_a_rule_or_an_image(self):
        self.expect(run("scene", "dof", "-o", self.output, "--size", "64x36", "--adaptive"), 0)
        self.expect(run("info", self.output), 0, "0 to 8 a pixel")
        density = self.folder / "density.exr"
        self.expect(run("scene", "constant", "-o", density, "--size", "64x36", "--reference", "2"), 0)  # R is 0.25
        self.expect(run("scene", "dof", "-o", self.output, "--size", "64x36", "--spp", "8", "--density", density), 0)
        self.expect(run("info", self.output), 0, "2 to 2 a pixel")

    def test_scene_world_scale_and_offset(self):
        self.expect(run("scene", "constant", "-o", self.output, "--size", "8x8", "--world-scale", "10", "--world-offset", "-5,7,1000"), 0)
        positions = [line.split() for line in run("info", self.output).stdout.splitlines() if "feature.P.Z" in line]
        self.assertEqual(positions[0][3:5], ["980", "980"])  # 10 * -2 + 1000

    def test_scene_errors(self):
        name = ["scene", "dof", "-o", self.output]
        for arguments, code, text in ((["scene", "door", "-o", self.output], 2, "dof-edge"), (["scene"], 2, "--list"), (["scene", "dof"], 2, "no output"),
                                      ([*name, "--size", "8"], 2, "--size 8"), ([*name, "--spp", "0"], 2, "--spp"),
                                      ([*name, "--sampler", "dice"], 2, "dice"), ([*name, "--world-offset", "1,2"], 2, "world-offset"),
                                      ([*name, "--reference", "1"], 2, "reference"), ([*name, "--adaptive", "--reference", "8"], 2, "excludes"),
                                      ([*name, "--density", EXAMPLE.parent / "none.exr"], 3, "none.exr"), ([*name, "--density", REFERENCE], 2, "density"),
                                      ([*name, "--spp", "1000000"], 2, "4294967294"), ([*name, "--spp", "10000", "--max-memory", "100"], 6, "memory"), (["scene", "dof", "-o", self.folder / "a" / "b.exr"], 4, "b.exr")):
            with self.subTest(text=text):
                self.expect(run(*arguments), code, text)
                self.expect_nothing_written()

    # ---- what cannot be

    def test_usage_errors(self):
        for arguments, text in (([], "no input"), ([EXAMPLE], "no output"), ([EXAMPLE, "-o", self.output, "--boxes", "8"], "--boxes 8"),
                                ([EXAMPLE, "-o", self.output, "--boxes", "7,x"], "--boxes 7,x"),
                                ([EXAMPLE, "-o", self.output, "--features", "N,Q"], "feature 'Q'"),
                                ([EXAMPLE, "-o", self.output, "--random", "moon"], "random parameter 'moon'"),
                                ([EXAMPLE, "-o", self.output, "--crop", "9x9"], "--crop 9x9"),
                                ([EXAMPLE, "-o", self.output, "--crop", "9x9+9999+0"], "not inside"),
                                ([EXAMPLE, "-o", self.output, "--map", "feature.N.X"], "SLOT=CHANNEL"),
                                ([EXAMPLE, "-o", self.output, "--noise", "0"], "noise"),
                                ([EXAMPLE, "-o", self.output, "--redraws", "16"], "--redraws"), ([EXAMPLE, "--nonsense"], "nonsense"),
                                ([EXAMPLE, "-o", self.output, "--backend", "abacus"], "abacus")):
            with self.subTest(text=text):
                self.expect(run(*arguments), 2, text)
                self.expect_nothing_written()

    def test_input_errors(self):
        cut = self.folder / "cut.exr"
        cut.write_bytes(EXAMPLE.read_bytes()[:100000])
        text = self.folder / "text.exr"
        text.write_text("not an image")
        for file, expected in (("missing.exr", "missing.exr"), (cut, "cut.exr"), (text, "text.exr"), (REFERENCE, "deep"), (self.folder, "test")):
            with self.subTest(file=file):
                self.expect(run(file, "-o", self.output), 3, expected)
                self.assertFalse(self.output.exists())

    def test_output_errors(self):
        nowhere = self.folder / "nowhere" / "a.exr"
        self.expect(run(EXAMPLE, "-o", nowhere, *QUICK), 4, "nowhere")
        self.expect(run(EXAMPLE, "-o", self.folder / "a.xyz", *QUICK), 4, "xyz", "exr")
        folder = self.folder / "folder.exr"
        folder.mkdir()
        self.expect(run(EXAMPLE, "-o", folder, *QUICK), 4, "folder.exr")
        self.assertEqual([p.name for p in self.folder.iterdir()], ["folder.exr"])

    def test_memory_limit(self):
        self.expect(run(EXAMPLE, "-o", self.output, "--max-memory", "1"), 6, "the limit is 1 MB")
        self.expect_nothing_written()

    # ---- stopping

    def test_signals_stop_within_two_seconds_and_leave_nothing(self):
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            process = subprocess.Popen([RPF, EXAMPLE, "-o", self.output, "--boxes", "55,55,55,55", "--samples-factor", "8"],
                                       stdout=subprocess.PIPE, stderr=subprocess.PIPE)
            time.sleep(1.0)
            start = time.monotonic()
            process.send_signal(number)
            process.communicate(timeout=30)
            self.assertLess(time.monotonic() - start, 2.0)
            self.assertIn(process.returncode, (128 + number, -number))
            self.expect_nothing_written()

    def test_a_signal_stops_a_reference(self):
        process = subprocess.Popen([RPF, "scene", "dof", "-o", self.output, "--reference", "100000"], stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        time.sleep(0.5)
        start = time.monotonic()
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=30)
        self.assertLess(time.monotonic() - start, 2.0)
        self.assertIn(process.returncode, (130, -signal.SIGINT))
        self.expect_nothing_written()

    def test_closed_standard_output_is_no_reason_to_lose_the_image(self):
        subprocess.run(f"'{RPF}' '{EXAMPLE}' -o '{self.output}' {' '.join(QUICK)} >&- 2>&-", shell=True, check=False)
        self.assertTrue(self.output.exists())

    # ---- the real files, where they are

    def test_real_files_can_be_read(self):
        files = sorted(SHARED.glob("*.samples.exr")) if SHARED.is_dir() else []
        if not files:
            self.skipTest("skipped: ../shared/data is not here")
        for file in files:
            with self.subTest(file=file.name):
                self.expect(run(file, "-o", self.output, "--boxes", "3", "--crop", "8x8+100+100"), 0)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
