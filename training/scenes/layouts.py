"""Where a scene takes place: what stands around the objects, how much room they have."""
from dataclasses import dataclass

import numpy as np

import shapes

HOW_OFTEN = {"room": 0.25, "open": 0.25, "cornell": 0.15, "floating": 0.12, "studio": 0.23}
FLOOR = {"diffuse": 0.62, "principled": 0.2, "conductor": 0.03, "plastic": 0.05, "normalmap": 0.05, "bumpmap": 0.05}
WALL = {"diffuse": 0.85, "principled": 0.05, "normalmap": 0.05, "plastic": 0.05}


@dataclass
class Layout:
    kind: str
    half: np.ndarray      # half the extent in x and z that objects may take
    height: float = 3.0
    front: bool = False   # a wall behind the camera
    window: bool = False

    @property
    def indoors(self):
        return self.kind in ("room", "cornell")

    @property
    def closed(self):
        """No light comes from the environment."""
        return self.front and not self.window


def _wall(builder, name, right, up, center, material, repeats):
    """A rectangle; right and up are half its edges, it faces right x up."""
    normal = np.cross(right, up)
    linear = np.stack([right, up, normal / np.linalg.norm(normal)], -1)
    builder.add(name, shapes.quad().moved(linear, center, repeats), material)


def _open_floor(builder, rng, kind):
    size = rng.uniform(6, 25)
    floor = builder.materials.any_of(FLOOR, uv_scale=1.0, plain_chance=0.12)
    _wall(builder, "floor", [size, 0, 0], [0, 0, -size], [0, 0, 0], floor, size * rng.uniform(0.15, 0.8))
    walls = int(rng.integers(1, 3)) if kind == "studio" or rng.random() < 0.3 else 0
    for k in range(walls):
        turn, distance = shapes.turn_about_y(k * np.pi / 2), rng.uniform(3.2, 8)
        half_height, half_width = rng.uniform(1.2, 4), rng.uniform(3, 12)
        material = builder.materials.any_of(WALL, uv_scale=1.0, plain_chance=0.15)
        _wall(builder, f"wall{k}", turn @ [half_width, 0, 0], [0, half_height, 0], turn @ [0, half_height, -distance], material,
              rng.uniform(0.8, 4))
    return Layout(kind, np.full(2, rng.uniform(1.6, 3.6)))


def _wall_with_window(builder, rng, width, depth, height, material):
    """The wall at x = width, in four parts around an opening."""
    z0, z1 = sorted(rng.uniform(-0.8, 0.8, 2) * depth)
    if z1 - z0 < 0.5:
        z0, z1 = -0.3 * depth, 0.3 * depth
    y0, y1 = height * rng.uniform(0.1, 0.45), height * rng.uniform(0.55, 0.95)
    parts = [(-depth, z0, 0, height), (z1, depth, 0, height), (z0, z1, 0, y0), (z0, z1, y1, height)]
    for i, (za, zb, ya, yb) in enumerate(parts):
        _wall(builder, f"window{i}", [0, 0, (zb - za) / 2], [0, (yb - ya) / 2, 0], [width, (ya + yb) / 2, (za + zb) / 2], material,
              (zb - za) / 2)


def _inside(builder, rng, kind):
    """A furnished room, or a Cornell box of plain walls that may be open in front."""
    box = kind == "cornell"
    width, depth = rng.uniform(1.2, 2, 2) if box else rng.uniform(1.8, 4.2, 2)
    height = rng.uniform(2, 3) if box else rng.uniform(2.2, 4)
    wall = lambda: builder.materials.any_of(WALL, uv_scale=1.0, plain_chance=1.0 if box else 0.35)
    repeats = lambda: rng.uniform(0.7, 3)
    y, floor = height / 2, builder.materials.any_of(FLOOR, uv_scale=1.0, plain_chance=0.12)
    _wall(builder, "floor", [width, 0, 0], [0, 0, -depth], [0, 0, 0], floor, repeats())
    _wall(builder, "ceiling", [width, 0, 0], [0, 0, depth], [0, height, 0], wall(), repeats())
    _wall(builder, "back", [width, 0, 0], [0, y, 0], [0, y, -depth], wall(), repeats())
    _wall(builder, "left", [0, 0, -depth], [0, y, 0], [-width, y, 0], wall(), repeats())
    window, front = not box and rng.random() < 0.4, not box or rng.random() < 0.5
    if window:
        _wall_with_window(builder, rng, width, depth, height, wall())
    else:
        _wall(builder, "right", [0, 0, depth], [0, y, 0], [width, y, 0], wall(), repeats())
    if front:
        _wall(builder, "front", [-width, 0, 0], [0, y, 0], [0, y, depth], wall(), repeats())
    return Layout(kind, np.array([width, depth]), height, front, window)


def _floating(builder, rng):
    if rng.random() < 0.6:
        radius = rng.uniform(8, 30)
        hill = shapes.sphere(nu=96, nv=48).moved(np.eye(3) * radius, [0, -radius - rng.uniform(0, 0.8), 0], rng.uniform(8, 30))
        builder.add("hill", hill, builder.materials.any_of(FLOOR, uv_scale=1.0))
    return Layout("floating", np.full(2, rng.uniform(1.6, 3.6)))


def build(builder, kind):
    """Adds what stands around. -> Layout"""
    if kind in ("room", "cornell"):
        return _inside(builder, builder.rng, kind)
    return _floating(builder, builder.rng) if kind == "floating" else _open_floor(builder, builder.rng, kind)
