"""Things that move while the shutter is open.

Mitsuba has no moving shapes: the interval is cut into slots, and the scene stands still in each."""
import drjit as dr
import mitsuba as mi
import numpy as np

from rpf.mitsuba import SamplePlanes
from rpf.mitsuba.wavefront import planes, trace
from shapes import turn_about_y

SLOTS = 30


class MovingObjects:
    """Sets the shapes of a scene to where they are at a time. moving: [(Placed, velocity, turn)] of views.move_objects."""

    def __init__(self, scene, meshes, moving):
        self.parameters, self.meshes, self.moving = mi.traverse(scene), meshes, moving

    def set_slot(self, slot):
        from_middle = (slot + 0.5) / SLOTS - 0.5
        for thing, velocity, turn in self.moving:
            linear, center = turn_about_y(turn * from_middle), thing.center
            mesh = self.meshes[thing.name].moved(linear, center - linear @ center + velocity * from_middle)
            self.parameters[f"{thing.name}.vertex_positions"] = mi.Float(mesh.vertices.ravel())
            self.parameters[f"{thing.name}.vertex_normals"] = mi.Float(mesh.normals.ravel())
        self.parameters.update()


def render_samples(scene, camera, objects, spp, seed):
    """As rpf.mitsuba.render_samples. Every sample has a slot of its own choice, and a time in it."""
    width, height = (int(v) for v in camera.film().crop_size())
    total = width * height * spp
    # slots of one size; those that fill the last up are rendered again
    lanes_of = np.resize(np.random.default_rng([seed, 1]).permutation(total), (SLOTS, -(-total // SLOTS)))
    channels = {}
    for slot, lanes in enumerate(lanes_of):
        objects.set_slot(slot)
        sampler = camera.sampler().clone()
        sampler.seed(dr.opaque(mi.UInt32, seed * SLOTS + slot), len(lanes))
        traced = planes(trace(scene, camera, sampler, mi.UInt32(lanes // spp), spp))
        traced["random.time"] = np.minimum((slot + traced["random.time"]) / SLOTS, np.float32(1 - 2**-24))  # 1 is excluded
        for name, values in traced.items():
            channels.setdefault(name, np.empty(total, np.float32))[lanes] = values
    metadata = {"rpf:seed": int(seed), "rpf:renderer": f"Mitsuba {mi.__version__}"}
    return SamplePlanes((0, 0, width, height), np.full(width * height, spp, np.uint32), channels, metadata)


def render_reference(scene, camera, objects, spp, seed):
    """Two renderings a slot, whose difference tells the noise. -> mean, variance of the mean, as rpf.mitsuba.render_reference"""
    each = max(1, round(spp / (2 * SLOTS)))
    total, variance = 0.0, 0.0
    for slot in range(SLOTS):
        objects.set_slot(slot)
        a, b = (np.array(scene.integrator().render(scene, sensor=camera, seed=dr.opaque(mi.UInt32, seed + 2 * slot + k), spp=each))
                .astype(np.float64) for k in (0, 1))
        total, variance = total + (a + b) / 2, variance + np.square(a - b) / 4
    return total / SLOTS, variance / SLOTS**2
