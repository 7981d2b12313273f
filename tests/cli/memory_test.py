"""Every command that reads: what it needs is compared with the limit before it is taken. Usage: memory_test.py RPF PROJECT"""
import os
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib
from pathlib import Path

import numpy as np

from command_case import SANITIZED
from small_files import write_exr

RPF, PROJECT = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
EXAMPLE = PROJECT / "examples" / "dof-spheres.samples.exr"
PROGRAM_MB = 260  # what the program itself takes, with all libraries that read images and with OpenCL
HEADERS_MB = 8  # enough for headers


def black_png(width, height):
    """Some bytes that unpack to a lot."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    packer = zlib.compressobj(9)
    rows = b"".join(packer.compress(bytes(3 * width + 1)) for _ in range(height)) + packer.flush()
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)) + chunk(b"IDAT", rows) + chunk(b"IEND", b"")


def exr_header(width, height):
    """A flat EXR file that ends behind its header and an empty table of its rows."""
    def attribute(name, kind, value):
        return name + b"\0" + kind + b"\0" + struct.pack("<I", len(value)) + value
    channels = b"".join(name + b"\0" + struct.pack("<iiii", 2, 0, 1, 1) for name in (b"B", b"G", b"R")) + b"\0"
    window = struct.pack("<4i", 0, 0, width - 1, height - 1)
    return (struct.pack("<II", 20000630, 2) + attribute(b"channels", b"chlist", channels) + attribute(b"compression", b"compression", b"\x03") +
            attribute(b"dataWindow", b"box2i", window) + attribute(b"displayWindow", b"box2i", window) + attribute(b"lineOrder", b"lineOrder", b"\0") +
            attribute(b"pixelAspectRatio", b"float", struct.pack("<f", 1)) + attribute(b"screenWindowCenter", b"v2f", bytes(8)) +
            attribute(b"screenWindowWidth", b"float", struct.pack("<f", 1)) + b"\0" + bytes(8 * ((height + 15) // 16)))


class Memory(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="rpf memory "))
        self.samples, self.picture, self.header = (self.folder / name for name in ("samples.exr", "picture.png", "header.exr"))
        self.picture.write_bytes(black_png(400, 300))
        self.header.write_bytes(exr_header(40000, 20000))

    def tearDown(self):
        shutil.rmtree(self.folder)

    def run_rpf(self, *arguments, **environment):
        """Exit code, text, peak in MB."""
        with tempfile.TemporaryFile("w+") as text:
            process = subprocess.Popen([RPF, *map(str, arguments)], stdout=text, stderr=subprocess.STDOUT, env={**os.environ, **environment})
            _, status, usage = os.wait4(process.pid, 0)
            process.returncode = os.waitstatus_to_exitcode(status)
            text.seek(0)
            return process.returncode, text.read(), usage.ru_maxrss / 1024

    def expect_refusal(self, arguments, **environment):
        code, text, peak = self.run_rpf(*arguments, **environment)
        self.assertEqual(code, 6, text)
        self.assertRegex(text, r"needs? [\d.]+ MB|takes? [\d.]+ MB")
        if not SANITIZED:
            self.assertLess(peak, PROGRAM_MB)
        return float(re.search(r"(?:needs?|takes?) ([\d.]+) MB", text)[1])

    def commands(self):
        output = self.folder / "out.exr"
        self.assertEqual(self.run_rpf("scene", "dof", "--size", "300x200", "--spp", "4", "-q", "-o", self.samples)[0], 0)
        other = self.folder / "other.exr"
        self.assertEqual(self.run_rpf("scene", "dof", "--size", "300x200", "--spp", "4", "--seed", "2", "-q", "-o", other)[0], 0)
        self.assertEqual(self.run_rpf(self.samples, "-o", self.samples.with_name("mean.exr"), "--boxes", "none", "-q")[0], 0)
        rounds = [RPF, "scene", "dof", "--size", "300x200", "--spp", "1", "-q", "--density", "{density}", "--seed", "{seed}", "-o", "{output}"]
        return {"filter": [self.samples, "-o", output, "--boxes", "3", "--drop-uninformative", "-q"],
                "bilateral": ["--method", "bilateral", self.picture, "-o", output, "--boxes", "3", "-q"],
                "compare": ["compare", self.picture, self.picture],
                "side by side": ["compare", self.picture, self.picture, self.picture, "--side-by-side", self.folder / "out.png"],
                "convert": ["convert", self.samples, "-o", output],
                "join": ["join", self.part(), "-o", output],
                "merge": ["merge", self.samples, other, "-o", output],
                "density": ["density", self.samples, "-o", output],
                "adapt": ["adapt", self.samples, "--spp", "6", "--", *rounds],
                "report": ["report", self.samples, self.samples.with_name("mean.exr"), self.samples.with_name("mean.exr"), "-o", self.folder / "page.html", "-q"],
                "explain": ["explain", self.samples, "-o", self.folder / "explained", "--box", "3", "-q"]}

    def part(self):
        """All rows of a frame, as rpf --rows marks them."""
        path, zeros = self.folder / "part.exr", np.zeros((600, 1000), np.float32)
        marks = [("rpf:rows", "string", b"0-599"), ("rpf:frameWindow", "string", b"1000x600+0+0")]
        write_exr(path, {channel: zeros for channel in "RGB"}, attributes=marks)
        return path

    def test_every_command_knows_what_it_needs(self):
        """Refused with what it needs, by option and by environment, before that is taken; and it takes no more."""
        for name, arguments in self.commands().items():
            with self.subTest(name):
                at = arguments.index("--") if "--" in arguments else len(arguments)  # another command stands behind it
                need = self.expect_refusal([*arguments[:at], "--max-memory", HEADERS_MB, *arguments[at:]])
                self.assertEqual(self.expect_refusal(arguments, RPF_MAX_MEMORY_MB=str(HEADERS_MB)), need)
                code, text, peak = self.run_rpf(*arguments)
                self.assertEqual(code, 0, text)
                print(f"{name}: predicted {need:.0f} MB, peak {peak:.0f} MB", file=sys.stderr)
                if not SANITIZED:
                    self.assertLess(peak, need + PROGRAM_MB)

    def test_passes_over_rows_that_are_read_as_they_are_needed(self):
        """The same file within less than half of the memory of the whole frame."""
        self.assertEqual(self.run_rpf("scene", "dof", "--size", "300x400", "--spp", "16", "-q", "-o", self.samples)[0], 0)
        pictures = [self.folder / "whole.exr", self.folder / "streamed.exr"]
        filtering = [self.samples, "--profile", "thesis", "--boxes", "5,3", "--backend", "cpu"]
        _, text, whole_peak = self.run_rpf(*filtering, "-o", pictures[0], "-v")
        limit = int(re.search(r"peak memory: (\d+) MB", text)[1]) * 2 // 5
        code, text, peak = self.run_rpf(*filtering, "-o", pictures[1], "-v", "--max-memory", limit)
        self.assertEqual(code, 0, text)
        needed = re.search(r"rows are read as they are needed, \d+ at once, \d+ in memory: (\d+) MB", text)
        self.assertLessEqual(int(needed[1]), limit)
        self.assertEqual(pictures[0].read_bytes(), pictures[1].read_bytes())
        print(f"whole: {whole_peak:.0f} MB, streamed: limit {limit} MB, predicted {needed[1]} MB, peak {peak:.0f} MB", file=sys.stderr)
        if not SANITIZED:
            self.assertLess(peak, limit + 30)  # the program itself

    def test_a_small_file_that_is_a_large_picture(self):
        self.picture.write_bytes(black_png(8000, 8000))
        for arguments in (["--method", "bilateral", self.picture, "-o", self.folder / "out.exr"], ["compare", self.picture, self.picture]):
            self.assertGreater(self.expect_refusal([*arguments, "--max-memory", "100"]), 1000)

    def test_pictures_beside_the_samples(self):
        self.assertEqual(self.run_rpf("scene", "dof", "--size", "8x6", "--spp", "4", "-q", "-o", self.samples)[0], 0)
        for arguments in (["scene", "dof", "--density", self.header], ["density", self.samples, "--error", self.header], ["join", self.header]):
            self.expect_refusal([*arguments, "-o", self.folder / "out.exr", "--max-memory", "1000"])

    def test_a_network(self):
        self.assertEqual(self.run_rpf("scene", "dof", "--size", "8x6", "--spp", "4", "-q", "-o", self.samples)[0], 0)
        network = self.folder / "large.rpfnet"
        with open(network, "wb") as file:
            file.truncate(200 << 20)
        code, text, peak = self.run_rpf(self.samples, "--model", network, "-o", self.folder / "out.exr", "--max-memory", "150")
        self.assertEqual(code, 6, text)
        self.assertIn("takes more than the limit of 150 MB", text)
        if not SANITIZED:
            self.assertLess(peak, 150)

    def test_scenes(self):
        for kind in (["--spp", "1"], ["--reference", "2"]):
            with self.subTest(kind):
                arguments = ["scene", "dof", "--size", "3000x2000", *kind, "-o", self.folder / "out.exr"]
                need = self.expect_refusal([*arguments, "--max-memory", HEADERS_MB])
                self.assertEqual(self.expect_refusal(arguments, RPF_MAX_MEMORY_MB=str(HEADERS_MB)), need)

    def test_a_header_that_promises_more_than_there_is(self):
        arguments = ["--method", "bilateral", self.header, "-o", self.folder / "out.exr"]
        self.expect_refusal([*arguments, "--max-memory", "1000"])
        code, text, peak = self.run_rpf(*arguments, "--max-memory", "100000")
        self.assertEqual(code, 3, text)
        if not SANITIZED:
            self.assertLess(peak, 2 * PROGRAM_MB)  # memory is taken for pixels that come

    def expect_in_group(self, controller, limits, expected):
        """What a dry run says in a group below one with these limits."""
        own = re.search(rf"^\d+:(?:.*,)?{controller}(?:,.*)?:(.*)$", Path("/proc/self/cgroup").read_text(encoding="utf-8"), re.M)
        group = Path("/sys/fs/cgroup") / controller / (own[1].lstrip("/") if own else "") / f"rpf-test-{os.getpid()}"
        inner = group / "inner"
        try:
            inner.mkdir(parents=True)
            for name, value in limits.items():
                (group / name).write_text(str(value))
        except OSError:
            self.skipTest(f"skipped: no control group of version 1 can be made for {controller}")
        try:
            result = subprocess.run(["sh", "-c", 'echo $$ > "$0/cgroup.procs" && exec "$@"', inner, RPF, EXAMPLE, "--dry-run"], capture_output=True, text=True, check=False)
            self.assertIn(expected, result.stdout + result.stderr)
        finally:
            inner.rmdir()
            group.rmdir()

    def test_the_limit_of_a_control_group(self):
        self.expect_in_group("memory", {"memory.limit_in_bytes": 300 << 20}, "of at most 270 MB")

    def test_the_processors_of_a_control_group(self):
        """A part of one is one thread, on any machine."""
        self.expect_in_group("cpu", {"cpu.cfs_period_us": 100000, "cpu.cfs_quota_us": 70000}, ", 1 threads")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
