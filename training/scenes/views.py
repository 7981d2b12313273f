"""Looks for a good view of a scene, then opens the lens or lets something move."""
import numpy as np

import acceptance
import shapes
from camera import View, look_at, preview
from materials import log_uniform

MODES = {"lens": 0.5, "camera motion": 0.15, "object motion": 0.15, "pinhole": 0.2}
PROPOSALS = 24
WIDEST_BLUR = 30     # of the circle of confusion, in pixels of a picture 128 wide
FARTHEST_MOTION = 20
LENS_OF_NEAREST = 0.08
NOMINAL_WIDTH = 128


def _propose(rng, layout, placed):
    center = placed[rng.integers(len(placed))].center
    target = center * rng.uniform(0.3, 1) + rng.normal(0, 0.25, 3)
    if layout.kind != "floating":
        target[1] = max(target[1], 0.05)
    x, z = layout.half
    if layout.kind == "room":
        origin = np.array([rng.uniform(-0.88, 0.88) * x, rng.uniform(0.25, 0.85) * layout.height, rng.uniform(-0.88, 0.88) * z])
    elif layout.kind == "cornell":
        distance = z * (0.93 if layout.front else rng.uniform(1.2, 2.4))
        origin = np.array([rng.uniform(-0.4, 0.4) * x, rng.uniform(0.35, 0.65) * layout.height, distance])
        target = 0.5 * target + [0, 0.2 * layout.height, -0.3 * z]
    else:
        from_above = rng.random() < 0.15
        elevation = np.radians(rng.uniform(50, 80) if from_above else rng.uniform(4, 50))
        origin = target + rng.uniform(1.6, 6.5) * shapes.direction(rng.uniform(0, 2 * np.pi), elevation)
    up = np.array([rng.normal(0, 0.12), 1, rng.normal(0, 0.12)])
    return View(look_at(origin, target, up), origin, float(rng.uniform(28, 72)))


def find(rng, scene, camera, layout, placed):
    """The best of some views that acceptance lets pass. -> View, Preview; None if there is none"""
    best, wanted = None, int(rng.integers(4, 10))
    for _ in range(PROPOSALS):
        view = _propose(rng, layout, placed)
        camera.look(view)
        seen = preview(scene, camera)
        score = acceptance.view_score(seen)
        if score is None:
            continue
        score += rng.normal(0, 0.7)
        if best is None or score > best[0]:
            best = (score, view, seen)
        wanted -= 1
        if wanted == 0:
            break
    return best and best[1:]


def open_lens(rng, view, seen):
    """Focuses near something that is seen; the blur of the farthest tenth is 0 to WIDEST_BLUR pixels."""
    depth = seen.depth[seen.hit]
    view.focus = float(np.clip(rng.choice(depth) * np.exp(rng.normal(0, 0.12)), 0.25, 30))
    defocus = np.percentile(np.abs(1 / depth - 1 / view.focus), 90)
    blur = WIDEST_BLUR * rng.random() ** 1.7
    view.aperture = float(min(blur * view.half_width() / (NOMINAL_WIDTH * max(defocus, 1e-3)),
                              LENS_OF_NEAREST * np.percentile(depth, 25)))


def pixel_at(view, depth):
    """Size of a nominal pixel at that depth."""
    return 2 * depth * view.half_width() / NOMINAL_WIDTH


def move_camera(rng, view, seen):
    depth, angle = seen.depth[seen.hit], rng.uniform(0, 2 * np.pi)
    direction = view.axes @ [np.cos(angle), 0.5 * np.sin(angle), rng.normal(0, 0.3)]
    velocity = direction * log_uniform(rng, 1, FARTHEST_MOTION) * pixel_at(view, np.median(depth))
    farthest = 1.7 * FARTHEST_MOTION * pixel_at(view, np.percentile(depth, 3))
    view.velocity = velocity * min(1, farthest / np.linalg.norm(velocity))


def move_objects(rng, view, placed):
    """Velocity and turn (about its center, in radians) of some things during one shutter interval. -> [(Placed, velocity, turn)]"""
    moving = []
    for thing in rng.permutation(np.array(placed, dtype=object))[:rng.integers(1, 4)]:
        depth = max((thing.center - view.origin) @ view.axes[:, 2], 0.5)
        direction = shapes.unit(view.axes @ [rng.normal(), 0.6 * rng.normal(), 0.4 * rng.normal()])
        velocity = direction * log_uniform(rng, 2, FARTHEST_MOTION) * pixel_at(view, depth)
        moving.append((thing, velocity, rng.uniform(-0.6, 0.6) if rng.random() < 0.4 else 0.0))
    return moving
