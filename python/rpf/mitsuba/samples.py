"""Samples of a frame as planes of numbers, and the file that holds them (docs/file-format.md, "Raw sample files")."""
import json
import os
from dataclasses import dataclass, field

import numpy as np


@dataclass
class SamplePlanes:
    """Samples of a frame, pixel by pixel from the top, all samples of a pixel in a row; an array for each slot.

    window: (x, y, width, height) of the data window in pixels.
    counts: [height * width] samples of each pixel.
    channels: name of the slot (docs/file-format.md, "Slots") -> [sum of counts] float32.
    metadata: name -> text, int, float or list of floats.
    """

    window: tuple
    counts: np.ndarray
    channels: dict
    metadata: dict = field(default_factory=dict)

    def mean(self, names="RGB"):
        """[height, width, number of names] mean of these slots in each pixel, by default its radiance; 0 where a pixel has no
        sample. Missing values count as 0. Sums are in double."""
        _, _, width, height = self.window
        pixel = np.repeat(np.arange(width * height), self.counts)
        sums = [np.bincount(pixel, np.nan_to_num(self.channels[name].astype(np.float64)), width * height) for name in names]
        return (np.stack(sums, -1) / np.maximum(self.counts, 1)[:, None]).reshape(height, width, len(sums))

    def records(self):
        """An rpf.Samples, which rpf.filter takes: a copy. Needs the compiled part of the package."""
        from .. import Samples
        x, y, width, height = self.window
        return Samples.from_channels(self.counts.reshape(height, width), self.channels, origin=(x, y), metadata=self.metadata)


class SampleFile:
    """A raw sample file that is written plane by plane, in any order; the file is there as a whole or not at all.

    A context manager. Takes its size on the disk at once, so that a full disk is told before the work."""

    def __init__(self, path, window, counts, names, metadata):
        self.path, self.part, self.names = path, f"{path}.{os.getpid()}.part", list(names)
        header = {"format": "rpf-raw-samples", "version": 1, "dataWindow": [int(v) for v in window], "channels": self.names,
                  "metadata": metadata}
        text = json.dumps(header).encode() + b"\n"
        self.samples, self.first = int(np.sum(counts, dtype=np.int64)), len(text) + 4 * len(counts)
        self.file = open(self.part, "wb")
        try:
            self.file.write(text)
            self.file.write(np.asarray(counts, "<u4"))
            self.file.flush()
            os.posix_fallocate(self.file.fileno(), 0, self.first + 4 * self.samples * len(self.names))
        except BaseException:
            self._give_up()
            raise

    def put(self, first, channels):
        """Values of the samples from number `first` on: slot -> [any number] float32."""
        for name, values in channels.items():
            self.file.seek(self.first + 4 * (self.names.index(name) * self.samples + first))
            self.file.write(np.ascontiguousarray(values, "<f4"))

    def __enter__(self):
        return self

    def __exit__(self, kind, *_):
        if kind is not None:
            self._give_up()
            return
        self.file.flush()
        os.fsync(self.file.fileno())
        self.file.close()
        os.replace(self.part, self.path)

    def _give_up(self):
        self.file.close()
        os.remove(self.part)


def write_samples(path, samples):
    """Writes a raw sample file; the file is there as a whole or not at all."""
    with SampleFile(path, samples.window, samples.counts, samples.channels, samples.metadata) as file:
        file.put(0, samples.channels)
