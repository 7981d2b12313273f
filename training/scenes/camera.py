"""A camera with a thin lens that may move while the shutter is open, and where to put it."""
from dataclasses import dataclass, field

import drjit as dr
import mitsuba as mi
import numpy as np


@dataclass
class View:
    """Where a camera is. Axes are columns (left, up, forward); angles in degrees, lengths in scene units."""
    axes: np.ndarray
    origin: np.ndarray
    field_of_view: float                                     # horizontal
    aperture: float = 0.0                                    # radius
    focus: float = 1.0
    velocity: np.ndarray = field(default_factory=lambda: np.zeros(3))  # for one shutter interval

    def half_width(self):
        """Half the picture's width at distance 1."""
        return np.tan(np.radians(self.field_of_view) / 2)


def look_at(origin, target, up):
    forward = (target - origin) / np.linalg.norm(target - origin)
    left = np.cross(up, forward)
    left /= np.linalg.norm(left)
    return np.stack([left, np.cross(forward, left), forward], -1)


class MovingThinLens(mi.Sensor):
    """As Mitsuba's thinlens, with a straight motion of the camera during the shutter interval [0, 1]. A radius of 0 is a pinhole.

    Mitsuba has no moving cameras of its own. All numbers are opaque: the kernels are the same for every view."""

    def __init__(self, props):
        super().__init__(props)
        self.m_needs_sample_2, self.m_needs_sample_3 = True, True
        self.look(View(np.eye(3), np.zeros(3), 45.0))

    def look(self, view):
        number = lambda v: dr.opaque(mi.Float, float(v))
        vector = lambda v: mi.Vector3f(*[number(x) for x in v])
        self.left, self.up, self.forward = (vector(view.axes[:, k]) for k in range(3))
        self.origin, self.velocity = vector(view.origin), vector(view.velocity)
        self.slope, self.aperture, self.focus = number(view.half_width()), number(view.aperture), number(view.focus)

    def sample_ray(self, time, sample1, sample2, sample3, active=True):
        width, height = self.film().crop_size()
        x, y = 1 - 2 * sample2.x, (1 - 2 * sample2.y) * (height / width)
        lens = mi.warp.square_to_uniform_disk_concentric(sample3) * self.aperture
        aim = self.slope * self.focus
        direction = dr.normalize(self.left * (x * aim - lens.x) + self.up * (y * aim - lens.y) + self.forward * self.focus)
        origin = self.origin + self.velocity * (time - 0.5) + self.left * lens.x + self.up * lens.y
        return mi.Ray3f(mi.Point3f(origin), direction, time, mi.Color0f()), mi.Color3f(1)

    def sample_ray_differential(self, time, sample1, sample2, sample3, active=True):
        ray, weight = self.sample_ray(time, sample1, sample2, sample3, active)
        return mi.RayDifferential3f(ray), weight

    def traverse(self, callback):
        pass

    def to_string(self):
        return "MovingThinLens[]"


mi.register_sensor("moving_thin_lens", MovingThinLens)


def make_camera(size, sampler):
    """A camera for pictures of size (width, height); sampler: name of a Mitsuba plugin."""
    return mi.load_dict({"type": "moving_thin_lens", "shutter_open": 0.0, "shutter_close": 1.0, "sampler": {"type": sampler},
                         "film": {"type": "hdrfilm", "width": size[0], "height": size[1], "pixel_format": "rgb",
                                  "component_format": "float32", "rfilter": {"type": "box"}}})


@dataclass
class Preview:
    """First hits through the pixels' centers, [pixels]."""
    depth: np.ndarray
    hit: np.ndarray
    shape: np.ndarray
    emitter: np.ndarray


def preview(scene, camera):
    width, height = (int(v) for v in camera.film().crop_size())
    i = dr.arange(mi.UInt32, width * height)
    center = mi.Point2f((mi.Float(i % width) + 0.5) / width, (mi.Float(i // width) + 0.5) / height)
    ray, _ = camera.sample_ray(mi.Float(0.5), mi.Float(0), center, mi.Point2f(0.5))
    hit = scene.ray_intersect(ray)
    there = hit.is_valid()
    depth = dr.select(there, dr.dot(hit.p - camera.origin, camera.forward), 0)
    shape = dr.select(there, dr.reinterpret_array(mi.UInt32, hit.shape), 0)
    emitter = there & (dr.reinterpret_array(mi.UInt32, hit.emitter(scene)) != 0)
    dr.eval(depth, there, shape, emitter)
    return Preview(np.array(depth), np.array(there).astype(bool), np.array(shape), np.array(emitter).astype(bool))
