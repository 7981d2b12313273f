"""The oracle itself against what can be said on paper. Exit status 0, or a failed assert; 77 without numpy."""
import sys

try:
    import numpy as np
except ImportError:
    print("skipped: numpy is missing")
    sys.exit(77)

sys.dont_write_bytecode = True      # the source folder stays clean
import cases
import draw_statistics
import oracle
import scene_frame

RNG = np.random.Generator(np.random.PCG64(2012))


def draw_table(frame, t, pixel, rng=RNG):
    """A random table [draws, attempts, 3] as a tool would use it."""
    box = frame.settings["boxes"][t]
    shape = (oracle.draw_count(frame.settings, box, frame.counts[pixel]), frame.settings["redraws"] + 1)
    half = (box - 1) // 2
    offset = [rng.choice(np.arange(-half, half + 1), size=shape, p=draw_statistics.point_weights(half, box / 4))
              for _ in range(2)]
    return np.stack([*offset, rng.integers(0, 2 ** 32, size=shape)], axis=-1)


def run(case):
    """The frame of a case, its passes and its image."""
    frame = scene_frame.load_frame(case)
    return (frame, *oracle.run(frame, lambda t, pixel: draw_table(frame, t, pixel)))


def close(a, b, bound=1e-12):
    return np.allclose(a, b, rtol=bound, atol=bound)


# ---------------------------------------------------------------- input

def test_constants_are_dropped():
    frame = scene_frame.load_frame(cases.make("spp1_paper"))
    assert frame.random == ["lens.U", "lens.V"] and "N.Y" not in frame.features and "N.X" in frame.features
    frame = scene_frame.load_frame(cases.make("missing_values"))
    assert not {"uv.U", "uv.V"} & set(frame.features)
    assert scene_frame.is_constant(np.array([np.nan, np.nan])) and not scene_frame.is_constant(np.array([1.0, np.nan, 2.0]))


def test_position_inside_the_pixel():
    case = cases.make("spp4_thesis")
    inside = scene_frame.random_parameters(case)["pixel.X"]
    assert (inside >= 0).all() and (inside < 1).all()
    assert close(inside + np.repeat(np.tile(np.arange(11), 8), 4), case["channels"]["film.X"])


def test_diagonal_leaves_missed_rays_out():
    channels = {"feature.N.X": [1, 0, 1, 1], "feature.N.Y": [0, 0, 0, 0], "feature.N.Z": [0, 0, 0, 0],
                "feature.P.X": [1, -99, 4, 50], "feature.P.Y": [2, 0, 6, None]}
    case = {"counts": [4], "channels": channels}
    assert scene_frame.position_diagonal(case) == 5.0
    channels["feature.hit"] = [1, 1, 0, 1]
    assert scene_frame.position_diagonal(case) == np.hypot(100, 2)


def test_rejection_rules():
    case = cases.make("second_hit_keep")
    names = ["N.X", "P.X", "N2.X", "P2.X"]
    factor, floor, rejecting = scene_frame.rejection_rules(case, names)
    assert list(factor) == [3, 30, 3, 30] and list(rejecting) == [True, True, False, False]
    assert close(floor[[0, 2]], 0.1) and close(floor[[1, 3]], 0.1 * scene_frame.position_diagonal(case) / 20)
    case["settings"]["reject_second_hit"] = True
    assert scene_frame.rejection_rules(case, names)[2].all()


# ---------------------------------------------------------------- neighborhood

def test_number_of_samples():
    settings = dict(cases.SETTINGS)
    assert [oracle.requested_samples(settings, b, 8) for b in (55, 35, 17, 7)] == [1512, 612, 144, 24]
    assert oracle.draw_count(settings, 3, 8) == 0
    settings["profile"] = "paper"
    assert oracle.requested_samples(settings, 7, 3) == 73
    assert oracle.requested_samples({**settings, "samples_factor": 2.0}, 7, 3) == 98
    assert oracle.requested_samples({**settings, "max_samples": 50}, 7, 3) == 50


def test_one_tolerance_is_the_printed_rule():
    for f, m, s, H in RNG.normal(0, [0.3, 0.3, 0.1, 0], (5000, 4)) + [0, 0, 0, 3]:
        s = abs(s)
        printed = abs(f - m) > H * s and (abs(f - m) > 0.1 or s > 0.1)
        assert printed == (abs(f - m) > max(H * s, 0.1))


def test_candidates():
    case = cases.make("spp_varying_thesis")
    frame = scene_frame.load_frame(case)
    empty, pixel = 30, 31                                        # counts 0 and 1, neighbors in a row of 11
    there = 32                                                   # count 2, to the right
    void = [[0, 0, 5], [-10, 0, 5], [9, 9, 5], [-1, 0, 5]]        # itself, left of and below the frame, an empty pixel
    low, high = [1, 0, 2 ** 31 - 1], [1, 0, 2 ** 31]
    assert frame.counts[empty] == 0 and frame.counts[there] == 2
    table = np.array([void + [low, high], void + [high, low], void + [void[0], void[3]]])
    assert list(oracle.candidates(frame, pixel, table)) == [frame.first[there], frame.first[there] + 1]


def test_missing_values_never_reject():
    frame = scene_frame.load_frame(cases.make("missing_values"))
    own = oracle.own_features(frame, 3)                          # all of its N.X are missing
    mean, std = oracle.moments(own)
    limit = oracle.tolerance(frame, own, std)
    assert np.isinf(limit[frame.features.index("N.X")]) and np.isfinite(limit[frame.features.index("N.Z")])
    distance = oracle.distances(frame, np.arange(len(frame.values)), mean)
    assert (distance[np.isnan(frame.values[:, frame.first_feature:])] == 0).all()


# ---------------------------------------------------------------- normalization, information

def test_normalization():
    values = RNG.normal(3, 2, (50, 4))
    values[:, 1], values[:, 2] = 7.0, 1e7 + RNG.random(50)       # constant; below 1e-6 of the magnitude
    values[::3, 3] = np.nan
    mean, std = oracle.neighborhood_moments(values)
    z = oracle.normalize(values, mean, std)
    assert close(z[:, 0].mean(), 0) and close(z[:, 0].std(), 1)
    assert (z[:, 1:3] == 0).all() and (std[1:3] == 0).all() and close(mean[1], 7)
    assert (z[::3, 3] == 0).all() and close(np.nanstd(values[:, 3]), std[3])


def test_bins():
    z = np.array([0.49, 0.5, -0.5, 1.5, -2.5, 2.49, 9.0, -9.0])
    assert list(oracle.bins_of(z, 3)) == [0, 1, -1, 2, -3, 2, 3, -3]


def test_identical_variables_share_their_entropy():
    x = RNG.integers(-3, 4, 500)
    p = np.bincount(x + 3) / 500
    assert close(oracle.mutual_information(oracle.joint_histogram(x, x, 3)), -(p * np.log(p)).sum())
    assert close(oracle.mutual_information(oracle.joint_histogram(x, -x, 3)), -(p * np.log(p)).sum())
    two = np.repeat([-1, 1], 8)
    assert close(oracle.mutual_information(oracle.joint_histogram(two, two, 3)), np.log(2))


def test_independent_variables_share_nothing():
    x, y = (a.ravel() for a in np.meshgrid([-3, -1, -1, 0, 2], [-2, 0, 0, 0, 1, 3]))
    assert oracle.mutual_information(oracle.joint_histogram(x, y, 3)) < 1e-15
    assert oracle.mutual_information(oracle.joint_histogram(x, np.zeros_like(x), 3)) == 0.0


def test_information_is_symmetric_and_bounded():
    x, y = RNG.integers(-3, 4, (2, 60))
    y = np.where(RNG.random(60) < 0.5, x, y)
    h = oracle.joint_histogram(x, y, 3)
    entropy = oracle.mutual_information(oracle.joint_histogram(x, x, 3))
    assert h.sum() == 60 and h[x[0] + 3, y[0] + 3] > 0
    assert close(oracle.mutual_information(h), oracle.mutual_information(h.T))
    assert 0 < oracle.mutual_information(h) <= entropy


def test_counts_give_the_same_information_as_probabilities():
    h = RNG.integers(0, 9, (7, 7))
    def n_ln_n(n):
        return (n[n > 0] * np.log(n[n > 0])).sum()
    N = h.sum()
    by_counts = (n_ln_n(h) - n_ln_n(h.sum(axis=1)) - n_ln_n(h.sum(axis=0)) + N * np.log(N)) / N
    assert close(oracle.mutual_information(h), by_counts)


# ---------------------------------------------------------------- weights and filter

def test_fractions_alpha_beta():
    D = {"c_r": np.array([1.0, 0, 3]), "c_p": np.array([1.0, 0, 1]), "c_f": np.array([2.0, 0, 0]),
         "c_fk": np.array([1.5, 0.5]), "f_r": np.array([0.3, 1]), "f_p": np.array([0.1, 0])}
    W_c_r, W_f_r, W_c_f, fraction_random = oracle.fractions(D)
    assert close(W_c_r, [0.5, 0, 0.75], 1e-9) and close(fraction_random, 1.25 / 3, 1e-9)
    assert close(W_f_r, [0.75, 1], 1e-9) and close(W_c_f, [1.5 / 8, 0.5 / 8], 1e-9)
    assert close(oracle.alpha_of(np.array([0, 0.3, 0.5]), 2, 2), [1, 1 - 0.72, 0])
    assert close(oracle.beta_of(np.array([0.2, 0.2]), np.array([0.5, 0.9]), 2), [0.2 * 0.4, 0])


def test_weights_by_hand():
    frame = scene_frame.load_frame(cases.make("spp4_thesis"))
    z = np.zeros((5, len(frame.variables)))
    z[1, 0], z[2, 3], z[3, frame.first_feature] = 2.0, 9.0, 3.0          # a color, a film position, a feature
    alpha, beta = np.array([0.5, 0, 0]), np.zeros(len(frame.features))
    beta[0] = 0.1
    w = oracle.weights(frame, z, 4, alpha, beta, 0.25)
    scale = 0.75 ** 2 / (2 * 8 * 0.02 / 4)
    assert close(w[0], np.exp(-scale * np.array([0, 2.0, 0, 0.9, 0])))
    assert close(oracle.weights(frame, z, 4, alpha, beta, 1.0), 1)       # W_c^r = 1: the plain mean


def test_one_sample_a_pixel():
    case = cases.make("spp1_thesis")
    frame, passes, _ = run(case)
    for stages in passes[0].values():
        assert (stages["own_std"] == 0).all() and (stages["tolerance"] == frame.floor).all()
        filtered = stages["filtered"]
        assert close(oracle.replace_outliers(filtered, oracle.outliers(filtered)), filtered)
    case["settings"]["boxes"] = [1]                                      # M = 0: each pixel is its own neighborhood
    frame, passes, image = run(case)
    assert close(image, frame.values[:, :3])
    assert all(stages["fraction_random"] == 0 and len(stages["neighbors"]) == 1 for stages in passes[0].values())


def test_constant_image_comes_back():
    for name in ("spp4_thesis", "spp_varying_paper"):
        case = cases.make(name)
        for channel, value in zip("RGB", (0.25, 3.0, 1e4)):
            case["channels"][channel] = [value] * len(case["channels"][channel])
        frame, _, image = run(case)
        assert close(image[frame.counts > 0], [0.25, 3.0, 1e4]) and (image[frame.counts == 0] == 0).all()


def test_convex_hull_without_the_outlier_step():
    frame, passes, image = run(cases.make("spp_varying_thesis"))
    color = frame.values[:, :3]
    low, high = color.min(axis=0), color.max(axis=0)
    for pixels in passes:
        for pixel, stages in pixels.items():
            around = color[stages["neighbors"]]
            assert (stages["filtered"] >= around.min(axis=0) - 1e-12).all()
            assert (stages["filtered"] <= around.max(axis=0) + 1e-12).all()
        color = color.copy()
        for pixel, stages in pixels.items():
            color[frame.own(pixel)] = stages["color"]
    assert (image[frame.counts > 0] >= low - 1e-12).all() and (image <= high + 1e-12).all()


def test_outlier_step_keeps_energy():
    frame, passes, _ = run(cases.make("hdr_radiance"))
    changed = 0
    for pixels in passes:
        for stages in pixels.values():
            assert close(stages["color"].mean(axis=0), stages["filtered"].mean(axis=0))
            changed += not close(stages["color"], stages["filtered"])
    assert changed > 20


def test_outlier_step_by_hand():
    two = np.array([[1.0, 5, 0], [2.0, 5, 0]])                           # both exactly one deviation off: no outliers
    assert not oracle.outliers(two).any()
    five = np.array([[0.0, 1, 1], [0, 1, 1], [0, 1, 1], [0, 1, 1], [5, 1, 1]])
    assert list(oracle.outliers(five)) == [False] * 4 + [True]
    mended = oracle.replace_outliers(five, oracle.outliers(five))        # 5 -> 1, mean 1 -> 0.2, so 0.8 is given back
    assert close(mended[:, 0], [0.8, 0.8, 0.8, 0.8, 1.8]) and close(mended[:, 1:], 1)


def test_resolve():
    case = cases.make("sample_weight")
    frame = scene_frame.load_frame(case)
    image = oracle.resolve(frame, frame.values[:, :3])
    own = frame.own(5)
    assert close(image[0], frame.values[:4, :3].mean(axis=0))            # all weights 0: the plain mean
    assert close(image[5], np.average(frame.values[own, :3], axis=0, weights=frame.weight[own]))


# ---------------------------------------------------------------- the cases

def test_cases_are_float32_and_in_their_pixels():
    for name in cases.CASES:
        case = cases.make(name)
        assert case == cases.make(name) and set(case["settings"]) == set(cases.SETTINGS)
        for channel in case["channels"]:
            values = scene_frame.channel(case, channel)
            assert len(values) == sum(case["counts"]), (name, channel)
            assert ((values == values.astype(np.float32)) | np.isnan(values)).all(), (name, channel)
        pixel = np.repeat(np.arange(case["width"] * case["height"]), case["counts"])
        for axis, index in (("X", pixel % case["width"]), ("Y", pixel // case["width"])):
            film = scene_frame.channel(case, "film." + axis)
            assert ((np.floor(film) == index) | np.isnan(film)).all(), name


def test_statistics_of_draws_see_faults():
    half, box, shape = 4, 9, (3000, 9)
    def draws(axis):
        offset = [RNG.choice(np.arange(-half, half + 1), size=shape, p=axis) for _ in range(2)]
        return np.stack([*offset, RNG.integers(0, 2 ** 32, size=shape)], axis=-1)
    for weights in (draw_statistics.point_weights, draw_statistics.cell_weights):
        good = draws(weights(half, box / 4))
        assert max(f(good) for f in (draw_statistics.words, draw_statistics.correlation)) < 5
        assert draw_statistics.offsets(good, box) < 5
    assert draw_statistics.offsets(draws(draw_statistics.point_weights(half, 2.0)), box) > 6
    truncated = good.copy()
    truncated[..., 0] = np.trunc(RNG.normal(0, box / 4, shape)).clip(-half, half)
    assert draw_statistics.offsets(truncated, box) > 6
    linked = good.copy()
    linked[..., 2] = (linked[..., 0] + half) * (2 ** 32 // box)
    assert draw_statistics.correlation(linked) > 6


def run_tests(tests):
    """Runs the functions of {name: function} whose name begins with test_."""
    for name, test in list(tests.items()):
        if name.startswith("test_"):
            test()
            print("ok", name)


if __name__ == "__main__":
    run_tests(globals())
