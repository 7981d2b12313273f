"""Turns the files of generate.py into what the trainer maps.

Usage: to_frames.py DIR CACHE [--remove]

For each NAME.samples.rpf with NAME.reference.rpf in DIR: CACHE/NAME.samples.npy, [27, n, y, x] float16 of frames.frame_channels,
CACHE/NAME.ref.npy, [3, y, x] float32, exposed alike, and CACHE/NAME.exposure.npy, what radiance was multiplied with. What is there is skipped.
--remove deletes what was turned.
"""
import argparse
import os
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from frames import exposure, frame_channels, raw_samples  # noqa: E402

LARGEST = 60000  # of binary16, nearly


def picture(file):
    """A sample file of one sample a pixel -> [3, y, x]"""
    header, _, channels = file
    _, _, width, height = header["dataWindow"]
    return np.stack([channels[c].reshape(height, width) for c in "RGB"])


def finite_radiance(file):
    header, counts, channels = file
    return header, counts, channels | {c: np.nan_to_num(channels[c], posinf=0, neginf=0) for c in "RGB"}


def frame_exposure(file):
    _, counts, channels = file
    _, _, width, height = file[0]["dataWindow"]
    return exposure(np.stack([channels[c].reshape(height, width, -1).transpose(2, 0, 1) for c in "RGB"], -1))


def save(path, array):
    part = path.with_suffix(".part")
    with open(part, "wb") as file:
        np.save(file, array)
    os.replace(part, path)


def convert(samples_path, reference_path, cache, name):
    file = finite_radiance(raw_samples.read_samples(samples_path))
    samples, _ = frame_channels(file)
    scale = frame_exposure(file)
    save(cache / f"{name}.exposure.npy", np.float32(scale))
    save(cache / f"{name}.ref.npy", (picture(raw_samples.read_samples(reference_path)) * scale).astype(np.float32))
    save(cache / f"{name}.samples.npy", np.clip(samples, -LARGEST, LARGEST).astype(np.float16))  # last: the trainer looks for it


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scenes", type=Path)
    parser.add_argument("cache", type=Path)
    parser.add_argument("--remove", action="store_true")
    options = parser.parse_args()
    options.cache.mkdir(parents=True, exist_ok=True)
    for samples in sorted(options.scenes.glob("*.samples.rpf")):
        name = samples.name[:-len(".samples.rpf")]
        reference = options.scenes / f"{name}.reference.rpf"
        if reference.exists() and not (options.cache / f"{name}.samples.npy").exists():
            convert(samples, reference, options.cache, name)
        if reference.exists() and options.remove:
            samples.unlink()
            reference.unlink()


if __name__ == "__main__":
    sys.exit(main())
