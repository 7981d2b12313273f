"""What a page names there is: commands and options of rpf, what ./run can do, presets of CMake, labels and names of tests, files. What
pages.py says of blocks holds. Usage: names_test.py RPF PROJECT BUILD"""
import json
import re
import subprocess
import sys
import unittest
from pathlib import Path

from pages import INDENTED, blocks, pages, spans, without_blocks

RPF, PROJECT, BUILD = (Path(argument).resolve() for argument in sys.argv[1:])
HISTORY = "CHANGELOG.md"  # tells of options that are gone
HIDDEN = {"manual"}  # a command that its help does not list
OPTIONS_OF_OTHERS = {"--sensor": "python -m rpf.mitsuba", "--uninitialized": "oclgrind"}
TESTS = [PROJECT / "tests/CMakeLists.txt", *(file for folder in ("tests", "python/tests") for file in (PROJECT / folder).rglob("*.py") if file.parent.name != "docs")]
FOLDERS = "bench|cmake|docs|examples|include|integrations|kernels|networks|src|tests|training"


def options_of(command):
    said = subprocess.run([RPF, *command.split(), "--help"], capture_output=True, text=True, check=True).stdout
    below = re.search(r"^Subcommands:\n((?:  .*\n)+)", said, re.M)
    options = {option for entry in re.findall(r"^  (-\S+)", said, re.M) for option in entry.split(",")}
    return options, re.findall(r"^  (\w+) ", below[1], re.M) if below else []


def all_options():
    """Of every command of rpf, by its name: "" is filtering."""
    known, waiting = {}, [""]
    while waiting:
        name = waiting.pop()
        known[name], below = options_of(name)
        waiting += [f"{name} {word}".strip() for word in below]
    return known


def all_tests():
    """Names and labels; those too that this build leaves out."""
    listed = json.loads(subprocess.run(["ctest", "--test-dir", BUILD, "--show-only=json-v1"], capture_output=True, text=True, check=True).stdout)["tests"]
    labels = {label for test in listed for entry in test["properties"] if entry["name"] == "LABELS" for label in entry["value"]}
    return {test["name"] for test in listed} | set(re.findall(r"NAME ([\w.]+) ", (PROJECT / "tests/CMakeLists.txt").read_text())), labels


def parts_of_tests():
    """Functions of Python's tests, SUITE.NAME of those in C++."""
    text = "".join(file.read_text(encoding="utf-8") for file in [*TESTS, *(PROJECT / "tests").rglob("*.cpp")])
    return {*re.findall(r"def (test_\w+)", text), *map(".".join, re.findall(r"^(?:TEST|TEST_F|TEST_P|RC_GTEST_PROP)\((\w+), (\w+)[,)]", text, re.M))}


class Known:
    options = all_options()
    tests, labels = all_tests()
    presets = set(re.findall(r'"name": "(\w+)"', (PROJECT / "CMakePresets.json").read_text()))
    read = set(re.findall(r"\b([\w-]+\.md)\b", "".join(file.read_text(encoding="utf-8") for file in TESTS)))
    parts = parts_of_tests()
    deeds = set(re.findall(r"^  (\w+)\)", (PROJECT / "run").read_text(), re.M))


def wrong_options(text):
    """Commands and options in a line of rpf, or in an option's span, that there are not. Behind -- stands another command."""
    text, _, inner = text.partition(" -- ")
    if re.match(r"(build/release/)?rpf ", inner):
        return wrong_options(text) + wrong_options(inner)
    words = re.sub(r"[\[\]|(){}]", " ", text).split()
    command, unknown = "", []
    if words[0].endswith("rpf"):
        words = words[1:]
        while words and f"{command} {words[0]}".strip() in Known.options:
            command = f"{command} {words.pop(0)}".strip()
        unknown = [word for word in words[:1] if not command and re.fullmatch("[a-z]+", word) and word not in HIDDEN]
    allowed = Known.options[command] if command else set(OPTIONS_OF_OTHERS).union(*Known.options.values())
    return unknown + [word for word in words if word.startswith("-") and len(word) > 1 and word.partition("=")[0] not in allowed]


def wrong_tools(text):
    """The same of ./run, cmake and ctest. Words in capitals stand for something."""
    given = {flag: re.findall(rf"{flag}[ =]([\w.]+)", text) for flag in ("--preset", "-L", "-R", r"\./run")}
    wrong = [name for name in given["--preset"] if name not in Known.presets] + [name for name in given[r"\./run"] if name not in Known.deeds]
    wrong += [name for name in given["-L"] if not name.isupper() and name not in Known.labels]
    return wrong + [name for name in given["-R"] if not name.isupper() and not any(name in test for test in Known.tests)]


def wrong_files(text):
    """Paths into the project that lead to nothing; a source's ending may be left out."""
    paths = re.findall(rf"(?<![\w./-])((?:{FOLDERS})/[\w./*-]+)", text)
    return [path for path in paths if not any(list(PROJECT.glob(path.rstrip("/.") + ending)) for ending in ("", ".h", ".cpp"))]


def wrong_parts(text):
    """Names of parts of tests, `test_a_file...` or `Suite.Name`, that there are not. Three dots: only how they begin."""
    known = re.fullmatch(r"(test_\w+|[A-Z]\w+\.[A-Z]\w+)(\.\.\.)?", text)
    return [text] if known and not any(name.startswith(known[1]) if known[2] else name == known[1] for name in Known.parts) else []


def is_read(place, by):
    """Whether tests read the page, so that they do not run a second copy of what it says."""
    return by.startswith("clone.") or Path(place).name in Known.read


def rule_broken(block, place):
    """What pages.py asks of a block, in a word where it is not so."""
    by = block.note.removeprefix("run by ") if block.note.startswith("run by ") else ""
    if by and by not in Known.tests:
        return f"there is no test {by}"
    if by and place.startswith(("README", "docs/")) and not is_read(place, by):
        return f"{by} does not read this page"
    if not block.language:
        return "a block without a language"
    explained = by or re.match(r"(not run: |file )\S", block.note)
    if block.language not in ("sh", "text") and not explained:
        return f"a block of {block.language} that no test runs"
    return "" if explained or not block.note else f"<!-- {block.note} --> is not known"


def cases(*choice):
    return len(subprocess.run([RPF, "selftest", "--list", *choice], capture_output=True, text=True, check=True).stdout.split())


def wrong_counts(page, all_cases, quick):
    """What a page says of the number of cases of rpf selftest, where there are not as many: in words, and in tables of groups."""
    text = without_blocks(page)
    said = re.findall(r"(?<!choice of )(?<![\d,])(\d{3,}) cases", text)
    wrong = [f"{count} cases, there are {all_cases}" for count in said if int(count) != all_cases]
    wrong += [f"a choice of {count} cases, there are {quick}" for count in re.findall(r"choice of (\d+) cases", text) if int(count) != quick]
    counts = [int(count) for table in re.findall(r"^\| group \| cases .*\n\|[-| ]+\n((?:\|.*\n)+)", page, re.M) for count in re.findall(r"^\| .*? \| (\d+) \|", table, re.M)]
    return wrong + ([f"tables of {sum(counts)} cases, there are {all_cases}"] if counts and sum(counts) != all_cases else [])


def wrong_in(place, page):
    found = [f"{place}: {broken}: {block.text[:60]!r}" for block in blocks(page) if (broken := rule_broken(block, place))]
    found += [f"{place}: an indented block, fence it: {line}" for line in INDENTED.findall(without_blocks(page))]
    lines = [line for block in blocks(page) if block.language in ("sh", "text") for line in re.sub(r"(\\\n|\n  +)", " ", block.text).splitlines()]
    for text in [*lines, *spans(page)]:
        wrong = wrong_files(text) + wrong_parts(text)
        if re.match(r"(build/release/)?rpf |--[a-z]", text):
            wrong += wrong_options(text)
        if re.match(r"(\./run|cmake|ctest) ", text):
            wrong += wrong_tools(text)
        found += [f"{place}: {text}: there is no {word}" for word in wrong]
    return found + [f"{place}: there is no test {name}" for name in re.findall(r"\(tests? `([\w.]+)`", page) if not any(name in test for test in Known.tests)]


class NamesTest(unittest.TestCase):
    def test_are_known(self):
        self.assertEqual([wrong for place, page in pages(PROJECT).items() if place != HISTORY for wrong in wrong_in(place, page)], [])

    def test_what_is_wrong_is_found(self):
        for page, complaint in (("```\nx\n```\n", "without a language"), ("```python\nx\n```\n", "that no test runs"), ("a\n\n    rpf x\n", "indented"),
                                ("<!-- run by nobody -->\n```sh\nx\n```\n", "no test nobody"), ("<!-- not run: -->\n```sh\nx\n```\n", "is not known"),
                                ("<!-- skip -->\n```sh\nx\n```\n", "is not known"), ("`rpf devces`", "devces"), ("`--presets fast`", "--presets"),
                                ("`rpf info --preset\nfast`", "--preset"), ("```text\nrpf merge A\n    [--seed]\n```\n", "--seed"),
                                ("<!-- not run: needs Slurm -->\n```sh\nrpf --frame 3\n```\n", "--frame"), ("`./run dmo`", "dmo"), ("`ctest --preset relase`", "relase"),
                                ("`ctest -L orcale`", "orcale"), ("`./run test -R Nowhere`", "Nowhere"), ("`tests/docs/missing.py`", "tests/docs/missing.py"),
                                ("(test `nowhere`)", "no test nowhere"), ("`test_nowhere_...`", "test_nowhere_"), ("`Outputs.Nowhere`", "Outputs.Nowhere"),
                                ("`python3 bench/missing.py`", "bench/missing.py")):
            self.assertIn(complaint, " ".join(wrong_in("page", page)), page)

    def test_cases_are_as_many_as_pages_say(self):
        counts = cases("--full"), cases()
        self.assertEqual({place: wrong for place, page in pages(PROJECT).items() if place != HISTORY and (wrong := wrong_counts(page, *counts))}, {})
        for page, complaint in (("in 477 cases", "477 cases"), ("a choice of 57 cases", "a choice of 57"), ("| group | cases | what |\n|---|---|---|\n| a, b | 470 | x |\n| c | 7 | y |\n", "477 cases")):
            self.assertIn(complaint, " ".join(wrong_counts(page, 478, 58)))
        self.assertEqual(wrong_counts("4,096 cases, 20 cases, 478 cases, a choice of 58 cases", 478, 58), [])

    def test_a_page_that_no_test_reads_is_found(self):
        place, block = "docs/" + "nowhere.md", "<!-- run by example -->\n```sh\nx\n```\n"
        self.assertIn("example does not read this page", " ".join(wrong_in(place, block)))
        self.assertEqual(wrong_in(place, block.replace("example", "clone.demo")), [])

    def test_what_is_right_is_left_alone(self):
        for page in ("<!-- not run: needs Slurm -->\n```sh\nrpf x.exr --frames 3\n```\n", "<!-- run by example -->\n```cpp\nx\n```\n",
                     "`rpf manual man`, `rpf a.exr -o b.exr`, `--preset=fast`", "`ctest --preset release -R NAME`, `./run test -L extremes`, `src/run/driver`"):
            self.assertEqual(wrong_in("page", page), [])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
