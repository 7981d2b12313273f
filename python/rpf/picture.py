"""What a notebook shows."""
import struct
import zlib

import numpy as np


def _encoded(linear: np.ndarray) -> np.ndarray:
    """Linear light to sRGB (IEC 61966-2-1) of 8 bits, clamped; NaN is black."""
    light = np.clip(np.nan_to_num(linear.astype(np.float64)), 0, 1)
    curve = np.where(light <= 0.0031308, 12.92 * light, 1.055 * light ** (1 / 2.4) - 0.055)
    return np.rint(255 * curve).astype(np.uint8)


def _chunk(kind: bytes, data: bytes) -> bytes:
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def png(pixels: np.ndarray) -> bytes:
    """[height, width, channels] linear float32 as a PNG file: the first three channels, or the first one as gray."""
    rgb = _encoded(pixels[..., :3] if pixels.shape[2] >= 3 else pixels[..., :1])
    height, width, channels = rgb.shape
    rows = np.concatenate([np.zeros((height, 1), np.uint8), rgb.reshape(height, -1)], axis=1)  # 0: rows are not filtered
    size = struct.pack(">IIBBBBB", width, height, 8, 2 if channels == 3 else 0, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + _chunk(b"IHDR", size) + _chunk(b"IDAT", zlib.compress(rows.tobytes())) + _chunk(b"IEND", b"")
