"""Samples of a frame as planes of numbers, and the file that holds them (docs/file-format.md, "Raw sample files")."""
import json
import os
from dataclasses import dataclass, field

import numpy as np


@dataclass
class Samples:
    """Samples of a frame, pixel by pixel from the top, all samples of a pixel in a row.

    window: (x, y, width, height) of the data window in pixels.
    counts: [height * width] samples of each pixel.
    channels: name of the slot (docs/file-format.md, "Slots") -> [sum of counts] float32.
    metadata: name -> text, int, float or list of floats.
    """

    window: tuple
    counts: np.ndarray
    channels: dict
    metadata: dict = field(default_factory=dict)

    def mean(self):
        """[height, width, 3] mean radiance of each pixel; 0 where a pixel has no sample. Sums are in double."""
        _, _, width, height = self.window
        pixel = np.repeat(np.arange(width * height), self.counts)
        sums = [np.bincount(pixel, self.channels[c].astype(np.float64), width * height) for c in "RGB"]
        return (np.stack(sums, -1) / np.maximum(self.counts, 1)[:, None]).reshape(height, width, 3)


def write_samples(path, samples):
    """Writes a raw sample file; the file is there as a whole or not at all."""
    header = {"format": "rpf-raw-samples", "version": 1, "dataWindow": [int(v) for v in samples.window],
              "channels": list(samples.channels), "metadata": samples.metadata}
    part = f"{path}.{os.getpid()}.part"
    try:
        with open(part, "wb") as file:
            file.write(json.dumps(header).encode() + b"\n")
            np.asarray(samples.counts, "<u4").tofile(file)
            for values in samples.channels.values():
                np.asarray(values, "<f4").tofile(file)
        os.replace(part, path)
    finally:
        if os.path.exists(part):
            os.remove(part)
