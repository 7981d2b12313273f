"""check_rooms.py fails where the house breaks, each time in a copy that is broken in one place. Usage: check_rooms_test.py PROJECT"""
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

PROJECT = Path(sys.argv[1])
COPIED = ("CMakeLists.txt", "README.md", "bench", "docs", "examples", "include", "integrations", "kernels", "src", "tests")
LEFT_OUT = shutil.ignore_patterns("corpus", "*.exr", "*.jpg", "*.png", "__pycache__")

# What is appended to which file (made where it is missing), and what must then be said.
BROKEN = (
    ("src/frame/prepare.cpp", '#include "plan/plan.h"\n', "src/frame must not depend on src/plan"),
    ("src/plan/plan.cpp", '#include "run/tiles.h"\n', "src/plan must not depend on src/run"),
    ("src/cpu/box.cpp", '#include "run/driver.h"\n', "src/cpu must not depend on src/run"),
    ("src/opencl/band.cpp", '#include "cpu/box.h"\n', "src/opencl must not depend on src/cpu"),
    ("src/io/guard.h", '#include "frame/frame.h"\n', "src/io must not depend on src/frame"),
    ("include/rpf/image.h", '#include "frame/frame.h"\n', "include must not depend on src/frame"),
    ("src/plan/plan.cpp", "#include <tbb/parallel_for.h>\n", "src/plan/plan.cpp includes tbb/parallel_for.h"),
    ("src/run/driver.cpp", "void f() { std::exit(1); }\n", "src/run/driver.cpp has std::exit"),
    ("integrations/rpf_samples.h", '#include "rpf/io.h"\n', "integrations must not depend on include"),
    ("src/io/raw_writer.cpp", '#include "rpf_samples.h"\n', "src/io must not depend on integrations"),
    ("docs/renderers.md", "```c\nint other;\n```\n", "docs/renderers.md: its code is not examples/renderer.c"),
    ("src/loose.cpp", "\n", "src/loose.cpp: src holds rooms only"),
    ("src/attic/old.cpp", "\n", "src/attic: src holds rooms only"),
    ("docs/architecture.md", "`src/attic/old`\n", "docs/architecture.md: there is no src/attic/old"),
    ("tests/unit/attic/old_test.cpp", "\n", "tests/unit/attic: the folders of unit tests are named as rooms"),
    ("tests/unit/old_test.cpp", "\n", "tests/unit/old_test.cpp: unit tests lie in the folder of a room"),
)


def check(project):
    run = subprocess.run([sys.executable, PROJECT / "tests/architecture/check_rooms.py", project], capture_output=True, text=True)
    return run.returncode, run.stdout


def copy_to(project):
    for name in COPIED:
        if (PROJECT / name).is_dir():
            shutil.copytree(PROJECT / name, project / name, ignore=LEFT_OUT)
        else:
            shutil.copy(PROJECT / name, project / name)


def said_when_broken(project, place, text):
    """The exit status and the output of the check while `text` stands at the end of a file."""
    file = project / place
    before = file.read_text() if file.exists() else None
    file.parent.mkdir(exist_ok=True)
    file.write_text((before or "") + text)
    said = check(project)
    if before is None:
        file.unlink()
        if not any(file.parent.iterdir()):
            file.parent.rmdir()
    else:
        file.write_text(before)
    return said


def said_without(project, place, text):
    """The same while `text` is missing from a file."""
    file = project / place
    before = file.read_text()
    assert text in before, f"{place} does not have {text}"
    file.write_text(before.replace(text, ""))
    said = check(project)
    file.write_text(before)
    return said


def main():
    with tempfile.TemporaryDirectory() as folder:
        project = Path(folder)
        copy_to(project)
        cases = [("nothing", check(project), (0, "all arrows point downwards"))]
        for place, text, message in BROKEN:
            cases.append((f"{place} + {text.strip()}", said_when_broken(project, place, text), (1, message)))
        cases.append(("CMakeLists.txt without the room explain", said_without(project, "CMakeLists.txt", " explain"),
                      (1, "src/explain: CMakeLists.txt must list the room once")))
        shutil.rmtree(project / "src" / "images")
        cases.append(("src/images without its files", check(project), (1, "src/images may include src/io and does not")))
    failed = 0
    for what, (status, output), (expected_status, expected) in cases:
        if status != expected_status or expected not in output:
            failed += 1
            print(f"{what}: expected {expected_status} and '{expected}', got {status} and:\n{output}")
    print(f"{len(cases) - failed} of {len(cases)} cases")
    return 1 if failed else 0


sys.exit(main())
