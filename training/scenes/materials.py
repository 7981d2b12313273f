"""BSDFs. Every kind has one form with the same parameters, textures all have one size: so Dr.Jit finds the kernels of earlier
scenes.

Loaded BSDFs count as soon as they exist: a kernel holds one entry for each that is alive in the process.
"""
from dataclasses import dataclass

import mitsuba as mi
import numpy as np
from scipy.ndimage import gaussian_filter

from textures import constant, height_field, hsv, random_color, random_texture

# How often, and the number of BSDF objects that one of the kind is made of.
KINDS = {"diffuse": (0.44, 2), "principled": (0.25, 2), "conductor": (0.11, 2), "plastic": (0.045, 2), "glass": (0.035, 1),
         "normalmap": (0.06, 3), "bumpmap": (0.06, 3)}


@dataclass
class Material:
    kind: str
    bsdf: object
    uv_scale: float


def log_uniform(rng, low, high):
    return float(np.exp(rng.uniform(np.log(low), np.log(high))))


def bitmap(image):
    return {"type": "bitmap", "bitmap": mi.Bitmap(np.ascontiguousarray(image, np.float32)), "raw": True, "wrap_mode": "repeat"}


def metal_color(rng):
    return hsv(rng.choice([0.1, 0.05, 0.6, rng.random()]), rng.uniform(0, 0.6), rng.uniform(0.6, 0.97))


def _two_sided(bsdf):
    return {"type": "twosided", "bsdf": bsdf}


def _diffuse(rng, color):
    return {"type": "diffuse", "reflectance": bitmap(color)}


def _principled(rng, color, metallic=None, roughness=(0.12, 0.75)):
    metallic = rng.choice([0.0, 0.0, 1.0, rng.random()]) if metallic is None else metallic
    if metallic > 0.6 and rng.random() < 0.6:
        color = constant(metal_color(rng))
    return {"type": "principled", "base_color": bitmap(color), "roughness": float(rng.uniform(*roughness)),
            "metallic": max(float(metallic), 1e-3), "specular": float(rng.uniform(0.3, 0.9))}


def _conductor(rng, color):
    return {"type": "roughconductor", "material": "none", "distribution": "ggx", "alpha": log_uniform(rng, 0.09, 0.45),
            "specular_reflectance": bitmap(constant(metal_color(rng)) if rng.random() < 0.7 else color)}


def _plastic(rng, color):
    return {"type": "plastic", "diffuse_reflectance": bitmap(color), "nonlinear": False}


def _normalmap(rng, color):
    height = gaussian_filter(height_field(rng), rng.uniform(0.5, 2), mode="wrap") * rng.uniform(2, 10)
    slope = [(np.roll(height, 1, axis) - np.roll(height, -1, axis)) / 2 for axis in (1, 0)]
    normal = np.stack([*slope, np.ones_like(height)], -1)
    normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
    return {"type": "normalmap", "normalmap": bitmap(normal * 0.5 + 0.5), "bsdf": _diffuse(rng, color)}


def _bumpmap(rng, color):
    height = np.repeat(height_field(rng)[..., None], 3, -1) * rng.uniform(0.02, 0.25)
    return {"type": "bumpmap", "arbitrary": bitmap(height), "scale": 1.0, "bsdf": _principled(rng, color, 0, (0.2, 0.6))}


def _description(rng, kind, color):
    if kind == "glass":
        return {"type": "dielectric", "int_ior": 1.5}
    make = {"diffuse": _diffuse, "principled": _principled, "conductor": _conductor, "plastic": _plastic, "normalmap": _normalmap,
            "bumpmap": _bumpmap}
    return _two_sided(make[kind](rng, color))


class Materials:
    """All BSDFs of one scene. plain: nothing has a texture."""

    ALIVE = 60  # BSDF objects in every scene, with those that nothing uses

    def __init__(self, rng, plain):
        self.rng, self.plain, self.objects, self.kept = rng, plain, 0, []
        for kind in KINDS:  # one of each kind, seen or not
            self.make(kind, color=constant((0.5, 0.5, 0.5)))
        self.black = self.make("diffuse", color=constant((0, 0, 0)))
        self.unused = len(self.kept)

    def used(self):
        return self.kept[self.unused:]

    def make(self, kind, pattern=None, plain_chance=0.3, uv_scale=None, color=None):
        rng = self.rng
        if color is None:
            plain = self.plain or (pattern is None and rng.random() < plain_chance)
            color = constant(random_color(rng)) if plain else random_texture(rng, pattern)
        self.objects += KINDS[kind][1]
        material = Material(kind, mi.load_dict(_description(rng, kind, color), optimize=False),
                            log_uniform(rng, 0.5, 4) if uv_scale is None else uv_scale)
        self.kept.append(material)
        return material

    def any_of(self, kinds, **how):
        """One of kinds, a dictionary from kind to how often."""
        return self.make(str(self.rng.choice(list(kinds), p=np.array(list(kinds.values())) / sum(kinds.values()))), **how)

    def pool(self):
        """A few materials of few kinds that the objects of a scene share."""
        rng, often = self.rng, np.array([often for often, _ in KINDS.values()])
        kinds = sorted(set(rng.choice(list(KINDS), int(rng.integers(2, 5)), p=often / often.sum())))
        return [self.any_of({str(k): KINDS[k][0] ** 0.6 for k in kinds}) for _ in range(rng.integers(4, 9))]

    def pad(self):
        """To be called last: as many objects as in any other scene."""
        if self.objects > self.ALIVE:
            raise RuntimeError(f"{self.objects} BSDFs, room for {self.ALIVE}")
        while self.objects < self.ALIVE:
            self.make("glass", color=0)
