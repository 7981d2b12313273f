"""The renderer of docs/renderers.md: its file is one that rpf reads without a note and filters, byte for byte what numpy would write.
Usage: renderer_test.py RPF PROJECT RENDERER"""
import re
import subprocess
import sys
import tempfile
from pathlib import Path

RPF, PROJECT, RENDERER = sys.argv[1], Path(sys.argv[2]).resolve(), sys.argv[3]
exec(re.search(r"```python\n(.*?)```", (PROJECT / "docs" / "file-format.md").read_text(encoding="utf-8"), re.S).group(1))  # read_samples, write_samples


def run(*arguments):
    result = subprocess.run([str(argument) for argument in arguments], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
    assert result.returncode == 0, result.stdout
    return result.stdout


def error(image, reference):
    """relMSE, as rpf compare says it."""
    return float(run(RPF, "compare", image, reference).splitlines()[1].split()[0])


def main():
    with tempfile.TemporaryDirectory(prefix="rpf renderer ü ") as name:
        folder = Path(name)
        samples = folder / "ball.rpf"
        assert run(RENDERER, samples) == ""
        header, counts, channels = read_samples(samples)
        write_samples(folder / "numpy.rpf", header["dataWindow"], counts, channels, header["metadata"])
        assert samples.read_bytes() == (folder / "numpy.rpf").read_bytes()

        info = run(RPF, "info", samples)
        assert "49152 samples: 8 to 8 a pixel, 8.00 on average, 0 empty pixels" in info, info
        # What rpf remarks is what was meant: samples that hit nothing have no surface.
        remarked = {line.split()[0].rsplit(".", 1)[0] for line in info.splitlines() if "non-finite" in line}
        assert remarked == {"feature.N", "feature.albedo"}, info
        assert "unused" not in info and "note" not in info, info

        run(RPF, samples, "-o", folder / "mean.exr", "--boxes", "none", "-q")
        run(RPF, samples, "-o", folder / "filtered.exr", "--preset", "balanced", "-q")
        assert error(folder / "filtered.exr", folder / "mean.exr") > 0.001
    print("written, described, filtered")


main()
