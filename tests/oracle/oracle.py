"""The third witness: Random Parameter Filtering in double precision, sections 3-7 of algorithm.md.

Slow and plain on purpose, and written from algorithm.md alone; it shares nothing with the C++ code. All arithmetic is
float64 on the file's float32 values, so no shifts, tables or fixed summation orders are needed here.

Shapes: S samples of the frame, s samples of the pixel, C candidates, N neighbors, n random parameters, m features,
V = 3 + 2 + n + m variables, always in the order color, position, random parameters, features. NaN = missing value.
"""
import numpy as np

from scene_frame import FIRST_RANDOM

EPSILON = 1e-10             # eps of T 5.4-5.6
NEGLIGIBLE_STD = 1e-6       # section 4: a standard deviation below this part of the largest magnitude is 0
GROUP = 512                 # sections 3 and 6: own samples that are weighed together
OUTLIER_SLACK = 1e-5        # section 7: this near to one standard deviation counts as equal to it


# ---------------------------------------------------------------- 3. neighborhood

def requested_samples(settings, box, s):
    """M: how many samples a neighborhood in a box x box asks for, the s own ones included (section 3.2)."""
    if settings["samples_factor"] is not None:
        wanted = int(np.floor(settings["samples_factor"] * box * box))
    else:
        wanted = box * box * min(s, GROUP) // 2 if settings["profile"] == "paper" else box * box // 2
    return wanted if settings["max_samples"] is None else min(wanted, settings["max_samples"])


def draw_count(settings, box, s):
    """The number of draws, M - s."""
    return max(requested_samples(settings, box, s) - s, 0)


def moments(values):
    """Mean [V] and population standard deviation [V] of the non-missing values [N, V]; 0 where there is none."""
    valid = ~np.isnan(values)
    n = np.maximum(valid.sum(axis=0), 1)
    mean = np.where(valid, values, 0.0).sum(axis=0) / n
    deviation = np.where(valid, values - mean, 0.0)
    return mean, np.sqrt((deviation ** 2).sum(axis=0) / n)


def own_features(frame, pixel):
    """The features of the pixel's own samples, [s, m]."""
    return frame.values[frame.own(pixel), frame.first_feature:]


def tolerance(frame, own, own_std):
    """max(H_k s_k, a) [m] from the own features [s, m]; infinite where a feature does not reject here."""
    rejects = frame.rejecting & ~np.isnan(own).all(axis=0)
    return np.where(rejects, np.maximum(frame.factor * own_std, frame.floor), np.inf)


def candidates(frame, pixel, table):
    """The candidates' sample indices [C] from a table [draws, attempts, (dx, dy, word)]; dropped draws left out."""
    dx, dy, word = table[..., 0], table[..., 1], table[..., 2]
    x, y = pixel % frame.width + dx, pixel // frame.width + dy
    inside = (x >= 0) & (x < frame.width) & (y >= 0) & (y < frame.height)
    there = np.where(inside, y * frame.width + x, 0)
    usable = inside & (frame.counts[there] > 0) & ((dx != 0) | (dy != 0))
    sample = frame.first[there] + (word * frame.counts[there] >> 32)    # floor(word * count / 2^32)
    attempt = usable.argmax(axis=1)                                     # the first usable one ends the draw
    return sample[np.arange(len(table)), attempt][usable.any(axis=1)]


def distances(frame, found, own_mean):
    """|f_jk - m_k| [C, m] of the candidates [C]; missing features are at distance 0."""
    return np.nan_to_num(np.abs(frame.values[found, frame.first_feature:] - own_mean))


def accepted(distance, limit):
    """Which candidates [C] have no feature further than the tolerance [m] from the pixel's mean (section 3.3)."""
    return ~(distance > limit).any(axis=1)


# ---------------------------------------------------------------- 4. normalization

def neighborhood_moments(values):
    """Mean [V] and standard deviation [V] over the neighborhood [N, V]; a negligible deviation is 0."""
    mean, std = moments(values)
    largest = np.nan_to_num(np.abs(values)).max(axis=0)
    return mean, np.where(std < NEGLIGIBLE_STD * largest, 0.0, std)


def normalize(values, mean, std):
    """The values [N, V] with mean 0 and standard deviation 1; 0 where missing or where the deviation is 0."""
    scaled = (values - mean) / np.where(std > 0, std, 1.0)
    return np.where(np.isnan(scaled) | (std == 0), 0.0, scaled)


# ---------------------------------------------------------------- 5. mutual information and weights

def bins_of(normalized, K):
    """Nearest integer, half away from zero, clamped to [-K, K]; any shape."""
    return np.clip(np.sign(normalized) * np.floor(np.abs(normalized) + 0.5), -K, K).astype(np.int64)


def joint_histogram(x, y, K):
    """Counts [2K+1, 2K+1] of the bins x [N] (rows) and y [N] (columns)."""
    size = 2 * K + 1
    return np.bincount((x + K) * size + (y + K), minlength=size * size).reshape(size, size)


def mutual_information(histogram):
    """I(X,Y) = sum p(x,y) ln( p(x,y) / (p(x) p(y)) ) in nats, at least 0, of a joint histogram."""
    p = histogram / histogram.sum()
    independent = p.sum(axis=1, keepdims=True) * p.sum(axis=0, keepdims=True)
    full = p > 0
    return max(float(np.sum(p[full] * np.log(p[full] / independent[full]))), 0.0)


def estimator_bias(bins, n):
    """The plug-in estimate of n neighbors is too high by about (B-1)^2 / (2N) nats."""
    return (bins - 1) ** 2 / (2.0 * n)


def pair_columns(frame):
    """The column pairs (x, y) whose dependency is needed: color or feature against the others (algorithm 3)."""
    color, features = range(3), range(frame.first_feature, len(frame.variables))
    position, random = range(3, FIRST_RANDOM), range(FIRST_RANDOM, frame.first_feature)
    pairs = [(c, other) for c in color for others in (random, position, features) for other in others]
    return pairs + [(f, other) for f in features for others in (random, position) for other in others]


def pair_information(frame, bins):
    """Histograms {(x, y): counts} and mutual information [V, V] of the needed pairs, from bins [N, V]."""
    settings = frame.settings
    bias = estimator_bias(settings["bins"], len(bins)) if settings["bias_correction"] else 0.0
    histograms, information = {}, np.zeros((bins.shape[1],) * 2)
    for x, y in pair_columns(frame):
        histograms[x, y] = joint_histogram(bins[:, x], bins[:, y], (settings["bins"] - 1) // 2)
        information[x, y] = max(mutual_information(histograms[x, y]) - bias, 0.0)
    return histograms, information


def dependency_sums(frame, information):
    """The D of section 5 from the mutual information [V, V]: dict of arrays."""
    color, position = slice(0, 3), slice(3, FIRST_RANDOM)
    random, features = slice(FIRST_RANDOM, frame.first_feature), slice(frame.first_feature, None)
    D = {"c_r": information[color, random].sum(axis=1),         # D_c,i^r  [3]
         "c_p": information[color, position].sum(axis=1),       # D_c,i^p  [3]
         "c_f": information[color, features].sum(axis=1),       # D_c,i^f  [3]
         "c_fk": information[color, features].sum(axis=0),      # D_c^{f,k} [m]
         "f_r": information[features, random].sum(axis=1),      # D_f,k^r  [m]
         "f_p": information[features, position].sum(axis=1)}    # D_f,k^p  [m]
    return D


def fractions(D):
    """W_c,i^r [3] (T 5.4), W_f,k^r [m] (T 5.5), W_c^{f,k} [m] (T 5.6) and W_c^r, their mean over the color channels."""
    W_c_r = D["c_r"] / (D["c_r"] + D["c_p"] + EPSILON)
    W_f_r = D["f_r"] / (D["f_r"] + D["f_p"] + EPSILON)
    W_c_f = D["c_fk"] / (D["c_r"].sum() + D["c_p"].sum() + D["c_f"].sum() + EPSILON)
    return W_c_r, W_f_r, W_c_f, float(W_c_r.mean())


def alpha_of(W_c_r, t, alpha_factor):
    """alpha_i = max(1 - 2 (1 + 0.1 t) W_c,i^r, 0)  [3]  (T 5.9); the factor 2 is an option."""
    return np.maximum(1.0 - alpha_factor * (1.0 + 0.1 * t) * W_c_r, 0.0)


def beta_of(W_c_f, W_f_r, t):
    """beta_k = W_c^{f,k} max(1 - (1 + 0.1 t) W_f,k^r, 0)  [m]  (T 5.9)."""
    return W_c_f * np.maximum(1.0 - (1.0 + 0.1 * t) * W_f_r, 0.0)


# ---------------------------------------------------------------- 6. filter

def variance(noise, s):
    """sigma^2 = 8 sigma_8^2 / s  (T 5.10)."""
    return 8.0 * noise / s


def weighed(s, n):
    """Which of n neighbors take part in the mean of which of s own samples [s, n]: group g of G has stretches g, g + G, ..."""
    group, stretch = np.arange(s) // GROUP, np.arange(n) // GROUP
    return group[:, None] == stretch % (-(-s // GROUP))


def weights(frame, normalized, s, alpha, beta, fraction_random):
    """w_ij [s, N] (T 5.3 with 5.10) from the normalized neighborhood [N, V], whose first s rows are the own samples."""
    features = frame.first_feature
    difference = normalized[:s, None, :] - normalized[None, :, :]
    distance = ((difference[..., :3] ** 2 * alpha).sum(axis=2)
                + (difference[..., features:] ** 2 * beta).sum(axis=2))
    w = np.exp(-(1.0 - fraction_random) ** 2 / (2.0 * variance(frame.settings["noise"], s)) * distance)
    return np.where(weighed(s, len(normalized)), w, 0.0)


def filtered_colors(w, color):
    """c''_i = sum_j w_ij c'_j / sum_j w_ij  [s, 3]  (T 5.11) from w [s, N] and c' [N, 3]."""
    return (w @ color) / w.sum(axis=1, keepdims=True)


# ---------------------------------------------------------------- 7. outlier step

def outliers(filtered):
    """Which samples [s] are off by more than one standard deviation of the pixel in any channel of [s, 3]."""
    mean, std = moments(filtered)
    return (np.abs(filtered - mean) > std * (1.0 + OUTLIER_SLACK)).any(axis=1)


def replace_outliers(filtered, outlier):
    """The outliers become the pixel's mean; the energy taken away is given back to every sample, [s, 3]."""
    before = filtered.mean(axis=0)
    replaced = np.where(outlier[:, None], before, filtered)
    return replaced + (before - replaced.mean(axis=0))


# ---------------------------------------------------------------- 2. the run

class Decisions:
    """The yes-or-no steps of one pixel. compare.py overrides them where rounding may decide either way."""

    def accepted(self, found, distance, limit):
        """Which candidates [C] stay; distance [C, m], limit [m]."""
        return accepted(distance, limit)

    def bins(self, normalized, K):
        """The bins [N, V] of the normalized values [N, V]."""
        return bins_of(normalized, K)

    def outliers(self, filtered):
        """Which of the filtered samples [s, 3] are outliers."""
        return outliers(filtered)


def find_neighbors(frame, pixel, table, decide):
    """Section 3: dict of the own moments, the tolerance, the number of candidates and the neighbors [N]."""
    own = own_features(frame, pixel)
    own_mean, own_std = moments(own)
    limit = tolerance(frame, own, own_std)
    found = candidates(frame, pixel, table)
    keep = decide.accepted(found, distances(frame, found, own_mean), limit)
    neighbors = np.concatenate([frame.own(pixel), found[keep]])
    return {"own_mean": own_mean, "own_std": own_std, "tolerance": limit, "drawn": len(found), "neighbors": neighbors}


def normalization(values):
    """Section 4: dict of the moments and the normalized neighborhood [N, V]."""
    mean, std = neighborhood_moments(values)
    return {"mean": mean, "std": std, "normalized": normalize(values, mean, std)}


def dependencies(frame, normalized, t, decide):
    """Section 5: dict of everything from the bins to alpha and beta, from the normalized neighborhood [N, V]."""
    settings = frame.settings
    bins = decide.bins(normalized, (settings["bins"] - 1) // 2)
    histograms, information = pair_information(frame, bins)
    W_c_r, W_f_r, W_c_f, fraction_random = fractions(dependency_sums(frame, information))
    return {"bins": bins, "histograms": histograms,
            "mutual_information": information, "W_c_r": W_c_r, "W_f_r": W_f_r, "W_c_f": W_c_f,
            "fraction_random": fraction_random, "alpha": alpha_of(W_c_r, t, settings["alpha_factor"]),
            "beta": beta_of(W_c_f, W_f_r, t)}


def filtering(frame, s, color, stages, decide):
    """Sections 6 and 7: dict of the colors of the s own samples; color [S, 3] is c' of the whole frame."""
    w = weights(frame, stages["normalized"], s, stages["alpha"], stages["beta"], stages["fraction_random"])
    filtered = filtered_colors(w, color[stages["neighbors"]])
    if frame.settings["profile"] != "paper":
        return {"filtered": filtered, "color": filtered}
    return {"filtered": filtered, "color": replace_outliers(filtered, decide.outliers(filtered))}


def filter_pixel(frame, pixel, t, color, table, decide):
    """One pixel of pass t: dict of all stages. color [S, 3] is c' of the whole frame."""
    stages = {"start": color[frame.own(pixel)]} | find_neighbors(frame, pixel, table, decide)
    stages |= normalization(frame.values[stages["neighbors"]])
    stages |= dependencies(frame, stages["normalized"], t, decide)
    return stages | filtering(frame, frame.counts[pixel], color, stages, decide)


def run_pass(frame, t, color, draws, decisions):
    """Pass t over all pixels that have samples, row by row: {pixel: stages} and the next c' [S, 3]."""
    pixels, result = {}, color.copy()
    for pixel in np.flatnonzero(frame.counts):
        pixels[pixel] = filter_pixel(frame, pixel, t, color, draws(t, pixel), decisions(t, pixel))
        result[frame.own(pixel)] = pixels[pixel]["color"]
    return pixels, result


def run(frame, draws, decisions=lambda t, pixel: Decisions()):
    """All passes: [{pixel: stages}] and the image [pixels, 3]. draws(t, pixel) gives the table [draws, attempts, 3]."""
    color, passes = frame.values[:, :3], []
    for t in range(len(frame.settings["boxes"])):
        pixels, color = run_pass(frame, t, color, draws, decisions)
        passes.append(pixels)
    return passes, resolve(frame, color)


def resolve(frame, color):
    """The image [pixels, 3]: the mean of each pixel's samples, weighted where weights exist; 0 for an empty pixel."""
    image = np.zeros((len(frame.counts), 3))
    for pixel in np.flatnonzero(frame.counts):
        own = frame.own(pixel)
        weight = np.ones(len(own)) if frame.weight is None or not frame.weight[own].any() else frame.weight[own]
        image[pixel] = weight @ color[own] / weight.sum()
    return image
