"""OpenCL drivers that abort, hang, crash or talk, and what the command then does. Usage: opencl_drivers_test.py RPF PROJECT"""
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

from command_case import SANITIZED

RPF, PROJECT = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
EXAMPLE = PROJECT / "examples" / "dof-spheres.samples.exr"
SMALL = ["--boxes", "5,3", "--crop", "16x12+20+20"]
NETWORK = ["--preset", "fast", "--crop", "16x12+20+20"]

# A driver that does something as soon as it is loaded, and leaves a line in $STARTS.
DRIVER = """
#define _GNU_SOURCE
#include <sched.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>
#include <unistd.h>
__attribute__((constructor)) static void start(void) {
  FILE* starts = fopen(getenv("STARTS"), "a");
  fprintf(starts, "%d\\n", getpid());
  fclose(starts);
  fprintf(stderr, "this driver is broken\\n");
  FAULT;
}
"""
FAULTS = {"aborts": "abort()", "crashes": "raise(SIGSEGV)", "exits": "_exit(0)", "divides": "raise(SIGFPE)"}

# In place of rpf_probe: leaves a line in $ASKED, and aborts where it is asked for what $ABORTS_AT says.
ASKING = """#!/bin/sh
echo "$1" >> "$ASKED"
if [ "$1" = "$ABORTS_AT" ]; then echo "the compiler failed" >&2; kill -ABRT $$; fi
exec "{}" "$@"
"""


# Between us and PoCL, which it makes a driver that is not PoCL; a line in $STARTS for each program that is compiled.
STRANGER = """
#define _GNU_SOURCE
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
int clGetDeviceInfo(void* device, unsigned name, size_t size, void* value, size_t* needed) {
  int (*next)(void*, unsigned, size_t, void*, size_t*) = dlsym(RTLD_NEXT, "clGetDeviceInfo");
  int result = next(device, name, size, value, needed);
  if (name == 0x102F && value && strstr(value, "PoCL")) memcpy(strstr(value, "PoCL"), "none", 4);
  return result;
}
void* clCreateProgramWithSource(void* context, unsigned count, const char** texts, const size_t* lengths, int* error) {
  void* (*next)(void*, unsigned, const char**, const size_t*, int*) = dlsym(RTLD_NEXT, "clCreateProgramWithSource");
  FILE* starts = fopen(getenv("STARTS"), "a");
  fprintf(starts, "compiled\\n");
  fclose(starts);
  return next(context, count, texts, lengths, error);
}
void* clCreateProgramWithBinary(void* context, unsigned count, void* devices, const size_t* sizes, const unsigned char** binaries, int* states, int* error) {
  void* (*next)(void*, unsigned, void*, const size_t*, const unsigned char**, int*, int*) = dlsym(RTLD_NEXT, "clCreateProgramWithBinary");
  if (!getenv("REFUSES")) return next(context, count, devices, sizes, binaries, states, error);
  if (error) *error = -42;
  return 0;
}
"""


class Drivers(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="rpf drivers "))
        self.output, self.reference, self.starts, self.asked = (self.folder / name for name in ("out.exr", "reference.exr", "starts", "asked"))
        self.use(SMALL)

    def use(self, settings):
        """What is filtered from here on."""
        self.settings = settings
        self.expect(self.filter("cpu", output=self.reference), 0)

    def tearDown(self):
        shutil.rmtree(self.folder)

    def run_rpf(self, *arguments, rpf=RPF, prefix=(), **environment):
        environment = {"RPF_CACHE_DIR": self.folder / "cache", "STARTS": self.starts, "ASKED": self.asked, **environment}
        return subprocess.run([*prefix, rpf, *map(str, arguments)], capture_output=True, text=True, check=False,
                              env={**os.environ, **{name: str(value) for name, value in environment.items()}})

    def filter(self, backend, *more, output=None, **environment):
        return self.run_rpf(EXAMPLE, "-o", output or self.output, "--backend", backend, *self.settings, *more, **environment)

    def expect(self, result, code, *texts):
        self.assertEqual(result.returncode, code, result.stdout + result.stderr)
        for text in texts:
            self.assertIn(text, result.stdout + result.stderr)

    def expect_same_bits(self):
        self.expect(self.run_rpf("compare", self.output, self.reference, "--max-error", "0"), 0)
        self.output.unlink()

    def expect_cpu(self, *texts, **environment):
        """No device for --backend=opencl; auto takes the reference and says why."""
        self.expect(self.filter("opencl", **environment), 5, "--backend=cpu", *texts)
        self.assertFalse(self.output.exists())
        self.expect(self.filter("auto", **environment), 0, "backend cpu (no OpenCL", *texts)
        self.expect_same_bits()
        self.assertEqual(self.filter("auto", "-q", **environment).stderr, "")
        self.expect_same_bits()

    def driver(self, fault):
        """The environment in which there is only such a driver."""
        vendors = self.folder / "vendors"
        vendors.mkdir(exist_ok=True)
        library = vendors / "driver.so"
        subprocess.run(["cc", "-shared", "-fPIC", "-x", "c", "-o", library, "-"], input=DRIVER.replace("FAULT", fault), text=True, check=True)
        (vendors / "driver.icd").write_text(f"{library}\n")
        return {"OCL_ICD_VENDORS": vendors}

    def loaded(self):
        return len(self.starts.read_text().split())

    # ---- drivers

    def test_a_driver_that_ends_the_process(self):
        for name, fault in FAULTS.items():
            with self.subTest(name):
                broken = {**self.driver(fault), "ASAN_OPTIONS": "intercept_tls_get_addr=0:handle_segv=0:handle_sigfpe=0"}  # no end of its own
                self.expect_cpu("this driver is broken", **broken)
                self.expect(self.run_rpf("devices", **broken), 5, "this driver is broken", "--backend=cpu")

    def test_a_driver_that_prints_spoils_no_answer_of_another(self):
        """On standard output, where the child that asks both has its answer."""
        talking = self.driver(r'puts("5\nno device"); fflush(stdout)')
        shutil.copy("/etc/OpenCL/vendors/pocl.icd", self.folder / "vendors")
        self.expect(self.filter("opencl", **talking), 0)
        self.expect_same_bits()
        self.expect(self.run_rpf("devices", **talking), 0, "keeps the numeric contract")

    def test_what_is_known_of_a_driver_is_remembered(self):
        broken = self.driver("abort()")
        self.expect(self.filter("opencl", **broken), 5)
        self.expect(self.filter("opencl", **broken), 5, "this driver is broken", "last hour")
        self.assertEqual(self.loaded(), 1)
        self.run_rpf("devices", **broken)  # asks again
        self.assertEqual(self.loaded(), 2)
        self.driver("abort(); abort()")  # another one
        self.expect(self.filter("opencl", **broken), 5)
        self.assertEqual(self.loaded(), 3)

    def test_a_driver_that_hangs(self):
        broken = self.driver("for (;;) pause()")
        self.expect(self.filter("opencl", **broken), 5, "no answer", "--backend=cpu")
        self.expect(self.filter("auto", **broken), 0, "backend cpu (no OpenCL", "no answer")
        self.expect_same_bits()
        self.assertEqual(self.loaded(), 1)  # the second time nobody waits

    def test_a_driver_that_is_slow_on_a_busy_machine_does_not_hang(self):
        """It gets a fourth of a processor for longer than a driver that does nothing would be waited for."""
        slow = self.driver("for (time_t end = time(0) + 24; time(0) < end; usleep(60000)) for (clock_t begin = clock(); clock() - begin < CLOCKS_PER_SEC / 50;) {}")
        self.expect(self.filter("opencl", **slow), 5, "no OpenCL device")

    def test_a_driver_that_gets_almost_no_processor_does_not_hang(self):
        """It works for longer than a driver that does nothing would be waited for, where others have three hundred times its share."""
        cpu = min(os.sched_getaffinity(0))
        starved = self.driver(f"""struct sched_param none = {{0}}; cpu_set_t all, one; CPU_ZERO(&one); CPU_SET({cpu}, &one);
            sched_getaffinity(0, sizeof all, &all); sched_setaffinity(0, sizeof one, &one); sched_setscheduler(0, SCHED_IDLE, &none);
            for (time_t end = time(0) + 24; time(0) < end;) {{}}
            sched_setscheduler(0, SCHED_OTHER, &none); sched_setaffinity(0, sizeof all, &all)""")
        others = [subprocess.Popen(["taskset", "-c", str(cpu), "sh", "-c", "while :; do :; done"]) for _ in range(3)]
        try:
            self.expect(self.filter("opencl", **starved), 5, "no OpenCL device")
        finally:
            for other in others:
                other.kill()
                other.wait()

    def compile(self, text, library, *options):
        subprocess.run(["cc", "-shared", "-fPIC", "-x", "c", "-o", library, "-", *options], input=text, text=True, check=True)

    def test_a_driver_with_a_library_of_its_own_that_we_might_have_too(self):
        """As Intel's runtime: it brings a newer TBB than Debian's, and there is one library of a name in a process."""
        vendors = self.folder / "vendors"
        vendors.mkdir()
        self.compile("void newer(void) {}", vendors / "libtbb.so.12", "-Wl,-soname,libtbb.so.12")
        self.compile("void newer(void); void* clGetExtensionFunctionAddress(const char* name) { newer(); return 0; }", vendors / "driver.so",
                     f"-Wl,-rpath,{vendors},-z,now", "-x", "none", vendors / "libtbb.so.12")
        self.expect(self.run_rpf("devices", OCL_ICD_VENDORS=vendors / "driver.so"), 0, "no OpenCL device")
        self.assertNotIn("cannot be loaded", self.run_rpf("devices", OCL_ICD_VENDORS=vendors / "driver.so").stdout)

    def test_drivers_that_do_not_load_are_named_with_the_reason(self):
        vendors = self.folder / "vendors"
        vendors.mkdir()
        self.compile("void missing(void); void* clGetExtensionFunctionAddress(const char* name) { missing(); return 0; }", vendors / "broken.so", "-z", "now")
        self.compile("void nothing(void) {}", vendors / "other.so")
        for name, library, reason in (("gone", "gone.so", "No such file"), ("broken", "broken.so", "undefined symbol: missing"), ("other", "other.so", "no OpenCL driver")):
            (vendors / f"{name}.icd").write_text(f"{vendors / library}\n")
            for chosen in (vendors, vendors / f"{name}.icd", vendors / library):
                with self.subTest(chosen):
                    self.expect(self.run_rpf("devices", OCL_ICD_VENDORS=chosen), 0, "no OpenCL device", f"{library}", "cannot be loaded", reason)
                    self.expect(self.filter("opencl", OCL_ICD_VENDORS=chosen), 5, "no OpenCL device", reason, "--backend=cpu")
        for icd in Path("/etc/OpenCL/vendors").glob("pocl*.icd"):
            shutil.copy(icd, vendors)
            self.expect(self.run_rpf("devices", OCL_ICD_VENDORS=vendors), 0, "keeps the numeric contract", "gone.icd cannot be loaded", "No such file")
            self.expect(self.filter("opencl", "--device", "Iris", OCL_ICD_VENDORS=vendors), 5, "no such device", "gone.icd cannot be loaded")
            self.assertEqual(self.filter("opencl", "-q", OCL_ICD_VENDORS=vendors).stderr, "")

    def test_nothing_is_left_behind(self):
        environment = {**os.environ, "RPF_CACHE_DIR": str(self.folder / "cache"), "STARTS": str(self.starts), **{k: str(v) for k, v in self.driver("for (;;) pause()").items()}}
        for number in (signal.SIGTERM, signal.SIGKILL):
            self.starts.unlink(missing_ok=True)
            with subprocess.Popen([RPF, EXAMPLE, "-o", self.output, "--backend=opencl"], env=environment) as process:
                while not self.starts.exists() or not self.starts.read_text().endswith("\n"):
                    time.sleep(0.05)
                process.send_signal(number)
                process.wait()
            child = Path("/proc") / self.starts.read_text().strip() / "cmdline"
            for _ in range(100):
                if not child.exists() or not child.read_bytes():
                    break
                time.sleep(0.05)
            else:
                self.fail("the process that asks the driver is still there")

    # ---- machines on which PoCL aborts

    def test_kernels_on_a_file_system_that_runs_nothing(self):
        (self.folder / "cache").mkdir()
        mounts = ["unshare", "-m", "sh", "-c", f'mount -t tmpfs -o noexec none "{self.folder}/cache" && exec "$@"', "sh"]
        if subprocess.run([*mounts, "true"], capture_output=True, check=False).returncode != 0:
            self.skipTest("skipped: mounting is not permitted")
        self.expect_cpu("Aborted", prefix=mounts)

    def test_without_sys(self):
        mounts = ["unshare", "-m", "sh", "-c", 'mount -t tmpfs none /sys && exec "$@"', "sh"]
        if subprocess.run([*mounts, "true"], capture_output=True, check=False).returncode != 0:
            self.skipTest("skipped: mounting is not permitted")
        self.expect(self.filter("opencl"), 0)  # what is known of another machine does not matter
        self.output.unlink()
        self.expect_cpu("Aborted", prefix=mounts)
        self.expect(self.run_rpf("devices", prefix=mounts), 5, "Aborted")

    def test_without_a_linker(self):
        self.expect_cpu("Final linking", PATH="/nonexistent")
        self.expect(self.run_rpf("devices"), 0, "keeps the numeric contract")  # compiles the self-test
        for settings in (SMALL, NETWORK):  # and now their kernels are the first; another PATH, for the verdict is known
            with self.subTest(settings):
                self.use(settings)
                self.expect_cpu("Final linking", PATH="/nonexistent/again")

    # ---- first builds of kernels

    def asking(self):
        """rpf beside a program that asks as `ASKING` does."""
        folder = self.folder / "bin"
        folder.mkdir()
        shutil.copy(RPF, folder / "rpf")
        (folder / "rpf_probe").write_text(ASKING.format(RPF.parent / "rpf_probe"))
        (folder / "rpf_probe").chmod(0o755)
        return {"rpf": folder / "rpf"}

    def test_a_kernel_whose_first_build_aborts(self):
        rpf = self.asking()
        for settings, asked in ((SMALL, ["test", "build"]), (NETWORK, ["build"])):
            with self.subTest(settings):
                self.use(settings)
                self.asked.unlink(missing_ok=True)
                self.expect_cpu("the compiler failed", ABORTS_AT="build", **rpf)
                self.assertEqual(self.asked.read_text().split(), asked)  # verdicts are remembered

    def test_what_failed_is_asked_again_once_devices_finds_that_it_works(self):
        rpf = self.asking()
        for fault in ("test", "build"):
            self.expect(self.filter("opencl", ABORTS_AT=fault, **rpf), 5, "the compiler failed")
            self.expect(self.filter("opencl", **rpf), 5, "last hour", "`rpf devices` asks again")
            self.expect(self.run_rpf("devices", **rpf), 0)
            self.expect(self.filter("opencl", **rpf), 0)
            self.expect_same_bits()
            shutil.rmtree(self.folder / "cache")

    def test_all_kernels_are_compiled_by_the_child_and_it_is_said_once(self):
        """A linker that says who started it: the program itself compiles nothing."""
        folder = self.folder / "tools"
        folder.mkdir()
        linker = folder / "ld"
        linker.write_text('#!/bin/sh\ncat /proc/$PPID/comm >> "$STARTS"\nexec /usr/bin/ld "$@"\n')
        linker.chmod(0o755)
        for settings in (SMALL, NETWORK):
            with self.subTest(settings):
                self.use(settings)
                for said in (1, 0):
                    result = self.filter("opencl", PATH=f"{folder}:{os.environ['PATH']}")
                    self.expect(result, 0)
                    self.assertEqual(result.stderr.count("compiling kernels"), said, result.stderr)
                    self.expect_same_bits()
                self.assertEqual(set(self.starts.read_text().split()), {"rpf_probe"})

    def test_of_several_processes_on_a_cold_cache_one_compiles(self):
        rpf = self.asking()["rpf"]
        self.use(NETWORK)
        environment = {**os.environ, "RPF_CACHE_DIR": str(self.folder / "cache"), "ASKED": str(self.asked)}
        outputs = [self.folder / f"{i}.exr" for i in range(3)]
        processes = [subprocess.Popen([rpf, EXAMPLE, "-o", output, "--backend=opencl", "-q", *NETWORK], env=environment) for output in outputs]
        self.assertEqual([process.wait() for process in processes], [0, 0, 0])
        self.assertEqual(sorted(self.asked.read_text().split()), ["build", "test"])
        for output in outputs:
            output.replace(self.output)
            self.expect_same_bits()

    def test_good_verdicts_are_remembered(self):
        rpf = self.asking()
        for _ in range(3):
            self.expect(self.filter("opencl", **rpf), 0)
            self.expect_same_bits()
        self.assertEqual(self.asked.read_text().split(), ["test", "build"])
        shutil.rmtree(self.folder / "cache" / "pocl")  # what is gone is compiled again, where it can do no harm
        self.expect(self.filter("opencl", **rpf), 0)
        self.assertEqual(self.asked.read_text().split(), ["test", "build", "build"])

    def test_without_the_program_that_asks(self):
        rpf = self.asking()["rpf"]
        (rpf.parent / "rpf_probe").write_text("#!/nonexistent\n")
        self.expect_cpu("rpf_probe", rpf=rpf)

    # ---- compiled programs of drivers that have no cache of their own

    def stranger(self):
        if SANITIZED:
            self.skipTest("skipped: the sanitizer's library must come first")
        place = Path(tempfile.mkdtemp(prefix="rpf-stranger-"))  # a blank ends a name in LD_PRELOAD
        self.addCleanup(shutil.rmtree, place)
        self.compile(STRANGER, place / "stranger.so")
        return {"LD_PRELOAD": place / "stranger.so"}

    def expect_compiled(self, count, **environment):
        self.starts.write_text("")
        result = self.filter("opencl", **environment)
        self.expect(result, 0)
        self.expect_same_bits()
        self.assertEqual(self.starts.read_text().count("compiled"), count)
        return result.stderr

    def kept(self):
        files = sorted((self.folder / "cache" / "programs").iterdir())
        self.assertEqual(len(files), 2)  # the self-test, and what filters
        return files

    def test_compiled_programs_are_kept_for_every_driver(self):
        stranger = self.stranger()
        for settings, compiled in ((SMALL, 2), (NETWORK, 1)):  # the self-test, and what filters
            with self.subTest(settings):
                self.use(settings)
                self.assertIn("compiling kernels", self.expect_compiled(compiled, **stranger))
                self.assertNotIn("compiling kernels", self.expect_compiled(0, **stranger))
                self.assertNotIn("compiling kernels", self.expect_compiled(0, **stranger))

    def test_damaged_programs_are_compiled_again(self):
        stranger = self.stranger()
        self.expect_compiled(2, **stranger)
        damages = {"overwritten": lambda content, other: content[:len(content) // 2] + b"damaged" + content[len(content) // 2 + 7:],
                   "of another": lambda content, other: other}
        for name, damage in damages.items():
            with self.subTest(name):
                whole = [file.read_bytes() for file in self.kept()]
                for file, content, other in zip(self.kept(), whole, reversed(whole)):
                    file.write_bytes(damage(content, other))
                self.expect_compiled(1, **stranger)  # the self-test is remembered
                self.expect_compiled(0, **stranger)
                self.expect(self.run_rpf("devices", **stranger), 0, "keeps the numeric contract")

    def test_a_driver_that_does_not_take_its_own_programs_back(self):
        stranger = {**self.stranger(), "REFUSES": "yes"}
        self.expect_compiled(3, **stranger)  # self-test and filter in the child, and again here
        self.assertNotIn("compiling kernels", self.expect_compiled(1, **stranger))

    # ---- what compilers say

    def test_compiling_is_not_said_where_nothing_shall_be(self):
        result = self.filter("auto", "--progress", "never")
        self.expect(result, 0)
        self.assertNotIn("compiling", result.stderr)

    def test_warnings_of_a_compiler_are_not_ours(self):
        talking = {"POCL_EXTRA_BUILD_FLAGS": "-DRPF_EPSILON=2"}  # a macro that the kernels define anew
        for backend in ("opencl", "auto"):
            for quiet in ([], ["-q"]):
                with self.subTest(backend=backend, quiet=quiet):
                    shutil.rmtree(self.folder / "cache", ignore_errors=True)
                    result = self.filter(backend, *quiet, **talking)
                    self.expect(result, 0)
                    self.assertNotIn("warning", result.stdout + result.stderr)
                    self.expect_same_bits()


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
