"""Every command of a page does its work, block after block in a folder a page, on small frames. Usage: commands_test.py RPF PROJECT"""
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from pages import Block, blocks, pages

RPF, PROJECT = (Path(argument).resolve() for argument in sys.argv[1:])
SECONDS = 3000 if b"__asan_init" in RPF.read_bytes() else 300  # of a page; sanitizers are slow
PREPARED = {  # what pages take for granted, and what makes it in the page's folder
    "render.samples.exr": "rpf scene dof --size 48x36 -o render.samples.exr",
    "frame.samples.exr": "rpf scene dof --size 48x36 -o frame.samples.exr",
    "reference.exr": "rpf scene dof --size 48x36 --reference 64 -o reference.exr",
    "picture.png": "rpf examples/dof-spheres.reference.exr -o picture.png --method gaussian --boxes 1",
    "in.####.exr": "for n in $(seq -w 1 24); do rpf scene motion --size 16x9 --seed $n -o in.00$n.exr; done",
}


def shell(script, folder):
    path = f"{folder}/build/release:{os.environ['PATH']}"
    return subprocess.run(["bash", "-euo", "pipefail", "-xc", script], cwd=folder, env={**os.environ, "PATH": path}, stdin=subprocess.DEVNULL,
                          capture_output=True, text=True, check=False, timeout=SECONDS)


def prepare(folder, script):
    """The project as a reader has it who has built it, and the files that the script takes for granted."""
    (folder / "build/release").mkdir(parents=True)
    (folder / "build/release/rpf").symlink_to(RPF)
    for name in ("examples", "integrations"):
        (folder / name).symlink_to(PROJECT / name)
    for name, command in PREPARED.items():
        if name in script:
            made = shell(command, folder)
            assert made.returncode == 0, made.stderr


def failure_of(found):
    """Runs the blocks of a page; what was said where a command failed, else nothing."""
    script = "".join(block.text for block in found if block.language == "sh" and not block.note)
    if not script:
        return ""
    with tempfile.TemporaryDirectory(prefix="rpf docs ü ") as name:
        folder = Path(name)
        for block in found:
            if block.note.startswith("file "):
                (folder / block.note.removeprefix("file ")).write_text(block.text)
        prepare(folder, "".join(block.text for block in found))
        result = shell(script, folder)
    return "" if result.returncode == 0 else result.stderr[-2000:]


class CommandsTest(unittest.TestCase):
    def test_run(self):
        for place, page in pages(PROJECT).items():
            with self.subTest(place):
                started = os.times()
                said = failure_of(blocks(page))
                print(f"{place}: {os.times().children_user - started.children_user:.1f} CPU seconds", flush=True)
                self.assertFalse(said, said)

    def test_failures_are_found(self):
        self.assertEqual(failure_of([Block("sh", "rpf --version\ncat in.txt\n", ""), Block("text", "a\n", "file in.txt")]), "")
        self.assertIn("rpf: error", failure_of([Block("sh", "rpf info missing.exr\n", ""), Block("sh", "true\n", "")]))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
