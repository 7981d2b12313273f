"""Holds the house together: who may include whom, sizes, and the README's code. Usage: check_rooms.py PROJECT"""
import re
import sys
from pathlib import Path

PROJECT = Path(sys.argv[1])

# A room may include the public headers, itself, and the rooms that stand behind it: these and no others, each of them in
# use. A room stands below all that it may include; so there is no circle.
API = "include"
ROOMS = {
    "kernels": "",
    "include": "",
    "src/parts": "",                  # where the files beside the library are
    "src/parallel": "",               # work that several threads share
    # what was rendered; what will be done about it; what a backend is asked
    "src/frame": "src/parallel kernels",  # the sums of resolve
    "src/plan": "src/parallel src/frame kernels",
    "src/learned": "src/parallel src/frame kernels",  # the estimator of docs/network.md: its networks, what it is shown
    "src/seam": "src/frame src/plan src/learned kernels",
    # those who do it; what follows a pass; the run
    "src/cpu": "src/parallel src/frame src/plan src/learned src/seam kernels",
    "src/opencl": "src/parts src/frame src/plan src/learned src/seam kernels",
    "src/probe": "src/opencl",        # a program: asks drivers in a process of its own
    "src/run": "src/parallel src/frame src/plan src/learned src/seam src/cpu src/opencl kernels",
    "src/explain": "src/parallel src/frame src/plan src/learned src/seam src/run kernels",
    "src/conformance": "src/parallel src/frame src/learned src/seam src/cpu src/opencl kernels",
    # beside the filter, sharing nothing with it but the public headers
    "src/io": "src/parts src/parallel",
    "src/images": "src/io",           # a library of its own; src/io loads it
    "src/metrics": "",
    "src/scene": "src/parallel",
    "src/c_api": "",                  # the public headers once more, for other languages
    # the command
    "src/bench": "",
    "src/report": "src/io src/bench",  # files that are whole or untouched; gnuplot as a program
    "src/study": "src/bench src/report",
    "src/cli": "src/bench src/report src/study",
    # copied into renderers: one file that knows nothing of this house
    "integrations": "",
    "examples": "integrations",
    "python": "",                     # the package: the public API, as Python sees it
    "bench": "src/frame src/plan src/cpu src/opencl src/bench kernels",
}
ROOMS = {room: {API, *targets.split()} for room, targets in ROOMS.items()}
ROOMS["kernels"] = ROOMS[API] = ROOMS["integrations"] = set()
ROOMS["tests"] = set(ROOMS) - {"src/images", "src/cli", "examples", "bench", "python"}
# Third-party headers, each in one room only (beside the tests).
LIBRARIES = {
    "OpenEXR/": {"src/io"}, "Imf": {"src/io"}, "libdeflate": {"src/io"}, "OpenImageIO/": {"src/images"}, "CL/": {"src/opencl"}, "CLI/": {"src/cli"},
    "embree3/": {"src/scene"}, "nanobind/": {"python"}, "tbb/": set(), "benchmark/": {"bench"},
    "fmt/": {"src/c_api", "src/frame", "src/plan", "src/learned", "src/run", "src/opencl", "src/conformance", "src/explain", "src/io", "src/images", "src/metrics", "src/scene", "src/cli", "src/bench", "src/report", "src/study"},
    "nlohmann/": {"src/learned", "src/run", "src/cli", "src/io", "src/conformance", "src/bench", "src/report", "src/study"},  # what is printed as JSON; the header of raw sample files; facts of a frame
}
LONGEST_FILE = 400
LONGER = {"integrations/rpf_samples.h": 660, "integrations/blender/rpf_blender.py": 720}  # one file, so that it can be copied

failures = []
used = set()                                  # (room, room that it includes)


def room_of(path):
    """The deepest room that a file lies in."""
    parts = path.relative_to(PROJECT).parts[:-1]
    rooms = ["/".join(parts[:n]) for n in range(len(parts), 0, -1)]
    return next((room for room in rooms if room in ROOMS), None)


def included_room(name, file):
    """The room of a project header, None for other headers."""
    for folder in (PROJECT / "include", PROJECT / "src", PROJECT / "kernels", PROJECT / "integrations", PROJECT / "tests" / "unit", file.parent):
        if (folder / name).is_file():
            return room_of(folder / name)
    return None


def check_include(file, name):
    room, place = room_of(file), str(file.relative_to(PROJECT))
    target = included_room(name, file)
    if target is not None:
        used.add((room, target))
        if target != room and target not in ROOMS[room]:
            failures.append(f"{place} includes {name}: {room} must not depend on {target}")
        return
    for prefix, rooms in LIBRARIES.items():
        if name.startswith(prefix) and room not in rooms and room != "tests":
            failures.append(f"{place} includes {name}: allowed in {sorted(rooms)} only")


def check_silence(file, text):
    """The library never prints and never exits; what it knows it throws or returns."""
    if file.is_relative_to(PROJECT / "src") and room_of(file) not in ("src/cli", "src/probe"):
        for word in re.findall(r"\b(?:std::(?:cout|cerr|clog|exit|abort|terminate|quick_exit)|fmt::print|f?printf|puts|_exit)\b", text):
            failures.append(f"{file.relative_to(PROJECT)} has {word}: only the programs, src/cli and src/probe, print and end the process")


def check_arrows():
    """Every allowed arrow is used and points to a room that stands above."""
    order = list(ROOMS)
    for room, targets in ROOMS.items():
        for target in targets - {API} if room != "tests" else ():
            if order.index(target) >= order.index(room):
                failures.append(f"{room} may include {target}, which does not stand above it")
            if (room, target) not in used:
                failures.append(f"{room} may include {target} and does not: take the arrow away")


def check_folders():
    """src holds rooms and nothing else; the build lists each of them, and unit tests lie in folders named as rooms."""
    build = (PROJECT / "CMakeLists.txt").read_text()
    listed = " ".join(re.findall(r"^sources_of_rooms\(\w+ ([^)]*)\)", build, re.M)).split()
    for entry in sorted((PROJECT / "src").iterdir()):
        if f"src/{entry.name}" not in ROOMS or not entry.is_dir():
            failures.append(f"src/{entry.name}: src holds rooms only, and check_rooms.py does not know this one")
        elif listed.count(entry.name) != 1:
            failures.append(f"src/{entry.name}: CMakeLists.txt must list the room once with sources_of_rooms()")
    for entry in sorted((PROJECT / "tests" / "unit").iterdir()):
        if entry.is_dir() and not {entry.name, f"src/{entry.name}"} & set(ROOMS):
            failures.append(f"tests/unit/{entry.name}: the folders of unit tests are named as rooms")
        if entry.name.endswith("_test.cpp"):
            failures.append(f"tests/unit/{entry.name}: unit tests lie in the folder of a room")


def sources():
    for folder in ("include", "kernels", "integrations", "src", "tests", "bench", "examples", "python"):
        for file in sorted((PROJECT / folder).rglob("*")):
            if file.suffix in (".h", ".c", ".cpp", ".cl", ".py"):
                yield file


def check_docs():
    """What a document calls a place in src is one: a folder, or a file without its ending."""
    for document in sorted((PROJECT / "docs").glob("*.md")):
        for name in re.findall(r"`(src/[\w./]+)`", document.read_text()):
            if not any((PROJECT / f"{name}{ending}").exists() for ending in ("", ".h", ".cpp")):
                failures.append(f"docs/{document.name}: there is no {name}")


def check_examples():
    """The code of a document is that of an example, which the build compiles."""
    for document, language, example in (("README.md", "cpp", "examples/filter_file.cpp"), ("docs/renderers.md", "c", "examples/renderer.c")):
        blocks = re.findall(rf"```{language}\n(.*?)```", (PROJECT / document).read_text(), re.S)
        if not blocks or any(block not in (PROJECT / example).read_text() for block in blocks):
            failures.append(f"{document}: its code is not {example}")


def main():
    for file in sources():
        text = file.read_text()
        longest = LONGER.get(str(file.relative_to(PROJECT)), LONGEST_FILE)
        if len(text.splitlines()) > longest:
            failures.append(f"{file.relative_to(PROJECT)}: {len(text.splitlines())} lines, at most {longest} are wanted")
        if file.suffix == ".py":
            continue
        check_silence(file, text)
        for name in re.findall(r'^\s*#include [<"]([^>"]+)[>"]', text, re.M):
            check_include(file, name)
    check_arrows()
    check_folders()
    check_docs()
    check_examples()
    print("\n".join(failures) or "all arrows point downwards")
    return 1 if failures else 0


sys.exit(main())
