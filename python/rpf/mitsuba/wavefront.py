"""Renders as SamplingIntegrator::render of Mitsuba does, all samples at once, and keeps every sample.

The order of the random numbers is Mitsuba's: film, aperture (where the sensor has one), time (where the shutter stays open),
wavelength (spectral variants), then the integrator's. So the mean of a pixel equals mi.render of the same seed.
"""
import drjit as dr
import mitsuba as mi
import numpy as np

from .first_hits import first_hits, second_hits
from .samples import Samples

_REFUSED = "rpf.mitsuba: the integrator {} gives no radiance for single rays; use one that does, such as path or volpath"


def sampling_integrator(scene):
    """The scene's integrator. Raises ValueError if it does not work ray by ray (ptracer) or is differential (prb)."""
    integrator = scene.integrator()
    differential = getattr(mi, "ad", None) and isinstance(integrator, mi.ad.integrators.common.ADIntegrator)
    if not isinstance(integrator, mi.SamplingIntegrator) or differential:
        raise ValueError(_REFUSED.format(integrator.class_name()))
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


def trace(scene, sensor, sampler, pixel, spp):
    """One sample for each entry of pixel (UInt32, row by row in the film's crop window).

    spp scales the ray differentials as the renderer would. -> slot -> array of Dr.Jit, not evaluated; time in [0, 1).
    """
    film = sensor.film()
    offset, scale = mi.ScalarVector2f(film.crop_offset()), 1 / mi.ScalarVector2f(film.crop_size())
    corner = mi.Vector2f(mi.Float(pixel % film.crop_size()[0]), mi.Float(pixel // film.crop_size()[0])) + offset
    position = mi.Point2f(corner + sampler.next_2d())
    lens = sampler.next_2d() if sensor.needs_aperture_sample() else mi.Point2f(0.5)
    time = sampler.next_1d() if sensor.shutter_open_time() > 0 else mi.Float(0)
    wavelength = sampler.next_1d() if mi.is_spectral else mi.Float(0)
    ray, ray_weight = sensor.sample_ray_differential(sensor.shutter_open() + time * sensor.shutter_open_time(), wavelength,
                                                     dr.fma(position, scale, -offset * scale), lens)
    if ray.has_differentials:
        ray.scale_differential(mi.Float(1 / np.sqrt(spp)))
    numbers = sampler.clone()  # PathIntegrator::sample draws these three first
    light, lobe, bsdf = numbers.next_2d(), numbers.next_1d(), numbers.next_2d()
    radiance, _, _ = sampling_integrator(scene).sample(scene, sampler, ray, sensor.get_medium())
    slots = {"radiance": _rgb(mi.unpolarized_spectrum(radiance * ray_weight), ray), "film": _inside(position, corner),
             "lens": lens, "time": time, "light": light, "bsdf": bsdf}
    hit = scene.ray_intersect(ray)
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


def render_samples(scene, spp=0, seed=0, sensor=0, moving=False):
    """Renders a scene and keeps all samples.

    spp: samples a pixel, 0 for the scene's number; some samplers round it up. sensor: index, or a sensor.
    moving: something moves while the shutter is open, so that the time of a sample is worth recording.
    -> Samples. Raises ValueError for an integrator that does not work ray by ray.
    """
    sampling_integrator(scene)
    sensor = scene.sensors()[sensor] if isinstance(sensor, int) else sensor
    sampler, spp = seeded_sampler(sensor, spp, seed)
    width, height = (int(v) for v in sensor.film().crop_size())
    lanes = dr.arange(mi.UInt32, width * height * spp)
    slots = trace(scene, sensor, sampler, lanes // dr.opaque(mi.UInt32, spp), spp)
    names = recorded(scene, sensor, moving)
    channels = planes({name: values for name, values in slots.items() if name in names})
    window = (*(int(v) for v in sensor.film().crop_offset()), width, height)
    metadata = {"rpf:seed": int(seed), "rpf:renderer": f"Mitsuba {mi.__version__}"}
    return Samples(window, np.full(width * height, spp, np.uint32), channels, metadata)


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
