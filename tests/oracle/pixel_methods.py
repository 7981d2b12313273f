"""The third witness of section 9: the methods that filter pixels, in double precision, from its text."""
import numpy as np

import oracle
import scene_frame
from report import Report
from tolerances import TOLERANCE

LEAST_SHARE, PATCH = 0.05, 3                     # (9.7); patches reach so far
REACH, AROUND, CUT, TURN, LEAST_ALBEDO = 15, 5, 3, 0.0304, 1e-3   # section 9.4
SIGMA = {"N": 0.8, "N2": 0.8, "albedo": 0.25}    # (9.16); all others 0.6


class Pixels:
    """Means and variances of a frame, as pictures [height, width, ...]."""

    def __init__(self, frame):
        self.frame, self.shape = frame, (len(frame.counts) // frame.width, frame.width)
        self.count = frame.counts.reshape(self.shape).astype(float)
        self.mask = self.count > 0
        self.color = frame.values[:, :3]

    def picture(self, per_pixel):
        return np.array([per_pixel(self.frame.own(p)) for p in range(len(self.frame.counts))]).reshape(*self.shape, -1)

    def mean(self, own):
        """The weighted mean [3] of some samples."""
        if len(own) == 0:
            return np.zeros(3)
        weight = np.ones(len(own)) if self.frame.weight is None or not self.frame.weight[own].any() else self.frame.weight[own]
        return weight @ self.color[own] / weight.sum()

    def variance(self):
        """(9.1), (9.2): of the pixels' means."""
        def of(own):
            return self.color[own].var(axis=0, ddof=1) if len(own) > 1 else np.full(3, np.nan)
        sample = self.picture(of)
        frame_mean = np.nanmean(sample.reshape(-1, 3), axis=0)
        sample = np.where(np.isnan(sample), frame_mean, sample)
        return np.where(self.mask[..., None], sample / np.maximum(self.count, 1)[..., None], 0)


def box(picture, reach):
    """Sums over 2 reach + 1 pixels in both directions, as far as the picture goes."""
    result = np.zeros_like(picture)
    for dy in range(-reach, reach + 1):
        for dx in range(-reach, reach + 1):
            result += shifted(picture, dx, dy)
    return result


def shifted(picture, dx, dy):
    """The picture's value at (x + dx, y + dy), 0 outside."""
    h, w = picture.shape[:2]
    result = np.zeros_like(picture)
    ys, xs = slice(max(-dy, 0), max(min(h, h - dy), 0)), slice(max(-dx, 0), max(min(w, w - dx), 0))
    yt, xt = slice(max(dy, 0), max(min(h, h + dy), 0)), slice(max(dx, 0), max(min(w, w + dx), 0))
    if ys.start < ys.stop and xs.start < xs.stop:
        result[ys, xs] = picture[yt, xt]
    return result


def offsets(reach):
    return [(dx, dy) for dy in range(-reach, reach + 1) for dx in range(-reach, reach + 1) if (dx, dy) != (0, 0)]


def quotient(a, b):
    return a / np.where(b == 0, 1, b)


# ---------------------------------------------------------------- section 9.1

def half_variance(pixels, a, b):
    """(9.3)."""
    variance, known = 2 * pixels.variance(), (pixels.count > 1)[..., None]
    difference, chance = box(np.where(known, (a - b) ** 2 / 2, 0), 10), box(np.where(known, variance, 0), 10)
    return np.where(chance > 0, variance * quotient(difference, chance), variance)


def shares(pixels, guide, variance, settings):
    """(9.4) to (9.7): for each neighbor's place its weights [h, w], before small ones are cut."""
    mask = pixels.mask.astype(float)
    for dx, dy in offsets((settings["window"] - 1) // 2):
        both = mask * shifted(mask, dx, dy)
        other, other_variance = shifted(guide, dx, dy), shifted(variance, dx, dy)
        above = (guide - other) ** 2 - (variance + np.minimum(variance, other_variance))
        below = settings["damping"] ** 2 * (variance + other_variance)
        with np.errstate(divide="ignore", invalid="ignore"):
            relative = np.where(below > 0, above / below, np.where(above > 0, 1e30, 0)).sum(axis=2)
        pairs = box(both, PATCH)
        distance = quotient(box(both * relative, PATCH), 3 * pairs)
        weight = both * np.exp(-np.maximum(distance, 0))
        yield dx, dy, both * quotient(box(weight, PATCH), pairs)


def filter_half(pixels, values, guide, variance, settings):
    """(9.8) and how far weights near the cut can move it."""
    total, sums, open_weight = np.ones(pixels.shape), values.copy(), np.zeros(pixels.shape)
    for dx, dy, share in shares(pixels, guide, variance, settings):
        kept = np.where(share < LEAST_SHARE, 0, share)
        open_weight += np.where(np.abs(share - LEAST_SHARE) < TOLERANCE["pixel_near"], share, 0)
        total += kept
        sums += kept[..., None] * shifted(values, dx, dy)
    return sums / total[..., None], open_weight / total


def non_local_means(pixels):
    a, b = (pixels.picture(lambda own, half=half: pixels.mean(own[half::2] if len(own) > 1 else own)) for half in (0, 1))
    variance, settings = half_variance(pixels, a, b), pixels.frame.settings
    (fa, open_a), (fb, open_b) = filter_half(pixels, a, b, variance, settings), filter_half(pixels, b, a, variance, settings)
    first, second = np.ceil(pixels.count / 2), np.maximum(pixels.count // 2, np.minimum(pixels.count, 1))
    result = quotient(fa * first[..., None] + fb * second[..., None], (first + second)[..., None])
    return result, open_a + open_b


# ---------------------------------------------------------------- section 9.2

def convolved(pixels, picture, kernel):
    """Sums of kernel(dx, dy) * value over the pixels with samples."""
    result = np.zeros_like(picture)
    for (dx, dy), weight in kernel.items():
        result += weight * shifted(picture * pixels.mask.reshape(*pixels.shape, *[1] * (picture.ndim - 2)), dx, dy)
    return result


def gaussian(sigma):
    reach = int(np.ceil(3 * sigma))
    return {(dx, dy): np.exp(-(dx * dx + dy * dy) / (2 * sigma ** 2)) for dx, dy in [(0, 0), *offsets(reach)]}


def gaussian_bank(pixels):
    gamma = pixels.frame.settings["gamma"]
    zeta = -np.log(1 - (1.9 * gamma) ** np.sqrt(0.5))
    ones = np.ones(pixels.shape)
    mean, variance = pixels.picture(pixels.mean), pixels.variance()
    fine, fine_variance, result, going = mean, variance, mean.copy(), pixels.mask.copy()
    for level in range(8):
        sigma = np.sqrt(0.5) * np.sqrt(2) ** level
        kernel = gaussian(sigma)
        total = convolved(pixels, ones, kernel)
        coarse = quotient(convolved(pixels, mean, kernel), total[..., None])                      # (9.10)
        squares = {place: weight ** 2 for place, weight in kernel.items()}
        coarse_variance = quotient(convolved(pixels, variance, squares), total[..., None] ** 2)   # (9.11)
        count = pixels.count if level == 0 else quotient(convolved(pixels, pixels.count, kernel), total)
        beta = 1 if level == 0 else 3                                                             # widths differ by sqrt(2)
        trust = np.where(count > 1, zeta * (1 - quotient(1, count)), 0)                           # (9.13)
        stop = (trust[..., None] * beta * (fine - coarse) ** 2 - (fine_variance - coarse_variance)).sum(axis=2) >= 0
        smooth = gaussian(2 * sigma)
        others = convolved(pixels, ones, smooth) - 1
        agreed = quotient(convolved(pixels, stop.astype(float), smooth) - stop, others) >= 0.5    # (9.14)
        going = going & ~(stop & (agreed | (others < 1e-5)))
        result = np.where(going[..., None], coarse, result)
        fine, fine_variance = coarse, coarse_variance
    return result, np.zeros(pixels.shape)


# ---------------------------------------------------------------- section 9.3

def feature_pictures(pixels, case):
    """Means, variances and 1 / (2 sigma^2) of the features, each in its unit."""
    frame = pixels.frame
    means, variances, scales = [], [], []
    spread = np.nanvar(frame.values[:, frame.first_feature:], axis=0) if frame.features else []
    for k, name in enumerate(frame.features):
        group = scene_frame.group(name)
        unit = 1.0
        if group in ("P", "P2"):
            unit = scene_frame.position_diagonal(case) or 1.0
        elif group not in SIGMA:
            unit = np.sqrt(sum(v for v, other in zip(spread, frame.features) if scene_frame.group(other) == group)) or 1.0
        values = frame.values[:, frame.first_feature + k]
        values = np.where(np.isnan(values), np.nanmean(values), values) / unit
        means.append(pixels.picture(lambda own: values[own].mean() if len(own) else 0.0)[..., 0])
        variances.append(pixels.picture(lambda own: values[own].var(ddof=1) if len(own) > 1 else 0.0)[..., 0])
        scales.append(1 / (2 * SIGMA.get(group, 0.6) ** 2))
    return means, variances, scales


def feature_weight(pixels, features, dx, dy):
    """(9.15), (9.16)."""
    exponent, mask = np.zeros(pixels.shape), pixels.mask.astype(float)
    for mean, variance, scale in zip(*features):
        exponent += scale * (mean - shifted(mean, dx, dy)) ** 2 / np.maximum(variance + shifted(variance, dx, dy), 0.01)
    return mask * shifted(mask, dx, dy) * np.exp(-exponent)


def cross_bilateral(pixels, features, picture, sigma):
    """(9.17): the mean, and the sum of the weights."""
    total, sums = np.ones(pixels.shape), picture.copy()
    for dx, dy in offsets(int(round(2 * sigma))):
        weight = np.exp(-(dx * dx + dy * dy) / (2 * sigma ** 2)) * feature_weight(pixels, features, dx, dy)
        total += weight
        sums += weight[..., None] * shifted(picture, dx, dy)
    return sums / total[..., None], total


def stein_risk(pixels, case):
    mean, variance, features = pixels.picture(pixels.mean), pixels.variance(), feature_pictures(pixels, case)
    filtered, risks = [], []
    for sigma in (1, 2, 4, 8):
        picture, total = cross_bilateral(pixels, features, mean, sigma)
        filtered.append(picture)
        risks.append(((picture - mean) ** 2 + 2 * variance / total[..., None] - variance).sum(axis=2))   # (9.18)
    smooth = cross_bilateral(pixels, features, np.stack(risks, axis=2), 8)[0]                            # (9.19)
    choice = smooth.argmin(axis=2)                                                                       # (9.20)
    return np.take_along_axis(np.stack(filtered, axis=2), choice[..., None, None], axis=2)[:, :, 0], np.zeros(pixels.shape)


# ---------------------------------------------------------------- section 9.4

def of_pixels(pixels, case, name, choose):
    """choose(the values of a feature that a pixel knows), as a picture; 0 where there are none, or nowhere any that vary."""
    names = pixels.frame.features
    if name not in names:
        return np.zeros(pixels.shape)
    values = pixels.frame.values[:, pixels.frame.first_feature + names.index(name)]

    def of(own):
        there = values[own][~np.isnan(values[own])]
        return choose(there) if len(there) else 0.0
    return pixels.picture(of)[..., 0]


def surface(pixels, case, group, unit=1.0):
    """Means of a group's features, from the frame's mean on: [h, w, components]; and where all are known."""
    names = [name for name in pixels.frame.features if scene_frame.group(name) == group]
    known, parts = pixels.mask.copy(), []
    for name in names:
        values = pixels.frame.values[:, pixels.frame.first_feature + pixels.frame.features.index(name)]
        has = of_pixels(pixels, case, name, lambda there: 1.0) > 0
        parts.append(np.where(has, (of_pixels(pixels, case, name, np.mean) - np.nanmean(values)) / unit, 0))
        known &= has
    return np.stack(parts, axis=2) if parts else np.zeros((*pixels.shape, 0)), known


def least_positive(values):
    return values[values > 0].min() if (values > 0).any() else 0.0


def falloff(pixels, case, position, known, unit):
    """(9.21), (9.22): 1 / (2 beta^2), 0 where nothing is filtered."""
    slope, width = (of_pixels(pixels, case, "penumbra." + name, least_positive) for name in ("slope", "width"))
    width = width / unit
    blocked = (width > 0).astype(float)
    total = box(blocked, AROUND)
    slope, width = (np.where(blocked > 0, v, quotient(box(blocked * v, AROUND), total)) for v in (slope, width))
    there = known.astype(float)
    sums, count = np.zeros(pixels.shape), np.zeros(pixels.shape)
    for dx, dy in ((1, 0), (-1, 0), (0, 1), (0, -1)):
        beside = shifted(there, dx, dy)
        sums += beside * ((shifted(position, dx, dy) - position) ** 2).sum(axis=2)
        count += beside
    beta2 = np.maximum(width ** 2, quotient(sums, count) * (1 + slope) ** 2) / (CUT * pixels.frame.settings["bandwidth"]) ** 2
    return np.where(known & (width > 0), quotient(1, 2 * beta2), 0)


def along(pixels, places, picture, rate, position, normal, known):
    """(9.23), (9.24) along one axis; and how far normals near the limit can move it."""
    total, sums, undecided = np.ones(pixels.shape), picture.copy(), np.zeros(pixels.shape)
    for dx, dy in places:
        weight = known * shifted(known.astype(float), dx, dy) * np.exp(-rate * ((shifted(position, dx, dy) - position) ** 2).sum(axis=2))
        turned = ((shifted(normal, dx, dy) - normal) ** 2).sum(axis=2)
        undecided += np.where(np.abs(turned - TURN) < TOLERANCE["pixel_near"], weight, 0)
        weight = np.where((turned <= TURN) & (rate > 0), weight, 0)
        total += weight
        sums += weight[..., None] * shifted(picture, dx, dy)
    return sums / total[..., None], undecided / total


def axis_aligned(pixels, case):
    unit = scene_frame.position_diagonal(case) or 1.0
    (position, known), (normal, _) = surface(pixels, case, "P", unit), surface(pixels, case, "N")
    rate, mean = falloff(pixels, case, position, known, unit), pixels.picture(pixels.mean)
    albedo = np.stack([of_pixels(pixels, case, "albedo." + c, np.mean) if "albedo." + c in pixels.frame.features else pixels.mask
                       for c in "RGB"], axis=2)
    albedo = np.maximum(albedo, LEAST_ALBEDO)
    steps = [i for i in range(-REACH, REACH + 1) if i]
    rows, first = along(pixels, [(i, 0) for i in steps], mean / albedo, rate, position, normal, known)
    both, second = along(pixels, [(0, i) for i in steps], rows, rate, position, normal, known)
    near = first + second + sum(shifted(first, 0, i) for i in steps)          # what is undecided reaches along the columns
    return np.where((rate > 0)[..., None], both * albedo, mean), near * albedo.max() / albedo.min()


def compare(case, trace):
    """The Report on a trace of a case with a method of section 9."""
    frame = scene_frame.load_frame(case, [], trace["features"])
    report, pixels = Report(), Pixels(frame)
    method = frame.settings["method"]
    witness = {"nlm": non_local_means, "gem": gaussian_bank, "sbf": lambda p: stein_risk(p, case),
               "axis-aligned": lambda p: axis_aligned(p, case)}[method]
    expected, undecided = witness(pixels)
    largest = np.abs(frame.values[:, :3]).max()
    bound = (TOLERANCE["pixel_color"] + 2 * undecided[..., None]) * largest
    report.check("image", trace["image"], expected.reshape(-1, 3), np.broadcast_to(bound, expected.shape).reshape(-1, 3), "image")
    return report
