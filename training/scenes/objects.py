"""The things in a scene: which, how large, where, of what, and which of them move."""
from dataclasses import dataclass

import numpy as np

import plants
import shapes
import textures

# Shape, how often, whether it stands upright, whether it is closed (glass needs that).
SHAPES = {
    "sphere": (shapes.sphere, 4, False, True), "bumpy": (shapes.bumpy, 1.5, False, True),
    "superellipsoid": (shapes.superellipsoid, 2, False, True), "box": (shapes.box, 2.5, False, True),
    "cylinder": (shapes.cylinder, 2, False, True), "vase": (shapes.vase, 1.5, True, False),
    "knot": (shapes.knot, 3, False, True), "blob": (shapes.blob, 2, False, True),
    "stacked": (shapes.stacked_boxes, 1.5, True, False), "stairs": (shapes.stairs, 0.6, True, False),
    "fence": (plants.fence, 1.2, True, False), "grass": (plants.grass, 1.6, True, False),
    "leaves": (plants.leaves, 1.8, False, False), "hair": (plants.hair, 1.2, False, False),
    "rocks": (plants.rocks, 0.8, True, False), "card": (shapes.quad, 2.2, False, False),
}
LARGER = ("leaves", "fence", "knot", "hair")


@dataclass
class Placed:
    name: str
    center: np.ndarray
    size: float


def _orientation(rng, kind, upright):
    if kind == "card":
        return shapes.turn_about_y(rng.uniform(0, 6.3)) @ (np.eye(3) if rng.random() < 0.5 else shapes.any_turn(rng))
    if upright or (kind in ("box", "cylinder") and rng.random() < 0.7):
        return shapes.turn_about_y(rng.uniform(0, 6.3))
    return shapes.any_turn(rng)


def _placed_mesh(rng, kind, layout, size):
    """-> mesh where it belongs, its center"""
    make, _, upright, _ = SHAPES[kind]
    x, z = rng.uniform(-1, 1, 2) * layout.half * (0.8 if layout.indoors else 1)
    if kind == "grass":
        extent = layout.half.min() * rng.uniform(0.5, 1)
        return make(rng, extent).moved(np.eye(3), [0, 0, 0] if rng.random() < 0.7 else [x, 0, z]), np.array([x, 0.1, z])
    stretch = np.ones(3) if rng.random() < 0.5 or kind in ("fence", "rocks", "hair") else rng.uniform(0.5, 1.4, 3)
    linear = _orientation(rng, kind, upright) @ np.diag(stretch * size * (1.3 if kind in LARGER else 1))
    mesh = make(rng).moved(linear)
    y = -mesh.vertices[:, 1].min()
    if layout.kind == "floating" and not upright:
        y = rng.uniform(-1, 1.8)
    elif not upright and rng.random() < 0.25:
        y += rng.uniform(0, 1.6)
    return mesh.moved(np.eye(3), [x, y, z]), np.array([x, y, z])


def _material(builder, kind, pool):
    rng, materials = builder.rng, builder.materials
    if kind == "card":
        return materials.make("diffuse", textures.text if rng.random() < 0.5 else None, 0, float(rng.choice([1, 1, 0.5, 2])))
    if kind in ("grass", "leaves") and rng.random() < 0.7:
        return materials.make(str(rng.choice(["diffuse", "principled"])), textures.leaf, 0, 1.0)
    if kind == "hair" and rng.random() < 0.7:
        return materials.make("principled", textures.wood if rng.random() < 0.5 else None, 0.5, 1.0)
    fitting = [m for m in pool if SHAPES[kind][3] or m.kind != "glass"]
    return fitting[rng.integers(len(fitting))] if fitting else materials.make("diffuse")


def place(builder, layout):
    """Adds 3 to 12 things. -> [Placed], those that cannot move left out"""
    rng, pool = builder.rng, builder.materials.pool()
    often = np.array([entry[1] for entry in SHAPES.values()])
    placed = []
    for i in range(rng.integers(3, 13)):
        kind = str(rng.choice(list(SHAPES), p=often / often.sum()))
        size = np.exp(rng.uniform(np.log(0.18), np.log(0.85))) * (0.75 if layout.indoors else 1)
        mesh, center = _placed_mesh(rng, kind, layout, size)
        builder.add(f"object{i}", mesh, _material(builder, kind, pool))
        if kind != "grass":
            placed.append(Placed(f"object{i}", center, size))
    return placed or [Placed("object0", np.array([0, 0.5, 0]), 1.0)]
