"""Whether a trace's draws are what section 3 asks for: discretized Gaussian offsets, uniform words, all independent.

Every function returns a deviation in standard deviations of what chance explains.
"""
from math import erf, sqrt

import numpy as np


def point_weights(half, sigma):
    """Probability [2 half + 1] of each offset, from the density at the offset."""
    d = np.arange(-half, half + 1)
    w = np.exp(-d ** 2 / (2 * sigma ** 2))
    return w / w.sum()


def cell_weights(half, sigma):
    """Probability [2 half + 1] of each offset, from the density integrated over its pixel."""
    edges = [erf((d - 0.5) / (sigma * sqrt(2))) for d in range(-half, half + 2)]
    w = np.diff(edges)
    return w / w.sum()


def surprise(counts, probability):
    """How far chi-square of the counts is from what chance explains (Wilson-Hilferty)."""
    expected = counts.sum() * probability
    freedom = counts.size - 1
    if freedom == 0 or expected.min() < 1:              # too few draws to say anything
        return 0.0
    ratio = ((counts - expected) ** 2 / expected).sum() / freedom
    return abs(ratio ** (1 / 3) - (1 - 2 / (9 * freedom))) / sqrt(2 / (9 * freedom))


def offsets(table, box):
    """Offsets [draws, attempts, 3] against both ways to discretize, without (0,0), which a tool need not list."""
    half = (box - 1) // 2
    cell = (table[..., 1] + half) * box + table[..., 0] + half
    counts = np.bincount(cell.ravel(), minlength=box * box)
    others = np.arange(box * box) != half * box + half
    results = []
    for weights in (point_weights, cell_weights):
        axis = weights(half, box / 4)
        joint = np.outer(axis, axis).ravel()[others]
        results.append(surprise(counts[others], joint / joint.sum()))
    return min(results)


def words(table):
    """The leading four bits of the words against the uniform distribution."""
    counts = np.bincount((table[..., 2] >> 28).ravel(), minlength=16)
    return surprise(counts, np.full(16, 1 / 16))


def correlation(table):
    """The largest correlation between a word and the offset it comes with, or between neighboring attempts' words."""
    dx, dy, word = (table[..., i].ravel().astype(float) for i in range(3))
    pairs = [(other, word) for other in (dx, dy, abs(dx), abs(dy))]
    pairs += [(word[1:], word[:-1]), (dx, dy), (dx[1:], dx[:-1])]
    return max(scaled_correlation(a, b) for a, b in pairs)


def scaled_correlation(a, b):
    """|r| sqrt(n) of two columns, about normal for independent ones."""
    if len(a) < 30 or a.std() == 0 or b.std() == 0:
        return 0.0
    return abs(np.corrcoef(a, b)[0, 1]) * sqrt(len(a))


def repeated(tables):
    """How many of the tables (one for each pass and pixel) start with the same words for three draws as another one."""
    starts = [table[:3, :, 2].tobytes() for table in tables if len(table) >= 3]
    return len(starts) - len(set(starts))
