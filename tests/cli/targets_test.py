"""What the command writes to: names, links, rights, formats; nothing is lost and nothing is found out late.
Usage: targets_test.py RPF PROJECT"""
import os
import shutil
import subprocess
import sys
import time
import unittest
from pathlib import Path

import numpy as np

from command_case import EXAMPLE, PROJECT, RPF, CommandCase
from small_files import attribute, frame, write_exr, write_raw, write_tiff  # noqa: F401

FAST = ["--backend", "cpu", "--boxes", "3", "--max-samples", "20"]


def run(*arguments, **keywords):
    return subprocess.run([RPF, *map(str, arguments)], capture_output=True, text=True, timeout=300, check=False, **keywords)


def noise(height=6, width=8, seed=1, dtype=np.float32):
    return np.random.default_rng(seed).random((height, width)).astype(dtype)


class TargetsTest(CommandCase):
    def setUp(self):
        super().setUp()
        self.samples = self.folder / "s.rpf"
        write_raw(self.samples, frame())
        self.output = self.folder / "out.exr"

    def expect_refused(self, code, *texts, arguments, **keywords):
        """And nothing has changed in the folder."""
        def files():
            return {p: p.is_dir() or p.lstat().st_mtime_ns for p in self.folder.rglob("*")}
        before = files()
        self.expect(run(*arguments, **keywords), code, *texts)
        self.assertEqual(files(), before)

    # ---- two results, one file

    def test_picture_and_features_are_two_files(self):
        for aov in (self.output, self.folder / "." / "out.exr", self.link("l.exr", "out.exr")):
            self.expect_refused(2, "one file", arguments=[*FAST, self.samples, "-o", self.output, "--aov", aov])

    def link(self, name, target):
        path = self.folder / name
        path.symlink_to(target)
        return path

    def test_the_folder_of_features_does_not_hide_the_output_or_the_input(self):
        aov = self.folder / "aov"
        aov.mkdir()
        self.expect_refused(2, "one file", arguments=[*FAST, self.samples, "-o", aov / "N.exr", "--aov", aov])
        inside = aov / "P.exr"
        shutil.copy(self.samples, inside)
        self.expect_refused(2, "would be lost", arguments=[*FAST, inside, "-o", self.output, "--aov", aov])
        self.expect(run(*FAST, self.samples, "-o", self.output, "--aov", str(self.folder / "new") + "/"), 0)
        self.assertEqual(sorted(p.name for p in (self.folder / "new").iterdir()), ["N.exr", "P.exr", "albedo.exr"])

    def test_a_group_that_is_a_path_does_not_leave_the_folder(self):
        channels = frame()
        channels["feature./tmp/x.R"] = channels["feature.albedo.R"]
        write_raw(self.samples, channels)
        self.expect_refused(3, "no name of a file", arguments=[*FAST, self.samples, "-o", self.output, "--aov", str(self.folder / "aov") + "/"])

    def test_inputs_that_no_result_stands_for_stay(self):
        image = self.folder / "a.exr"
        write_exr(image, {c: noise(seed=i) for i, c in enumerate("RGB")})
        self.expect_refused(2, "would be lost", arguments=["compare", image, image, "--diff", image])
        self.expect_refused(2, "would be lost", arguments=["compare", image, image, "--side-by-side", image])
        self.expect_refused(2, "one file", arguments=["compare", image, image, "--side-by-side", self.folder / "x.png", "--diff", self.folder / "x.png"])
        self.expect_refused(2, "would be lost", arguments=[*FAST, self.samples, "-o", self.output, "--aov", self.link("l.exr", "s.rpf")])
        self.expect_refused(2, "would be lost", arguments=["scene", "dof", "--size", "8x6", "--density", image, "-o", image])
        shutil.copy(EXAMPLE, self.folder / "explain.exr")
        self.expect_refused(2, "would be lost", arguments=["explain", self.folder / "explain.exr", "-o", self.folder])
        plan = self.folder / "plan.json"
        plan.write_text('{"frames": [{"scene": "dof", "size": "8x6"}], "settings": {"a": "--boxes 3"}}')
        self.assertNotEqual(run("bench", "sweep", plan, "-o", plan).returncode, 0)
        self.assertIn("settings", plan.read_text())

    def test_networks_and_facts_stay(self):
        network, facts = self.folder / "network.exr", self.folder / "facts.exr"
        shutil.copy(PROJECT / "networks" / "fast.rpfnet", network)
        learned = ["--backend", "cpu", "--model", network]
        self.expect_refused(2, "would be lost", arguments=[*learned, self.samples, "-o", network])
        self.expect_refused(2, "would be lost", arguments=[*learned, self.samples, "-o", self.output, "--aov", self.link("l.exr", "network.exr")])
        self.expect_refused(2, "would be lost", arguments=["facts", self.samples, "-o", network, *learned])
        self.expect(run("facts", self.samples, "-o", self.folder / "facts.json", *FAST), 0)
        shutil.move(self.folder / "facts.json", facts)  # an image may have that name
        self.expect_refused(2, "would be lost", arguments=[*FAST, self.samples, "-o", facts, "--facts", facts])

    def test_lines_of_a_log_go_into_no_file_of_a_frame(self):
        network = self.folder / "network.rpfnet"
        shutil.copy(PROJECT / "networks" / "fast.rpfnet", network)
        first, second = self.folder / "f.1.rpf", self.folder / "f.2.rpf"
        for frame_of in (first, second):
            shutil.copy(self.samples, frame_of)
        frames = [self.folder / "f.#.rpf", "-o", self.folder / "o.#.exr", "--aov", self.folder / "a.#.exr", "--model", network, "--backend", "cpu"]
        for log in (first, second, self.link("l", "f.2.rpf"), network, self.folder / "o.2.exr", self.folder / "a.1.exr"):
            self.expect_refused(2, "--log-json", "name another file", arguments=[*frames, "--log-json", log])
        self.expect_refused(2, "--log-json", arguments=[*FAST, self.samples, "-o", self.output, "--log-json", self.samples])

    def test_samples_are_not_replaced_by_their_picture(self):
        deep = self.folder / "s.exr"
        shutil.copy(EXAMPLE, deep)
        raw = self.folder / "raw.exr"  # the content decides what it is read as
        write_raw(raw, frame())
        for samples, output in ((deep, deep), (deep, self.link("l.exr", "s.exr")), (raw, raw)):
            for settings in (FAST, ["--backend", "cpu", "--preset", "fast"], ["--backend", "cpu", "--method", "bilateral"]):
                self.expect_refused(2, "would be lost", "name another file", arguments=[*settings, samples, "-o", output])
        self.expect_refused(2, "would be lost", arguments=[*FAST, "--dry-run", deep, "-o", deep])

    # ---- links, rights, other writers

    def test_links_lead_to_where_the_result_is_written(self):
        (self.folder / "real").mkdir()
        for name, target in (("new.exr", "real/new.exr"), ("chain.exr", "new2.exr"), ("new2.exr", "real/new2.exr")):
            self.link(name, target)
        for name in ("new.exr", "chain.exr"):
            self.expect(run(*FAST, self.samples, "-o", self.folder / name), 0)
            self.assertTrue((self.folder / name).is_symlink())
        self.assertEqual(sorted(p.name for p in (self.folder / "real").iterdir()), ["new.exr", "new2.exr"])

    def test_links_that_lead_nowhere_are_refused_by_every_writer(self):
        lost, circle = self.link("lost.exr", "missing/x.exr"), self.link("circle.exr", "circle.exr")
        second = self.folder / "second.rpf"
        shutil.copy(self.samples, second)
        for writer in ([*FAST, self.samples], ["convert", self.samples], ["scene", "dof", "--size", "8x6"], ["merge", self.samples, second],
                       ["density", self.samples], ["facts", self.samples], ["join", self.samples], ["report", self.samples, self.samples]):
            self.expect_refused(4, "missing/x.exr", "make the folder", arguments=[*writer, "-o", lost])
            self.expect_refused(4, "symbolic links", arguments=[*writer, "-o", circle])

    def test_protected_files_stay_and_rights_are_kept(self):
        self.output.write_bytes(b"old")
        for mode in (0o444, 0o400):
            self.output.chmod(mode)
            for writer in ([*FAST, self.samples], ["convert", self.samples], ["scene", "dof", "--size", "8x6"]):
                self.expect_refused(4, "write-protected", f"{mode:04o}", arguments=[*writer, "-o", self.output])
        for mode in (0o600, 0o660):
            self.output.chmod(mode)
            self.expect(run(*FAST, self.samples, "-o", self.output), 0)
            self.assertEqual(self.output.stat().st_mode & 0o7777, mode)

    @unittest.skipUnless(os.geteuid() == 0, "needs another user")
    def test_a_file_of_somebody_else_in_a_sticky_folder(self):
        self.folder.chmod(0o1777)
        self.output.write_bytes(b"old")
        self.output.chmod(0o666)
        outer = [p for p in Path(RPF).resolve().parents if p.stat().st_mode & 0o005 != 0o005]
        if outer:
            self.skipTest(f"others may not enter {outer[0]}")
        self.expect_refused(4, "belongs to somebody else", arguments=[*FAST, self.samples, "-o", self.output], user=65534, group=65534)

    @unittest.skipUnless(os.geteuid() == 0 and shutil.which("unshare"), "needs to mount")
    def test_a_file_that_is_mounted(self):
        self.output.write_bytes(b"old")
        (self.folder / "other").write_bytes(b"")
        script = f'mount --bind "{self.folder}/other" "{self.output}" && "{RPF}" --boxes 3 "{self.samples}" -o "{self.output}"'
        result = subprocess.run(["unshare", "-m", "sh", "-c", script], capture_output=True, text=True, timeout=300, check=False)
        if "mount" in result.stderr and "permitted" in result.stderr:
            self.skipTest("mounting is not permitted")
        self.expect(result, 4, "is mounted as a file of its own")

    @unittest.skipUnless(shutil.which("strace"), "strace answers flock() as a disk does whose locks are local")
    def test_two_machines_whose_locks_do_not_meet(self):
        slow = ["strace", "-f", "-o", self.folder / "a.trace", "-e", "trace=fsync", "-e", "inject=fsync:delay_enter=3000000:when=1"]
        blind = ["strace", "-f", "-o", self.folder / "b.trace", "-e", "trace=flock", "-e", "inject=flock:retval=0"]
        traced = {**os.environ, "ASAN_OPTIONS": os.environ.get("ASAN_OPTIONS", "") + ":detect_leaks=0"}  # that traces, too: one can
        first = subprocess.Popen([*slow, RPF, *FAST, "-q", self.samples, "-o", self.folder / "1.exr"], stderr=subprocess.PIPE, env=traced)
        deadline = time.monotonic() + 60
        while not list(self.folder.glob(".rpf-*-1.exr")) and first.poll() is None and time.monotonic() < deadline:
            time.sleep(0.02)
        if first.poll() is not None and b"strace" in first.stderr.read():
            self.skipTest("tracing is not permitted")
        second = subprocess.run([*blind, RPF, *FAST, "-q", self.samples, "-o", self.folder / "2.exr"], capture_output=True, text=True, timeout=300, check=False, env=traced)
        self.assertEqual(second.returncode, 0, second.stderr)
        self.assertEqual(first.wait(300), 0)
        first.stderr.close()
        self.assertTrue((self.folder / "1.exr").exists() and (self.folder / "2.exr").exists())

    # ---- what is refused before the work, also by a dry run

    def test_formats_are_asked_first(self):
        for dry in ([], ["--dry-run"]):
            common = [*FAST, *dry, self.samples, "-o"]
            self.expect_refused(4, "a.png", "R, G and B", arguments=[*common, self.output, "--aov", self.folder / "a.png"])
            self.expect_refused(4, "a.xyz", ".exr", arguments=[*common, self.output, "--aov", self.folder / "a.xyz"])
            self.expect_refused(4, "a.xyz", ".exr", arguments=[*common, self.folder / "a.xyz"])
        self.expect_refused(4, "x.rpf", ".exr", arguments=["scene", "dof", "--size", "8x6", "--reference", "2", "-o", self.folder / "x.rpf"])
        self.expect_refused(4, "x.png", ".exr", arguments=["scene", "dof", "--size", "8x6", "-o", self.folder / "x.png"])
        self.expect_refused(2, "--crop 4x4+6+0", "8x6+0+0", arguments=[*FAST, "--dry-run", self.samples, "-o", self.output, "--crop", "4x4+6+0"])
        for arguments in ([*FAST, self.samples, "-o", self.output, "--report"], ["facts", self.samples, "-o"],
                          ["report", self.samples, self.samples, "-o"]):
            self.expect_refused(2, "p.png", "name of an image or of samples", arguments=[*arguments, self.folder / "p.png"])
        write_raw(self.samples, frame(8, 6, 1), spp=1)
        self.expect_refused(3, "no pixel has 2 samples", arguments=[*FAST, "--dry-run", self.samples, "-o", self.output, "--aov", self.folder / "a.exr", "--error"])
        write_raw(self.samples, frame(17000, 1, 1), 17000, 1, 1)
        self.expect_refused(4, "16383", arguments=[*FAST, "--dry-run", self.samples, "-o", self.folder / "wide.webp"])

    def test_a_missing_library_of_images_is_found_first(self):
        alone = self.folder / "bin"
        alone.mkdir()
        program = Path(RPF).read_bytes()
        built = str(Path(RPF).resolve().parent).encode() + b"\0"
        copy = alone / "rpf"
        copy.write_bytes(program.replace(built, b"/" + b"x" * (len(built) - 2) + b"\0"))
        if built not in program:
            self.skipTest("the folder of the build is not in the program")
        copy.chmod(0o755)
        for arguments in ([*FAST, self.samples, "-o", self.folder / "a.png"], [*FAST, "--dry-run", self.samples, "-o", self.folder / "a.png"],
                          ["explain", self.samples, "-o", self.folder / "pages"]):
            result = subprocess.run([copy, *map(str, arguments)], capture_output=True, text=True, timeout=300, check=False)
            self.expect(result, 4, "librpf_images.so", "write an .exr file")
        self.expect(subprocess.run([copy, *FAST, "-q", str(self.samples), "-o", str(self.output)], capture_output=True, text=True, timeout=300, check=False), 0)
        result = subprocess.run([copy, "compare", str(self.output), str(self.output)], capture_output=True, text=True, timeout=300, check=False)
        self.expect(result, 3, "librpf_images.so")

    # ---- what is dropped

    def test_several_images_in_one_file_are_refused(self):
        pages = self.folder / "pages.tif"
        write_tiff(pages, [np.full((6, 8, 3), v, np.uint8) for v in (10, 20, 30)])
        before = pages.read_bytes()
        for arguments in (["--method", "bilateral", pages, "-o", pages], ["--method", "gaussian", pages, "-o", self.output], ["compare", pages, pages]):
            self.expect_refused(3, "images", "would be lost", arguments=arguments)
        self.assertEqual(pages.read_bytes(), before)

    def test_channels_and_attributes_that_are_dropped_are_named_and_not_lost_in_place(self):
        image = self.folder / "layers.exr"
        channels = {c: noise(seed=i) for i, c in enumerate(["R", "G", "B", "left.R", "left.G", "left.B", "Z"])}
        write_exr(image, channels, attributes=[("shot", "v2i", b"\1\0\0\0\2\0\0\0")])
        for in_place in (image, self.link("link.exr", "layers.exr")):
            self.expect_refused(2, "left.R", "Z", "shot", "would replace its input", arguments=["--method", "bilateral", image, "-o", in_place])
        result = run("--method", "bilateral", image, "-o", self.output)
        self.expect(result, 0)
        notes = [line for line in result.stderr.splitlines() if "not in the result" in line]
        self.assertEqual(len(notes), 1, result.stderr)
        self.assertIn("left.R", notes[0])
        self.assertIn("shot", notes[0])
        self.assertEqual(run("--method", "bilateral", "-q", image, "-o", self.output).stderr, "")

    def test_sample_channels_without_a_slot_are_named_and_not_lost_in_place(self):
        channels = frame()
        channels["object.id"] = channels["R"]
        write_raw(self.samples, channels)
        self.expect_refused(2, "object.id", "would replace its input", arguments=["convert", self.samples, "-o", self.samples])
        for arguments in (["convert", self.samples, "-o", self.folder / "b.rpf"], [*FAST, self.samples, "-o", self.output]):
            result = run(*arguments)
            self.expect(result, 0)
            self.assertIn("object.id", result.stderr)

    def test_an_alpha_that_the_format_has_no_room_for_is_named(self):
        channels = frame()
        channels["A"] = channels["feature.albedo.R"]
        write_raw(self.samples, channels)
        image = self.folder / "a.exr"
        write_exr(image, {c: noise(seed=i) for i, c in enumerate("ARGB")})
        for arguments in ([*FAST, self.samples], ["--method", "bilateral", image]):
            for name, said in (("b.jpg", True), ("b.hdr", True), ("b.png", False), ("b.exr", False)):
                result = run(*arguments, "-o", self.folder / name)
                self.expect(result, 0)
                self.assertEqual("not in the result: channels A" in result.stderr, said, (name, result.stderr))
            self.assertEqual(run(*arguments, "-q", "-o", self.folder / "b.jpg").stderr, "")
        write_exr(self.folder / "c.jpg", {c: noise(seed=i) for i, c in enumerate("ARGB")})  # the content decides
        self.expect_refused(2, "lose channels A", arguments=["--method", "bilateral", self.folder / "c.jpg", "-o", self.folder / "c.jpg"])

    def test_sixteen_bits_do_not_become_eight_in_place(self):
        image = self.folder / "a.png"  # the content decides what it is read as
        write_tiff(image, [np.full((6, 8, 3), 12345, np.uint16)])
        self.expect_refused(2, "8 of its 16 bits", arguments=["--method", "gaussian", image, "-o", image])
        write_tiff(image, [np.full((6, 8, 3), 123, np.uint8)])
        self.expect(run("--method", "gaussian", image, "-o", image), 0)

    def test_in_place_keeps_what_it_can_keep(self):
        image = self.folder / "a.exr"
        write_exr(image, {c: noise(seed=i) for i, c in enumerate("ARGB")})
        self.expect(run("--method", "bilateral", image, "-o", image), 0)
        self.expect(run(*FAST, self.samples, "-o", self.output), 0)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
