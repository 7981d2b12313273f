"""Many thin things: fences, rocks, grass, leaves, hair. What averages of features know least about."""
import numpy as np

from shapes import Mesh, any_turn, box, joined, revolved, smooth_normals, sphere, unit


def fence(rng):
    """Pickets, round or square."""
    n, width, square = int(rng.integers(8, 22)), rng.uniform(0.015, 0.05), rng.random() < 0.5
    round_picket = revolved(np.array([[1.0, -1], [1, 1]]), np.array([[1.0, 0], [1, 0]]), 12)
    pickets = []
    for i in range(n):
        height = rng.uniform(0.7, 1.1)
        lean = np.array([[width, rng.normal(0, 0.03), 0], [0, height, 0], [0, rng.normal(0, 0.03), width]])
        pickets.append((box() if square else round_picket).moved(lean, [4 * (i + 0.5) / n - 2, height - 1, rng.normal(0, 0.05)]))
    return joined(pickets)


def rocks(rng):
    stone = lambda: sphere(nu=10, nv=6).moved(any_turn(rng) @ np.diag(rng.uniform(0.04, 0.14, 3)), [*rng.normal(0, 0.8, 2), 0])
    parts = [stone() for _ in range(rng.integers(10, 60))]
    return joined([Mesh(p.vertices[:, [0, 2, 1]] + [0, 0.05, 0], p.faces[:, ::-1], p.normals[:, [0, 2, 1]], p.uv) for p in parts])


def _blades(root, side, middle, tip, rng):
    """Ribbons of five vertices each, [n, 3] points; every ribbon has its own place in the texture."""
    n = len(root)
    vertices = np.stack([root - side, root + side, middle - 0.7 * side, middle + 0.7 * side, tip], 1).reshape(-1, 3)
    first = np.arange(n)[:, None] * 5
    faces = np.concatenate([first + [0, 1, 3], first + [0, 3, 2], first + [2, 3, 4]])
    across, along = np.tile([0, 1, 0, 1, 0.5], n), np.tile([0, 0, 0.6, 0.6, 1], n)
    uv = 0.15 * np.stack([across, along], -1) + np.repeat(rng.random((n, 2)), 5, 0)
    return Mesh(vertices, faces, smooth_normals(vertices, faces), uv)


def grass(rng, extent=1.0):
    """Blades on the ground y = 0, |x|, |z| <= extent."""
    n, height, width = int(rng.integers(300, 2600)), rng.uniform(0.15, 0.7), rng.uniform(0.015, 0.05)
    ground = lambda x, y, z: np.stack(np.broadcast_arrays(x, y, z), -1)
    x, z = rng.uniform(-extent, extent, (2, n))
    angle, tall = rng.uniform(0, np.pi, n), height * rng.uniform(0.5, 1.3, n)
    lean_x, lean_z = rng.normal(0, 0.35, (2, n)) * tall
    root = ground(x, 0.0, z)
    side = ground(np.cos(angle), 0.0, np.sin(angle)) * width / 2
    bend = ground(0.35 * lean_x, 0.6 * tall, 0.35 * lean_z)
    return _blades(root, side, root + bend, root + ground(lean_x, tall, lean_z), rng)


def hair(rng):
    """A ball of fur: thin ribbons that grow from a sphere and hang."""
    n, length, width = int(rng.integers(1500, 5000)), rng.uniform(0.25, 0.7), rng.uniform(0.006, 0.02)
    out = unit(rng.normal(size=(n, 3)))
    droop = np.array([0, -rng.uniform(0, 0.6), 0]) + rng.normal(0, 0.12, (n, 3))
    root, grown = 0.6 * out, length * rng.uniform(0.7, 1.2, (n, 1))
    side = unit(np.cross(out, rng.normal(size=(n, 3)))) * width / 2
    return _blades(root, side, root + grown * (0.55 * out + 0.2 * droop), root + grown * (0.9 * out + 0.8 * droop), rng)


def leaves(rng):
    """Leaves in a ball, turned any way."""
    n, length = int(rng.integers(300, 2500)), rng.uniform(0.04, 0.16)
    center = unit(rng.normal(size=(n, 3))) * rng.random((n, 1)) ** (1 / 3)
    along = unit(rng.normal(size=(n, 3)))
    across = 0.4 * unit(np.cross(along, rng.normal(size=(n, 3))))
    vertices = np.stack([center - length * along, center + length * across, center + length * along, center - length * across], 1)
    vertices, first = vertices.reshape(-1, 3), np.arange(n)[:, None] * 4
    faces = np.concatenate([first + [0, 1, 2], first + [0, 2, 3]])
    uv = 0.2 * np.tile([[0, 0.5], [0.5, 1], [1, 0.5], [0.5, 0]], (n, 1)) + np.repeat(rng.random((n, 2)), 4, 0)
    return Mesh(vertices, faces, smooth_normals(vertices, faces), uv)
