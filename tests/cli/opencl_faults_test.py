"""What can go wrong with OpenCL on a machine, and what the command then does. Usage: opencl_faults_test.py RPF PROJECT"""
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from collections import Counter
from pathlib import Path

RPF, PROJECT = sys.argv[1], Path(sys.argv[2]).resolve()
EXAMPLE = PROJECT / "examples" / "dof-spheres.samples.exr"
QUICK = ["--boxes", "5,3", "--crop", "16x12+20+20", "-q"]
for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):  # a shell ignores them for what it starts in the background
    signal.signal(number, signal.SIG_DFL)


def run(*arguments, **environment):
    return subprocess.run([RPF, *map(str, arguments)], capture_output=True, text=True,
                          env={**os.environ, **{name: str(value) for name, value in environment.items()}})


class OpenClFaults(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="rpf faults "))
        self.cache = self.folder / "cache"
        self.output = self.folder / "out.exr"
        self.reference = self.folder / "reference.exr"
        self.expect(self.filter("cpu", self.reference), 0)

    def tearDown(self):
        subprocess.run(["chmod", "-R", "u+w", self.folder], check=True)
        shutil.rmtree(self.folder)

    def filter(self, backend, output=None, *more, **environment):
        return run(EXAMPLE, "-o", output or self.output, "--backend", backend, *QUICK, *more,
                   **{"RPF_CACHE_DIR": self.cache, **environment})

    def expect(self, result, code, *texts):
        self.assertEqual(result.returncode, code, result.stdout + result.stderr)
        for text in texts:
            self.assertIn(text, result.stdout + result.stderr)

    def expect_same_bits(self):
        self.expect(run("compare", self.output, self.reference, "--max-error", "0"), 0)
        self.output.unlink()

    def compiled(self, suffix):
        files = list(self.cache.rglob("*" + suffix))
        self.assertTrue(files, f"nothing compiled with the suffix {suffix}")
        return files

    # ---- devices

    def test_without_a_platform(self):
        nowhere = {"OCL_ICD_VENDORS": self.folder / "none"}
        self.expect(self.filter("opencl", **nowhere), 5, "apt-get install pocl-opencl-icd", "--backend=cpu")
        self.assertFalse(self.output.exists())
        self.expect(run("devices", **nowhere), 0, "no OpenCL device")
        self.expect(self.filter("auto", **nowhere), 0)
        self.expect_same_bits()

    def test_auto_says_what_it_chose(self):
        loud = [option for option in QUICK if option != "-q"]
        self.expect(run(EXAMPLE, "-o", self.output, "--backend=auto", *loud), 0, "backend opencl (")
        self.expect_same_bits()
        nowhere = {"OCL_ICD_VENDORS": self.folder / "none"}
        self.expect(run(EXAMPLE, "-o", self.output, "--backend=auto", *loud, **nowhere), 0, "backend cpu (no OpenCL")
        self.expect(run("explain", EXAMPLE, "-o", self.folder / "explained", "--backend=auto", **nowhere), 0, "backend cpu (no OpenCL")

    def processors_of_threads(self, processors):
        """The processors on which each thread may run, in text, of a run that itself may run on these. Seen several times: hwloc, which
        PoCL asks what the machine has, moves a thread to each processor for a moment."""
        seen = Counter()
        with subprocess.Popen([RPF, "bench", "frames", EXAMPLE, "--rounds", "8", "--set", "--backend opencl --preset fast"],
                              stdout=subprocess.DEVNULL, env={k: v for k, v in os.environ.items() if k != "POCL_AFFINITY"},
                              preexec_fn=lambda: os.sched_setaffinity(0, processors)) as running:
            while running.poll() is None:
                for status in Path(f"/proc/{running.pid}/task").glob("*/status"):
                    try:
                        seen.update((status, line.split()[1]) for line in status.read_text().splitlines() if line.startswith("Cpus_allowed_list"))
                    except OSError:  # that thread has ended
                        pass
                time.sleep(0.01)
            self.assertEqual(running.returncode, 0)
        return {processors for (_, processors), times in seen.items() if times >= 3}

    def test_driver_threads_stay_where_the_process_may_run(self):
        all_processors = os.sched_getaffinity(0)
        if len(all_processors) != os.cpu_count() or len(all_processors) < 2 or "Portable Computing" not in run("devices").stdout:
            self.skipTest("needs PoCL, and two processors or more")
        last = max(all_processors)
        self.assertEqual(self.processors_of_threads({last}), {str(last)})
        self.assertLessEqual({"0", str(last)}, self.processors_of_threads(all_processors))

    def test_device_by_index_and_name(self):
        self.expect(run("devices"), 0, "keeps the numeric contract")
        name = run("devices").stdout.split()[1]
        for wanted in ("0", name[:8].upper()):
            self.expect(self.filter("opencl", None, "--device", wanted), 0)
            self.expect_same_bits()
        for wanted in ("7", "no such thing"):
            for backend in ("opencl", "auto"):  # who names a device wants it
                self.expect(self.filter(backend, None, "--device", wanted), 5, wanted, name)

    def test_two_devices(self):
        two = {"POCL_DEVICES": "basic pthread"}
        listed = [line.split()[1] for line in run("devices", **two).stdout.splitlines() if line[0] in "01"]
        self.assertEqual([name.split("-")[0] for name in listed], ["basic", "pthread"])
        for wanted in ("0", "1", "basic", "pthread"):
            self.expect(self.filter("opencl", None, "--device", wanted, **two), 0)
            self.expect_same_bits()
        common = listed[0].split("-", 1)[1][:6]
        self.expect(self.filter("opencl", None, "--device", common, **two), 2, common, *listed)
        self.assertFalse(self.output.exists())

    def test_a_platform_without_devices(self):
        none = {"POCL_DEVICES": "nothing"}
        self.expect(self.filter("opencl", **none), 5, "--backend=cpu")
        self.assertFalse(self.output.exists())
        self.expect(self.filter("auto", **none), 0)
        self.expect_same_bits()

    def test_a_kernel_that_does_not_compile(self):
        broken = {"POCL_EXTRA_BUILD_FLAGS": "-D__kernel=nonsense"}
        self.expect(self.filter("opencl", **broken), 5, "compiling", "failed", "--backend=cpu")
        self.assertFalse(self.output.exists())
        self.expect(self.filter("auto", **broken), 0)
        self.expect_same_bits()

    # ---- the kernel cache

    def test_cache_that_cannot_be_written(self):
        self.cache.write_text("a file where a folder should be")
        self.expect(self.filter("opencl"), 0)
        self.expect_same_bits()

    def test_cache_on_a_full_disk(self):
        self.cache.mkdir()
        if subprocess.run(["mount", "-t", "tmpfs", "-o", "size=64k", "rpf-test", self.cache], capture_output=True, check=False).returncode != 0:
            self.skipTest("skipped: mounting is not permitted")
        try:
            self.expect(self.filter("opencl"), 0)  # a folder of its own below TMPDIR
            self.expect_same_bits()
            self.expect(self.filter("opencl", TMPDIR=self.cache), 5, "RPF_CACHE_DIR", "--backend=cpu")
            self.assertFalse(self.output.exists())
        finally:
            subprocess.run(["umount", self.cache], check=True)

    def test_without_any_folder_for_caches(self):
        self.expect(self.filter("opencl", RPF_CACHE_DIR="", XDG_CACHE_HOME="", HOME="/nonexistent"), 0)
        self.expect_same_bits()

    def test_damaged_kernels(self):
        def shorten(path, size):
            with open(path, "r+b") as file:
                file.truncate(size)

        def overwrite(path):
            with open(path, "r+b") as file:
                file.seek(path.stat().st_size // 2)
                file.write(b"garbage")

        self.expect(self.filter("opencl"), 0)
        self.expect_same_bits()
        for suffix in (".so", ".bc"):
            for damage in (lambda path: shorten(path, 0), lambda path: shorten(path, path.stat().st_size // 2), overwrite):
                for path in self.compiled(suffix):
                    damage(path)
                self.expect(self.filter("opencl"), 0)
                self.expect_same_bits()

    def test_several_processes_on_a_cold_cache(self):
        outputs = [self.folder / f"out{i}.exr" for i in range(8)]
        environment = {**os.environ, "RPF_CACHE_DIR": str(self.cache)}
        processes = [subprocess.Popen([RPF, EXAMPLE, "-o", output, "--backend=opencl", *QUICK], env=environment) for output in outputs]
        self.assertEqual([process.wait() for process in processes], [0] * len(outputs))
        self.expect(run("compare", *outputs, self.reference, "--max-error", "0"), 0)

    # ---- memory, signals

    def test_refuses_what_does_not_fit_into_memory(self):
        self.expect(self.filter("opencl", None, "--max-memory", "1"), 6, "MB", "--max-memory")
        self.assertFalse(self.output.exists())

    def test_stops_within_two_seconds(self):
        process = subprocess.Popen([RPF, EXAMPLE, "-o", self.output, "--backend=opencl", "--profile", "paper", "--samples-factor", "50"],
                                   env={**os.environ, "RPF_CACHE_DIR": str(self.folder / "warm")})
        time.sleep(6)  # by then the kernel is compiled and runs
        started = time.monotonic()
        process.send_signal(signal.SIGINT)
        self.assertIn(process.wait(), (130, -signal.SIGINT))
        self.assertLess(time.monotonic() - started, 2)
        self.assertFalse(self.output.exists())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
