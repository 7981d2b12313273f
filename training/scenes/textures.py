"""Reflectances that tile: [SIZE, SIZE, 3] float32, linear, in [0.01, 0.95]. All of one size, so that kernels are compiled once."""
from functools import lru_cache
from pathlib import Path

import numpy as np
from scipy.ndimage import map_coordinates, zoom
from scipy.spatial import cKDTree

SIZE = 256
_V, _U = np.meshgrid(*[(np.arange(SIZE) + 0.5) / SIZE] * 2, indexing="ij")
LETTERS = "abcdefghijklmnopqrstuvwxyz      ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789.,;"


def hsv(hue, saturation, value):
    """A color, linear RGB."""
    k = (np.array([5, 3, 1]) + hue * 6) % 6
    return value * (1 - saturation * np.clip(np.minimum(k, 4 - k), 0, 1))


def random_color(rng, darkest=0.05, brightest=0.9):
    saturation = rng.choice([0, rng.uniform(0.1, 0.5), rng.uniform(0.5, 1)])
    return np.clip(hsv(rng.random(), saturation, darkest * (brightest / darkest) ** rng.random() ** 0.6), 0.01, 0.95)


def noise(rng, octaves, cells):
    """Value noise that tiles, in [0, 1]; cells across at the first octave."""
    total, weights = np.zeros((SIZE, SIZE)), 0.0
    for octave in range(octaves):
        n = min(cells << octave, SIZE)
        total += 0.6**octave * zoom(rng.random((n, n)), SIZE / n, order=1, mode="grid-wrap", grid_mode=True)
        weights += 0.6**octave
    return total / weights


def _mixed(mask, a, b):
    mask = np.asarray(mask, float)[..., None]
    return mask * a + (1 - mask) * b


def checker(rng):
    n = rng.choice([8, 16, 32])
    squares = (np.floor(_U * n) + np.floor(_V * n)) % 2
    return _mixed(squares, random_color(rng), random_color(rng)) * (0.6 + 0.8 * noise(rng, 5, 16)[..., None])


def wood(rng):
    rings = 0.5 + 0.5 * np.sin(2 * np.pi * (_V * rng.integers(6, 20) + 3 * noise(rng, 5, 4)))
    return hsv(0.07, 0.7, 0.5) * (0.45 + 0.75 * rings[..., None]) * (0.7 + 0.6 * noise(rng, 2, 128)[..., None])


def stripes(rng):
    across, along = np.floor(_U * rng.choice([10, 20, 40])) % 2, np.floor(_V * 10) % 2
    return _mixed(across, random_color(rng), random_color(rng)) * (1 - 0.4 * along[..., None])


def colored_noise(rng):
    cells = int(rng.choice([4, 8, 32]))
    return (np.stack([noise(rng, 6, cells) for _ in range(3)], -1) - 0.3) * 2.2


def leaf(rng):
    veins = noise(rng, 6, 8)
    return (_mixed(veins, hsv(0.18, 0.8, 0.55), hsv(0.28, 0.8, 0.28)) - 0.18) * 1.8 + 0.18


def _cells(rng, n):
    """Nearest of n^2 scattered points: its index and the distance to the border, in cells."""
    points = (np.stack(np.meshgrid(np.arange(n), np.arange(n)), -1).reshape(-1, 2) + rng.random((n * n, 2))) / n
    copies = np.concatenate([points + (x, y) for x in (0, -1, 1) for y in (0, -1, 1)])
    distance, index = cKDTree(copies).query(np.stack([_U, _V], -1).reshape(-1, 2), k=2)
    return index[:, 0] % (n * n), (distance[:, 1] - distance[:, 0]) * n


def gravel(rng):
    n = int(rng.choice([12, 30, 60]))
    index, border = _cells(rng, n)
    colors = rng.random((n * n, 1)) * 0.5 + 0.2 + rng.choice([0.1, 0.6]) * (rng.random((n * n, 3)) - 0.5)
    return (colors[index] * np.clip(border * 3, 0.15, 1)[:, None]).reshape(SIZE, SIZE, 3)


def bricks(rng):
    n, mortar = int(rng.choice([4, 8, 14])), rng.uniform(0.05, 0.1)
    row = np.floor(_V * 2 * n).astype(int)
    x = _U * n + (row % 2) * 0.5
    joint = (x % 1 < mortar / 2) | ((_V * 2 * n) % 1 < mortar)
    tone = rng.random((2 * n, n))[row, np.floor(x).astype(int) % n]
    stone = hsv(rng.uniform(0, 0.1), 0.7, 0.5) * (0.5 + 0.8 * tone * (0.7 + 0.5 * noise(rng, 3, 32)))[..., None]
    return _mixed(joint, 0.6, stone)


def text(rng):
    """A page of letters: an albedo that no filter may smear."""
    from PIL import Image, ImageDraw, ImageFont
    size, dark = int(rng.choice([9, 14, 22, 40])), rng.random() < 0.3
    some_gray = lambda low, high: tuple(int(v) for v in rng.integers(low, high, 3))
    paper, ink = (some_gray(20, 70), some_gray(180, 255)) if dark else (some_gray(190, 255), some_gray(0, 90))
    page = Image.new("RGB", (SIZE, SIZE), paper)
    draw, font = ImageDraw.Draw(page), ImageFont.load_default(size=size)
    for y in range(2, SIZE, int(size * 1.15)):
        draw.text((3, y), "".join(rng.choice(list(LETTERS)) for _ in range(80)), fill=ink, font=font)
    return (np.asarray(page) / 255.0) ** 2.2


def dots(rng):
    n, radius = rng.choice([6, 16, 40]), rng.uniform(0.2, 0.4)
    return _mixed(np.hypot((_U * n) % 1 - 0.5, (_V * n) % 1 - 0.5) < radius, random_color(rng), random_color(rng))


def grid(rng):
    n = rng.choice([10, 20, 40])
    return _mixed(((_U * n) % 1 < 0.1) | ((_V * n) % 1 < 0.1), random_color(rng), random_color(rng))


def zigzag(rng):
    n = rng.choice([8, 16, 28])
    return _mixed((_V * n + np.abs((_U * n) % 2 - 1)) % 1 < 0.5, random_color(rng), random_color(rng))


def marble(rng):
    veins = 0.5 + 0.5 * np.sin(2 * np.pi * (_U * rng.integers(1, 4) + 4 * noise(rng, 6, 4)))
    return 0.15 + 0.7 * (veins**0.35)[..., None] * np.array([1, 0.97, 0.9])


def rings(rng):
    distance = np.hypot(_U - 0.5, _V - 0.5) + 0.08 * noise(rng, 5, 6)
    return _mixed(0.5 + 0.5 * np.sin(distance * 2 * np.pi * rng.choice([10, 35])), random_color(rng), random_color(rng))


def clouds(rng):
    """Warped noise of many scales with steps in it: like a photo, but of nothing."""
    y, x = [(c + 0.4 * (noise(rng, 4, 4) - 0.5)) * SIZE for c in (_V, _U)]
    base = np.stack([noise(rng, 7, 4) for _ in range(3)], -1)
    base = base * 0.5 + base.mean(-1, keepdims=True) * 0.5
    warped = np.stack([map_coordinates(base[..., c], [y, x], order=1, mode="grid-wrap") for c in range(3)], -1)
    warped = (warped - warped.min()) / np.ptp(warped)
    steps = np.floor(warped.mean(-1, keepdims=True) * 6) / 6
    return np.clip(warped * 0.6 + (steps - 0.5) * 0.6 + 0.15, 0.02, 0.95) ** 1.5


def gradient(rng):
    return _mixed(0.5 + 0.5 * np.sin(2 * np.pi * _V), random_color(rng), random_color(rng)) * (0.5 + 0.5 * _U[..., None])


def mosaic(rng):
    n = int(rng.choice([8, 16, 32]))
    return np.kron(rng.random((n, n, 3)) ** 1.5, np.ones((SIZE // n, SIZE // n, 1))) * 0.85


def speckle(rng):
    return _mixed(noise(rng, 1, 128) > 0.72, random_color(rng), random_color(rng))


@lru_cache(maxsize=None)
def _photos():
    """Photos that scikit-image installs (free to use, see its data/README.txt), linear."""
    import skimage
    from PIL import Image
    names = ("astronaut", "chelsea", "coffee", "rocket", "brick", "grass", "gravel", "camera", "motorcycle_left")
    files = [f for f in sorted(Path(skimage.__file__).parent.joinpath("data").glob("*.*g")) if f.stem in names]
    return [(np.asarray(Image.open(f).convert("RGB").resize((SIZE, SIZE))) / 255.0) ** 2.2 for f in files]


def photo(rng):
    return _photos()[rng.integers(len(_photos()))]


PATTERNS = (checker, wood, stripes, colored_noise, leaf, gravel, bricks, text, dots, grid, zigzag, marble, rings, clouds, gradient,
            mosaic, speckle, photo)


def constant(color):
    return np.ones((SIZE, SIZE, 3), np.float32) * np.asarray(color, np.float32)


def random_texture(rng, pattern=None):
    """A pattern as it is, tinted, in two colors of its own, or with channels permuted."""
    image = np.broadcast_to((PATTERNS[rng.integers(len(PATTERNS))] if pattern is None else pattern)(rng), (SIZE, SIZE, 3))
    image, change = np.clip(image, 0.01, 0.95), rng.random()
    if 0.4 < change < 0.6:
        image = image * (random_color(rng, 0.3, 1) / max(image.mean(), 0.2) * 0.5)
    elif 0.6 < change < 0.85:
        tone = image.mean(-1)
        image = _mixed((tone - tone.min()) / max(np.ptp(tone), 1e-3), random_color(rng), random_color(rng))
    elif change > 0.85:
        image = image[..., rng.permutation(3)]
    if rng.random() < 0.3:
        image = np.clip(image, 0.01, 0.95) ** rng.uniform(0.6, 1.8)
    return np.ascontiguousarray(np.clip(np.rot90(image) if rng.random() < 0.5 else image, 0.01, 0.95), np.float32)


def height_field(rng):
    """[SIZE, SIZE] in [0, 1], for bumps."""
    tone = random_texture(rng).mean(-1)
    return (tone - tone.min()) / max(np.ptp(tone), 1e-3)
