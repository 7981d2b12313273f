"""Files that the header for renderers writes: bytes equal to those of the numpy code of docs/file-format.md, whole or not at all, within
its memory. Usage: rpf_samples_test.py WRITE_NUMBERS PROJECT"""
import re
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

import numpy as np

WRITE_NUMBERS, PROJECT = sys.argv[1], Path(sys.argv[2]).resolve()
exec(re.search(r"```python\n(.*?)```", (PROJECT / "docs" / "file-format.md").read_text(encoding="utf-8"), re.S).group(1))  # write_samples

OUTPUT_ERROR = 2  # RPF_SAMPLES_OUTPUT
OLD = b"the old file"


def command(path, width, height, most_samples, threads):
    return [WRITE_NUMBERS, *map(str, (path, width, height, most_samples, threads))]


def limit_file_size(size):
    """A full disk for everybody: needs no rights. A renderer that ignores the signal is told by the error."""
    signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))


class SampleHeaderTest(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="rpf header ü "))  # a blank and UTF-8 on purpose
        self.path = self.folder / "a.rpf"

    def tearDown(self):
        shutil.rmtree(self.folder)

    def write(self, *arguments, **keywords):
        return subprocess.run(command(self.path, *arguments), capture_output=True, text=True, timeout=300, check=False, **keywords)

    def expect_the_bytes_of_numpy(self, width, height, most_samples, threads):
        result = self.write(width, height, most_samples, threads)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        counts = np.arange(width * height) * 7 % (most_samples + 1)
        pixels = np.repeat(np.arange(width * height), counts)
        samples = np.arange(len(pixels)) - np.repeat(np.cumsum(counts) - counts, counts)
        names = ("R", "G", "B", "film.X", "film.Y", "random.time")
        channels = {name: 1000 * pixels + 10 * samples + c for c, name in enumerate(names)}
        write_samples(self.folder / "numpy.rpf", [0, 0, width, height], counts, channels, {"rpf:seed": 7})
        self.assertTrue(self.path.read_bytes() == (self.folder / "numpy.rpf").read_bytes())
        self.assertEqual(sorted(entry.name for entry in self.folder.iterdir()), ["a.rpf", "numpy.rpf"])

    def test_bytes_are_those_of_numpy(self):
        for size in ((1, 1, 0), (1, 1, 3), (50, 1, 1), (123, 45, 4), (150, 70, 60)):
            for threads in (1, 5):
                with self.subTest(size=size, threads=threads):
                    self.expect_the_bytes_of_numpy(*size, threads)

    def expect_old_file_survives(self, folder, message, *arguments, **keywords):
        self.path = folder / "a.rpf"
        self.path.write_bytes(OLD)
        result = self.write(*arguments, **keywords)
        self.assertEqual(result.returncode, OUTPUT_ERROR, result.stderr)
        self.assertIn(f'"{self.path}" cannot be written: {message}; free space or choose another folder', result.stderr)
        self.assertEqual(self.path.read_bytes(), OLD)
        self.assertEqual([entry.name for entry in folder.iterdir()], ["a.rpf"])

    def test_limit_of_file_size_while_samples_come_and_at_the_end(self):
        # Few samples a band stay in memory until the end; many go to the spool while they come.
        for arguments in ((100, 100, 1, 2), (30, 30, 200, 2)):
            with self.subTest(arguments=arguments):
                self.expect_old_file_survives(self.folder, "File too large", *arguments, restore_signals=False,
                                              preexec_fn=lambda: limit_file_size(32 << 10))

    def test_full_disk(self):
        for size, arguments in (("64k", (100, 100, 1, 2)), ("64k", (30, 30, 200, 2)), ("3m", (30, 30, 200, 2))):  # 2.2 MB, twice
            disk = self.folder / "disk"
            disk.mkdir()
            if subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={size}", "rpf-test", disk], capture_output=True, check=False).returncode != 0:
                self.skipTest("needs the right to mount")
            try:
                self.expect_old_file_survives(disk, "No space left on device", *arguments)
            finally:
                subprocess.run(["umount", disk], check=True)
            disk.rmdir()

    def test_a_killed_renderer_leaves_the_old_file(self):
        self.path.write_bytes(OLD)
        with subprocess.Popen(command(self.path, 1000, 1000, 60, 2), stderr=subprocess.DEVNULL) as process:
            while process.poll() is None and not any(entry.name.startswith(".rpf-") for entry in self.folder.iterdir()):
                time.sleep(0.001)
            process.kill()
        self.assertEqual(self.path.read_bytes(), OLD)
        left = [entry for entry in self.folder.iterdir() if entry != self.path]
        self.assertLessEqual(len(left), 1)  # the next result of rpf in this folder removes it
        self.assertTrue(all(re.fullmatch(r"\.rpf-[\w-]+-\d+-\d+\.rpf", entry.name) for entry in left), left)

    def test_memory_is_bounded(self):
        # In between a process without numpy: a child's peak begins with its parent's memory.
        code = "import resource, subprocess, sys; subprocess.run(sys.argv[1:], check=True); print(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss)"
        run = subprocess.run([sys.executable, "-c", code, *command(self.path, 250, 200, 400, 2)], capture_output=True, text=True, check=True)
        size = self.path.stat().st_size
        self.assertGreater(size, 200 << 20)
        self.assertLess(int(run.stdout) * 1024, 40 << 20)  # 16 MB are sorted at once, 49 bands have a block; the rest is on the disk


unittest.main(argv=sys.argv[:1])
