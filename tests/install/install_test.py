"""The library as it is installed. The examples build against it with CMake and with pkg-config, in C99 and C++17, from a
prefix that was moved; they run, and stop where their callback says so. Usage: install_test.py BUILD PROJECT"""
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

BUILD, PROJECT = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
EXAMPLE = PROJECT / "examples" / "dof-spheres.samples.exr"
SOURCES = {"filter_file": ".cpp", "filter_in_memory": ".cpp", "filter_frame": ".c"}
# What filtering uses: files (OpenEXR with Imath, libdeflate), devices (OpenCL's loader), texts (fmt); the language's own.
NEEDED = r"lib(OpenEXR-|OpenEXRCore-|Iex-|IlmThread-|Imath-|deflate|OpenCL|fmt|stdc\+\+|m|gcc_s|c)[-.\d_]*\.so[.\d]*|ld-linux.*"


def run(*command, code=0, **keywords):
    result = subprocess.run([str(part) for part in command], capture_output=True, text=True, check=False, timeout=600, **keywords)
    if result.returncode != code:
        raise AssertionError(f"{command}: {result.returncode}, not {code}\n{result.stdout}{result.stderr}")
    return result


class InstallTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = Path(tempfile.mkdtemp(prefix="rpf install "))
        run("cmake", "--install", BUILD, "--prefix", cls.folder / "first")
        cls.prefix = cls.folder / "moved"
        (cls.folder / "first").rename(cls.prefix)
        cls.libraries = next(cls.prefix.rglob("librpf.so")).parent

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def environment(self):
        kept = {name: value for name, value in os.environ.items() if name not in ("CFLAGS", "CXXFLAGS", "LDFLAGS")}
        return {**kept, "LD_LIBRARY_PATH": str(self.libraries), "PKG_CONFIG_PATH": str(self.libraries / "pkgconfig"), "RPF_BACKEND": "cpu"}

    def test_a_prefix_gets_what_belongs_there(self):
        """A build with tests makes the Python package too, which wheels carry."""
        self.assertEqual({path.name for path in self.prefix.iterdir()}, {"bin", "include", "lib", "share"})

    # ---- what programs are built with

    def expect_programs(self, programs):
        output, environment = self.folder / "out.exr", self.environment()
        for name, arguments, stopping in (("filter_file", [EXAMPLE, output], None), ("filter_in_memory", [output], "0"),
                                          ("filter_frame", [EXAMPLE, output], "0"), ("filter_frame", ["-", output], "0")):
            output.unlink(missing_ok=True)
            run(programs / name, *arguments, env=environment)
            self.assertGreater(output.stat().st_size, 10000, name)
            output.unlink()
            if stopping is not None:
                result = run(programs / name, *arguments, stopping, code=130, env=environment)
                self.assertIn("cancelled", result.stderr)
                self.assertFalse(output.exists(), name)
        self.assertIn("none.exr", run(programs / "filter_frame", "none.exr", output, code=3, env=environment).stderr)

    def test_examples_with_cmake(self):
        build = self.folder / "with cmake"
        run("cmake", "-G", "Ninja", "-S", PROJECT / "examples", "-B", build, f"-DCMAKE_PREFIX_PATH={self.prefix}", "-DCMAKE_C_FLAGS=-Wall -Wextra -Wpedantic -Werror",
            "-DCMAKE_CXX_FLAGS=-Wall -Wextra -Wpedantic -Werror", env=self.environment())
        run("cmake", "--build", build)
        self.expect_programs(build)

    def test_examples_with_pkg_config(self):
        build = self.folder / "with pkg-config"
        build.mkdir()
        self.assertEqual(run("pkg-config", "--modversion", "rpf", env=self.environment()).stdout, run(self.prefix / "bin/rpf", "--version").stdout.split()[1] + "\n")
        flags = run("pkg-config", "--cflags", "--libs", "rpf", env=self.environment()).stdout
        for name, ending in SOURCES.items():
            compiler = "cc -std=c99 -Wpedantic" if ending == ".c" else "c++ -std=c++17"
            run("sh", "-c", f"{compiler} -Wall -Wextra -Werror '{PROJECT}/examples/{name}{ending}' -o '{build}/{name}' {flags}")
        self.expect_programs(build)

    def test_another_minor_version_is_refused(self):
        source = self.folder / "future"
        source.mkdir()
        (source / "CMakeLists.txt").write_text("cmake_minimum_required(VERSION 3.16)\nproject(future LANGUAGES CXX)\nfind_package(rpf 0.9 REQUIRED)\n")
        result = run("cmake", "-S", source, "-B", source / "build", f"-DCMAKE_PREFIX_PATH={self.prefix}", code=1)
        self.assertIn('compatible with requested version "0.9"', " ".join(result.stderr.split()))

    # ---- the library itself

    def test_needs_only_what_filtering_uses(self):
        dynamic = run("readelf", "-d", self.libraries / "librpf.so").stdout
        for name in re.findall(r"\(NEEDED\).*\[(.*)\]", dynamic):
            self.assertRegex(name, f"^({NEEDED})$")
        self.assertRegex(dynamic, r"\(SONAME\).*\[librpf\.so\.0\]")
        self.assertNotIn("RPATH", dynamic.replace("RUNPATH", "RPATH"))
        loaded = run("ldd", self.libraries / "librpf.so").stdout
        for name in ("embree", "tbb", "OpenImageIO", "gnuplot", "CLI"):
            self.assertNotIn(name, loaded)

    def test_shows_what_its_headers_declare_and_nothing_else(self):
        symbols = run("nm", "-DC", "--defined-only", self.libraries / "librpf.so").stdout
        names = [line.split(" ", 2)[2] for line in symbols.splitlines() if line[17] not in "A"]
        header = "".join(path.read_text() for path in (PROJECT / "include/rpf").glob("*.h"))
        for name in names:
            short = re.sub(r"@.*|\[abi:.*?\]|\(.*", "", re.sub(r"^(typeinfo|vtable|typeinfo name) for ", "", name)).split("::")
            self.assertTrue(short[0] == "rpf" or name.startswith("rpf_"), name)
            self.assertRegex(header, rf"\b{re.escape(short[-1].lstrip('~'))}\b", name)
        shown = {re.sub(r"[(@\[].*", "", name).split("::")[-1] for name in names}
        for name in set(re.findall(r"^(?!typedef)[\w:<>,*& ]+[ *&](\w+)\((?!.*\) (?:const )?(?:\{|= (?:0|delete|default);))", header, re.M)):  # with a body elsewhere
            self.assertIn(name, shown)

    def test_its_parts_are_found_where_they_are_installed(self):
        """Not where they were built: images of other formats, OpenCL's drivers, scenes."""
        picture, samples = self.folder / "picture.png", self.folder / "scene.exr"
        program, environment = self.prefix / "bin/rpf", self.environment()
        run(program, EXAMPLE, "-o", picture, "-q", env=environment)
        self.assertEqual(picture.read_bytes()[:4], b"\x89PNG")
        run(program, "scene", "dof", "--size", "16x12", "-o", samples, env=environment)
        run(program, "devices", env=environment)
        self.assertNotIn(str(BUILD).encode() + b"\0", (self.libraries / "librpf.so").read_bytes())

    def test_every_header_stands_alone(self):
        for header in sorted((self.prefix / "include/rpf").glob("*.h")):
            for compiler in ["c++ -std=c++17 -x c++"] + ["cc -std=c99 -x c"] * (header.name == "rpf_c.h"):
                run("sh", "-c", f"echo '#include <rpf/{header.name}>' | {compiler} -Wall -Wextra -Wpedantic -Werror -fsyntax-only '-I{self.prefix}/include' -")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
