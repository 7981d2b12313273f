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
        try:
            self.run_here("/usr/bin/python3", "-c", "import dask.distributed")
        except AssertionError:
            self.skipTest("dask is not installed (Debian: apt-get install python3-distributed)")
        self.run_here("/usr/bin/python3", FARM / "with_dask.py", self.folder / "in.####.exr", self.folder / "out.####.exr", 3, RPF=self.rpf)
        self.expect_all()

    def test_slurm_array(self):
        """With the machine's own Slurm where one answers; the task that is killed is requeued by hand, as an operator would."""
        if shutil.which("sinfo") is None or subprocess.run(["sinfo", "-h", "-o", "%a"], capture_output=True, text=True, timeout=60, check=False).stdout.strip() != "up":
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


if __name__ == "__main__":
    signal.signal(signal.SIGINT, signal.default_int_handler)
    unittest.main(argv=sys.argv[:1])
