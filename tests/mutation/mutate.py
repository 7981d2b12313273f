"""Proof that every check can fail: breaks the source in one small place after the other and runs the check meant for it.

    python3 mutate.py PROJECT [--only PREFIX] [--work DIR]

Works on a copy of the project. With --work the copy and its build are kept and reused. Needs about half an hour on one core.
Exit status 0: every mutant was killed; 1: a mutant survived, is out of date or does not compile.
"""
import argparse
import re
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

sys.dont_write_bytecode = True      # the source folder stays clean
from error_estimate_mutants import MUTANTS as ERROR_ESTIMATE_MUTANTS
from explain_mutants import MUTANTS as EXPLAIN_MUTANTS
from fixed_weights_mutants import MUTANTS as FIXED_WEIGHTS_MUTANTS
from learned_mutants import MUTANTS as LEARNED_MUTANTS
from mutants import MUTANTS as REFERENCE_MUTANTS
from opencl_mutants import MUTANTS as OPENCL_MUTANTS
from pixel_mutants import MUTANTS as PIXEL_MUTANTS

MUTANTS = REFERENCE_MUTANTS + OPENCL_MUTANTS + FIXED_WEIGHTS_MUTANTS + EXPLAIN_MUTANTS + LEARNED_MUTANTS + PIXEL_MUTANTS + ERROR_ESTIMATE_MUTANTS
LEFT_OUT = {".git", "build", "demo", "__pycache__"}
# -O1 compiles fast; -w because a mutant may leave a variable unused, and the project makes warnings errors.
CONFIGURE = ["-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_CXX_FLAGS_RELEASE=-O1 -DNDEBUG -w",
             "-DRPF_BUILD_TESTS=ON", "-DRPF_BUILD_BENCH=OFF"]
JOBS = "1"
BUILD_TIMEOUT, TEST_TIMEOUT = 3600, 300     # seconds
KILLED, SURVIVED = "killed", "SURVIVED"


class Failed(Exception):
    """A mutant that says nothing: out of date, not compiled, or its test fails without it."""


# ---------------------------------------------------------------- the copy

def files_of(project):
    """The project's files as relative paths, without what is not source."""
    paths = (path.relative_to(project) for path in project.rglob("*") if path.is_file())
    return {path for path in paths if not LEFT_OUT.intersection(path.parts)}


def is_same(a, b):
    """Whether both files are there with the same bytes."""
    return b.exists() and a.read_bytes() == b.read_bytes()


def copy_project(project, source):
    """Makes `source` a copy of the project; files that are equal keep their time, so that they are not built again."""
    wanted = files_of(project)
    for path in wanted:
        if not is_same(project / path, source / path):
            (source / path).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(project / path, source / path)
    for path in files_of(source) - wanted:
        (source / path).unlink()


# ---------------------------------------------------------------- build and test

def run(command, timeout):
    """Exit status and output of a command; a timeout is no result."""
    try:
        done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace", timeout=timeout)
    except subprocess.TimeoutExpired:
        raise Failed(f"{Path(str(command[0])).name} took more than {timeout} s") from None
    return done.returncode, done.stdout


def build(work, targets):
    """Configures where that is needed, and builds."""
    if not (work / "build" / "build.ninja").exists():
        status, output = run(["cmake", "-S", work / "source", "-B", work / "build", *CONFIGURE], BUILD_TIMEOUT)
        if status != 0:
            raise Failed("cmake failed:\n" + output)
    status, output = run(["cmake", "--build", work / "build", "-j", JOBS, "--target", *targets], BUILD_TIMEOUT)
    if status != 0:
        raise Failed("does not compile:\n" + output)


def is_oracle(test):
    """Oracle tests are written "oracle CASE STAGE"; tests of neither kind are filters of rpf_unit_tests."""
    return test.startswith("oracle ")


def is_conformance(test):
    """Conformance tests are written "conformance CASE STAGE", with _ for a blank in the stage."""
    return test.startswith("conformance ")


def is_extremes(test):
    """Properties are written "extremes FILTER", with a filter of rpf_extremes_tests."""
    return test.startswith("extremes ")


def target_of(test):
    """The program that the test runs."""
    if is_extremes(test):
        return "rpf_extremes_tests"
    return "rpf_command" if is_conformance(test) else "rpf_trace" if is_oracle(test) else "rpf_unit_tests"


def run_conformance(work, case):
    """Exit status and output of the comparison of a device with the reference on some cases."""
    return run([work / "build" / "rpf", "selftest", "--full", "--filter", case], TEST_TIMEOUT)


def conformance_verdict(work, test):
    """Killed where the first stage that differs is the one named; "device": where the device's own test fails; "any": where
    anything fails, also the process, for planes that contradict each other lead anywhere."""
    _, case, stage = test.split()
    status, output = run_conformance(work, case)
    if stage in ("device", "any"):
        return KILLED if status == 5 or (stage == "any" and status != 0) else SURVIVED
    # The first line is "CASE: pass P, PLACE: STAGE[INDEX] is ..." or "... STAGE has N values ...".
    first = re.search(r", [^:]*: ([^\[]*?)(\[| has )", (output.splitlines() or [""])[0])
    return KILLED if status == 1 and first and first.group(1) == stage.replace("_", " ") else SURVIVED


def run_oracle(work, case):
    """Exit status and output of the comparison of one case."""
    compare = work / "source" / "tests" / "oracle" / "compare.py"
    return run([sys.executable, compare, "--tool", work / "build" / "tests" / "rpf_trace", "--case", case], TEST_TIMEOUT)


def run_unit(work, test):
    """Exit status and output of the unit tests, or properties, that the filter names."""
    return run([work / "build" / "tests" / target_of(test), f"--gtest_filter={test.split()[-1]}"], TEST_TIMEOUT)


def reported_state(output, stage):
    """What compare.py's table says of a stage: "yes", "NO, 3 times" or "not reached"."""
    rows = (line.split(maxsplit=4) for line in output.splitlines())
    return next((row[4] for row in rows if len(row) == 5 and row[0] == stage), "not reached")


def passes(work, test):
    """Whether the check is there, was reached and found nothing."""
    if is_conformance(test):
        return run_conformance(work, test.split()[1])[0] == 0
    if is_oracle(test):
        _, case, stage = test.split()
        status, output = run_oracle(work, case)
        return status == 0 and reported_state(output, stage) == "yes"
    status, output = run_unit(work, test)
    return status == 0 and "[       OK ]" in output and "[  SKIPPED ]" not in output


def verdict(work, test):
    """Whether the check failed, for an oracle test in the stage it names; a crash of the unit tests counts."""
    if is_conformance(test):
        return conformance_verdict(work, test)
    if not is_oracle(test):
        return KILLED if run_unit(work, test)[0] != 0 else SURVIVED
    _, case, stage = test.split()
    status, output = run_oracle(work, case)
    return KILLED if status == 1 and reported_state(output, stage).startswith("NO") else SURVIVED


# ---------------------------------------------------------------- mutants

def mutated(text, mutant):
    """The text with the mutation; the place must be there exactly once."""
    if text.count(mutant.old) != 1:
        raise Failed(f"mutant out of date: its text occurs {text.count(mutant.old)} times")
    return text.replace(mutant.old, mutant.new)


def try_mutant(work, mutant, sound):
    """Verdict on one mutant. `sound`: the tests that pass without any."""
    path = work / "source" / mutant.file
    if not path.exists():
        raise Failed("mutant out of date: no such file")
    original = path.read_text()
    text = mutated(original, mutant)
    if mutant.test not in sound:
        raise Failed("its test does not pass without it")
    try:
        path.write_text(text)
        build(work, [target_of(mutant.test)])
        return verdict(work, mutant.test)
    finally:
        path.write_text(original)


def sound_tests(work, mutants):
    """The mutants' tests that pass on the unchanged project; each is run once."""
    return {test for test in {m.test for m in mutants} if passes(work, test)}


def row(mutant, state, seconds):
    """One line of the table."""
    return f"{mutant.name:<28} {mutant.file:<26} {mutant.test:<72} {state:<9} {seconds:6.1f}"


def try_all(work, mutants):
    """Prints the table; the number of mutants killed."""
    sound = sound_tests(work, mutants)
    print(f"{'mutant':<28} {'file':<26} {'test':<72} {'verdict':<9} seconds", flush=True)
    killed = 0
    for mutant in mutants:
        started, reason = time.monotonic(), ""
        try:
            state = verdict_of = try_mutant(work, mutant, sound)
            reason = mutant.reason if verdict_of == SURVIVED else ""
        except Failed as failure:
            state, reason = "ERROR", str(failure)
        killed += state == KILLED
        print(row(mutant, state, time.monotonic() - started), flush=True)
        if reason:
            print(f"    {reason}", flush=True)
    return killed


def chosen(only):
    """The mutants to try."""
    names = [m.name for m in MUTANTS]
    found = [m for m in MUTANTS if m.name.startswith(only or "")]
    if not found:
        sys.exit(f"no mutant '{only}'; there are: {', '.join(names)}")
    return found


def mutate(project, work, mutants):
    """The number of mutants killed, after copying and building the project."""
    copy_project(project, work / "source")
    build(work, sorted({target_of(mutant.test) for mutant in mutants}))
    return try_all(work, mutants)


def main():
    parser = argparse.ArgumentParser(description="Breaks the source on purpose and sees whether the tests notice.")
    parser.add_argument("project", type=Path, help="folder of the project")
    parser.add_argument("--only", metavar="PREFIX", help="try the mutants whose name begins like this")
    parser.add_argument("--work", type=Path, metavar="DIR", help="folder for the copy and its build, kept afterwards")
    options = parser.parse_args()
    mutants = chosen(options.only)
    with tempfile.TemporaryDirectory() as folder:
        try:
            killed = mutate(options.project.resolve(), (options.work or Path(folder)).resolve(), mutants)
        except Failed as failure:
            print(failure)
            return 1
    print(f"{killed} passed, {len(mutants) - killed} failed")
    return 0 if killed == len(mutants) else 1


if __name__ == "__main__":
    sys.exit(main())
