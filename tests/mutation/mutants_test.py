"""Every mutant can be tried: its name is its own, its text is in its file exactly once, and there are tests of the name that is to notice
it. Usage: mutants_test.py PROJECT RPF UNIT_TESTS EXTREMES_TESTS"""
import fnmatch
import subprocess
import sys
import unittest
from collections import Counter
from pathlib import Path

sys.dont_write_bytecode = True
from mutants import Mutant
from mutate import MUTANTS, Failed, is_conformance, is_extremes, is_oracle, mutated

PROJECT, RPF, PROGRAMS = Path(sys.argv[1]).resolve(), sys.argv[2], sys.argv[3:5]


def listed(program):
    """The names of its tests."""
    names, suite = [], ""
    for line in subprocess.run([program, "--gtest_list_tests"], capture_output=True, text=True, check=True).stdout.splitlines():
        word = line.split("#")[0].strip()
        if line.startswith(" "):
            names.append(suite + word)
        else:
            suite = word
    return names


UNIT, EXTREMES = map(listed, PROGRAMS)
ORACLE, CONFORMANCE = (subprocess.run(command, capture_output=True, text=True, check=True).stdout.split()
                       for command in ([sys.executable, PROJECT / "tests/oracle/compare.py", "--list"], [RPF, "selftest", "--full", "--list"]))


def is_known(test):
    if is_conformance(test):  # a part of names is enough
        return len(test.split()) == 3 and any(test.split()[1] in case for case in CONFORMANCE)
    if is_oracle(test):
        return len(test.split()) == 3 and test.split()[1] in ORACLE
    known = EXTREMES if is_extremes(test) else UNIT
    return all(fnmatch.filter(known, pattern) for pattern in test.split()[-1].split(":"))


def what_is_wrong(mutant):
    file = PROJECT / mutant.file
    try:
        mutated(file.read_text() if file.exists() else "", mutant)
    except Failed as failure:
        return f"{mutant.name}, {mutant.file}: {failure}"
    return "" if is_known(mutant.test) else f"{mutant.name}: there is no test {mutant.test}"


class MutantsTest(unittest.TestCase):
    def test_can_be_tried(self):
        self.assertEqual([wrong for mutant in MUTANTS if (wrong := what_is_wrong(mutant))], [])

    def test_have_names_of_their_own(self):
        self.assertEqual([name for name, times in Counter(mutant.name for mutant in MUTANTS).items() if times > 1], [])

    def test_what_is_wrong_is_found(self):
        for file, old, test, complaint in (("CMakeLists.txt", "no such text", "ControlGroups.*", "0 times"), ("missing.cpp", "x", "ControlGroups.*", "0 times"),
                                           ("CMakeLists.txt", "project(rpf VERSION", "Nothing.*", "no test"), ("CMakeLists.txt", "project(rpf VERSION", "oracle nowhere W", "no test"),
                                           ("CMakeLists.txt", "project(rpf VERSION", "conformance scene/nowhere W", "no test"),
                                           ("CMakeLists.txt", "project(rpf VERSION", "ControlGroups.*:Nothing.*", "no test")):
            self.assertIn(complaint, what_is_wrong(Mutant("m", file, old, "", test, "")))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
