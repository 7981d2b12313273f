"""Gaussian and bilateral filter of ordinary images against scikit-image. Usage: compare_with_skimage.py RPF IMAGE_TO_FLOATS PROJECT

Exit code 77 (skipped) where scikit-image is missing (Debian: apt-get install python3-skimage).
"""
import subprocess
import sys
import tempfile
from pathlib import Path

try:
    import numpy as np
    from PIL import Image
    from skimage.filters import gaussian
    from skimage.restoration import _denoise, denoise_bilateral
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

RPF, IMAGE_TO_FLOATS, PROJECT = sys.argv[1], sys.argv[2], Path(sys.argv[3])
SAMPLES = PROJECT / "examples" / "dof-spheres.samples.exr"
TOLERANCE = 1e-4    # absolute, of images that end at 1 (brighter ones: of their largest value)
BINS = 1000000      # scikit-image looks its color weights up in a table: 1e-6 of the largest difference


def spatial_weights(size, sigma, *, dtype=float):
    """The window's weights in the order in which scikit-image's loop reads them, [size * size]. Its own function (0.19 to
    0.26) makes a grid of size + 1 values from -(size + 1) / 2 on, so that the loop, which reads rows of `size`, finds the
    weights of other places."""
    place = np.arange(size) - size // 2
    return np.exp(-np.hypot(*np.meshgrid(place, place)) ** 2 / (2 * sigma ** 2)).astype(dtype).ravel()


_denoise._compute_spatial_lut = spatial_weights


def linear(encoded):
    """sRGB as light."""
    return np.where(encoded <= 0.04045, encoded / 12.92, ((encoded + 0.055) / 1.055) ** 2.4)


def pixels(file):
    with tempfile.NamedTemporaryFile() as floats:
        size = subprocess.run([IMAGE_TO_FLOATS, file, floats.name], check=True, capture_output=True, text=True).stdout
        width, height = map(int, size.split())
        return np.fromfile(floats.name, np.float32).reshape(height, width, 3).astype(np.float64)


def expected(image, box, sigma_color):
    """The filter of scikit-image with a window of `box` pixels and a standard deviation of box / 4 on the film."""
    if sigma_color is None:
        return gaussian(image, sigma=box / 4, truncate=(box - 1) / 2 / (box / 4), mode="nearest", channel_axis=-1)
    is_gray = (image == image[..., :1]).all()
    # Of gray pixels R, G and B all differ: rpf's distance is sqrt(3) times theirs. And scikit-image divides the distance of
    # two colors by the number of channels before it looks the weight up.
    result = denoise_bilateral(image[..., 0] if is_gray else image, win_size=box, sigma_spatial=box / 4, bins=BINS, mode="edge",
                               sigma_color=sigma_color / (np.sqrt(3) if is_gray else 3), channel_axis=None if is_gray else -1)
    return np.repeat(result[..., None], 3, axis=2) if is_gray else result


def check(title, file, image, box, sigma_color, folder):
    """Filters `file`, whose linear pixels are `image`. Compared where the window is inside: at the border rpf leaves out
    what is not there, scikit-image makes something up. Returns whether they agree and the filter did something."""
    method = ["--method", "gaussian"] if sigma_color is None else ["--method", "bilateral", "--sigma-color", str(sigma_color)]
    output = folder / "filtered.exr"
    subprocess.run([RPF, file, "-o", output, "-q", "--boxes", str(box), *method], check=True)
    inside = (slice(box // 2, -(box // 2)),) * 2
    ours, theirs = pixels(output)[inside], expected(image, box, sigma_color)[inside]
    largest, change = np.abs(ours - theirs).max() / max(image.max(), 1), np.abs(ours - image[inside]).mean()
    good = largest <= TOLERANCE and change > 10 * TOLERANCE
    print(f"{title:40} box {box:2}: largest difference {largest:.1e}, mean change {change:.1e} {'' if good else 'DIFFERS'}")
    return good


def main():
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        light, color, gray = folder / "light.exr", folder / "color.png", folder / "gray.png"
        for file in (light, color):
            subprocess.run([RPF, SAMPLES, "-o", file, "-q", "--boxes", "none"], check=True)
        encoded = np.asarray(Image.open(color).convert("RGB"))
        Image.fromarray(encoded[..., 1]).save(gray)
        shown = linear(encoded / 255)
        of_green = np.repeat(shown[..., 1:2], 3, axis=2)
        good = [check("gaussian, HDR", light, pixels(light), box, None, folder) for box in (3, 9)]
        good += [check("gaussian, color PNG", color, shown, 7, None, folder)]
        good += [check(f"bilateral {sigma}, color PNG", color, shown, 7, sigma, folder) for sigma in (0.03, 0.1, 1)]
        good += [check("bilateral 0.1, gray PNG", gray, of_green, 9, 0.1, folder)]
        good += [check("bilateral 3, HDR", light, pixels(light), 5, 3, folder)]
    print("all agree" if all(good) else f"{good.count(False)} differ")
    return 0 if all(good) else 1


sys.exit(main())
