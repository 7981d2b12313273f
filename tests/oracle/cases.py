"""The small scenes on which the C++ code is compared with the oracle.

Each looks like a thin-lens picture of two surfaces: the lens and time move the boundary between them, the light sample
decides on the shadow. So pixels are pure or mixed, acceptance is partial, and W, alpha and beta lie between 0 and 1.
Everything is deterministic, and every value is a float32.
"""
import numpy as np

SETTINGS = {"profile": "thesis", "boxes": [9, 7, 5, 3], "noise": 0.02, "bins": 7, "seed": 1,
            "random": ["lens", "time"], "features": ["N", "P", "albedo"], "samples_factor": None, "max_samples": None,
            "position_scale": 20, "reject_second_hit": False, "bias_correction": False, "alpha_factor": 2, "redraws": 8,
            "method": "rpf", "sigma_color": 30, "sigma_feature": 0.5, "damping": 0.45, "window": 21, "gamma": 0.2, "bandwidth": 2,
            "views": 128}


def uniform(rng, n):
    """n numbers in [0,1) that stay below 1 as float32, and below x + 1 when added to a pixel x < 256."""
    return np.floor(rng.random(n) * 65536) / 65536


def unit(vectors):
    """The vectors [S, 3] at length 1."""
    return vectors / np.linalg.norm(vectors, axis=1, keepdims=True)


def components(name, letters, table):
    """{name.letter: column} of a table [S, len(letters)]."""
    return {f"{name}.{letter}": table[:, i] for i, letter in enumerate(letters)}


def geometry(x, y, front, size):
    """Normal [S, 3], world position [S, 3] and albedo [S, 3] of the visible point at film position x, y."""
    depth = np.where(front, 2.0 + 0.02 * y, 5.0 + 0.03 * x)
    P = np.stack([(x - size[0] / 2) * 0.05 * depth, (y - size[1] / 2) * 0.05 * depth, depth], axis=1)
    bent = np.stack([0.3 * np.sin(0.6 * x), 0.2 * np.cos(0.7 * y), np.ones(len(x))], axis=1)
    flat = np.stack([0.02 * y, np.ones(len(x)), 0.2 + 0.01 * x], axis=1)
    N = unit(np.where(front[:, None], bent, flat))
    texture = 0.85 + 0.15 * np.sin(1.3 * x + 0.4 * y)
    albedo = np.where(front[:, None], [0.8, 0.35, 0.2], [0.2, 0.45, 0.7]) * texture[:, None]
    return N, P, albedo


def scene(seed, width, height, counts):
    """The channels {name: [S]} of the two-surface scene."""
    rng = np.random.Generator(np.random.PCG64(seed))
    pixel = np.repeat(np.arange(width * height), counts)
    x, y, lens_u, lens_v, time, light_u, light_v = (uniform(rng, len(pixel)) for _ in range(7))
    x, y = x + pixel % width, y + pixel // width
    edge = 0.5 * width + 3.0 * (lens_u - 0.5) + 1.5 * (time - 0.5) + 0.4 * (y - height / 2)
    N, P, albedo = geometry(x, y, x < edge, (width, height))
    lit = light_u + 0.3 * light_v < 0.35 + 0.9 * y / height
    glow = (0.05 + lit * (0.6 + 0.05 * light_v))[:, None] * np.array([1.0, 0.95, 0.9])
    direction = unit(np.stack([lens_u - 0.5 + 0.1 * x, light_v - 0.5, 0.3 + 0 * x], axis=1))
    channels = dict(zip("RGB", (albedo * glow + 0.02 * lens_v[:, None]).T))
    channels.update({"film.X": x, "film.Y": y, "random.lens.U": lens_u, "random.lens.V": lens_v, "random.time": time,
                     "random.light.U": light_u, "random.light.V": light_v})
    channels.update(components("feature.N", "XYZ", N) | components("feature.P", "XYZ", P)
                    | components("feature.albedo", "RGB", albedo) | components("feature.N2", "XYZ", direction)
                    | components("feature.P2", "XYZ", P + 2.0 * direction))
    return channels


def as_case(width, height, counts, channels, settings):
    """The case dict, as rpf_trace reads it; NaN becomes null."""
    unknown = set(settings) - set(SETTINGS)
    assert not unknown, unknown
    single = {name: np.asarray(values, dtype=np.float32) for name, values in channels.items()}
    listed = {name: [None if np.isnan(v) else float(v) for v in values] for name, values in single.items()}
    return {"width": width, "height": height, "counts": [int(c) for c in counts], "channels": listed, "metadata": {},
            "settings": {**SETTINGS, **settings}}


def simple(seed, width=11, height=8, spp=4, change=None, **settings):
    """A case with spp samples in every pixel (or spp = array of counts); change(channels, rng, counts) edits it."""
    counts = np.broadcast_to(spp, width * height)
    channels = scene(seed, width, height, counts)
    if change:
        change(channels, np.random.Generator(np.random.PCG64(seed + 1000)), counts)
    return as_case(width, height, counts, channels, {"seed": seed, **settings})


def varying(seed, **settings):
    """0 to 9 samples a pixel, with 0, 1 and 2 certain to occur."""
    counts = np.random.Generator(np.random.PCG64(seed)).integers(0, 10, 88)
    counts[[0, 30, 40]], counts[[1, 31, 41]], counts[[2, 32, 42]] = 0, 1, 2
    return simple(seed, spp=counts, **settings)


def with_gaps(seed):
    """Counts of 11 x 8 pixels, 1 to 4 in two of five and 0 in the others; the 3 x 3 in the middle are all empty."""
    rng = np.random.Generator(np.random.PCG64(seed))
    counts = rng.integers(1, 5, (8, 11)) * (rng.random((8, 11)) < 0.4)
    counts[3:6, 3:6] = 0
    return counts.ravel()


def crowded():
    """Counts of 3 x 3 pixels: one of 700 between others of 3."""
    return np.where(np.arange(9) == 4, 700, 3)


def some(rng, n, part):
    """A random mask [n] that is true for about this part."""
    return rng.random(n) < part


def lose_values(channels, rng, counts):
    """NaN at single values, in all of a pixel's N.X, in the first sample of many pixels, and in a whole channel."""
    samples = len(channels["R"])
    first = (np.cumsum(counts) - counts).astype(int)
    for name in ("feature.N.X", "feature.P.Y", "feature.albedo.G", "random.lens.U", "random.time", "film.X", "film.Y"):
        channels[name] = np.where(some(rng, samples, 0.05), np.nan, channels[name])
    for name in ("feature.P.X", "random.lens.V", "film.X", "feature.albedo.R"):
        channels[name][first[::3]] = np.nan
    for pixel in (3, 40, 41):
        channels["feature.N.X"][first[pixel]:first[pixel] + counts[pixel]] = np.nan
    channels["feature.uv.U"] = np.full(samples, np.nan)
    channels["feature.uv.V"] = np.where(some(rng, samples, 0.5), np.nan, 0.25)     # constant where not missing


def miss_rays(channels, rng, counts):
    """The upper right of the picture sees no surface: N = P = 0, and feature.hit tells it."""
    missed = channels["film.X"] - 1.2 * channels["film.Y"] + 2 * channels["random.lens.U"] > 0.6 * len(counts) ** 0.5
    for name in [c for c in channels if c.startswith(("feature.N", "feature.P", "feature.albedo"))]:
        channels[name] = np.where(missed, 0.0, channels[name])
    channels["feature.hit"] = np.where(missed, 0.0, 1.0)


def miss_rays_unmarked(channels, rng, counts):
    """Missed rays that only N = (0,0,0) tells; P is far away there, which must not enter the bounding box."""
    miss_rays(channels, rng, counts)
    missed = channels.pop("feature.hit") == 0
    channels["feature.P.Z"] = np.where(missed, -1000.0, channels["feature.P.Z"])


def weigh_samples(channels, rng, counts):
    """A weight for each sample, with zeros, and one pixel of zeros only."""
    weight = np.where(some(rng, len(channels["R"]), 0.1), 0.0, 0.25 + 1.75 * uniform(rng, len(channels["R"])))
    weight[:counts[0]] = 0.0
    channels["weight"] = weight


def add_fireflies(channels, rng, counts):
    """A few samples of 1e4."""
    for sample in rng.choice(len(channels["R"]), 5, replace=False):
        for name, factor in zip("RGB", (1.0, 0.9, 0.6)):
            channels[name][sample] = 1e4 * factor


def add_weighted_fireflies(channels, rng, counts):
    """The same, and a weight from 0.5 to 1.5 for every sample."""
    add_fireflies(channels, rng, counts)
    channels["weight"] = 0.5 + uniform(rng, len(channels["R"]))


def move_world(channels, rng, counts):
    """World positions far from the origin."""
    for axis in "XYZ":
        channels["feature.P." + axis] = channels["feature.P." + axis] + 4096.0


def scaled_radiance(factor):
    """All radiance times the factor."""
    def change(channels, rng, counts):
        for name in "RGB":
            channels[name] = channels[name] * factor
    return change


def far_world(size):
    """A world `size` times as large, 1e7 away, where float counts in ones."""
    def change(channels, rng, counts):
        for axis in "XYZ":
            channels["feature.P." + axis] = channels["feature.P." + axis] * size + 1e7
    return change


def still_scene(channels, rng, counts):
    """No motion, and one flat normal component: what is constant must be dropped."""
    channels["random.time"] = np.full(len(channels["R"]), 0.5)
    channels["feature.N.Y"] = np.zeros(len(channels["R"]))


def fixed(method, seed, **keywords):
    """A case of a method with fixed weights; features only where it knows them."""
    keywords = {"boxes": [7, 3], "sigma_color": 0.2, "features": ["N", "P", "albedo"], "random": [], **keywords}
    if method != "cross-bilateral":
        keywords["features"] = []
    return (varying if "varying" in keywords and keywords.pop("varying") else simple)(seed, method=method, **keywords)


FIXED_CASES = {
    "gaussian": lambda: fixed("gaussian", 50),
    "gaussian_varying": lambda: fixed("gaussian", 51, varying=True),
    "gaussian_box15": lambda: fixed("gaussian", 52, boxes=[15]),        # larger than the image
    "bilateral": lambda: fixed("bilateral", 53),
    "bilateral_spp1": lambda: fixed("bilateral", 54, spp=1),
    "bilateral_gaps": lambda: fixed("bilateral", 55, spp=with_gaps(55), sigma_color=0.05),
    "bilateral_crowded": lambda: fixed("bilateral", 62, width=3, height=3, spp=crowded()[::-1], boxes=[3]),
    "bilateral_hdr": lambda: fixed("bilateral", 56, change=add_weighted_fireflies, sigma_color=3000),
    "bilateral_1e-30": lambda: fixed("bilateral", 57, change=scaled_radiance(1e-30), sigma_color=2e-29),
    "bilateral_1e30": lambda: fixed("bilateral", 57, change=scaled_radiance(1e30), sigma_color=2e29),
    "cross_bilateral": lambda: fixed("cross-bilateral", 58),
    "cross_bilateral_varying": lambda: fixed("cross-bilateral", 59, varying=True, sigma_feature=0.2),
    "cross_bilateral_missing": lambda: fixed("cross-bilateral", 60, change=lose_values, features=["N", "P", "albedo", "uv"]),
    "cross_bilateral_far": lambda: fixed("cross-bilateral", 61, change=move_world, features=["P"], sigma_feature=0.3),
}


def pixels(method, seed, **keywords):
    """A case of a method that filters pixels; features only where it knows them."""
    keywords = {"features": ["N", "P", "albedo"] if method == "sbf" else [], "random": [], **keywords}
    return (varying if keywords.pop("varying", False) else simple)(seed, method=method, **keywords)


def cast_shadows(channels, rng, counts):
    """A slope and a width for the third of the samples that is in the dark; the farther down, the wider."""
    dark = channels["random.light.U"] + 0.3 * channels["random.light.V"] >= 0.35 + 0.05 * channels["film.Y"]
    slope = np.where(dark, 0.05 + 0.02 * channels["film.Y"] + 0.1 * uniform(rng, len(dark)), 0.0)
    channels["feature.penumbra.slope"], channels["feature.penumbra.width"] = slope, 2.0 * slope


def shadows(seed, also=None, **keywords):
    """A case of the axis-aligned filter; also(channels, rng, counts) edits it further."""
    def change(channels, rng, counts):
        cast_shadows(channels, rng, counts)
        if also:
            also(channels, rng, counts)
    return pixels("axis-aligned", seed, change=change, **{"features": ["N", "P", "albedo", "penumbra"], **keywords})


PIXEL_CASES = {
    "nlm": lambda: pixels("nlm", 70),
    "nlm_varying": lambda: pixels("nlm", 71, varying=True, damping=1.0),
    "nlm_gaps": lambda: pixels("nlm", 72, spp=with_gaps(72), window=5),
    "nlm_weighted": lambda: pixels("nlm", 73, change=add_weighted_fireflies, damping=3.0),
    "nlm_1e-30": lambda: pixels("nlm", 74, change=scaled_radiance(1e-30)),
    "nlm_one_row": lambda: pixels("nlm", 75, width=13, height=1, spp=3),
    "gem": lambda: pixels("gem", 80),
    "gem_varying": lambda: pixels("gem", 81, varying=True),
    "gem_gaps": lambda: pixels("gem", 82, spp=with_gaps(82), gamma=0.05),
    "gem_weighted": lambda: pixels("gem", 83, change=add_weighted_fireflies, gamma=0.4),
    "gem_1e30": lambda: pixels("gem", 84, change=scaled_radiance(1e30)),
    "gem_one_row": lambda: pixels("gem", 85, width=13, height=1, spp=3),
    "sbf": lambda: pixels("sbf", 90),
    "sbf_varying": lambda: pixels("sbf", 91, varying=True),
    "sbf_gaps": lambda: pixels("sbf", 92, spp=with_gaps(92), features=["albedo"]),
    "sbf_missing": lambda: pixels("sbf", 93, change=lose_values, features=["N", "P", "albedo", "uv"]),
    "sbf_1e-30": lambda: pixels("sbf", 94, change=scaled_radiance(1e-30), features=[]),
    "sbf_second_hit": lambda: pixels("sbf", 95, width=13, height=3, features=["N", "P2", "N2"]),
    "axis_aligned": lambda: shadows(100),
    "axis_aligned_varying": lambda: shadows(101, varying=True, bandwidth=1),
    "axis_aligned_gaps": lambda: shadows(102, spp=with_gaps(102), features=["P", "penumbra"]),
    "axis_aligned_missing": lambda: shadows(103, also=lose_values, bandwidth=0.5),
    "axis_aligned_one_sample": lambda: shadows(104, spp=1, width=40, height=3),
    "axis_aligned_1e30": lambda: shadows(105, also=scaled_radiance(1e30), bandwidth=0.2),
    "axis_aligned_far": lambda: shadows(106, also=move_world),
}

def move_surfaces(channels, rng, counts):
    """Where each point was when the shutter opened, and is when it closes: the near surface is faster, and all turn a little."""
    time, depth = channels["random.time"], channels["feature.P.Z"]
    for axis, speed, turn in (("X", 0.6, 0.1), ("Y", -0.2, 0.15), ("Z", 0.1, -0.05)):
        place, travel = channels["feature.P." + axis], speed / depth
        channels["feature.opening." + axis] = place - time * travel + turn * time * (1 + time)
        channels["feature.closing." + axis] = place + (1 - time) * travel + turn * (1 - time) * (2 - time)


def light_field(seed, also=None, lens=0.3, **keywords):
    """A case of the light field: a camera in the origin that looks along z, y down; also(channels, rng, counts) edits it."""
    def change(channels, rng, counts):
        move_surfaces(channels, rng, counts)
        if also:
            also(channels, rng, counts)
    case = pixels("lightfield", seed, change=change, **{"features": ["P", "opening", "closing"], "random": ["time"], "views": 12, **keywords})
    width, height = case["width"], case["height"]
    to_ndc = [20 / width, 0, 0, 0, 0, 20 / height, 0, 0, 0.5, 0.5, 0, 1, 0, 0, 1, 0]
    to_camera = [1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]
    case["metadata"] = {"worldToCamera": [float(v) for v in to_camera], "worldToNDC": [float(np.float32(v)) for v in to_ndc],
                        "rpf:lensRadius": float(np.float32(lens)), "rpf:focusDistance": 3.0}
    return case


LIGHT_FIELD_CASES = {
    "lightfield": lambda: light_field(120),
    "lightfield_varying": lambda: light_field(121, varying=True),
    "lightfield_gaps": lambda: light_field(122, spp=with_gaps(122)),
    "lightfield_missing": lambda: light_field(123, also=miss_rays),
    "lightfield_weighted": lambda: light_field(124, also=add_weighted_fireflies),
    "lightfield_one_sample": lambda: light_field(125, spp=1, width=40, height=3),
    "lightfield_pinhole": lambda: light_field(126, lens=0),
    "lightfield_many": lambda: light_field(127, spp=40, width=5, height=4),
    "lightfield_1e30": lambda: light_field(128, also=scaled_radiance(1e30)),
}

def lose_lens(channels, rng, counts):
    """NaN for some numbers of the lens and of time; these samples have no place."""
    for name in ("random.lens.U", "random.time"):
        channels[name] = np.where(some(rng, len(channels["R"]), 0.1), np.nan, channels[name])


def no_lens(channels, rng, counts):
    """Neither lens nor time: what is left is the film."""
    still_scene(channels, rng, counts)
    for name in ("random.lens.U", "random.lens.V"):
        del channels[name]


COLUMN_CASES = {
    "multidim": lambda: pixels("multidim", 130, views=12),
    "multidim_varying": lambda: pixels("multidim", 131, varying=True, views=12),
    "multidim_gaps": lambda: pixels("multidim", 132, spp=with_gaps(132), views=12),
    "multidim_missing": lambda: pixels("multidim", 133, change=lose_lens, views=12),
    "multidim_weighted": lambda: pixels("multidim", 134, change=weigh_samples, views=12),
    "multidim_one_sample": lambda: pixels("multidim", 135, spp=1, width=40, height=3, views=12),
    "multidim_film": lambda: pixels("multidim", 136, change=no_lens, views=12),
    "multidim_many": lambda: pixels("multidim", 137, spp=100, width=5, height=4, views=12),
    "multidim_1e30": lambda: pixels("multidim", 138, change=scaled_radiance(1e30), views=12),
}

CASES = {
    "spp1_thesis": lambda: simple(11, spp=1, position_scale=1),
    "spp1_paper": lambda: simple(12, spp=1, position_scale=1, profile="paper", change=still_scene),
    "spp4_thesis": lambda: simple(13, random=["light", "pixel"]),
    "spp4_paper": lambda: simple(14, profile="paper"),
    "spp8_thesis": lambda: simple(15, 9, 7, spp=8),
    "spp8_paper": lambda: simple(16, 9, 7, spp=8, profile="paper", random=["lens"]),
    "spp_varying_thesis": lambda: varying(17, random=["lens"]),
    "spp_varying_paper": lambda: varying(18, profile="paper", random=["light"]),
    "box55": lambda: simple(19, 9, 7, boxes=[55]),
    "bins5": lambda: simple(20, bins=5, profile="paper"),
    "bins9": lambda: simple(21, bins=9),
    "second_hit_reject": lambda: simple(22, features=["N", "P", "albedo", "N2", "P2"], reject_second_hit=True),
    "second_hit_keep": lambda: simple(22, features=["N", "P", "N2", "P2"], random=["light"]),
    "missing_values": lambda: simple(23, profile="paper", change=lose_values, features=["N", "P", "albedo", "uv"]),
    "missed_rays": lambda: simple(24, change=miss_rays, random=["lens"]),
    "missed_rays_unmarked": lambda: simple(25, change=miss_rays_unmarked, position_scale=10),
    "bias_correction": lambda: simple(26, 9, 7, spp=8, profile="paper", bias_correction=True),
    "alpha_factor_5_2": lambda: simple(27, spp=8, alpha_factor=5.2, random=["time"], noise=0.002),
    "samples_factor_2": lambda: simple(28, samples_factor=2.0, redraws=3, noise=0.002),
    "max_samples": lambda: simple(29, profile="paper", max_samples=50, redraws=0,
                                  random=["lens", "time", "light", "pixel"]),
    "sample_weight": lambda: simple(30, change=weigh_samples, features=["N", "P"]),
    "hdr_radiance": lambda: simple(31, profile="paper", change=add_fireflies),
    "world_offset": lambda: simple(32, change=move_world),
    "radiance_1e-30": lambda: simple(35, 9, 7, profile="paper", change=scaled_radiance(1e-30)),
    "radiance_1e30": lambda: simple(35, 9, 7, profile="paper", change=scaled_radiance(1e30)),
    "far_world": lambda: simple(36, 9, 7, change=far_world(1e5)),       # spreads are far above 1e-6 of the magnitude
    "far_small_world": lambda: simple(36, 9, 7, change=far_world(100)),  # many are below, and count as none
    "crowded": lambda: simple(37, 3, 3, spp=crowded(), boxes=[9], samples_factor=18.0, random=["lens"], features=["albedo"]),
    "one_pixel": lambda: simple(33, 1, 1, spp=5, profile="paper", boxes=[5, 3]),
    "one_row": lambda: simple(34, 13, 1, profile="paper", random=["lens", "light"]),
    **FIXED_CASES,
    **PIXEL_CASES,
    **LIGHT_FIELD_CASES,
    **COLUMN_CASES,
}


def make(name):
    """The case of this name."""
    return CASES[name]()
