"""Many small frames, one process each: the same bits, no more memory, nothing left in the folders.
Usage: soak_test.py RPF PROJECT PROCESSES"""
import os
import subprocess
import sys
import tempfile
from pathlib import Path

RPF, EXAMPLE, PROCESSES = sys.argv[1], Path(sys.argv[2]) / "examples" / "dof-spheres.samples.exr", int(sys.argv[3])
WARM_UP, ALLOWED = 10, 8 << 10  # KB: which thread allocates when differs from run to run


def files_below(folder):
    """Without the empty file that PoCL leaves in every process: the next process removes those older than an hour."""
    return sorted(str(path.relative_to(folder)) for path in folder.rglob("*") if not path.name.startswith("tempfile_"))


def peak_of(command, environment):
    """Kilobytes of this one process."""
    process = subprocess.Popen(command, env=environment)
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    assert process.returncode == 0, process.returncode
    return usage.ru_maxrss


def main():
    for backend in ("cpu", "opencl"):
        with tempfile.TemporaryDirectory(prefix="rpf soak ") as name:
            folder, output = Path(name), Path(name) / "out.exr"
            environment = {**os.environ, "RPF_CACHE_DIR": name + "/cache", "TMPDIR": name}
            command = [RPF, EXAMPLE, "-o", output, "--backend", backend, "--boxes", "5,3", "--crop", "24x16+20+20", "-q"]
            peaks, bits, files = [], set(), None
            for number in range(1, PROCESSES + 1):
                peaks.append(peak_of(command, environment))
                bits.add(output.read_bytes())
                if number == min(WARM_UP, PROCESSES):
                    files = files_below(folder)
            print(f"{backend}: {PROCESSES} processes, largest {max(peaks[:WARM_UP])} KB in the first {WARM_UP}, {max(peaks)} KB in all, "
                  f"{len(files_below(folder)) - len(files):+d} files")
            assert len(bits) == 1, "not the same bits"
            assert max(peaks) <= max(peaks[:WARM_UP]) + ALLOWED, peaks
            assert files_below(folder) == files, set(files_below(folder)) - set(files)


main()
