"""The oracle's settings and steps that thesis and paper do not have, against what can be said on paper.

Exit status 0, or a failed assert; 77 without numpy.
"""
import sys

try:
    import numpy as np
except ImportError:
    print("skipped: numpy is missing")
    sys.exit(77)

sys.dont_write_bytecode = True      # the source folder stays clean
import cases
import oracle
import scene_frame
import spikes
from test_closed_forms import RNG, close, draw_table, run, run_tests


# ---------------------------------------------------------------- drawing and measuring less

def test_drawing_ends_after_the_portion_with_enough():
    settings = {**cases.SETTINGS, "neighbors_factor": 2.5}
    assert [oracle.enough_samples(settings, b) for b in (9, 3)] == [202, 22]
    assert oracle.enough_samples({**settings, "neighbors_factor": 0.06}, 3) == 1
    assert oracle.enough_samples(cases.SETTINGS, 3) == np.inf

    class AcceptEvenPlaces(oracle.Decisions):
        def accepted(self, found, distance, limit):
            return np.arange(len(found)) % 2 == 0
    case = cases.make("neighbors_factor")
    frame = scene_frame.load_frame(case)
    pixel = 4 * 9 + 4                                            # the box of 9 reaches the border of 9 x 7 only
    table = draw_table(frame, 0, pixel)
    assert len(table) == 968
    for enough, portions in ((4, 0), (5, 1), (132, 1), (133, 2), (260, 2), (261, 3), (388, 3), (389, 4), (9999, 4)):
        frame.settings["neighbors_factor"] = (enough + 0.5) / 81
        stages = oracle.find_neighbors(frame, pixel, 0, table, AcceptEvenPlaces())
        used = oracle.candidates(frame, pixel, table[:256 * portions])
        assert stages["drawn"] == len(used) and len(used) == min(256 * portions, 968), (enough, len(used))
        assert list(stages["neighbors"]) == [*frame.own(pixel), *used[::2]]


def test_only_the_first_neighbors_are_measured():
    frame = scene_frame.load_frame(cases.make("statistics_samples"))
    z = RNG.normal(0, 1, (40, len(frame.variables)))
    some, decide = oracle.dependencies(frame, z, 1, oracle.Decisions()), oracle.Decisions()
    frame.settings["statistics_samples"] = None
    first, every = (oracle.dependencies(frame, rows, 1, decide) for rows in (z[:12], z))
    assert len(some["bins"]) == 12 and all(h.sum() == 12 for h in some["histograms"].values())
    assert (some["mutual_information"] == first["mutual_information"]).all() and (some["alpha"] == first["alpha"]).all()
    assert not close(some["mutual_information"], every["mutual_information"], 1e-3)


def run_with(case, **settings):
    """The frame and the first pass {pixel: stages} of a case with other settings, on the same draws for all settings."""
    frame = scene_frame.load_frame({**case, "settings": {**case["settings"], "boxes": [9], **settings}})
    passes, _ = oracle.run(frame, lambda t, pixel: draw_table(frame, t, pixel, np.random.Generator(np.random.PCG64(pixel))))
    return frame, passes[0]


def test_a_square_shares_what_its_first_pixel_measures():
    shared = ("bins", "histograms", "mutual_information", "W_c_r", "W_f_r", "W_c_f", "fraction_random", "alpha", "beta")
    for name, side in (("block2_varying", 2), ("block3_gaps", 3)):
        case = cases.make(name)
        frame, alone = run_with(case, statistics_block=1)
        frame, passes = run_with(case, statistics_block=side)
        followers = 0
        for pixel, stages in passes.items():
            x, y = pixel % 11, pixel // 11
            square = [v * 11 + u for v in range(8) for u in range(11) if (u // side, v // side) == (x // side, y // side)]
            first = min(p for p in square if frame.counts[p] > 0)
            followers += first != pixel
            assert all(stages[stage] is passes[first][stage] for stage in shared)
            assert (passes[first]["alpha"] == alone[first]["alpha"]).all()
            assert (passes[first]["color"] == alone[first]["color"]).all()
            assert list(stages["neighbors"]) == list(alone[pixel]["neighbors"])
            assert (stages["normalized"] == alone[pixel]["normalized"]).all()
        assert followers > 5, name


# ---------------------------------------------------------------- spikes

def gray_frame(width, height, counts):
    """A frame without variables but the color, which is 1."""
    counts = np.broadcast_to(counts, width * height).astype(np.int64)
    return scene_frame.Frame(width=width, height=height, settings={}, counts=counts, first=np.cumsum(counts) - counts,
                             values=np.ones((counts.sum(), 3)))


def spread(frame, bright):
    """The image after spreading, with pixels that have other colors {pixel: gray}."""
    color = frame.values.copy()
    for pixel, gray in bright.items():
        color[frame.own(pixel)] = gray
    return oracle.resolve(frame, spikes.spread(frame, oracle.resolve(frame, color), color))[:, 0]


def test_spikes_by_hand():
    frame = gray_frame(7, 6, 2)
    assert close(spread(frame, {}), 1)
    around = np.abs(np.arange(7) - 3)[None, :] <= 2, np.abs(np.arange(6) - 2)[:, None] <= 2
    expected = 1 + 0.2 * (around[0] & around[1])                         # 6 -> 1, and 5/25 for each of 25
    assert close(spread(frame, {2 * 7 + 3: 6.0}), expected.ravel())
    corner = spread(frame, {0: 10.0})                                    # 10 -> 1, and 9/9 for each of 9
    assert close(corner[[0, 2, 14, 16]], 2) and close(corner[[3, 21]], 1)
    assert close(spread(frame, {8: 6.0, 9: 6.0})[[8, 9]], 6)             # neither is brighter than the other
    row = spread(gray_frame(6, 1, 1), {0: 4, 2: 9, 3: 3, 4: 0, 5: 0})    # 4 -> 1 and 9 -> 3, found before any is spread
    assert close(row, [1 + 1 + 1.2, 1 + 1 + 1.2, 3 + 1 + 1.2, 3 + 1.2, 1.2, 0])
    gap = gray_frame(3, 1, [2, 0, 3])                                    # no neighbor that has samples
    assert close(spread(gap, {2: 5.0}), [1, 0, 5])
    dark = spread(gray_frame(3, 1, 1), {0: -1.0, 1: 6.0, 2: -1.0})       # all of its light, not more
    assert close(dark, [1, 2, 1])


def test_spikes_keep_energy():
    frame, passes, image = run(cases.make("spikes_varying"))
    color = frame.values[:, :3]
    before = oracle.resolve(frame, color)
    after = oracle.resolve(frame, spikes.spread(frame, before, color))
    assert close(before.sum(axis=0), after.sum(axis=0)) and after.max() < 0.6 * before.max()
    assert (after[frame.counts == 0] == 0).all()


if __name__ == "__main__":
    run_tests(globals())
