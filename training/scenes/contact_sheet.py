"""A sheet of references to look at.

Usage: contact_sheet.py DIR OUT.jpg [--columns 8] [--samples]

Shows the references of all scenes in DIR, exposed as the trainer sees them; --samples shows the mean of the samples below each.
"""
import argparse
import sys
from pathlib import Path

import numpy as np
from PIL import Image

from to_frames import finite_radiance, frame_exposure, picture, raw_samples

QUALITY = 80


def srgb(image):
    """[3, y, x] linear -> [y, x, 3] bytes"""
    image = np.clip(np.moveaxis(image, 0, -1), 0, 1)
    image = np.where(image <= 0.0031308, 12.92 * image, 1.055 * image ** (1 / 2.4) - 0.055)
    return (image * 255 + 0.5).astype(np.uint8)


def tile(samples, show_samples):
    file = finite_radiance(raw_samples.read_samples(samples))
    name = samples.name[:-len(".samples.rpf")]
    scale = frame_exposure(file) * 1.5
    images = [picture(raw_samples.read_samples(samples.with_name(f"{name}.reference.rpf")))]
    if show_samples:
        _, _, width, height = file[0]["dataWindow"]
        images.append(np.stack([file[2][c].reshape(height, width, -1).mean(-1) for c in "RGB"]))
    return np.concatenate([srgb(image * scale) for image in images], 0)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scenes", type=Path)
    parser.add_argument("out", type=Path)
    parser.add_argument("--columns", type=int, default=8)
    parser.add_argument("--samples", action="store_true")
    options = parser.parse_args()
    tiles = [tile(samples, options.samples) for samples in sorted(options.scenes.glob("*.samples.rpf"))]
    tiles += [np.zeros_like(tiles[0])] * (-len(tiles) % options.columns)
    rows = [np.concatenate(tiles[k:k + options.columns], 1) for k in range(0, len(tiles), options.columns)]
    Image.fromarray(np.concatenate(rows, 0)).save(options.out, quality=QUALITY)


if __name__ == "__main__":
    sys.exit(main())
