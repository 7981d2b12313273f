"""A page of rpf report, read by itself: its description and its values."""
import base64
import json
import re
import subprocess
import tempfile
import zlib
from pathlib import Path

import numpy as np
import tifffile


class ReportPage:
    def __init__(self, path):
        self.html = Path(path).read_text()
        self.frame = json.loads(self._script("viewer-frame"))
        self.names = [layer["name"] for layer in self.frame["layers"]]

    def _script(self, name):
        return re.search(rf'<script type="[^"]*" id="{name}">(.*?)</script>', self.html, re.S).group(1)

    def values(self, name):
        """The layer's values, [height, width, channel]."""
        number = self.names.index(name)
        size = self.frame["height"], self.frame["width"], len(self.frame["layers"][number]["channels"])
        planes = np.frombuffer(zlib.decompress(base64.b64decode(self._script(f"viewer-layer-{number}"))), np.uint8)
        words = np.moveaxis(planes.reshape(size[2], 4, -1), 1, 2)  # [channel, pixel, byte], the highest first
        return np.ascontiguousarray(words).view(">f4").reshape(size[2], size[0], size[1]).transpose(1, 2, 0).astype(np.float32)


def exr_values(path):
    """R, G, B of an image as other programs read them, [height, width, channel]."""
    with tempfile.TemporaryDirectory() as folder:
        tiff = Path(folder) / "image.tif"
        subprocess.run(["oiiotool", str(path), "--ch", "0,1,2", "-d", "float", "--compression", "none", "-o", str(tiff)], check=True)
        return tifffile.imread(tiff)
