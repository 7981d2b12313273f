"""The commands of pages that build everything, word for word, in a fresh clone of what is committed: all blocks that say
`<!-- run by clone.NAME -->`, one after the other, with a home of their own, so that every cache is cold.
Usage: clone_test.py NAME PROJECT"""
import os
import re
import subprocess
import sys
import tempfile
import threading
from pathlib import Path

from pages import run_by

NAME, PROJECT = sys.argv[1], Path(sys.argv[2]).resolve()
# What a compiler says of itself is none of a reader's business; test results are listed by ctest, not by one.
TALK = re.compile(r"warnings? generated|(?<!=)\bwarning:|CMake Warning", re.I)  # ==PID==WARNING: is a sanitizer without its symbolizer
SCENE = """<scene version="3.0.0">
<integrator type="path"><integer name="max_depth" value="4"/></integrator>
<sensor type="thinlens"><float name="aperture_radius" value="0.3"/><float name="focus_distance" value="6"/>
  <transform name="to_world"><lookat origin="0 2 6" target="0 0.7 0" up="0 1 0"/></transform>
  <film type="hdrfilm"><integer name="width" value="48"/><integer name="height" value="36"/><rfilter type="box"/></film></sensor>
<shape type="sphere"><point name="center" x="0" y="1" z="0"/></shape>
<shape type="rectangle"><transform name="to_world"><scale value="9"/><rotate x="1" angle="-90"/></transform></shape>
<emitter type="constant"/>
</scene>
"""
# What takes hours in full: a frame and two settings of the plan, a few of the benchmarks.
PLAN = """{"rounds": 1, "settings": {"mean": "--boxes none", "fast": "--backend opencl --preset fast", "paper": "--backend opencl --profile paper"},
"frames": [{"name": "dof", "scene": "dof", "size": "48x27", "spp": 4, "reference_spp": 64}]}
"""
BENCHMARKS = "roof.*read|dof.4spp.240x135.opencl.paper.17"


def environment(folder, clone):
    """That of a reader who has just logged in, on Debian's own programs; ccache's variables are kept, a proxy's too."""
    kept = {name: value for name, value in os.environ.items() if not name.startswith(("RPF_", "XDG_", "POCL_", "OCL_"))}
    return {**kept, "HOME": str(folder), "PATH": f"{folder}/venv/bin:/usr/local/bin:/usr/bin:/bin:/usr/sbin:/sbin", "CCACHE_BASEDIR": str(clone),
            "BENCHMARK_FILTER": BENCHMARKS, "SKBUILD_BUILD_DIR": "build/pip"}  # the second pip install builds nothing again


def run(script, folder, clone):
    """Exit status and what was said, which is passed on at once."""
    process = subprocess.Popen(["bash", "-euo", "pipefail", "-xc", script], cwd=clone, env=environment(folder, clone), text=True, errors="replace",
                               stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    said = []
    reader = threading.Thread(target=lambda: [said.append(line) or print(line, end="", flush=True) for line in process.stdout])
    reader.start()
    status = process.wait()
    reader.join()
    return status, said


def main():
    script = run_by(PROJECT, f"clone.{NAME}")
    with tempfile.TemporaryDirectory(prefix="rpf clone ü ") as name:
        folder, clone = Path(name), Path(name) / "rpf"
        subprocess.run(["git", "clone", "--quiet", PROJECT, clone], check=True)
        if "pip " in script:
            subprocess.run(["/usr/bin/python3", "-m", "venv", folder / "venv"], check=True)
        if "scene.xml" in script:
            (clone / "scene.xml").write_text(SCENE)
        if "run report" in script:
            (clone / "bench" / "trade_plan.json").write_text(PLAN)
        status, said = run(script, folder, clone)
    talk = [line for line in said if TALK.search(line)]
    print(*["said by a compiler: " + line for line in talk], f"exit status {status}")
    return 1 if status != 0 or talk else 0


sys.exit(main())
