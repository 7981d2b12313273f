"""The third witness of section 8: Gaussian, bilateral and cross-bilateral filter in double precision, from its text."""
import numpy as np

import oracle
import scene_frame
from report import Report
from tolerances import TOLERANCE

USES_COLOR, USES_FEATURES = ("bilateral", "cross-bilateral"), ("cross-bilateral",)


def positions(frame):
    """Film positions [S, 2]; a missing one is the middle of its pixel."""
    pixel = np.repeat(np.arange(len(frame.counts)), frame.counts)
    middle = np.stack([pixel % frame.width, pixel // frame.width], axis=1) + 0.5
    film = frame.values[:, 3:5]
    return np.where(np.isnan(film), middle, film)


def scaled_features(frame):
    """Features [S, m] less their mean over the frame, in standard deviations of their group; 0 where missing."""
    mean, std = oracle.moments(frame.values[:, frame.first_feature:])
    groups = [scene_frame.group(name) for name in frame.features]
    deviation = np.array([np.sqrt(sum(s ** 2 for s, other in zip(std, groups) if other == own)) for own in groups])
    return np.nan_to_num((frame.values[:, frame.first_feature:] - mean) / deviation) if groups else np.zeros((len(frame.values), 0))


def coordinates(frame, box):
    """[S, a]: what divides by the sigmas has a weight of exp(-distance^2 / 2)."""
    settings = frame.settings
    parts = [positions(frame) / (box / 4)]
    if settings["method"] in USES_COLOR:
        parts.append(frame.values[:, :3] / settings["sigma_color"])
    if settings["method"] in USES_FEATURES:
        parts.append(scaled_features(frame) / settings["sigma_feature"])
    return np.concatenate(parts, axis=1)


def samples_in_box(frame, pixel, box):
    """[N]: the pixel's own samples, then the others row by row."""
    reach, x, y = (box - 1) // 2, pixel % frame.width, pixel // frame.width
    height = len(frame.counts) // frame.width
    rows, columns = range(max(y - reach, 0), min(y + reach + 1, height)), range(max(x - reach, 0), min(x + reach + 1, frame.width))
    others = [frame.own(v * frame.width + u) for v in rows for u in columns if (u, v) != (x, y)]
    return np.concatenate([frame.own(pixel), *others]).astype(np.int64)


def filter_pixel(frame, pixel, box, place, color):
    """The neighbors, their weights [s, N], how far a rounding of the coordinates can move these, and the means [s, 3]."""
    neighbors = samples_in_box(frame, pixel, box)
    own, all_ = place[neighbors[:frame.counts[pixel]]], place[neighbors]
    distance = np.sqrt(((own[:, None] - all_[None]) ** 2).sum(axis=2))
    weights = np.where(oracle.weighed(*distance.shape), np.exp(-distance ** 2 / 2), 0.0)
    slack = weights * (1 + distance ** 2 + distance * np.abs(all_).max())
    return {"neighbors": neighbors, "weights": weights, "slack": slack,
            "filtered": oracle.filtered_colors(weights, color[neighbors])}


def compare(case, trace):
    """The Report on a trace of a case with fixed weights."""
    frame = scene_frame.load_frame(case, [], trace["features"])
    report, color = Report(), frame.values[:, :3]
    bound = TOLERANCE["fixed_color"] * np.abs(color).max()
    report.check("variables", [p["box"] for p in trace["passes"]], frame.settings["boxes"], 0, "frame", " boxes")
    for one in trace["passes"]:
        place, result = coordinates(frame, one["box"]), color.copy()
        traced = {p["y"] * frame.width + p["x"]: p for p in one["pixels"]}
        report.check("variables", sorted(traced), np.flatnonzero(frame.counts), 0, "frame", " pixels")
        for pixel, found in traced.items():
            where = f"box {one['box']}, pixel x {pixel % frame.width} y {pixel // frame.width}"
            expected = filter_pixel(frame, pixel, one["box"], place, color)
            if report.check("neighbors", found["neighbors"], expected["neighbors"], 0, where):
                report.check("weights", np.reshape(found["weights"], expected["weights"].shape), expected["weights"],
                             TOLERANCE["fixed_weight"] * expected["slack"] + TOLERANCE["fixed_least"], where)
            for stage in ("filtered", "color"):
                report.check(stage, found[stage], expected["filtered"], bound, where)
            result[frame.own(pixel)] = expected["filtered"]
        color = result
    report.check("image", trace["image"], oracle.resolve(frame, color), bound, "image")
    return report
