"""From a raw sample file (docs/file-format.md) to what the estimator sees of a frame: the channels of estimator.SAMPLE,
normalized by the frame facts of docs/network.md. The only place in training/ that does so."""
import importlib.util
import math
from pathlib import Path

import numpy as np

_spec = importlib.util.spec_from_file_location("raw_samples", Path(__file__).resolve().parent.parent / "bench/raw_samples.py")
raw_samples = importlib.util.module_from_spec(_spec)
_spec.loader.exec_module(raw_samples)

# Slots of a sample file in the order of estimator.SAMPLE; hit, hit2 and distance2 are computed.
NORMAL = [f"feature.N.{c}" for c in "XYZ"]
POSITION = [f"feature.P.{c}" for c in "XYZ"]
NORMAL2 = [f"feature.N2.{c}" for c in "XYZ"]
POSITION2 = [f"feature.P2.{c}" for c in "XYZ"]
ALBEDO = [f"feature.albedo.{c}" for c in "RGB"]
RANDOM = ["random.lens.U", "random.lens.V", "random.time", "film.X", "film.Y", "random.light.U", "random.light.V",
          "random.bsdf.U", "random.bsdf.V"]

BLOCK = 8  # pixels that brightness is measured of together


def lower_median(values):
    return np.partition(values, (len(values) - 1) // 2)[(len(values) - 1) // 2]


def brightness(color):
    """B of docs/network.md, of radiance [n, y, x, 3]."""
    luminance = np.maximum(color.astype(np.float64).sum(-1).mean(0) / 3, 0)
    sums = lambda plane: np.add.reduceat(np.add.reduceat(plane, range(0, plane.shape[0], BLOCK), 0), range(0, plane.shape[1], BLOCK), 1)
    pixels = sums(np.ones_like(luminance))
    means = sums(luminance) / pixels
    positive = means[means > 0]
    return (pixels * np.minimum(means, 8 * lower_median(positive))).sum() / luminance.size if len(positive) else 0.0


def exposure(color):
    """The power of two that brings the brightness into [1/4, 1/2)."""
    b = brightness(color)
    return 2.0 ** (-1 - math.frexp(b)[1]) if b > 0 else 1.0


def position_facts(position):
    """Medians [3] and mean distance from them, of the first sample of each pixel, [n, y, x, 3] with NaN where nothing is hit."""
    first = position[0].reshape(-1, 3)
    first = first[np.isfinite(first).all(1)]
    if not len(first):
        return np.zeros(3, np.float32), 1.0
    median = np.array([lower_median(first[:, k]) for k in range(3)])
    distance = np.abs(first.astype(np.float64) - median).mean()
    return median, distance if distance > 0 else 1.0


def frame_channels(file):
    """-> [27, n, y, x] float32, names of the groups that the file has. All pixels have the same number of samples."""
    header, counts, channels = file
    _, _, width, height = header["dataWindow"]
    n = int(counts[0])
    if (counts != n).any():
        raise ValueError("training needs the same number of samples in every pixel")
    shape = lambda v: v.reshape(height, width, n).transpose(2, 0, 1)
    stack = lambda names: np.stack([shape(channels[c]) for c in names], -1) if all(c in channels for c in names) else None
    none = np.full((n, height, width, 3), np.nan, np.float32)
    color, albedo = stack("RGB"), stack(ALBEDO)
    normal, position, normal2, position2 = (stack(s) for s in (NORMAL, POSITION, NORMAL2, POSITION2))
    groups = {g for g, v in (("albedo", albedo), ("N", normal), ("P", position), ("second", normal2)) if v is not None}
    normal, position, normal2, position2 = (none if v is None else v for v in (normal, position, normal2, position2))
    if "feature.hit" in channels:
        hit = shape(channels["feature.hit"]) != 0
    else:
        hit = (normal != 0).any(-1) if "N" in groups else np.ones((n, height, width), bool)
    hit2 = np.isfinite(normal2).all(-1) & (normal2 != 0).any(-1) & hit
    where_hit = lambda values, there: np.where(there[..., None] & np.isfinite(values), values, 0)
    medians, distance = position_facts(np.where(hit[..., None], position, np.nan))
    gap = np.sqrt(np.square(position2 - position).sum(-1)) / distance
    numbers = []
    for name in RANDOM:
        u = shape(channels[name]) if name in channels else np.full((n, height, width), 0.5, np.float32)
        if name.startswith("film."):
            u = u - np.floor(u)
        numbers.append(np.zeros_like(u) if (u == u.flat[0]).all() else 2 * u - 1)
    columns = [color * exposure(color), where_hit(normal, hit), where_hit(np.clip(none if albedo is None else albedo, 0, 1), hit),
               where_hit(np.clip((position - medians) / distance, -4, 4), hit), hit[..., None],
               where_hit(normal2, hit2), where_hit(gap[..., None], hit2), hit2[..., None], np.stack(numbers, -1)]
    return np.moveaxis(np.concatenate(columns, -1), -1, 0).astype(np.float32), groups
