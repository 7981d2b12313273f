"""rpf.mitsuba against Mitsuba's own renderings. Skipped where Mitsuba is not installed."""
import os
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import rpf

mi = pytest.importorskip("mitsuba")
import drjit as dr  # noqa: E402

from rpf.mitsuba import render_reference, render_samples, render_to_file, select_variant, write_samples  # noqa: E402
from rpf import errors as rpf_errors  # noqa: E402
from rpf.mitsuba.__main__ import main  # noqa: E402

select_variant()
PROJECT = Path(__file__).parents[2]

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
    with pytest.raises(rpf_errors.InputError, match="gives no radiance for single rays"):
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
    code = {}
    exec(re.search(r"```python\n(.*?)```", (PROJECT / "docs/file-format.md").read_text(), re.S).group(1), code)
    samples = render_samples(mi.load_dict(cornell_box()), 4)
    write_samples(tmp_path / "a.rpf", samples)
    header, counts, channels = code["read_samples"](tmp_path / "a.rpf")
    assert header["dataWindow"] == [0, 0, 33, 20] and (counts == 4).all()
    assert all(np.array_equal(channels[name], samples.channels[name], equal_nan=True) for name in samples.channels)
    assert [p.name for p in tmp_path.iterdir()] == ["a.rpf"]


def test_lines_of_the_document():
    code = re.search(r"<!-- run by python.mitsuba -->\n```python\n(.*?)```", (PROJECT / "docs/python.md").read_text(encoding="utf-8"), re.S).group(1)
    names = {"rpf": rpf, "scene": mi.load_dict(cornell_box())}
    exec(code, names)
    assert names["image"].pixels.shape == (20, 33, 3) and names["image"].pixels.mean() > 0.01


# ---- counts that vary

def varying(height=20, width=33):
    """0 to 6 samples, more to the right."""
    return np.random.default_rng(4).integers(0, 4, (height, width)) + np.arange(width) // 11


def test_density_is_rendered_sample_by_sample():
    density = varying()
    samples = render_samples(mi.load_dict(cornell_box("stratified")), density=density.astype(np.float32), seed=2)
    assert np.array_equal(samples.counts, density.ravel()) and samples.records().check() == []
    pixel = np.floor(samples.channels["film.Y"]) * 33 + np.floor(samples.channels["film.X"])
    assert np.array_equal(pixel, np.repeat(np.arange(density.size), density.ravel()))


def test_density_has_the_mean_of_the_scene():
    """32 rounds of varying counts against as many of even ones, within the noise that both have."""
    scene, density = mi.load_dict(cornell_box()), 1 + varying()
    mean, variance = render_reference(scene, 400)
    rounds = np.mean([render_samples(scene, density=density, seed=s).mean() for s in range(32)], 0)
    assert 0.5 < (np.square(rounds - mean) / (variance * 400 / (32 * density[..., None]) + variance + 1e-9)).mean() < 2


def test_rows_of_a_density_are_those_of_the_whole_frame(tmp_path):
    scene, density = mi.load_dict(cornell_box()), varying()
    render_to_file(tmp_path / "a.rpf", scene, seed=3, density=density, block_bytes=4 * 33 * 3 * 27 * 7)
    write_samples(tmp_path / "b.rpf", render_samples(scene, seed=3, density=density))
    assert (tmp_path / "a.rpf").read_bytes() == (tmp_path / "b.rpf").read_bytes()


@pytest.mark.parametrize("density, words", [(np.ones((3, 4)), "4 x 3 pixels"), (np.full((20, 33), 1.5), "whole numbers"), (np.zeros((20, 33)), "somewhere 1"),
                                            (np.full((20, 33), -1), "whole numbers")])
def test_density_that_cannot_be_is_refused(density, words):
    with pytest.raises(rpf_errors.InputError, match=words):
        render_samples(mi.load_dict(cornell_box()), density=density)


# ---- the command ----------------------------------------------------------------------------------------------------------

LOOK = '<transform name="to_world"><lookat origin="0 2 6" target="0 0.7 0" up="0 1 0"/></transform>'
AREA = """<shape type="rectangle"><transform name="to_world"><rotate x="1" angle="90"/><translate y="5"/></transform>
          <emitter type="area"><rgb name="radiance" value="12"/></emitter></shape>"""


def write_scene(name, folder, rfilter="box"):
    """One of six scenes of Mitsuba's own plugins: a ball on a floor. -> its file"""
    kind, camera, ball, floor, light = "perspective", "", '<bsdf type="diffuse"/>', '<rgb name="reflectance" value="0.6 0.5 0.4"/>', AREA
    if name == "lens":
        kind, camera = "thinlens", '<float name="aperture_radius" value="0.3"/><float name="focus_distance" value="5"/>'
    if name == "shutter":  # open, and nothing moves: Mitsuba 3 has no moving cameras or shapes
        camera = '<float name="shutter_open" value="0"/><float name="shutter_close" value="1"/>'
    if name == "metal":
        ball = '<bsdf type="roughconductor"><string name="material" value="Al"/><float name="alpha" value="0.2"/></bsdf>'
    if name == "glass":
        ball = '<bsdf type="dielectric"/>'
    if name == "textured":
        floor = '<texture name="reflectance" type="checkerboard"><transform name="to_uv"><scale value="8"/></transform></texture>'
        sky = np.full((8, 16, 3), 0.5, np.float32)
        sky[2, 3] = 20
        mi.Bitmap(sky).write(str(folder / "sky.exr"))
        light = f'<emitter type="envmap"><string name="filename" value="{folder}/sky.exr"/></emitter>'
    (folder / "scene.xml").write_text(f"""<scene version="3.0.0">
      <default name="integrator" value="path"/><integrator type="$integrator"/>
      <sensor type="{kind}"><float name="fov" value="40"/>{LOOK}{camera}
        <film type="hdrfilm"><integer name="width" value="48"/><integer name="height" value="32"/><rfilter type="{rfilter}"/></film>
        <sampler type="independent"><integer name="sample_count" value="4"/></sampler></sensor>
      <shape type="sphere"><point name="center" value="0 0.8 0"/><float name="radius" value="0.8"/>{ball}</shape>
      <shape type="rectangle"><transform name="to_world"><scale value="6"/><rotate x="1" angle="-90"/></transform>
        <bsdf type="diffuse">{floor}</bsdf></shape>
      {light}</scene>""")
    return str(folder / "scene.xml")


SCENES = {"lens": [], "shutter": [], "metal": [], "textured": [], "glass": [], "crop": ["--crop", "17x11+20+8"]}


@pytest.mark.parametrize("name", SCENES)
@pytest.mark.parametrize("ending", ["rpf", "exr"])
def test_command_writes_what_mitsuba_renders(tmp_path, name, ending):
    rpf = pytest.importorskip("rpf", reason="not built")
    pytest.importorskip("rpf._core", reason="the compiled part is not for this Python")
    path = write_scene(name, tmp_path)
    output = tmp_path / f"out.{ending}"
    assert main([path, "-o", str(output), "--spp", "4", "--seed", "5", *SCENES[name]]) == 0
    samples = rpf.read(output)
    x, y, width, height = samples.window
    scene = mi.load_file(path)
    if name == "crop":
        assert samples.window == (20, 8, 17, 11)
        parameters = mi.traverse(scene.sensors()[0])
        parameters["film.crop_size"], parameters["film.crop_offset"] = [17, 11], [20, 8]
        parameters.update()
    rendered = np.array(mi.render(scene, spp=4, seed=5))[..., :3]
    mean = np.stack([samples[c].reshape(height, width, 4).mean(-1) for c in "RGB"], -1)
    assert np.abs(mean - rendered).max() < MEAN_TOLERANCE * max(1, rendered.max()) and rendered.mean() > 0.01
    assert ("random.lens.U" in samples.slots) == (name == "lens") and "random.time" not in samples.slots
    assert samples.check() == []
    assert not list(tmp_path.glob("*.part")) and len(list(tmp_path.glob("out*"))) == 1


def test_rows_are_those_of_the_whole_frame(tmp_path):
    scene = mi.load_dict(cornell_box())
    render_to_file(tmp_path / "a.rpf", scene, 4, 3, block_bytes=4 * 33 * 4 * 27 * 7)  # 7 rows of 20
    write_samples(tmp_path / "b.rpf", render_samples(scene, 4, 3))
    assert (tmp_path / "a.rpf").read_bytes() == (tmp_path / "b.rpf").read_bytes()


def test_command_filters(tmp_path):
    rpf = pytest.importorskip("rpf")
    pytest.importorskip("rpf._core")
    names = [write_scene("lens", tmp_path), str(tmp_path / "out.exr"), str(tmp_path / "clean.exr")]
    assert main([names[0], "-o", names[1], "--size", "40x24", "--filter", names[2], "--preset", "fast"]) == 0
    assert np.array_equal(rpf.read_image(names[2]).pixels, rpf.filter(rpf.read(names[1]), "fast").pixels)


@pytest.mark.parametrize("arguments, code, words", [
    (["--crop", "40x40+30+0"], 2, "not inside the film"), (["--sensor", "3"], 2, "--sensor 3"), (["--filter", "a.png", "--preset", "best"], 2, "best"),
    (["-D", "integrator=ptracer"], 3, "gives no radiance for single rays"), (["--density", "none.exr"], 3, "--density none.exr")])
def test_command_refuses_before_it_renders(tmp_path, capsys, arguments, code, words):
    pytest.importorskip("rpf._core")
    assert main([write_scene("lens", tmp_path), "-o", str(tmp_path / "out.exr"), *arguments]) == code
    assert words in capsys.readouterr().err
    assert not list(tmp_path.glob("out*"))


def test_command_renders_the_rounds_of_rpf_adapt(tmp_path):
    rpf = pytest.importorskip("rpf")
    pytest.importorskip("rpf._core")
    scene, file = write_scene("lens", tmp_path), str(tmp_path / "all.exr")
    assert main([scene, "-o", file, "--spp", "2"]) == 0
    render = [sys.executable, "-m", "rpf.mitsuba", scene, "--density", "{density}", "--seed", "{seed}", "-o", "{output}"]
    adapted = subprocess.run([os.environ["RPF_COMMAND"], "adapt", file, "--spp", "8", "--", *render], capture_output=True, text=True, check=False)
    assert adapted.returncode == 0, adapted.stderr
    samples = rpf.read(file)
    assert len(samples.values) == 8 * 48 * 32 and samples.check() == [] and samples.metadata["rpf:seeds"] == "0 2 3"
    assert sorted(p.name for p in tmp_path.iterdir()) == ["all.exr", "scene.xml"]


def test_film_with_another_filter_is_told(tmp_path, capsys):
    assert main([write_scene("lens", tmp_path, "gaussian"), "-o", str(tmp_path / "out.rpf"), "--spp", "1"]) == 0
    assert "no pixel filter" in capsys.readouterr().err


def test_samples_become_records():
    pytest.importorskip("rpf._core")
    planes = render_samples(mi.load_dict(cornell_box()), 4)
    records = planes.records()
    assert records.window == planes.window and all(np.array_equal(records[name], planes.channels[name], equal_nan=True) for name in records.slots)
