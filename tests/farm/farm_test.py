"""Twelve frames through farms that run on this machine, one process killed and begun again: nothing lost, all files those of
one process. A farm that is not installed is skipped with a word. Usage: farm_test.py RPF PROJECT"""
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

RPF, PROJECT = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
FARM = PROJECT / "examples" / "farm"
FRAMES = 24
# In place of rpf: the first process that begins is killed after its first frame.
KILLED_ONCE = """#!/bin/sh
if mkdir "{folder}/killed" 2>/dev/null; then
  "{rpf}" "$@" & child=$!
  while [ -z "$(ls "{folder}"/out.*.exr 2>/dev/null)" ] && kill -0 $child 2>/dev/null; do sleep 0.02; done
  kill -KILL $child; kill -KILL $$
fi
exec "{rpf}" "$@"
"""

# The same, where the first process that filters rows is killed before it is done.
PART_KILLED_ONCE = """#!/bin/sh
case "$*" in *--rows*)
  if mkdir "{folder}/killed" 2>/dev/null; then
    "{rpf}" "$@" & child=$!
    sleep 0.05
    kill -KILL $child; kill -KILL $$
  fi;;
esac
exec "{rpf}" "$@"
"""
PARTS = 4


def has_dask():
    return subprocess.run(["/usr/bin/python3", "-c", "import dask.distributed"], capture_output=True, check=False).returncode == 0


def has_slurm():
    return shutil.which("sinfo") is not None and subprocess.run(["sinfo", "-h", "-o", "%a"], capture_output=True, text=True, timeout=60, check=False).stdout.strip() == "up"


def slurm_states(*jobs):
    """"12_1": "FAILED", of all tasks of these jobs."""
    lines = subprocess.run(["squeue", "-h", "-a", "-r", "-j", ",".join(jobs), "-t", "all", "-o", "%i %T"], capture_output=True, text=True, check=False).stdout.split("\n")
    return dict(line.split() for line in lines if line)


class FarmTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = Path(tempfile.mkdtemp(prefix="rpf_farm_"))
        for number in range(1, FRAMES + 1):
            cls.run_here(RPF, "scene", "motion", "--size", "96x64", "--spp", 4, "--seed", number, "-o", cls.folder / f"in.{number:04}.exr")
        cls.run_here(RPF, cls.folder / "in.####.exr", "-o", cls.folder / "single.####.exr", "--frames", f"1-{FRAMES}", "-q")
        cls.rpf = cls.folder / "rpf"
        cls.rpf.write_text(KILLED_ONCE.format(folder=cls.folder, rpf=RPF))
        cls.rpf.chmod(0o755)

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def tearDown(self):
        for path in self.folder.glob("out.*.exr"):
            path.unlink()
        shutil.rmtree(self.folder / "killed", ignore_errors=True)

    @classmethod
    def run_here(cls, *command, **env):
        environment = {**os.environ, "RPF_BACKEND": "cpu", **{name: str(value) for name, value in env.items()}}
        result = subprocess.run([str(part) for part in command], capture_output=True, text=True, check=False, timeout=500, env=environment, cwd=cls.folder)
        if result.returncode != 0:
            raise AssertionError(f"{command}: {result.returncode}\n{result.stdout}{result.stderr}")
        return result

    def expect_all(self):
        self.assertTrue((self.folder / "killed").is_dir(), "no process was killed")
        for number in range(1, FRAMES + 1):
            self.assertEqual((self.folder / f"out.{number:04}.exr").read_bytes(), (self.folder / f"single.{number:04}.exr").read_bytes(), number)

    def test_gnu_parallel(self):
        if shutil.which("parallel") is None:
            self.skipTest("GNU parallel is not installed (Debian: apt-get install parallel)")
        self.run_here(FARM / "gnu_parallel.sh", self.folder / "in.####.exr", self.folder / "out.####.exr", 4, 2, RPF=self.rpf)
        self.expect_all()

    def test_dask(self):
        if not has_dask():
            self.skipTest("dask is not installed (Debian: apt-get install python3-distributed)")
        self.run_here("/usr/bin/python3", FARM / "with_dask.py", self.folder / "in.####.exr", self.folder / "out.####.exr", 3, RPF=self.rpf)
        self.expect_all()

    def test_slurm_array(self):
        """With the machine's own Slurm where one answers; the task that is killed is requeued by hand, as an operator would."""
        if not has_slurm():
            self.skipTest("no Slurm answers here (Debian: slurm-wlm and munge, one node)")
        job = self.run_here("sbatch", "--parsable", FARM / "slurm_array.sh", self.folder / "in.####.exr", self.folder / "out.####.exr", RPF=self.rpf).stdout.split(";")[0].strip()
        requeued = False
        for _ in range(600):
            states = subprocess.run(["squeue", "-h", "-a", "-j", job, "-t", "all", "-o", "%i %T"], capture_output=True, text=True, check=False).stdout.split("\n")
            failed = [line.split()[0] for line in states if line.endswith(("FAILED", "NODE_FAIL"))]
            if failed and not requeued:
                self.run_here("scontrol", "requeue", failed[0])
                requeued = True
            elif requeued and not any(line.endswith(("RUNNING", "PENDING", "COMPLETING", "CONFIGURING")) for line in states):
                break
            time.sleep(0.5)
        self.expect_all()


class OneFrameTest(unittest.TestCase):
    """One frame by several processes, one of them killed: the file of one process."""

    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="rpf_farm_"))
        self.frame, self.single, self.out = (self.folder / name for name in ("in.exr", "single.exr", "out.exr"))
        FarmTest.folder = self.folder
        FarmTest.run_here(RPF, "scene", "motion", "--size", "120x160", "--spp", 4, "-o", self.frame)
        FarmTest.run_here(RPF, self.frame, "-o", self.single, "-q")
        self.rpf = self.folder / "rpf"
        self.rpf.write_text(PART_KILLED_ONCE.format(folder=self.folder, rpf=RPF))
        self.rpf.chmod(0o755)

    def tearDown(self):
        shutil.rmtree(self.folder)

    def expect_whole(self):
        self.assertTrue((self.folder / "killed").is_dir(), "no process was killed")
        self.assertEqual(self.out.read_bytes(), self.single.read_bytes())

    def test_dask(self):
        if not has_dask():
            self.skipTest("dask is not installed (Debian: apt-get install python3-distributed)")
        FarmTest.run_here("/usr/bin/python3", FARM / "parts_with_dask.py", self.frame, self.out, PARTS, RPF=self.rpf)
        self.expect_whole()

    def wait_for(self, *jobs):
        """Until all their tasks are done in one way or another."""
        for _ in range(600):
            states = slurm_states(*jobs)
            if states and all(state in ("COMPLETED", "FAILED", "NODE_FAIL") for state in states.values()):
                return [task for task, state in states.items() if state != "COMPLETED"]
            time.sleep(0.5)
        raise AssertionError(states)

    def test_slurm_array(self):
        """The join finds that a part is missing and says so; once that is requeued, so is the join."""
        if not has_slurm():
            self.skipTest("no Slurm answers here (Debian: slurm-wlm and munge, one node)")
        jobs = FarmTest.run_here(FARM / "slurm_parts.sh", self.frame, self.out, PARTS, RPF=self.rpf).stdout.split()
        failed = self.wait_for(*jobs)
        self.assertEqual(len(failed), 2, failed)
        part = next(task for task in failed if "_" in task)
        number = int(part.split("_")[1])
        log = (self.folder / f"slurm-{jobs[-1]}.out").read_text()
        self.assertIn(f"rows {160 * (number - 1) // PARTS}-{160 * number // PARTS - 1} are missing", log)
        self.assertFalse(self.out.exists())
        for task in (part, jobs[-1]):
            FarmTest.run_here("scontrol", "requeue", task)
            time.sleep(1)
            self.assertEqual(self.wait_for(task), [])
        self.expect_whole()


if __name__ == "__main__":
    signal.signal(signal.SIGINT, signal.default_int_handler)
    unittest.main(argv=sys.argv[:1])
