"""What the tests of the command share. Usage of each: TEST RPF PROJECT"""
import shutil
import sys
import tempfile
import unittest
from pathlib import Path

RPF, PROJECT = sys.argv[1], Path(sys.argv[2]).resolve()
EXAMPLE = PROJECT / "examples" / "dof-spheres.samples.exr"
REFERENCE = PROJECT / "examples" / "dof-spheres.reference.exr"
SANITIZED = b"__asan_init" in Path(RPF).read_bytes()  # slower, and of larger memory


class CommandCase(unittest.TestCase):
    """A folder of its own for every test, and what a finished command is expected to be."""

    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="rpf test ü "))  # a blank and UTF-8 on purpose

    def tearDown(self):
        shutil.rmtree(self.folder)

    def expect(self, result, code, *texts):
        self.assertEqual(result.returncode, code, result.stdout + result.stderr)
        for text in texts:
            self.assertIn(text, result.stdout + result.stderr)
