"""Solid shapes of about unit size around the origin, as triangle meshes."""
from typing import NamedTuple

import numpy as np


class Mesh(NamedTuple):
    vertices: np.ndarray  # [n, 3]
    faces: np.ndarray     # [m, 3]
    normals: np.ndarray   # [n, 3]
    uv: np.ndarray        # [n, 2]

    def moved(self, linear, offset=(0, 0, 0), uv_scale=1.0):
        """The mesh under x -> linear x + offset."""
        linear = np.asarray(linear, float)
        normals = unit(self.normals @ np.linalg.inv(linear))
        faces = self.faces if np.linalg.det(linear) > 0 else self.faces[:, ::-1]
        return Mesh(self.vertices @ linear.T + np.asarray(offset), faces, normals, self.uv * uv_scale)


def unit(vectors):
    return vectors / np.maximum(np.linalg.norm(vectors, axis=-1, keepdims=True), 1e-12)


def joined(meshes):
    starts = np.cumsum([0] + [len(m.vertices) for m in meshes])
    return Mesh(np.concatenate([m.vertices for m in meshes]), np.concatenate([m.faces + k for m, k in zip(meshes, starts)]),
                np.concatenate([m.normals for m in meshes]), np.concatenate([m.uv for m in meshes]))


def turn_about_y(angle):
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]])


def direction(azimuth, elevation):
    """Unit vector, elevation above the plane y = 0; angles in radians."""
    return np.array([np.cos(azimuth) * np.cos(elevation), np.sin(elevation), np.sin(azimuth) * np.cos(elevation)])


def any_turn(rng):
    q, _ = np.linalg.qr(rng.normal(size=(3, 3)))
    return q * np.sign(np.linalg.det(q))


def smooth_normals(vertices, faces, weld=False):
    """Normals from the faces around a vertex; weld joins vertices at the same place (seams of a sphere)."""
    owner = np.unique(np.round(vertices, 5), axis=0, return_inverse=True)[1].ravel() if weld else np.arange(len(vertices))
    a, b, c = (vertices[faces[:, k]] for k in range(3))
    normals = np.zeros_like(vertices)
    for k in range(3):
        np.add.at(normals, owner[faces[:, k]], np.cross(b - a, c - a))
    return unit(normals[owner])


def lattice(vertices, normals, uv):
    """Mesh of a grid of points [nu + 1, nv + 1, ...]."""
    nu, nv = vertices.shape[0] - 1, vertices.shape[1] - 1
    corner = (np.arange(nu)[:, None] * (nv + 1) + np.arange(nv)).ravel()
    faces = np.concatenate([np.stack([corner, corner + nv + 1, corner + nv + 2], -1),
                            np.stack([corner, corner + nv + 2, corner + 1], -1)])
    return Mesh(vertices.reshape(-1, 3), faces, normals.reshape(-1, 3), uv.reshape(-1, 2))


def _angles(nu, nv):
    return np.meshgrid(np.linspace(-np.pi, np.pi, nu + 1), np.linspace(-np.pi / 2, np.pi / 2, nv + 1), indexing="ij")


def superellipsoid(rng, exponents=None, nu=56, nv=28):
    """Between a box, a sphere, a cylinder and a star (Barr 1981)."""
    e1, e2 = rng.uniform(0.25, 1.6, 2) if exponents is None else exponents
    longitude, latitude = _angles(nu, nv)
    power = lambda x, e: np.sign(x) * np.abs(x) ** e
    point = lambda s, t: np.stack([power(np.cos(latitude), s) * power(np.cos(longitude), t), power(np.sin(latitude), s),
                                   -power(np.cos(latitude), s) * power(np.sin(longitude), t)], -1)
    vertices = point(e1, e2)
    normals = unit(point(2 - e1, 2 - e2) + 1e-6 * vertices)
    return lattice(vertices, normals, np.stack([longitude / np.pi, latitude / np.pi + 0.5], -1))


def sphere(rng=None, nu=48, nv=24):
    return superellipsoid(rng, (1, 1), nu, nv)


def bumpy(rng):
    """A sphere with hills."""
    ball = sphere(nu=72, nv=36)
    waves = np.sin(ball.vertices @ rng.normal(0, rng.uniform(2, 6), (5, 3)).T + rng.uniform(0, 6, 5)).mean(-1)
    vertices = ball.vertices * (1 + 0.35 * rng.uniform(0.2, 1) * waves[:, None])
    return ball._replace(vertices=vertices, normals=smooth_normals(vertices, ball.faces, weld=True))


def quad(rng=None):
    """The square [-1, 1]^2 that faces +z."""
    corners = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], float)
    return Mesh(corners, np.array([[0, 1, 2], [0, 2, 3]]), np.tile([0.0, 0, 1], (4, 1)), corners[:, :2] / 2 + 0.5)


def box(rng=None):
    sides = []
    for axis in range(3):
        for sign in (-1, 1):
            normal, right = np.zeros(3), np.zeros(3)
            normal[axis], right[(axis + 1) % 3] = sign, 1
            sides.append(quad().moved(np.stack([right, np.cross(normal, right), normal], -1), normal))
    return joined(sides)


def revolved(profile, normals, nu=40):
    """Turns a line of (radius, height) about y."""
    angle = np.linspace(0, 2 * np.pi, nu + 1)[:, None]
    around = lambda line: np.stack(np.broadcast_arrays(line[:, 0] * np.cos(angle), line[:, 1], -line[:, 0] * np.sin(angle)), -1)
    length = np.r_[0, np.cumsum(np.linalg.norm(np.diff(profile, axis=0), axis=1))]
    uv = np.stack(np.broadcast_arrays(angle / np.pi, length / max(length[-1], 1e-9)), -1)
    return lattice(around(profile), around(normals), uv)


def cylinder(rng):
    """A cylinder or a part of a cone, closed."""
    top, height = (1.0 if rng.random() < 0.6 else rng.uniform(0, 0.8)), rng.uniform(0.5, 2)
    slope = unit(np.array([2 * height, 1 - top]))
    line = lambda a, b, normal: revolved(np.array([a, b]), np.array([normal, normal], float))
    return joined([line([1, -height], [top, height], slope), line([1e-4, -height], [1, -height], [0, -1]),
                   line([top + 1e-4, height], [1e-4, height], [0, 1])])


def vase(rng):
    height = np.linspace(-1, 1, 40)
    radius = 0.5 + 0.45 * np.sin(np.outer(height, rng.uniform(1, 7, 3)) + rng.uniform(0, 6, 3)).mean(1)
    profile = np.stack([np.maximum(radius, 0.08), height], -1)
    along = np.gradient(profile, axis=0)
    return revolved(profile, unit(np.stack([along[:, 1], -along[:, 0]], -1)), 48)


def tube(curve, radius, nu, nv):
    """A round tube along a closed curve of a parameter in [0, 2 pi]."""
    u, v = np.linspace(0, 2 * np.pi, nu + 1), np.linspace(0, 2 * np.pi, nv + 1)
    center, along = curve(u), unit(curve(u + 1e-4) - curve(u - 1e-4))
    side = unit(np.cross(along, center + 0.3))
    normals = np.cos(v)[:, None] * np.cross(side, along)[:, None] - np.sin(v)[:, None] * side[:, None]
    uv = np.stack(np.broadcast_arrays(u[:, None] * 6 / np.pi, v / np.pi), -1)
    return lattice(center[:, None] + radius * normals, normals, uv)


def knot(rng, detail=1.0):
    """A torus knot, or a torus."""
    p, q = ((2, 3), (3, 2), (2, 5), (3, 4), (1, 0), (1, 4), (3, 5))[rng.integers(7)]
    radius = rng.uniform(0.06, 0.2) if q else rng.uniform(0.1, 0.4)
    wave = 0.25 if q else 0.0
    ring = lambda t: 0.65 + wave * np.cos(q * t)
    curve = lambda t: np.stack([ring(t) * np.cos(p * t), 0.3 * np.sin(q * t), ring(t) * np.sin(p * t)], -1)
    return tube(curve, radius, int((240 if q else 80) * detail), int(20 * detail))


def blob(rng):
    """Metaballs."""
    from skimage.measure import marching_cubes
    axis = np.linspace(-1.3, 1.3, 36)
    points = np.stack(np.meshgrid(axis, axis, axis, indexing="ij"), -1)
    centers = rng.uniform(-0.55, 0.55, (int(rng.integers(3, 9)), 3))
    field = sum(0.055 / (np.square(points - center).sum(-1) + 1e-3) for center in centers)
    vertices, faces, _, _ = marching_cubes(field, min(0.5, field.max() / 2))
    vertices = vertices / 35 * 2.6 - 1.3
    vertices, faces = vertices - vertices.mean(0), faces.astype(np.int64)
    normals = smooth_normals(vertices, faces)
    if (normals * vertices).sum(-1).mean() < 0:
        faces, normals = faces[:, ::-1], -normals
    return Mesh(vertices, faces, normals, np.stack([np.arctan2(vertices[:, 2], vertices[:, 0]) / np.pi, vertices[:, 1]], -1))


def stacked_boxes(rng):
    parts, height, width = [], 0.0, rng.uniform(0.5, 0.9)
    for _ in range(rng.integers(2, 6)):
        half = rng.uniform(0.1, 0.35)
        size = np.diag([width * rng.uniform(0.6, 1), half, width * rng.uniform(0.5, 1)])
        center = [rng.normal(0, 0.06), height + half, rng.normal(0, 0.06)]
        parts.append(box().moved(turn_about_y(rng.uniform(0, 6.3)) @ size, center))
        height, width = height + 2 * half, width * rng.uniform(0.75, 1)
    return joined(parts).moved(np.eye(3), [0, -height / 2, 0])


def stairs(rng):
    n = int(rng.integers(4, 9))
    return joined([box().moved(np.diag([0.8, (i + 1) / n, 1 / n]), [0, (i + 1) / n - 1, (2 * i + 1) / n - 1]) for i in range(n)])
