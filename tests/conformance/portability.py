"""rpf selftest on other OpenCL drivers than Debian's, installed from PyPI below FOLDER. Usage: portability.py RPF EXAMPLE FOLDER intel|pocl-3.0|avx2"""
import os
import shutil
import subprocess
import sys
from pathlib import Path

RPF, EXAMPLE, FOLDER, NAME = Path(sys.argv[1]), Path(sys.argv[2]), Path(sys.argv[3]) / sys.argv[4], sys.argv[4]
SKIPPED = 77
KEEPS_CONTRACT = "keeps the numeric contract"  # of `rpf devices`


class Skipped(Exception):
    pass


def installed(library, *packages):
    """The library of a driver; the packages are installed where it is not there yet."""
    place, begun = FOLDER / "driver", FOLDER / "begun"  # begun: what a killed run leaves is no driver
    if not place.exists():
        shutil.rmtree(begun, ignore_errors=True)
        # --prefix: --target would leave out what is no Python.
        pip = subprocess.run([sys.executable, "-m", "pip", "install", "--quiet", "--no-warn-script-location", "--prefix", begun, *packages],
                             capture_output=True, text=True, check=False)
        if pip.returncode != 0:
            raise Skipped(f"{' '.join(packages)} cannot be had from PyPI: {(pip.stderr.strip().splitlines() or ['?'])[-1]}")
        begun.rename(place)
    return next(iter(place.rglob(library)))


def intel():
    """Nothing but its library is named: the .icd files of the package name a folder that is not there."""
    return {"OCL_ICD_VENDORS": installed("libintelocl.so", "intel-opencl-rt", "intel-cmplr-lib-rt")}


def pocl_3_0():
    """Of a Zen 4 its LLVM makes a Zen 3, its library is that for AVX-512, and the two do not go together: there it gets the one for AVX2."""
    environment = {"OCL_ICD_VENDORS": installed("libpocl-*.so", "pocl-binary-distribution==3.0")}
    if KEEPS_CONTRACT not in run(environment, "devices").stdout:
        for functions in FOLDER.rglob("kernel-*-avx512.bc"):
            shutil.copy(functions.with_name(functions.name.replace("avx512", "avx2")), functions)
    return environment


def avx2():
    """Debian's PoCL compiles for older processors where it is told to; so AVX2 is tried where there is AVX-512."""
    return {"POCL_KERNELLIB_NAME": "avx2"}


DRIVERS = {"intel": (intel, "Intel(R) OpenCL"), "pocl-3.0": (pocl_3_0, "driver 3.0"), "avx2": (avx2, "haswell")}


def run(environment, *arguments):
    return subprocess.run([RPF, *arguments], env={**os.environ, "RPF_CACHE_DIR": str(FOLDER / "cache"), **{k: str(v) for k, v in environment.items()}},
                          capture_output=True, text=True, check=False)


def has_avx512(folder):
    """Whether compiled kernels use its registers."""
    return any("%zmm" in subprocess.run(["objdump", "-d", kernel], capture_output=True, text=True, check=True).stdout for kernel in folder.rglob("*.so"))


def main():
    choose, ran = DRIVERS[NAME]
    environment = choose()
    listed = run(environment, "devices")
    if ran not in listed.stdout and NAME == "avx2":
        raise Skipped("this PoCL does not compile for AVX2 when told to")
    result = run(environment, "selftest", *sys.argv[5:])
    print(result.stdout + result.stderr)
    if result.returncode != 0 or ran not in listed.stdout + result.stdout:
        print(listed.stdout + listed.stderr)
        return 1
    first, second = (run(environment, EXAMPLE, "-o", FOLDER / "out.exr", "--backend=opencl", "--preset", "fast") for _ in range(2))
    print(first.stderr + second.stderr)
    if NAME == "avx2" and has_avx512(FOLDER / "cache"):
        print("kernels for AVX2 use registers of AVX-512")
        return 1
    return 0 if first.returncode == second.returncode == 0 and "compiling" not in second.stderr else 1


try:
    sys.exit(main())
except Skipped as reason:
    print(f"skipped: {reason}")
    sys.exit(SKIPPED)
