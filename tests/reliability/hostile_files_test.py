"""Hostile sample files through the command: a refusal with its reason, or a whole picture; fast, and within the memory limit.
Usage: hostile_files_test.py RPF PROJECT"""
import resource
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

RPF, PROJECT = sys.argv[1], Path(sys.argv[2]).resolve()
sys.path.insert(0, str(PROJECT / "tests" / "fuzz"))
from exr_file import ExrFile, pack  # noqa: E402

CORPUS = PROJECT / "tests" / "fuzz" / "corpus" / "samples"
CHANNELS = ["B", "G", "R", "film.X", "film.Y", "random.lens.U"]
MEGABYTE = 1 << 20
SANITIZED = 10 if b"__asan_init" in Path(RPF).read_bytes() else 1  # so many times slower and larger
TIMEOUT = 300  # seconds, for a machine with more to do; the tests count CPU seconds


class HostileFilesTest(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="rpf hostile ü "))
        self.file, self.output = self.folder / "hostile.exr", self.folder / "out.exr"

    def tearDown(self):
        shutil.rmtree(self.folder)

    def run_command(self, *arguments, seconds=1.0):
        """At most so many CPU seconds. RUSAGE_CHILDREN also has the largest memory of any command so far."""
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        result = subprocess.run([RPF, *map(str, arguments)], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace", timeout=TIMEOUT, check=False)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        self.assertLess(after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, seconds * SANITIZED)
        return result

    def expect_refusal(self, code, *texts, megabytes=300):
        """Quickly, with far less memory than the file asks for, by every command that reads it."""
        for arguments in (["info", self.file], [self.file, "-o", self.output], ["convert", self.file, "-o", self.output]):
            result = self.run_command(*arguments)
            self.assertEqual(result.returncode, code, result.stdout)
            for text in texts:
                self.assertIn(text, result.stdout)
            self.assertLess(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss, megabytes * 1024 * SANITIZED)
            self.assertFalse(self.output.exists())

    def zips(self):
        return ExrFile((CORPUS / "zips.exr").read_bytes())

    def test_the_whole_corpus(self):
        codes = {0: 0, 2: 0, 3: 0, 6: 0}
        for file in sorted(CORPUS.iterdir()):
            with self.subTest(file=file.name):
                result = self.run_command(file, "-o", self.output, "--boxes", "3", "--max-memory", "300")
                self.assertIn(result.returncode, codes, result.stdout)
                codes[result.returncode] += 1
                self.assertEqual(self.output.exists(), result.returncode == 0)
                if result.returncode == 0:
                    self.assertEqual(self.run_command("compare", self.output, self.output, "--max-error", "0").returncode, 0)
                    self.output.unlink()
                else:
                    self.assertRegex(result.stdout, r"^rpf: error: [^\n]*\n$")  # one line
                self.assertEqual(list(self.folder.iterdir()), [])
        print(f"exit codes: {codes}", file=sys.stderr)
        self.assertGreater(codes[3], codes[0])

    def test_16k_header_in_a_small_file(self):
        file = self.zips().set("dataWindow", pack("4i", 0, 0, 16383, 16383)).set("chunkCount", pack("i", 16384))
        file.tail = bytes(132000)
        self.file.write_bytes(file.bytes())
        self.expect_refusal(3, "16384 rows", "truncated or damaged")

    def test_65536_channels(self):
        names = sorted([f"c{i:05}" for i in range(65536)] + CHANNELS)
        rows = b"".join(name.encode() + b"\0" + pack("iBxxxii", 2, 0, 1, 1) for name in names) + b"\0"
        self.file.write_bytes(self.zips().set("channels", rows).bytes())
        self.expect_refusal(3, "more than 1024 channels")

    def test_constant_samples_that_unpack_to_300_megabytes(self):
        """12.3 million samples; the packed file takes less than half a megabyte."""
        raw, width, height, count = self.folder / "a.rpf", 1024, 750, 16
        header = b'{"format": "rpf-raw-samples", "version": 1, "dataWindow": [0, 0, %d, %d], "channels": ["R", "G", "B", "film.X", "film.Y", "random.time"]}\n'
        with open(raw, "wb") as file:
            file.write(header % (width, height) + pack("I", count) * (width * height))
            file.truncate(file.tell() + width * height * count * 6 * 4)  # zeros
        subprocess.run([RPF, "convert", raw, "-o", self.file], check=True, capture_output=True, timeout=TIMEOUT)
        raw.unlink()
        print(f"{self.file.stat().st_size / 1024:.0f} KB", file=sys.stderr)
        self.assertLess(self.file.stat().st_size, MEGABYTE)
        before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss  # of the conversion, which has some rows at once
        result = self.run_command(self.file, "-o", self.output, "--max-memory", "100")
        self.assertEqual(result.returncode, 6, result.stdout)
        self.assertRegex(result.stdout, r"needs \d{3,4} MB.* the limit is 100 MB")
        result = self.run_command("convert", self.file, "-o", self.output, "--max-memory", "100", seconds=60)
        self.assertEqual(result.returncode, 0, result.stdout)
        self.assertEqual(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss, before)  # never more than that

    def sparse_raw_file(self, samples):
        with open(self.file, "wb") as file:
            file.write(b'{"format": "rpf-raw-samples", "version": 1, "dataWindow": [0, 0, 1024, 1], "channels": ["R", "G", "B", "film.X", "film.Y"]}\n')
            file.write(pack("I", samples // 1024) * 1024)
            file.truncate(file.tell() + samples * 5 * 4)

    def test_2_to_31_samples(self):
        """A sparse file of 43 GB."""
        self.sparse_raw_file(2**31)  # in one row
        for arguments in ([self.file, "-o", self.output, "--max-memory", "300"], ["convert", self.file, "-o", self.output, "--max-memory", "300"]):
            result = self.run_command(*arguments)
            self.assertEqual(result.returncode, 6, result.stdout)
            self.assertRegex(result.stdout, r"needs \d{5,6} MB.* the limit is 300 MB")
        self.sparse_raw_file(2**32)
        result = self.run_command("convert", self.file, "-o", self.output)
        self.assertEqual(result.returncode, 3, result.stdout)
        self.assertIn("4294967296 samples, more than the 4294967294", result.stdout)

    def test_2_to_31_samples_in_openexr(self):
        """Row headers that claim 1.6 GB each, with as few bytes behind them as compression could need."""
        file = self.zips().set("dataWindow", pack("4i", 0, 0, 3, 31)).set("chunkCount", pack("i", 32))
        unpacked = 2**26 * 4 * len(CHANNELS)
        packed = unpacked // 1032 + 1
        head = file.parts()[0]
        with open(self.file, "wb") as out:
            table = len(head) + 8 * 32
            out.write(head + b"".join(struct.pack("<Q", table + i * (28 + 16 + packed)) for i in range(32)))
            for y in range(32):
                out.write(pack("i", y) + pack("QQQ", 16, packed, unpacked) + pack("4I", 2**24, 2**25, 3 * 2**24, 2**26))
                out.seek(packed, 1)
            out.truncate(out.tell())
        for arguments in ([self.file, "-o", self.output], ["convert", self.file, "-o", self.output]):
            result = self.run_command(*arguments, "--max-memory", "300")
            self.assertIn(result.returncode, (3, 6), result.stdout)
            self.assertFalse(self.output.exists())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
