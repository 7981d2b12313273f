"""Collects shapes, BSDFs and emitters of a scene and loads them: always the same number of each, so that kernels are compiled once.

What a scene does not need lies below it, far too small to be seen.
"""
import tempfile
from pathlib import Path

import mitsuba as mi
import numpy as np

import shapes
from materials import Material, Materials, bitmap
from textures import constant

SHAPES = 36
LIGHTS = 4          # spheres and rectangles each
GLOW_FACES = 4096   # of the mesh that glows with a texture: the size of an emitter's table is part of the kernel
_HIDDEN = np.eye(3) * 1e-4


def rgb(color):
    return {"type": "rgb", "value": [float(v) for v in color]}


def area_light(radiance, weight=1.0):
    return {"type": "area", "radiance": radiance, "sampling_weight": float(weight)}


def _write_ply(path, mesh):
    names = ("x", "y", "z", "nx", "ny", "nz", "u", "v")
    faces = np.empty(len(mesh.faces), [("n", "u1"), ("vertex", "<i4", 3)])
    faces["n"], faces["vertex"] = 3, mesh.faces
    header = ["ply", "format binary_little_endian 1.0", f"element vertex {len(mesh.vertices)}"]
    header += [f"property float {name}" for name in names]
    header += [f"element face {len(faces)}", "property list uchar int vertex_indices", "end_header\n"]
    vertices = np.concatenate([mesh.vertices, mesh.normals, mesh.uv], 1).astype("<f4")
    path.write_bytes("\n".join(header).encode() + vertices.tobytes() + faces.tobytes())


class SceneBuilder:
    def __init__(self, rng, plain):
        self.rng, self.materials = rng, Materials(rng, plain)
        self.items, self.meshes = {}, {}
        self.environment = None

    def add(self, name, mesh, material: Material, emitter=None):
        mesh = mesh._replace(uv=mesh.uv * material.uv_scale)
        self.meshes[name] = mesh
        self.items[name] = {"type": "ply", "bsdf": material.bsdf} | ({"emitter": emitter} if emitter else {})

    def add_rectangle_light(self, index, linear, offset, radiance, weight=1.0):
        self.add(f"rectangle{index}", shapes.quad().moved(linear, offset), self.materials.black, area_light(rgb(radiance), weight))

    def add_sphere_light(self, index, center, radius, radiance, weight=1.0):
        place = mi.ScalarTransform4f().translate([float(v) for v in center]).scale(float(radius))
        self.items[f"sphere{index}"] = {"type": "sphere", "to_world": place, "bsdf": self.materials.black.bsdf,
                                        "emitter": area_light(rgb(radiance), weight)}

    def add_glow(self, mesh, image, weight=1.0):
        """A mesh that glows with a texture."""
        spare = np.zeros((GLOW_FACES - len(mesh.faces), 3), mesh.faces.dtype)
        mesh = mesh._replace(faces=np.concatenate([mesh.faces, spare]))
        self.add("glow", mesh, self.materials.black, area_light(bitmap(image), weight))

    def set_environment(self, image, angle, weight):
        turn = mi.ScalarTransform4f().rotate([0, 1, 0], float(angle))
        self.environment = {"type": "envmap", "bitmap": mi.Bitmap(image), "to_world": turn, "sampling_weight": float(weight)}

    def _pad(self):
        for i in range(LIGHTS):
            if f"sphere{i}" not in self.items:
                self.add_sphere_light(i, [0.1 * i, -3, 0], 1e-4, (0, 0, 0), 0)
            if f"rectangle{i}" not in self.items:
                self.add_rectangle_light(i, _HIDDEN, [0.1 * i, -3, 0.1], (0, 0, 0), 0)
        if "glow" not in self.items:
            self.add_glow(shapes.box().moved(_HIDDEN, [0.2, -3, 0.3]), constant((0, 0, 0)), 0)
        if len(self.items) > SHAPES:
            raise RuntimeError(f"{len(self.items)} shapes, room for {SHAPES}")
        for i in range(SHAPES - len(self.items)):
            self.add(f"spare{i}", shapes.quad().moved(_HIDDEN, [0.1 * i, -3, 1]), self.materials.black)
        self.materials.pad()

    def load(self, depth):
        """-> mi.Scene with a path tracer of that depth. The builder has to outlive the scene: it keeps the spare BSDFs."""
        self._pad()
        with tempfile.TemporaryDirectory(prefix="rpf-scene-") as folder:
            for name, mesh in self.meshes.items():
                self.items[name]["filename"] = str(Path(folder) / f"{name}.ply")
                _write_ply(Path(folder) / f"{name}.ply", mesh)
            return mi.load_dict({"type": "scene", **self.items, "environment": self.environment,
                                 "integrator": {"type": "path", "max_depth": int(depth), "rr_depth": 4}}, optimize=False)
