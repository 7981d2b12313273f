"""Holds the house together: who may include whom, sizes, and the README's code. Usage: check_rooms.py PROJECT"""
import re
import sys
from pathlib import Path

PROJECT = Path(sys.argv[1])

# A room may include what stands behind it, and itself. Dependencies point downwards only.
API = {"include"}
ROOMS = {
    "kernels": set(),
    "include": set(),
    "src/frame": API | {"src/plan"},
    "src/plan": API | {"src/frame", "src/after", "kernels"},
    "src/seam": API | {"src/frame", "src/plan", "kernels"},
    "src/cpu": API | {"src/frame", "src/plan", "src/seam", "kernels"},
    "src/opencl": API | {"src/frame", "src/plan", "src/seam", "kernels"},
    "src/after": API | {"src/frame", "kernels"},
    "src/run": API | {"src/frame", "src/plan", "src/seam", "src/cpu", "src/opencl", "src/after", "kernels"},
    "src/explain": API | {"src/frame", "src/seam", "src/after", "src/run", "kernels"},
    "src/conformance": API | {"src/seam", "src/after", "src/cpu", "src/opencl", "kernels"},
    "src/io": API,
    "src/images": API | {"src/io"},           # a library of its own; src/io loads it
    "src/metrics": API,
    "src/scene": API,
    "src/bench": API,
    "src/report": API | {"src/io", "src/bench"},  # files that are whole or untouched; gnuplot as a program
    "src/study": API | {"src/bench", "src/report"},
    "src/cli": API | {"src/bench", "src/report", "src/study"},
    "examples": API,
    "bench": API | {"src/frame", "src/plan", "src/seam", "src/cpu", "src/opencl", "src/bench", "kernels"},
    "tests": API | {"kernels", "src/frame", "src/plan", "src/seam", "src/cpu", "src/opencl", "src/after", "src/run", "src/explain", "src/conformance", "src/io", "src/metrics", "src/scene", "src/bench", "src/report", "src/study"},
}
# Third-party headers, each in one room only (beside the tests).
LIBRARIES = {
    "OpenEXR/": {"src/io"}, "Imf": {"src/io"}, "libdeflate": {"src/io"}, "OpenImageIO/": {"src/images"}, "CL/": {"src/opencl"}, "CLI/": {"src/cli"},
    "embree3/": {"src/scene"}, "tbb/": {"src/after", "src/cpu", "src/explain", "src/scene"}, "benchmark/": {"bench"},
    "fmt/": {"src/frame", "src/plan", "src/run", "src/opencl", "src/conformance", "src/explain", "src/io", "src/images", "src/metrics", "src/scene", "src/cli", "src/bench", "src/report", "src/study"},
    "nlohmann/": {"src/cli", "src/io", "src/conformance", "src/bench", "src/study"},  # what is printed as JSON; the header of raw sample files
}
LONGEST_FILE = 400

failures = []


def room_of(path):
    """The deepest room that a file lies in."""
    parts = path.relative_to(PROJECT).parts[:-1]
    rooms = ["/".join(parts[:n]) for n in range(len(parts), 0, -1)]
    return next((room for room in rooms if room in ROOMS), None)


def included_room(name, file):
    """The room of a project header, None for other headers."""
    for folder in (PROJECT / "include", PROJECT / "src", PROJECT / "kernels", PROJECT / "tests" / "unit", file.parent):
        if (folder / name).is_file():
            return room_of(folder / name)
    return None


def check_include(file, name):
    room, place = room_of(file), str(file.relative_to(PROJECT))
    target = included_room(name, file)
    if target is not None:
        if target != room and target not in ROOMS[room]:
            failures.append(f"{place} includes {name}: {room} must not depend on {target}")
        return
    for prefix, rooms in LIBRARIES.items():
        if name.startswith(prefix) and room not in rooms and room != "tests":
            failures.append(f"{place} includes {name}: allowed in {sorted(rooms)} only")


def check_silence(file, text):
    """The library never prints and never exits; what it knows it throws or returns."""
    if file.is_relative_to(PROJECT / "src") and room_of(file) != "src/cli":
        for word in re.findall(r"\b(?:std::(?:cout|cerr|clog|exit|abort|terminate|quick_exit)|fmt::print|f?printf|puts|_exit)\b", text):
            failures.append(f"{file.relative_to(PROJECT)} has {word}: only src/cli prints and ends the process")


def sources():
    for folder in ("include", "kernels", "src", "tests", "bench", "examples"):
        for file in sorted((PROJECT / folder).rglob("*")):
            if file.suffix in (".h", ".cpp", ".cl", ".py"):
                yield file


def check_readme():
    """The README's C++ is examples/filter_file.cpp, which the build compiles."""
    readme = (PROJECT / "README.md").read_text()
    example = (PROJECT / "examples" / "filter_file.cpp").read_text()
    for block in re.findall(r"```cpp\n(.*?)```", readme, re.S):
        if block not in example:
            failures.append("README.md: its C++ is not examples/filter_file.cpp")


def main():
    for file in sources():
        text = file.read_text()
        if len(text.splitlines()) > LONGEST_FILE:
            failures.append(f"{file.relative_to(PROJECT)}: {len(text.splitlines())} lines, at most {LONGEST_FILE} are wanted")
        if file.suffix == ".py":
            continue
        check_silence(file, text)
        for name in re.findall(r'^\s*#include [<"]([^>"]+)[>"]', text, re.M):
            check_include(file, name)
    check_readme()
    print("\n".join(failures) or "all arrows point downwards")
    return 1 if failures else 0


sys.exit(main())
