"""The pictures of `rpf compare --side-by-side`, pixel by pixel. Usage: side_by_side_test.py RPF PROJECT"""
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

RPF = sys.argv[1]
GAP, ORANGE = 8, (255, 188, 0)
DARK, GRAY, WHITE = 60, 128, 255


def write_ppm(path, pixels):
    height, width, _ = pixels.shape
    path.write_bytes(b"P6 %d %d 255\n" % (width, height) + pixels.astype(np.uint8).tobytes())


def read_ppm(path):
    width, height, pixels = re.match(rb"P6\s(\d+)\s(\d+)\s255\s(.*)", path.read_bytes(), re.S).groups()
    return np.frombuffer(pixels, np.uint8).reshape(int(height), int(width), 3)


def enlarged(pixels, factor):
    return pixels.repeat(factor, axis=0).repeat(factor, axis=1)


class SideBySideTest(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory(prefix="rpf test ü ")
        self.random = np.random.default_rng(1)

    def tearDown(self):
        self.folder.cleanup()

    def compare(self, a, b, *options, code=0):
        paths = [Path(self.folder.name) / name for name in ("a.ppm", "b.ppm", "picture.ppm")]
        write_ppm(paths[0], a)
        write_ppm(paths[1], b)
        result = subprocess.run([RPF, "compare", *map(str, paths[:2]), "--side-by-side", str(paths[2]), *options],
                                capture_output=True, text=True, check=False)
        self.assertEqual(result.returncode, code, result.stderr)
        return read_ppm(paths[2]) if code == 0 else result.stderr

    def noise(self, width, height):
        return self.random.integers(0, 256, (height, width, 3))

    def outline(self, picture):
        """Left, top, right, bottom of the orange pixels in the picture of the first image, the ends excluded."""
        rows, columns = np.nonzero((picture == ORANGE).all(axis=2))
        return columns.min(), rows.min(), columns.max() + 1, rows.max() + 1

    def test_the_crop_stands_below_enlarged_and_is_outlined_above(self):
        a, b = self.noise(40, 32), self.noise(40, 32)
        picture = self.compare(a, b, "--zoom", "8x4+3+5")
        width, height = 4 * 40, 4 * 32  # enlarged to about 400 pixels, at most four times
        self.assertEqual(picture.shape, (height + GAP + 20 * 4, 2 * width + GAP, 3))
        for i, image in enumerate((a, b)):
            left = i * (width + GAP)
            np.testing.assert_array_equal(picture[height + GAP:, left:left + width], enlarged(image[5:9, 3:11], 20))
            above, expected = picture[:height, left:left + width], enlarged(image, 4)
            # Two pixels around the crop's place, none in it.
            outside = np.ones((height, width), bool)
            outside[18:38, 10:46] = False
            inside = (slice(20, 36), slice(12, 44))
            np.testing.assert_array_equal(above[outside], expected[outside])
            np.testing.assert_array_equal(above[inside], expected[inside])
            self.assertTrue((above[18:20, 10:46] == ORANGE).all() and (above[18:38, 44:46] == ORANGE).all())
        self.assertTrue((picture[height:height + GAP] == WHITE).all())

    def test_by_default_the_crop_is_where_the_first_image_is_worst(self):
        a, b = np.full((32, 40, 3), 80), np.full((32, 40, 3), DARK)  # an error of 0.1 everywhere
        a[17:25, 22:32] = 90  # as large as the crop; 80 pixels of error 0.27
        a[2, 3] = WHITE       # one pixel of error 76
        picture = self.compare(a, b)[:128, :160]
        self.assertEqual(self.outline(picture), (4 * 22 - 2, 4 * 17 - 2, 4 * 32 + 2, 4 * 25 + 2))

    def test_an_outline_at_the_border_stays_inside(self):
        a, b = np.full((32, 40, 3), DARK), np.full((32, 40, 3), GRAY)
        picture = self.compare(a, b, "--zoom", "40x32+0+0")
        self.assertEqual(self.outline(picture[:, :160]), (0, 0, 160, 128))
        self.assertEqual(picture.shape, (2 * 128 + GAP, 2 * 160 + GAP, 3))

    def test_wide_images_are_averaged_and_their_crop_is_not(self):
        a, b = self.noise(2500, 12), self.noise(2500, 12)
        a[:, 0:2] = DARK  # a square that is easy to average
        picture = self.compare(a, b, "--zoom", "100x2+600+4")
        self.assertEqual(picture.shape[1], 2 * 1250 + GAP)
        self.assertTrue((picture[0, 0] == DARK).all())
        np.testing.assert_array_equal(picture[6 + GAP:, :600], enlarged(a[4:6, 600:700], 6))  # twice as high as above
        whole = self.compare(a, b, "--zoom", "2500x12+0+0")  # does not fit as it is
        self.assertEqual(whole.shape, (6 + GAP + 6, 2 * 1250 + GAP, 3))

    def test_zoom_none_and_zooms_that_cannot_be(self):
        a, b = self.noise(40, 32), self.noise(40, 32)
        np.testing.assert_array_equal(self.compare(a, b, "--zoom", "none")[:, :160], enlarged(a, 4))
        for zoom in ("8x4", "8x4+33+0", "8x4+0+29", "8x4-1+0", "41x4+0+0", "8x4+2147483647+0"):
            with self.subTest(zoom=zoom):
                self.assertIn(f"--zoom {zoom}", self.compare(a, b, "--zoom", zoom, code=2))
        self.assertEqual(self.compare(a[:2, :3], b[:2, :3]).shape, (8 + GAP + 12, 2 * 12 + GAP, 3))  # a crop of one pixel


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
