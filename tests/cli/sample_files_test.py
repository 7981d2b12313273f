"""merge and convert as a user runs them, with the numpy code of docs/file-format.md.
Usage: sample_files_test.py RPF PROJECT"""
import re
import subprocess
import sys
import unittest

import numpy as np

from command_case import EXAMPLE, PROJECT, RPF, SANITIZED, CommandCase

# The document's code is what is tested.
DOCUMENT = (PROJECT / "docs" / "file-format.md").read_text(encoding="utf-8")
exec(re.search(r"```python\n(.*?)```", DOCUMENT, re.S).group(1))  # write_samples, read_samples
MAIN = """
int main(int, char** argv) {
  std::vector<unsigned> counts = {2, 0, 1};
  std::map<std::string, std::vector<float>> channels = {
      {"R", {1, 2, 3}}, {"G", {4, 5, 6}}, {"B", {7, 8, 9}}, {"film.X", {0.25F, 0.5F, 2.75F}}, {"film.Y", {0.5F, 0.5F, 0.5F}}};
  write_samples(argv[1], 3, 1, counts, channels);
}
"""


def run(*arguments):
    return subprocess.run([RPF, *map(str, arguments)], capture_output=True, text=True, check=False)


class SampleFilesTest(CommandCase):
    def setUp(self):
        super().setUp()
        self.random = np.random.default_rng(1)

    def expect_same(self, a, b):
        """Two read raw files: same counts, same channels, same bits."""
        np.testing.assert_array_equal(a[1], b[1])
        self.assertEqual(set(a[2]), set(b[2]))
        for name in a[2]:
            np.testing.assert_array_equal(a[2][name].view("<u4"), b[2][name].view("<u4"), name)

    def frame(self, counts, names=("R", "G", "B", "film.X", "film.Y", "random.time")):
        """Random bits, so infinities and NaN of all kinds are among them."""
        return {name: self.random.integers(0, 2**32, int(np.sum(counts)), np.uint32).view("<f4") for name in names}

    # ---- the document's code in C++

    def test_cpp_of_the_document_writes_what_is_read(self):
        source, program = self.folder / "write.cpp", self.folder / "write"
        source.write_text(re.search(r"```cpp\n(.*?)```", DOCUMENT, re.S).group(1) + MAIN)
        flags = subprocess.run(["pkg-config", "--cflags", "--libs", "OpenEXR"], capture_output=True, text=True, check=True).stdout.split()
        subprocess.run(["c++", "-std=c++17", str(source), "-o", str(program), *flags], check=True)
        subprocess.run([str(program), str(self.folder / "a.exr")], check=True)
        self.expect(run("convert", self.folder / "a.exr", "-o", self.folder / "a.rpf"), 0, "3x1 pixels")
        _, counts, channels = read_samples(self.folder / "a.rpf")
        np.testing.assert_array_equal(counts, [2, 0, 1])
        np.testing.assert_array_equal(channels["film.X"], np.float32([0.25, 0.5, 2.75]))
        np.testing.assert_array_equal(channels["B"], np.float32([7, 8, 9]))

    # ---- convert

    def test_raw_to_openexr_and_back_is_lossless(self):
        counts = self.random.integers(0, 5, 7 * 4)
        window, metadata = [-3, 2, 7, 4], {"rpf:seed": 5, "shutter": 0.1, "rpf:renderer": "ä", "rpf:worldOrigin": [1.5, 2, 3]}
        write_samples(self.folder / "a.rpf", window, counts, self.frame(counts), metadata)
        self.expect(run("convert", self.folder / "a.rpf", "-o", self.folder / "b.exr"), 0, "7x4 pixels", "6 slots")
        self.expect(run("convert", self.folder / "b.exr", "-o", self.folder / "c.rpf"), 0)
        first, last = read_samples(self.folder / "a.rpf"), read_samples(self.folder / "c.rpf")
        self.expect_same(first, last)
        self.assertEqual(last[0]["dataWindow"], window)
        for name, value in metadata.items():
            np.testing.assert_array_equal(np.float32(value) if not isinstance(value, str) else value, last[0]["metadata"][name])
        self.expect(run("convert", self.folder / "c.rpf", "-o", self.folder / "d.exr"), 0)
        self.assertEqual((self.folder / "b.exr").read_bytes(), (self.folder / "d.exr").read_bytes())

    @unittest.skipIf(SANITIZED, "sanitizers take memory of their own")
    def test_predicted_memory_is_an_upper_bound(self):
        def peak_mb(*arguments):
            # In between a process without numpy: a child's peak begins with its parent's memory.
            code = ("import resource, subprocess, sys; subprocess.run(sys.argv[1:], check=True); "
                    "print(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss)")
            command = [sys.executable, "-c", code, RPF, *map(str, arguments)]
            return int(subprocess.run(command, capture_output=True, text=True, check=True).stdout) / 1024

        names = ["R", "G", "B", "film.X", "film.Y", "random.lens.U", "random.lens.V", "random.time"]
        names += [f"feature.{group}.{axis}" for group in ("N", "P", "albedo", "N2", "P2") for axis in "XYZ"]
        counts = np.full(300 * 200, 16)
        values = np.random.default_rng(1).random(counts.sum(), dtype=np.float32)
        big, small, output = self.folder / "big.rpf", self.folder / "small.rpf", self.folder / "out.exr"
        write_samples(big, [0, 0, 300, 200], counts, {name: values for name in names})
        write_samples(small, [0, 0, 1, 1], counts[:1], {name: values[:16] for name in names})
        options = ["-q", "--backend=cpu", "-t", "1", "--boxes", "1"]
        first = ["--profile", "paper", "--features", "first"]
        # thesis: two more columns than were read
        for more in (["--profile", "thesis"], ["--profile", "paper"], first):
            with self.subTest(options=more):
                text = run(big, "--dry-run", *options, *more).stdout
                predicted = float(re.search(r"peak memory: (\d+) MB", text).group(1))
                used = peak_mb(big, "-o", output, *options, *more) - peak_mb(small, "-o", output, *options)
                self.assertLess(used, predicted * 1.02)  # pages, buffers of files
                self.assertGreater(used, predicted * 0.75)
                self.assertLess(used, 1.5 * counts.sum() * len(names) * 4 / 2**20)
        # What constant channels took is given back, in time for the second set of colors.
        constant = {name: values * 0 if "2" in name else values for name in names}
        write_samples(big, [0, 0, 300, 200], counts, constant)
        text = run(big, "--dry-run", *options, "--profile", "paper").stdout
        predicted = float(re.search(r"peak memory: (\d+) MB", text).group(1))
        used = peak_mb(big, "-o", output, *options, "--profile", "paper") - peak_mb(small, "-o", output, *options)
        self.assertLess(used, predicted * 0.93)

    def test_half_stays_half_and_names_become_slots(self):
        same = self.folder / "same.exr"
        self.expect(run("convert", EXAMPLE, "-o", same), 0)
        self.assertEqual(run("info", same).stdout.splitlines()[1:], run("info", EXAMPLE).stdout.splitlines()[1:])
        counts = np.full(4, 2)
        theirs = self.frame(counts, ("COLOR_R", "COLOR_G", "COLOR_B", "IMAGE_X", "IMAGE_Y", "LENS_U", "other"))
        write_samples(self.folder / "theirs.rpf", [0, 0, 2, 2], counts, theirs)
        self.expect(run("convert", self.folder / "theirs.rpf", "-o", self.folder / "ours.rpf", "--map", "random.time=other"), 0)
        ours = read_samples(self.folder / "ours.rpf")[2]
        self.assertEqual(list(ours), ["R", "G", "B", "film.X", "film.Y", "random.lens.U", "random.time"])
        np.testing.assert_array_equal(ours["random.time"].view("<u4"), theirs["other"].view("<u4"))

    def test_raw_files_can_be_used_directly(self):
        raw, images = self.folder / "a.rpf", []
        self.expect(run("convert", EXAMPLE, "-o", raw), 0)
        self.expect(run("info", raw), 0, "4 to 4 a pixel", "random.lens.U", "compression none")
        for file in (EXAMPLE, raw):
            self.expect(run(file, "-o", self.folder / "out.exr", "-q", "--boxes", "5,3", "--crop", "16x12+20+20"), 0)
            images.append((self.folder / "out.exr").read_bytes())
        of_input = rb"(rpf:inputHash\0string\0\x10\0\0\0)([0-9a-f]{16})"  # the only thing that tells which file it was
        self.assertNotEqual(re.search(of_input, images[0])[2], re.search(of_input, images[1])[2])
        self.assertEqual(*(re.sub(of_input, rb"\1", image) for image in images))

    def test_damaged_raw_files_are_input_errors(self):
        raw, out = self.folder / "a.rpf", self.folder / "out.exr"
        counts = np.full(4, 2)
        write_samples(raw, [0, 0, 2, 2], counts, self.frame(counts))
        good = raw.read_bytes()
        for bytes_, texts in ((good[:-1], ("truncated",)), (good.replace(b'"version": 1', b'"version": 2'), ('"version"', "1, the version")),
                              (good.replace(b'"channels"', b'"canals"'), ('"canals"', '"channels"')),
                              (good.replace(b"[0, 0, 2, 2]", b"[0, 0, 2, 99999999999]"), ('"dataWindow"',)),
                              (good.replace(b'"R"', b"12345"), ('"channels"',))):
            raw.write_bytes(bytes_)
            with self.subTest(texts=texts):
                self.expect(run("convert", raw, "-o", out), 3, "a.rpf", *texts)
                self.assertFalse(out.exists())

    def test_convert_refuses_other_targets_and_too_little_memory(self):
        self.expect(run("convert", EXAMPLE, "-o", self.folder / "a.png"), 4, "a.png", ".exr", ".rpf")
        self.expect(run("convert", EXAMPLE, "-o", self.folder / "a.rpf", "--max-memory", "1"), 6, "the limit is 1 MB")
        self.expect(run("convert", EXAMPLE), 2)
        self.expect(run("convert", EXAMPLE, EXAMPLE, "-o", self.folder / "a.rpf"), 2, "one sample file")
        self.assertEqual(list(self.folder.iterdir()), [])

    # ---- merge

    def split_example(self):
        """Samples 0 and 1, and samples 2 and 3 of the example, as a renderer with two seeds would have written them."""
        self.expect(run("convert", EXAMPLE, "-o", self.folder / "whole.rpf"), 0)
        header, counts, channels = read_samples(self.folder / "whole.rpf")
        for name, begin, seed in (("a", 0, 11), ("b", 2, 12)):
            part = {channel: values.reshape(-1, 4)[:, begin:begin + 2].ravel() for channel, values in channels.items()}
            write_samples(self.folder / f"{name}.rpf", header["dataWindow"], counts // 2, part, {"rpf:seed": seed})
        return [self.folder / "a.rpf", self.folder / "b.rpf"]

    def test_filtering_two_merged_halves_is_filtering_the_whole(self):
        parts, images = self.split_example(), []
        self.expect(run("merge", *parts, "-o", self.folder / "merged.exr"), 0, "37632 samples")
        self.expect(run("convert", self.folder / "merged.exr", "-o", self.folder / "merged.rpf"), 0)
        merged = read_samples(self.folder / "merged.rpf")
        self.expect_same(merged, read_samples(self.folder / "whole.rpf"))
        self.assertEqual(merged[0]["metadata"]["rpf:seeds"], "11 12")
        for file in (EXAMPLE, self.folder / "merged.exr"):
            self.expect(run(file, "-o", self.folder / "out.ppm", "-q", "--profile", "paper", "--boxes", "7,3"), 0)
            images.append((self.folder / "out.ppm").read_bytes())
        self.assertEqual(images[0], images[1])

    def test_merge_keeps_half_where_all_have_it(self):
        shifted = self.folder / "shifted.rpf"
        self.expect(run("convert", EXAMPLE, "-o", shifted), 0)
        header, counts, channels = read_samples(shifted)
        channels["random.lens.U"] = 1 - channels["random.lens.U"]
        write_samples(shifted, header["dataWindow"], counts, channels)
        both = self.folder / "both.exr"
        self.expect(run("merge", EXAMPLE, shifted, "-o", both), 0, "75264 samples")
        self.assertRegex(run("info", both).stdout, r"feature.N.X +float")  # one of them is raw
        # Two files of halves: the example, and the example with its lens coordinates exchanged.
        other = self.folder / "other.exr"
        self.expect(run("convert", EXAMPLE, "-o", other, "--map", "random.lens.V=random.lens.U", "--map", "random.lens.U=random.lens.V"), 0)
        self.expect(run("merge", EXAMPLE, other, "-o", both), 0)
        self.assertRegex(run("info", both).stdout, r"feature.N.X +half")
        self.assertRegex(run("info", both).stdout, r"film.X +film.X +float")
        self.assertIn("8 to 8 a pixel", run("info", both).stdout)

    def test_merge_refuses_what_is_no_second_rendering(self):
        parts, out = self.split_example(), self.folder / "out.exr"
        self.expect(run("merge", parts[0], parts[0], "-o", out), 3, "repeats samples", "seeds 11 and 11")
        self.expect(run("merge", EXAMPLE, parts[1], "-o", out), 3, "b.rpf", "repeats samples")
        header, counts, channels = read_samples(parts[1])
        write_samples(parts[1], [1, 0, *header["dataWindow"][2:]], counts, channels)
        self.expect(run("merge", *parts, "-o", out), 3, "b.rpf", "data window 112x84+1+0")
        write_samples(parts[1], header["dataWindow"], counts, {**channels, "feature.depth": channels["R"]})
        self.expect(run("merge", *parts, "-o", out), 3, "a.rpf", "feature.depth", "--map feature.depth=")
        self.assertFalse(out.exists())
        self.expect(run("merge", *parts, "-o", out, "--map", "feature.depth="), 0)

    def test_merge_usage_and_memory(self):
        self.expect(run("merge", EXAMPLE, "-o", self.folder / "a.exr"), 2, "two or more")
        self.expect(run("merge", EXAMPLE, EXAMPLE, "-o", self.folder / "a.exr", "--max-memory", "5"), 6, "the limit is 5 MB")
        self.expect(run("merge", EXAMPLE, self.folder / "no.exr", "-o", self.folder / "a.exr"), 3, "no.exr")
        self.assertEqual(list(self.folder.iterdir()), [])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
