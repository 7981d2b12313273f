"""Light from all around: [64, 128, 3] of a mean luminance of about 1, the sun excepted."""
import numpy as np
from scipy.ndimage import gaussian_filter

from textures import hsv

HEIGHT, WIDTH = 64, 128
_THETA = (np.arange(HEIGHT)[:, None] + 0.5) / HEIGHT * np.pi
_PHI = (np.arange(WIDTH)[None, :] + 0.5) / WIDTH * 2 * np.pi
_DIRECTION = np.stack(np.broadcast_arrays(np.sin(_THETA) * np.sin(_PHI), np.cos(_THETA), -np.sin(_THETA) * np.cos(_PHI)), -1)
_UP = _DIRECTION[..., 1:2]
_SOLID_ANGLE = np.sin(_THETA) * (np.pi / HEIGHT) * (2 * np.pi / WIDTH) * np.ones((1, WIDTH))


def _blurred_noise(rng, sizes):
    return sum(s * gaussian_filter(rng.normal(size=(HEIGHT, WIDTH)), s, mode=("nearest", "wrap")) for s in sizes)


def constant(rng):
    return np.ones((HEIGHT, WIDTH, 3)) * hsv(rng.choice([0.6, 0.1, rng.random()]), rng.uniform(0, 0.5), 1)


def sky(rng):
    zenith = hsv(rng.uniform(0.52, 0.68), rng.uniform(0.2, 0.75), rng.uniform(0.4, 1))
    horizon = hsv(rng.choice([0.08, 0.6]), rng.uniform(0, 0.4), rng.uniform(0.6, 1.3))
    ground = hsv(rng.uniform(0.05, 0.15), rng.uniform(0, 0.4), rng.uniform(0.05, 0.4))
    t = np.clip(_UP, 0, 1) ** rng.uniform(0.3, 1)
    return np.where(_UP >= 0, horizon * (1 - t) + zenith * t, ground)


def cloudy(rng):
    cover = _blurred_noise(rng, (1, 2.5, 6))
    cover = np.clip(cover / cover.std() * 0.7 + rng.uniform(-0.3, 0.5), 0, 1)[..., None] * (_UP > 0)
    return sky(rng) * (1 - cover) + cover * rng.uniform(0.8, 1.6)


def sunny(rng):
    """A sun of 1 to 10 degrees, with 1 to 8 times the light of a white sky."""
    elevation, azimuth = np.radians(rng.uniform(8, 75)), rng.uniform(0, 2 * np.pi)
    sun = np.array([np.cos(elevation) * np.sin(azimuth), np.sin(elevation), np.cos(elevation) * np.cos(azimuth)])
    cosine = _DIRECTION @ sun
    disk = cosine >= min(np.cos(np.radians(rng.choice([1.2, 2, 4, 10]))), cosine.max())
    radiance = rng.uniform(1, 8) / (_SOLID_ANGLE * disk).sum()
    light = sky(rng) * rng.uniform(0.3, 1) + 0.3 * np.exp((cosine - 1) * 40)[..., None]
    return light + disk[..., None] * radiance * hsv(0.1, rng.uniform(0, 0.5), 1)


def studio(rng):
    """Softboxes in the dark."""
    light = np.full((HEIGHT, WIDTH, 3), rng.uniform(0.02, 0.2))
    for _ in range(rng.integers(2, 6)):
        from_left = np.abs((_PHI - rng.uniform(0, 2 * np.pi) + np.pi) % (2 * np.pi) - np.pi)
        lit = (from_left < rng.uniform(0.08, 0.6)) & (np.abs(_THETA - rng.uniform(0.2, 1.7)) < rng.uniform(0.08, 0.5))
        light = light + lit[..., None] * hsv(rng.random(), rng.uniform(0, 0.5), 1) * rng.uniform(1, 12)
    return light


def colorful(rng):
    light = np.stack([_blurred_noise(rng, (1.5, 4, 10)) for _ in range(3)], -1)
    light = 0.6 * light + 0.6 * light.mean(-1, keepdims=True)
    return np.exp(light / light.std() * rng.uniform(0.5, 1.2))


KINDS = {"constant": constant, "sky": sky, "cloudy": cloudy, "sunny": sunny, "studio": studio, "colorful": colorful}


def environment(rng, kind, gain):
    light = KINDS[kind](rng)
    if kind != "sunny":
        light = light * (0.5 / light.mean())
    return np.maximum(light * gain, 1e-4).astype(np.float32)
