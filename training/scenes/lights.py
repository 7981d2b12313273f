"""What lights a scene: rectangles and spheres, something that glows, the environment."""
import numpy as np

import environments
import shapes
from builder import LIGHTS
from materials import log_uniform
from textures import constant, hsv, random_texture

ENVIRONMENTS = {"room": ("sky", "sunny", "constant", "cloudy"), "cornell": ("constant", "colorful"),
                "open": ("constant", "sky", "sunny", "sunny", "cloudy", "studio", "colorful"),
                "floating": ("sky", "sunny", "cloudy", "studio", "colorful"), "studio": ("constant", "sky", "studio", "colorful")}
GLOWING = (shapes.sphere, shapes.quad, shapes.superellipsoid, shapes.stacked_boxes, lambda rng: shapes.knot(rng, 0.5))


def _size(rng, sharp):
    """Half an edge. Small lights make hard shadows, and fireflies where glass or gloss finds them by chance."""
    return log_uniform(rng, 0.02, 0.1) if sharp and rng.random() < 0.2 else log_uniform(rng, 0.15, 1.1)


def _place(rng, layout, size):
    """-> where a light is, what it faces, its size"""
    if layout.indoors:
        height = layout.height * (rng.uniform(0.93, 0.985) if rng.random() < 0.65 else rng.uniform(0.3, 0.9))
        x, z = rng.uniform(-0.8, 0.8, 2) * layout.half
        center = np.array([x, height, z])
        return center, center - [rng.normal(0, 0.15), 1, rng.normal(0, 0.15)], 0.75 * size
    if rng.random() < 0.2:  # a lamp among the objects
        x, z = rng.uniform(-1, 1, 2) * layout.half
        return np.array([x, rng.uniform(0.3, 1.8), z]), rng.normal(0, 0.6, 3), min(size, 0.12)
    toward = shapes.direction(rng.uniform(0, 2 * np.pi), np.radians(rng.uniform(15, 88)))
    return toward * rng.uniform(2.5, 7), rng.normal(0, 0.6, 3), size


def _add_light(builder, index, layout, sharp):
    rng = builder.rng
    color = np.array([1, 0.95, 0.85]) if rng.random() < 0.4 else hsv(rng.random(), rng.uniform(0, 0.6), 1)
    center, target, size = _place(rng, layout, _size(rng, sharp))
    strength = log_uniform(rng, 0.8, 5) * (0.7 if layout.indoors else 1) * max(np.square(center - [0, 0.5, 0]).sum(), 0.6)
    if rng.random() < 0.35:
        size = min(size, 0.5)
        if layout.indoors:
            center[1] = min(center[1], layout.height - 1.2 * size)
        builder.add_sphere_light(index, center, size, color * strength / (np.pi * size**2))
    else:
        other = size * rng.uniform(0.3, 1.5)
        forward = shapes.unit(target - center)
        left = shapes.unit(np.cross([0.01, 0.03, 1], forward))
        axes = np.stack([left, np.cross(forward, left), forward], -1)
        builder.add_rectangle_light(index, axes @ np.diag([size, other, 1]), center, color * strength / (4 * size * other))


def _add_glow(builder, placed):
    rng = builder.rng
    center = placed[rng.integers(len(placed))].center + rng.normal(0, 0.5, 3) * [1, 0, 1] + [0, rng.uniform(0.2, 0.8), 0]
    mesh = GLOWING[rng.integers(len(GLOWING))](rng).moved(shapes.any_turn(rng) * rng.uniform(0.06, 0.35), center)
    image = random_texture(rng) if rng.random() < 0.6 else constant(hsv(rng.random(), rng.uniform(0, 0.7), 1))
    builder.add_glow(mesh, image * log_uniform(rng, 1.5, 30))


def _environment_gain(rng, layout, lights):
    if layout.closed:
        return 0.5
    if layout.window:
        return rng.uniform(3, 15)
    return log_uniform(rng, 0.02, 0.6) if lights and layout.kind != "room" else rng.uniform(0.5, 1.2)


def light(builder, layout, placed):
    """Adds all light. -> facts for the file"""
    rng = builder.rng
    kind = str(rng.choice(ENVIRONMENTS[layout.kind]))
    few = layout.kind == "floating" or (layout.kind == "open" and rng.random() < 0.5)
    lights = int(rng.integers(0, 2)) if few else int(rng.integers(1, LIGHTS + 1))
    sharp = not any(m.kind in ("glass", "plastic") for m in builder.materials.used())
    for i in range(lights):
        _add_light(builder, i, layout, sharp)
    glows = rng.random() < 0.25
    if glows:
        _add_glow(builder, placed)
    image = environments.environment(rng, kind, _environment_gain(rng, layout, lights))
    builder.set_environment(image, rng.uniform(0, 360), 0 if layout.closed else 1)
    return {"environment": kind, "lights": lights, "glow": int(glows)}
