"""The oracle's section 1: a case becomes a Frame with only the modeled variables. Written from algorithm.md alone."""
from dataclasses import dataclass, field

import numpy as np

COLOR = ["R", "G", "B"]
POSITION = ["film.X", "film.Y"]
FIRST_RANDOM = 5            # column of the first random parameter, after 3 colors and 2 film positions
BASE_TOLERANCE = 0.1        # a of section 3, in the feature's own units


@dataclass
class Frame:
    """The samples of one frame with only the modeled variables, and what depends on the frame as a whole."""
    width: int
    height: int
    settings: dict
    counts: np.ndarray                              # [pixels] samples of each pixel, row-major
    first: np.ndarray                               # [pixels] index of each pixel's first sample
    values: np.ndarray                              # [S, V]
    random: list = field(default_factory=list)      # n names such as "lens.U"
    features: list = field(default_factory=list)    # m names such as "N.X"
    factor: np.ndarray = None                       # [m] H of section 3
    floor: np.ndarray = None                        # [m] a of section 3
    rejecting: np.ndarray = None                    # [m] whether the feature takes part in the rejection
    weight: np.ndarray = None                       # [S] or None

    @property
    def first_feature(self):
        return FIRST_RANDOM + len(self.random)

    @property
    def variables(self):
        return (COLOR + POSITION + ["random." + r for r in self.random]
                + ["feature." + f for f in self.features])

    def own(self, pixel):
        """Indices of the pixel's samples, [s]."""
        return self.first[pixel] + np.arange(self.counts[pixel])


def channel(case, name):
    """One channel of the case as float64 [S]; null becomes NaN."""
    return np.array(case["channels"][name], dtype=np.float64)


def group(name):
    """'lens.U' belongs to the group 'lens', 'time' to 'time'."""
    return name.split(".")[0]


def requested(case, prefix, groups):
    """The channels prefix.<group>[.component] of the requested groups: {name without prefix: [S]}."""
    names = [c[len(prefix):] for c in case["channels"] if c.startswith(prefix)]
    return {name: channel(case, prefix + name) for name in names if group(name) in groups and name != "hit"}


def random_parameters(case):
    """The requested random parameters, {name: [S]}; the group 'pixel' is the position inside the pixel (T 5.1.1)."""
    found = requested(case, "random.", case["settings"]["random"])
    if "pixel" in case["settings"]["random"]:
        for axis in "XY":
            film = channel(case, "film." + axis)
            found["pixel." + axis] = film - np.floor(film)
    return found


def is_constant(values):
    """Whether all non-missing values [S] are equal; all missing counts as constant."""
    valid = values[~np.isnan(values)]
    return valid.size == 0 or bool(np.all(valid == valid[0]))


def without_constants(channels):
    """Section 1, "model only what a scene requires": {name: [S]} without what is constant over the frame."""
    return {name: values for name, values in channels.items() if not is_constant(values)}


def hit_mask(case):
    """Which samples [S] hit something: feature.hit, else a normal other than (0,0,0), else all."""
    channels = case["channels"]
    if "feature.hit" in channels:
        return channel(case, "feature.hit") != 0
    normal = ["feature.N." + axis for axis in "XYZ"]
    if all(name in channels for name in normal):
        return np.any([channel(case, name) != 0 for name in normal], axis=0)
    return np.ones(sum(case["counts"]), dtype=bool)


def position_diagonal(case):
    """The diagonal of the bounding box of all first-hit world positions; missed rays and missing P are left out."""
    names = [c for c in case["channels"] if c.startswith("feature.P.")]
    if not names:
        return 0.0
    points = np.stack([channel(case, name) for name in names], axis=1)
    points = points[hit_mask(case) & ~np.isnan(points).any(axis=1)]
    return float(np.linalg.norm(points.max(axis=0) - points.min(axis=0))) if len(points) else 0.0


def rejection_rules(case, features):
    """H [m], a [m] and participation [m] of the features in the rejection (section 3)."""
    settings = case["settings"]
    is_position = np.array([group(f) in ("P", "P2") for f in features], dtype=bool)
    is_second = np.array([group(f).endswith("2") for f in features], dtype=bool)
    factor = np.where(is_position, 30.0, 3.0)
    position_floor = BASE_TOLERANCE * position_diagonal(case) / settings["position_scale"]
    floor = np.where(is_position, position_floor, BASE_TOLERANCE)
    return factor, floor, ~is_second | settings["reject_second_hit"]


def load_frame(case, random_order=None, feature_order=None):
    """The Frame of a case; the orders, when given, are permutations of the modeled names."""
    random = without_constants(random_parameters(case))
    features = without_constants(requested(case, "feature.", case["settings"]["features"]))
    random_names = list(random_order if random_order is not None else random)
    feature_names = list(feature_order if feature_order is not None else features)
    columns = [channel(case, name) for name in COLOR + POSITION]
    columns += [random[name] for name in random_names] + [features[name] for name in feature_names]
    counts = np.array(case["counts"], dtype=np.int64)
    factor, floor, rejecting = rejection_rules(case, feature_names)
    return Frame(width=case["width"], height=case["height"], settings=case["settings"], counts=counts,
                 first=np.cumsum(counts) - counts, values=np.stack(columns, axis=1),
                 random=random_names, features=feature_names, factor=factor, floor=floor, rejecting=rejecting,
                 weight=channel(case, "weight") if "weight" in case["channels"] else None)
