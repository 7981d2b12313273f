"""rpf.mitsuba against Mitsuba's own renderings. Skipped where Mitsuba is not installed."""
import numpy as np
import pytest

mi = pytest.importorskip("mitsuba")
import drjit as dr  # noqa: E402

from rpf.mitsuba import render_reference, render_samples, select_variant, write_samples  # noqa: E402

select_variant()

# mi.render sums in another order, in float
MEAN_TOLERANCE = 1e-5
RADIANCE_TOLERANCE = 1e-4


def cornell_box(sampler="independent", size=(33, 20), depth=6, rfilter="box", **film):
    scene = mi.cornell_box()
    scene["integrator"] = {"type": "path", "max_depth": depth}
    scene["sensor"]["sampler"] = {"type": sampler, "sample_count": 4}
    scene["sensor"]["film"].update({"width": size[0], "height": size[1], "rfilter": {"type": rfilter}, **film})
    return scene


def assert_mean_is_rendering(scene, spp):
    samples = render_samples(scene, spp, seed=3)
    rendered = np.array(mi.render(scene, spp=spp, seed=3))[..., :3]
    assert rendered.mean() > 0.01
    assert np.abs(samples.mean() - rendered).max() < MEAN_TOLERANCE * max(1, rendered.max())
    return samples


@pytest.mark.parametrize("sampler", ["independent", "stratified", "multijitter", "orthogonal", "ldsampler"])
@pytest.mark.parametrize("spp", [4, 16])
def test_mean_is_what_mitsuba_renders(sampler, spp):
    assert_mean_is_rendering(mi.load_dict(cornell_box(sampler)), spp)


def test_crop_window():
    crop = {"crop_offset_x": 5, "crop_offset_y": 7, "crop_width": 11, "crop_height": 9}
    samples = assert_mean_is_rendering(mi.load_dict(cornell_box(**crop)), 4)
    assert samples.window == (5, 7, 11, 9)
    x = np.floor(samples.channels["film.X"]).reshape(9, 11, 4)
    assert (x == np.arange(5, 16)[None, :, None]).all()


def test_lens_is_recorded():
    scene = cornell_box()
    scene["sensor"] = {"type": "thinlens", "aperture_radius": 0.2, "focus_distance": 3.9, "to_world": scene["sensor"]["to_world"],
                       "film": scene["sensor"]["film"], "sampler": scene["sensor"]["sampler"]}
    samples = assert_mean_is_rendering(mi.load_dict(scene), 4)
    assert {"random.lens.U", "random.lens.V"} < set(samples.channels)
    assert "random.time" not in samples.channels


def test_other_integrators():
    for kind in ("direct", "volpath"):
        scene = cornell_box()
        scene["integrator"] = {"type": kind}
        samples = assert_mean_is_rendering(mi.load_dict(scene), 4)
        assert not any(name.startswith("random.") for name in samples.channels)  # their numbers are not known


@pytest.mark.parametrize("kind", ["ptracer", "prb"])
def test_integrators_without_single_rays_are_refused(kind):
    scene = cornell_box()
    scene["integrator"] = {"type": kind}
    with pytest.raises(ValueError, match="gives no radiance for single rays"):
        render_samples(mi.load_dict(scene), 4)


def test_light_numbers_are_the_integrators():
    """Direct light without the light that the chosen direction hits: computed again from the recorded numbers."""
    scene = mi.load_dict(cornell_box(depth=2))
    channels = render_samples(scene, 4, seed=1).channels
    width, height = scene.sensors()[0].film().crop_size()
    on_film = mi.Point2f(mi.Float(channels["film.X"]) / width, mi.Float(channels["film.Y"]) / height)
    ray, _ = scene.sensors()[0].sample_ray_differential(0, 0, on_film, mi.Point2f(0.5))
    hit = scene.ray_intersect(ray)
    light, weight = scene.sample_emitter_direction(hit, mi.Point2f(channels["random.light.U"], channels["random.light.V"]))
    value, pdf = hit.bsdf(ray).eval_pdf(mi.BSDFContext(), hit, hit.to_local(light.d))
    balance = dr.square(light.pdf) / (dr.square(light.pdf) + dr.square(pdf))
    expected = dr.select(light.pdf > 0, value * weight * balance, 0)
    ceiling = np.nanmax(channels["feature.P2.Y"])  # second hits up there may be the light
    elsewhere = (channels["feature.hit"] == 1) & ~(channels["feature.P2.Y"] > 0.9 * ceiling) & np.array(~hit.shape.is_emitter())
    radiance = np.stack([channels[c] for c in "RGB"])
    assert elsewhere.mean() > 0.3 and radiance[:, elsewhere].mean() > 0.01
    assert np.abs(np.array(expected) - radiance)[:, elsewhere].max() < RADIANCE_TOLERANCE


def test_nothing_hit_is_nan():
    scene = cornell_box()
    for wall in ("back", "ceiling"):
        scene.pop(wall)
    channels = render_samples(mi.load_dict(scene), 4).channels
    missed = channels["feature.hit"] == 0
    assert 0 < missed.mean() < 1
    for name in ("feature.N.X", "feature.P.Y", "feature.uv.U", "feature.albedo.G", "feature.N2.Z", "feature.P2.X"):
        assert np.isnan(channels[name][missed]).all()
    assert np.isfinite(channels["feature.N.X"][~missed]).all()


def test_reference_is_the_mean_of_many_and_knows_its_noise():
    scene = mi.load_dict(cornell_box())
    mean, variance = render_reference(scene, 100)
    other, _ = render_reference(scene, 100, seed=77)
    assert mean.shape == (20, 33, 3)
    assert 0.5 < np.square(mean - other).mean() / (2 * variance.mean()) < 2


def test_file_is_read_by_the_code_of_the_document(tmp_path):
    import re
    from pathlib import Path
    code = {}
    exec(re.search(r"```python\n(.*?)```", (Path(__file__).parents[2] / "docs/file-format.md").read_text(), re.S).group(1), code)
    samples = render_samples(mi.load_dict(cornell_box()), 4)
    write_samples(tmp_path / "a.rpf", samples)
    header, counts, channels = code["read_samples"](tmp_path / "a.rpf")
    assert header["dataWindow"] == [0, 0, 33, 20] and (counts == 4).all()
    assert all(np.array_equal(channels[name], samples.channels[name], equal_nan=True) for name in samples.channels)
    assert [p.name for p in tmp_path.iterdir()] == ["a.rpf"]
