"""Every command of a page does what a reader would see: block after block in a folder a page, on small frames. Every option that a page
names is one. What pages.py says of blocks holds. Usage: commands_test.py RPF PROJECT BUILD"""
import json
import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from pages import INDENTED, Block, blocks, pages, spans, without_blocks

RPF, PROJECT, BUILD = (Path(argument).resolve() for argument in sys.argv[1:])
PREPARED = {  # what pages take for granted, and what makes it in the page's folder
    "render.samples.exr": "rpf scene dof --size 48x36 -o render.samples.exr",
    "reference.exr": "rpf scene dof --size 48x36 --reference 64 -o reference.exr",
    "picture.png": "rpf examples/dof-spheres.reference.exr -o picture.png --method gaussian --boxes 1",
    "in.####.exr": "for n in $(seq -w 1 24); do rpf scene motion --size 16x9 --seed 1$n -o in.00$n.exr; done",
}
HISTORY = "CHANGELOG.md"  # tells of options that are gone
HIDDEN = {"manual"}  # a command that its help does not list
OPTIONS_OF_OTHERS = {"--sensor": "python -m rpf.mitsuba", "--uninitialized": "oclgrind"}


def shell(script, folder):
    path = f"{folder}/build/release:{os.environ['PATH']}"
    return subprocess.run(["bash", "-euo", "pipefail", "-xc", script], cwd=folder, env={**os.environ, "PATH": path}, stdin=subprocess.DEVNULL,
                          capture_output=True, text=True, check=False, timeout=300)


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


# ---- options


def options_of(subcommand):
    said = subprocess.run([RPF, *subcommand.split(), "--help"], capture_output=True, text=True, check=True).stdout
    names = re.search(r"^(?:Subcommands|COMMANDS):\n((?:  .*\n)+)", said, re.M | re.I)
    options = {option for entry in re.findall(r"^  (-\S+)", said, re.M) for option in entry.split(",")}
    return options, re.findall(r"^  (\w+) ", names[1], re.M) if names else []


def known_options():
    """Of every command, by its name: "" is filtering."""
    known, waiting = {}, [""]
    while waiting:
        name = waiting.pop()
        known[name], below = options_of(name)
        waiting += [f"{name} {word}".strip() for word in below]
    return known


def wrong_words(text, known):
    """Commands and options in a synopsis of rpf, or in an option's span, that there are not."""
    words = re.sub(r"[\[\]|(){}]", " ", text).split()
    command, unknown = "", []
    if words[0].endswith("rpf"):
        words = words[1:]
        while words and f"{command} {words[0]}".strip() in known:
            command = f"{command} {words.pop(0)}".strip()
        unknown = [word for word in words[:1] if not command and re.fullmatch("[a-z]+", word) and word not in HIDDEN]
    allowed = known[command] if command else set(OPTIONS_OF_OTHERS).union(*known.values())
    return unknown + [word for word in words if word.startswith("-") and len(word) > 1 and word.partition("=")[0] not in allowed]


# ---- what is wrong with a page


def rule_broken(block, tests):
    """What pages.py asks of a block, in a word where it is not so."""
    by = block.note.removeprefix("run by ") if block.note.startswith("run by ") else ""
    if by and by not in tests:
        return f"there is no test {by}"
    if not block.language:
        return "a block without a language"
    explained = by or re.match(r"(not run: |file )\S", block.note)
    if block.language not in ("sh", "text") and not explained:
        return f"a block of {block.language} that no test runs"
    return "" if explained or not block.note else f"<!-- {block.note} --> is not known"


def wrong_in(place, page, known, tests):
    found = [f"{place}: {broken}: {block.text[:60]!r}" for block in blocks(page) if (broken := rule_broken(block, tests))]
    found += [f"{place}: an indented block, fence it: {line}" for line in INDENTED.findall(without_blocks(page))]
    synopses = [line for block in blocks(page) if block.language == "text" or block.note.startswith("not run") for line in re.sub(r"\n  +", " ", block.text).splitlines()]
    for text in [*synopses, *spans(page)]:
        if re.match(r"(build/release/)?rpf |--[a-z]", text):
            found += [f"{place}: {text}: there is no {word}" for word in wrong_words(text, known)]
    return found


class CommandsTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.pages = {place: page for place, page in pages(PROJECT).items() if place != HISTORY}
        cls.known = known_options()
        listed = subprocess.run(["ctest", "--test-dir", BUILD, "--show-only=json-v1"], capture_output=True, text=True, check=True).stdout
        cls.tests = {test["name"] for test in json.loads(listed)["tests"]}

    def test_pages_keep_the_rules(self):
        self.assertEqual([wrong for place, page in self.pages.items() for wrong in wrong_in(place, page, self.known, self.tests)], [])

    def test_commands_run(self):
        for place, page in self.pages.items():
            with self.subTest(place):
                started = os.times()
                said = failure_of(blocks(page))
                print(f"{place}: {os.times().children_user - started.children_user:.1f} CPU seconds", flush=True)
                self.assertFalse(said, said)

    def test_what_is_wrong_is_found(self):
        for page, complaint in (("```\nx\n```\n", "without a language"), ("```python\nx\n```\n", "that no test runs"), ("a\n\n    rpf x\n", "indented"),
                                ("<!-- run by nobody -->\n```sh\nx\n```\n", "no test nobody"), ("<!-- not run: -->\n```sh\nx\n```\n", "is not known"),
                                ("<!-- skip -->\n```sh\nx\n```\n", "is not known"), ("`rpf devces`", "devces"), ("`--presets fast`", "--presets"),
                                ("`rpf info --preset\nfast`", "--preset"), ("```text\nrpf merge A\n    [--seed]\n```\n", "--seed"),
                                ("<!-- not run: needs Slurm -->\n```sh\nrpf --frame 3\n```\n", "--frame")):
            self.assertIn(complaint, " ".join(wrong_in("page", page, self.known, self.tests)), page)
        for page in ("<!-- not run: needs Slurm -->\n```sh\nrpf x.exr --frames 3\n```\n", "<!-- run by example -->\n```cpp\nx\n```\n", "`rpf manual man`, `rpf a.exr -o b.exr`, `--preset=fast`"):
            self.assertEqual(wrong_in("page", page, self.known, self.tests), [])
        self.assertEqual(failure_of([Block("sh", "rpf --version\ncat in.txt\n", ""), Block("text", "a\n", "file in.txt")]), "")
        self.assertIn("rpf: error", failure_of([Block("sh", "rpf info missing.exr\n", ""), Block("sh", "true\n", "")]))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
