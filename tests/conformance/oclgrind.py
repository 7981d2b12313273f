"""Runs conformance cases on Oclgrind and fails on any complaint. Usage: oclgrind.py RPF FILTER"""
import shutil
import subprocess
import sys

RPF, FILTER = sys.argv[1:3]
SKIPPED = 77
OCLGRIND = ["oclgrind", "--data-races", "--build-options", "-cl-opt-disable"]
COMPLAINTS = ("invalid read", "invalid write", "data race", "error")


def main():
    if not shutil.which("oclgrind"):
        print("skipped: oclgrind is not installed")
        return SKIPPED
    done = subprocess.run([*OCLGRIND, RPF, "selftest", "--full", "--filter", FILTER], stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True)
    print(done.stdout[:4000])
    complaints = [line for line in done.stdout.splitlines() if any(text in line.lower() for text in COMPLAINTS)]
    ran_there = "Oclgrind Simulator" in done.stdout
    return 0 if done.returncode == 0 and ran_there and not complaints else 1


sys.exit(main())
