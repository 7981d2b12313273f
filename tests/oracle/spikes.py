"""The step between passes that is not in the sources: light of single bright pixels is shared with those around them.

Written from docs/deviations.md and the definition in src/after/spikes.h alone.
"""
import numpy as np

SPREAD = 2      # pixels to each side of a spike that get a share of what it loses


def square_around(frame, pixel, reach):
    """The pixels that have samples within `reach` pixels to each side of a pixel, itself included where it has any."""
    x, y = pixel % frame.width, pixel // frame.width
    columns = np.arange(max(x - reach, 0), min(x + reach + 1, frame.width))
    rows = np.arange(max(y - reach, 0), min(y + reach + 1, frame.height))
    square = (rows[:, None] * frame.width + columns).ravel()
    return square[frame.counts[square] > 0]


def kept_part(frame, image, pixel):
    """The part of its light that a pixel keeps: brightest neighbor / own where it is brighter than all; 1 elsewhere."""
    around = square_around(frame, pixel, 1)
    own, neighbors = image[pixel].sum(), image[around[around != pixel]].sum(axis=1)
    if len(neighbors) == 0 or own <= max(neighbors.max(), 0.0):
        return 1.0
    return max(neighbors.max(), 0.0) / own


def changes(frame, image):
    """What happens to the samples of each pixel: a factor [pixels], then light that is added [pixels, 3]."""
    factor, added = np.ones(len(image)), np.zeros((len(image), 3))
    for pixel in np.flatnonzero(frame.counts):
        factor[pixel] = kept_part(frame, image, pixel)
        receivers = square_around(frame, pixel, SPREAD)
        added[receivers] += (1.0 - factor[pixel]) * image[pixel] / len(receivers)
    return factor, added


def spread(frame, image, color):
    """c' [S, 3] after the step, from c' before it and its image [pixels, 3]."""
    factor, added = changes(frame, image)
    pixel = np.repeat(np.arange(len(image)), frame.counts)
    return color * factor[pixel, None] + added[pixel]
