"""Renders as SamplingIntegrator::render of Mitsuba does, all samples at once, and keeps every sample.

The order of the random numbers is Mitsuba's: film, aperture (where the sensor has one), time (where the shutter stays open),
wavelength (spectral variants), then the integrator's. So the mean of a pixel equals mi.render of the same seed.
"""
import drjit as dr
import mitsuba as mi
import numpy as np

from .first_hits import first_hits, second_hits
from ..errors import InputError
from .samples import SampleFile, SamplePlanes

_REFUSED = "the integrator {} gives no radiance for single rays; use one that does, such as path or volpath"


def sampling_integrator(scene):
    """The scene's integrator. Raises InputError if it does not work ray by ray (ptracer) or is differential (prb)."""
    integrator = scene.integrator()
    differential = getattr(mi, "ad", None) and isinstance(integrator, mi.ad.integrators.common.ADIntegrator)
    if not isinstance(integrator, mi.SamplingIntegrator) or differential:
        raise InputError(_REFUSED.format(integrator.class_name()))
    return integrator


def seeded_sampler(sensor, spp, seed):
    """A sampler of its own for spp samples (0: the scene's number) in each pixel of the film. -> sampler, spp

    Some samplers round the number up."""
    sampler = sensor.sampler().clone()
    if spp:
        sampler.set_sample_count(spp)
    spp = sampler.sample_count()
    sampler.set_samples_per_wavefront(spp)
    sampler.seed(dr.opaque(mi.UInt32, seed), int(np.prod(sensor.film().crop_size())) * spp)
    return sampler, spp


def _rgb(spectrum, ray):
    if mi.is_monochromatic:
        return mi.Color3f(spectrum[0])
    if mi.is_spectral:
        xyz = [dr.mean(response * spectrum) for response in mi.cie1931_xyz(ray.wavelengths)]
        return mi.xyz_to_srgb(mi.Color3f(*xyz))
    return mi.Color3f(spectrum)


def trace(scene, sensor, sampler, pixel, spp, active=True):
    """One sample for each entry of pixel (UInt32, row by row in the film's crop window).

    spp scales the ray differentials as the renderer would. Samples that are not active are not rendered. -> slot -> array of Dr.Jit, not evaluated; time in [0, 1).
    """
    film = sensor.film()
    offset, scale = mi.ScalarVector2f(film.crop_offset()), 1 / mi.ScalarVector2f(film.crop_size())
    corner = mi.Vector2f(mi.Float(pixel % film.crop_size()[0]), mi.Float(pixel // film.crop_size()[0])) + offset
    position = mi.Point2f(corner + sampler.next_2d(active))
    lens = sampler.next_2d(active) if sensor.needs_aperture_sample() else mi.Point2f(0.5)
    time = sampler.next_1d(active) if sensor.shutter_open_time() > 0 else mi.Float(0)
    wavelength = sampler.next_1d(active) if mi.is_spectral else mi.Float(0)
    ray, ray_weight = sensor.sample_ray_differential(sensor.shutter_open() + time * sensor.shutter_open_time(), wavelength,
                                                     dr.fma(position, scale, -offset * scale), lens, active)
    if ray.has_differentials:
        ray.scale_differential(mi.Float(1 / np.sqrt(spp)))
    numbers = sampler.clone()  # PathIntegrator::sample draws these three first
    light, lobe, bsdf = numbers.next_2d(active), numbers.next_1d(active), numbers.next_2d(active)
    radiance, _, _ = sampling_integrator(scene).sample(scene, sampler, ray, sensor.get_medium(), active)
    slots = {"radiance": _rgb(mi.unpolarized_spectrum(radiance * ray_weight), ray), "film": _inside(position, corner),
             "lens": lens, "time": time, "light": light, "bsdf": bsdf}
    hit = scene.ray_intersect(ray, active)
    slots.update(first_hits(hit, ray))
    if scene.integrator().class_name() == "PathIntegrator":  # its numbers are known, so its second ray is too
        slots.update(second_hits(scene, hit, ray, lobe, bsdf))
    return slots


def _inside(position, corner):
    """Rounding may lift a position into the next pixel: the largest float below that."""
    return dr.minimum(position, mi.Point2f(corner + 1) * (1 - 2**-24))


# What a vector of trace() is called in a file.
_PLANES = {"radiance": ["R", "G", "B"], "film": ["film.X", "film.Y"], "lens": ["random.lens.U", "random.lens.V"],
           "time": ["random.time"], "light": ["random.light.U", "random.light.V"], "bsdf": ["random.bsdf.U", "random.bsdf.V"],
           "N": [f"feature.N.{c}" for c in "XYZ"], "P": [f"feature.P.{c}" for c in "XYZ"],
           "albedo": [f"feature.albedo.{c}" for c in "RGB"], "uv": ["feature.uv.U", "feature.uv.V"], "hit": ["feature.hit"],
           "N2": [f"feature.N2.{c}" for c in "XYZ"], "P2": [f"feature.P2.{c}" for c in "XYZ"]}


def planes(slots):
    """Evaluates slots of trace(): name of the slot in a file -> [samples] float32."""
    dr.eval(slots)
    result = {}
    for name, values in slots.items():
        rows = np.array(values, dtype=np.float32).reshape(len(_PLANES[name]), -1)
        result.update(zip(_PLANES[name], rows))
    return result


def recorded(scene, sensor, moving):
    """Names of the slots of trace() that say something about this scene: numbers that nothing depends on are noise."""
    names = set(_PLANES)
    if not sensor.needs_aperture_sample():
        names -= {"lens"}
    if not moving:
        names -= {"time"}
    if scene.integrator().class_name() != "PathIntegrator":
        names -= {"light", "bsdf", "N2", "P2"}
    return names


def whole_counts(density, width, height):
    """Samples of each pixel, row by row, of what a density asks for: [height, width] whole numbers, 0 or more."""
    counts = np.asarray(density)
    if counts.shape != (height, width):
        raise InputError(f"a density of {' x '.join(map(str, counts.shape[::-1]))} pixels, where the film has {width} x {height}")
    if not (np.isfinite(counts).all() and (counts >= 0).all() and (counts == np.rint(counts)).all() and counts.any()):
        raise InputError("a density is whole numbers of samples, 0 or more and somewhere 1, as `rpf density` writes")
    return counts.astype(np.uint32).ravel()


class _Rendering:
    """What a rendering is before it is rendered: its window, counts, names of planes and metadata."""

    def __init__(self, scene, spp, seed, sensor, moving, density):
        sampling_integrator(scene)
        self.scene, self.seed = scene, seed
        self.sensor = scene.sensors()[sensor] if isinstance(sensor, int) else sensor
        self.slots = [name for name in _PLANES if name in recorded(scene, self.sensor, moving)]
        self.names = [name for slot in self.slots for name in _PLANES[slot]]
        self.width, self.height = (int(v) for v in self.sensor.film().crop_size())
        self.window = (*(int(v) for v in self.sensor.film().crop_offset()), self.width, self.height)
        self.even = density is None
        if self.even:
            _, self.spp = seeded_sampler(self.sensor, spp, seed)
            self.counts = np.full(self.width * self.height, self.spp, np.uint32)
        else:
            self.counts = whole_counts(density, self.width, self.height)
            self.spp = self.counts.mean()
        self.first = np.concatenate([[0], np.cumsum(self.counts, dtype=np.int64)])
        self.metadata = {"rpf:seed": int(seed), "rpf:renderer": f"Mitsuba {mi.__version__}"}

    def first_of(self, row):
        """Number of the first sample of a row."""
        return int(self.first[row * self.width])

    def _wavefront(self):
        """-> sampler, pixel of each sample of the film. Where counts vary, numbers are independent, whatever the scene's sampler:
        others are laid out for one count."""
        if self.even:
            sampler, spp = seeded_sampler(self.sensor, self.spp, self.seed)
            return sampler, dr.arange(mi.UInt32, self.first_of(self.height)) // dr.opaque(mi.UInt32, spp)
        sampler = mi.load_dict({"type": "independent", "sample_count": 1})
        sampler.seed(dr.opaque(mi.UInt32, self.seed), self.first_of(self.height))
        return sampler, mi.UInt32(np.repeat(np.arange(self.counts.size, dtype=np.uint32), self.counts))

    def rows(self, first, count):
        """Renders rows of the film. -> slot in a file -> [samples] float32

        The sampler belongs to the whole film, so that the numbers are the same for any cut. Other rows are not active, and only
        the results of these rows are kept; where counts do not vary, nothing of the film's size is in memory.
        """
        sampler, pixel = self._wavefront()
        begin, samples = self.first_of(first), self.first_of(first + count) - self.first_of(first)
        place = dr.arange(mi.UInt32, self.first_of(self.height)) - dr.opaque(mi.UInt32, begin)  # wraps around in rows before these
        active = place < dr.opaque(mi.UInt32, samples)
        slots = trace(self.scene, self.sensor, sampler, pixel, self.spp, active)
        result = {}
        for slot in self.slots:
            parts = [slots[slot]] if len(_PLANES[slot]) == 1 else list(slots[slot])
            for name, part in zip(_PLANES[slot], parts):
                result[name] = dr.empty(mi.Float, samples)
                dr.scatter(result[name], mi.Float(part), place, active)
        dr.eval(result)
        return {name: np.array(values, dtype=np.float32) for name, values in result.items()}


def render_samples(scene, spp=0, seed=0, sensor=0, moving=False, density=None):
    """Renders a scene and keeps all samples in memory.

    spp: samples a pixel, 0 for the scene's number; some samplers round it up. sensor: index, or a sensor.
    moving: something moves while the shutter is open, so that the time of a sample is worth recording.
    density: [height, width] samples of each pixel in place of spp; then numbers are independent, whatever the scene's sampler.
    -> SamplePlanes. Raises InputError for an integrator that does not work ray by ray, or a density that cannot be.
    """
    rendering = _Rendering(scene, spp, seed, sensor, moving, density)
    channels = rendering.rows(0, rendering.height)
    return SamplePlanes(rendering.window, rendering.counts, channels, rendering.metadata)


def render_to_file(path, scene, spp=0, seed=0, sensor=0, moving=False, density=None, block_bytes=256 << 20):
    """As render_samples, into a raw sample file: in blocks of rows, so that at most about twice block_bytes of samples are in
    memory. The bytes do not depend on it. Raises InputError, OSError."""
    rendering = _Rendering(scene, spp, seed, sensor, moving, density)
    row = rendering.first_of(rendering.height) / rendering.height
    rows = int(max(1, min(rendering.height, block_bytes // (4 * row * len(rendering.names)))))
    with SampleFile(path, rendering.window, rendering.counts, rendering.names, rendering.metadata) as file:
        for first in range(0, rendering.height, rows):
            file.put(rendering.first_of(first), rendering.rows(first, min(rows, rendering.height - first)))


def render_reference(scene, spp, seed=0, sensor=0, sets=5):
    """Mean of `sets` independent renderings of spp / sets samples a pixel each.

    -> [height, width, 3] radiance, [height, width, 3] variance of that mean, both float64. Not finite values count as 0.
    """
    sensor = scene.sensors()[sensor] if isinstance(sensor, int) else sensor
    spp = max(1, round(spp / sets))
    images = []
    for k in range(sets):
        image = scene.integrator().render(scene, sensor=sensor, seed=dr.opaque(mi.UInt32, seed + k), spp=spp)
        images.append(np.nan_to_num(np.array(image)[..., :3].astype(np.float64), nan=0, posinf=0, neginf=0))
    return np.mean(images, 0), np.var(images, 0, ddof=1) / sets
