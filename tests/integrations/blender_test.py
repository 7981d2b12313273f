"""The add-on for Blender, with bpy: what it renders is what Cycles renders, its numbers are Cycles', and it leaves the file as it was.
Usage (python with bpy): blender_test.py RPF PROJECT"""
import os
import sys
import tempfile
import unittest
from pathlib import Path

import bpy
import numpy as np

RPF, PROJECT = sys.argv.pop(1), Path(sys.argv.pop(1)).resolve()
os.environ["RPF_EXECUTABLE"] = RPF
ADDON = PROJECT / "integrations" / "blender" / "rpf_blender.py"
sys.path += [str(ADDON.parent), str(PROJECT / "tests" / "integrations")]
import blender_scenes  # noqa: E402
import rpf_blender  # noqa: E402

SAMPLES = 4
MEAN = 1e-3  # largest difference of a pixel: what differs is the order of floating-point sums


def drain(steps):
    """Runs a generator. -> what it returns"""
    while True:
        try:
            next(steps)
        except StopIteration as end:
            return end.value


def described(thing, depth=4):
    """All settings of a thing that can be written, and of the things in it."""
    found = {}
    for prop in thing.bl_rna.properties:
        name = prop.identifier
        # the color space of a format is filled in by Blender when it is first asked for
        if name in ("rna_type", "bl_rna", "is_updated", "is_updated_data", "linear_colorspace_settings", "depsgraph") or prop.type == "COLLECTION":
            continue
        try:
            value = getattr(thing, name)
        except (AttributeError, RuntimeError):
            continue
        if prop.type != "POINTER":
            found[name] = tuple(np.array(value).ravel()) if getattr(prop, "is_array", False) else repr(value)
        elif isinstance(value, bpy.types.ID):
            found[name] = value.name
        elif value is not None and depth:
            found[name] = described(value, depth - 1)
    return found


def changed(old, new, path=()):
    """What differs between two descriptions, in short."""
    if isinstance(old, dict) and isinstance(new, dict):
        return [line for key in old.keys() | new.keys() for line in changed(old.get(key), new.get(key), (*path, key))]
    return [] if old == new else [f"{path}: {str(old)[:80]} -> {str(new)[:80]}"]


def everything():
    """The file: its data blocks and their settings. That pictures were shown is no part of a file."""
    kinds = ("scenes", "objects", "meshes", "materials", "worlds", "cameras", "lights", "actions", "shape_keys", "node_groups", "collections")
    found = {(kind, block.name): described(block) for kind in kinds for block in getattr(bpy.data, kind)}
    for scene in bpy.data.scenes:
        found |= {(scene.name, layer.name): described(layer) for layer in scene.view_layers}
    return found


def k_samples(scene, samples):
    """Cycles' own render of K samples -> name of the pass -> [height, width]."""
    settings = rpf_blender.Settings()
    with tempfile.TemporaryDirectory() as folder:
        try:
            rpf_blender._prepare(settings, scene, samples)
            rpf_blender._prepare_layers(settings, scene, rpf_blender.Camera(scene))  # a layer's own number of samples
            scene.cycles.use_sample_subset = False
            return rpf_blender._render(scene, folder)
        finally:
            settings.restore()


def means(channels, window, samples=SAMPLES):
    return {c: channels[c].reshape(-1, samples).mean(1).reshape(window.height, window.width) for c in "RGB"}


class BlenderTest(unittest.TestCase):
    def expect_mean(self, scene, samples=SAMPLES):
        """-> layer -> channels, window"""
        before = everything()
        said = []
        layers, window = drain(rpf_blender.render_samples(scene, samples, said.append))
        self.assertEqual(changed(before, everything()), [])
        self.assertEqual(said, [])
        theirs = k_samples(scene, samples)
        for layer, channels in layers.items():
            for c, ours in means(channels, window, samples).items():
                self.assertLess(np.abs(ours - theirs[f"{layer}.Combined.{c}"]).max(), MEAN)
        return layers, window

    def expect_scene(self, kind, random, position=True):
        scene = blender_scenes.make(kind)
        layers, window = self.expect_mean(scene)
        channels = layers["ViewLayer"]
        self.assertEqual({name for name in channels if name.startswith("random.")} - {"random.light.U", "random.light.V", "random.bsdf.U", "random.bsdf.V"}, random)
        self.assertEqual("feature.P.X" in channels, position)
        self.expect_plane_to_agree(scene, window)
        return channels

    def expect_plane_to_agree(self, scene, window):
        camera, lens, time = rpf_blender.Camera(scene), scene.camera.data.dof.use_dof, scene.render.use_motion_blur
        with tempfile.TemporaryDirectory() as folder, rpf_blender._plane_scene(scene, camera, SAMPLES) as plane:
            for sample in (0, 2):
                measured = rpf_blender.measure(plane, camera, window, sample, folder)
                film, slots = rpf_blender.numbers_of(window, sample, SAMPLES, scene.cycles.seed, lens, time)
                found = rpf_blender.disagreement(measured, film, slots)
                print(sample, found)
                for name, size in found.items():
                    self.assertLess(size, rpf_blender.TOLERANCE[name], name)
                # another sample's numbers are noticed
                film, slots = rpf_blender.numbers_of(window, sample + 1, SAMPLES, scene.cycles.seed, lens, time)
                for name, size in rpf_blender.disagreement(measured, film, slots).items():
                    self.assertGreater(size, 10 * rpf_blender.TOLERANCE[name], name)

    def test_defocus(self):
        channels = self.expect_scene("defocus", {"random.lens.U", "random.lens.V"})
        hit = channels["feature.hit"] == 1
        self.assertLess(np.ptp(hit.reshape(-1, SAMPLES).mean(0)), 0.05)  # every sample has its features, not the first alone
        self.assertGreater(np.isfinite(channels["feature.P.X"][hit]).mean(), 0.99)
        floor = hit & (np.abs(channels["feature.N.Z"] - 1) < 1e-6) & np.isfinite(channels["feature.P.Z"])
        self.assertGreater(floor.sum(), 1000)
        self.assertLess(np.quantile(np.abs(channels["feature.P.Z"][floor]), 0.98), 0.01)  # the floor is at z = 0

    def test_motion(self):
        self.expect_scene("motion", {"random.time"})

    def test_pinhole(self):
        self.expect_scene("pinhole", set())

    def test_border_percentage_and_all_view_layers(self):
        scene = blender_scenes.make("pinhole", (192, 108))
        scene.render.resolution_percentage, scene.render.use_border = 50, True
        scene.render.border_min_x, scene.render.border_max_x, scene.render.border_min_y, scene.render.border_max_y = 0.25, 0.75, 0.5, 1.0
        scene.view_layers.new("second").samples = 2
        scene.view_layers.new("off").use = False
        layers, window = self.expect_mean(scene)
        self.assertEqual(list(layers), ["ViewLayer", "second"])
        self.assertEqual(window.data_window(), [24, 0, 48, 27])
        film = layers["second"]["film.X"].reshape(27, 48, SAMPLES), layers["second"]["film.Y"].reshape(27, 48, SAMPLES)
        self.assertTrue((np.floor(film[0]) == np.arange(24, 72)[None, :, None]).all())
        self.assertTrue((np.floor(film[1]) == np.arange(27)[:, None, None]).all())
        self.expect_plane_to_agree(scene, window)

    def test_settings_come_back_after_an_error_and_after_esc(self):
        scene = blender_scenes.make("motion")
        before = everything()
        steps = rpf_blender.render_samples(scene, SAMPLES)
        next(steps)
        self.assertNotEqual(changed(before, everything()), [])
        steps.close()  # what Esc does
        self.assertEqual(changed(before, everything()), [])
        steps = rpf_blender.render_samples(scene, SAMPLES)
        next(steps)
        with self.assertRaises(OSError):
            steps.throw(OSError("no space"))
        self.assertEqual(changed(before, everything()), [])

    def test_numbers_that_are_not_cycles_are_replaced_by_measured_ones(self):
        scene = blender_scenes.make("defocus")
        known, rpf_blender.FILM = rpf_blender.FILM, (7, 2)
        try:
            said = []
            layers, _ = drain(rpf_blender.render_samples(scene, 2, said.append))
        finally:
            rpf_blender.FILM = known
        self.assertIn("light and bsdf left out", said[0])
        self.assertEqual({name for name in layers["ViewLayer"] if name.startswith("random.")}, {"random.lens.U", "random.lens.V"})

    def test_refusals_name_what_to_do(self):
        scene = blender_scenes.make("pinhole")
        for change, words in ((lambda: setattr(scene.camera.data, "type", "ORTHO"), "perspective camera"),
                              (lambda: setattr(scene.render, "engine", "BLENDER_WORKBENCH"), "choose Cycles")):
            change()
            with self.assertRaisesRegex(rpf_blender.RpfError, words):
                drain(rpf_blender.render_samples(scene, 2))
            scene.render.engine = "CYCLES"

    def test_operator_runs_in_background_and_unregisters_cleanly(self):
        scene = blender_scenes.make("defocus")
        for _ in range(2):
            rpf_blender.register()
            self.assertTrue(hasattr(bpy.types, "RENDER_OT_rpf"))
            rpf_blender.unregister()
            self.assertFalse(hasattr(bpy.types, "RENDER_OT_rpf") or hasattr(bpy.types.Scene, "rpf"))
        rpf_blender.register()
        try:
            with tempfile.TemporaryDirectory() as folder:
                scene.rpf.samples, scene.rpf.preset = 2, "fast"
                scene.rpf.output, scene.rpf.filtered = f"{folder}/a.rpf", f"{folder}/clean.exr"
                self.assertEqual(bpy.ops.render.rpf(), {"FINISHED"})
                image = bpy.data.images["clean.exr"]
                self.assertEqual(tuple(image.size), (96, 54))
                self.assertGreater(np.array(image.pixels[:]).reshape(-1, 4)[:, :3].mean(), 0.01)
                scene.rpf.output = f"{folder}/missing/a.rpf"
                with self.assertRaises(RuntimeError):
                    bpy.ops.render.rpf()
        finally:
            rpf_blender.unregister()

    def test_headless(self):
        blender_scenes.make("motion")
        with tempfile.TemporaryDirectory(prefix="rpf blender ü ") as folder:
            samples, clean = Path(folder, "a.exr"), Path(folder, "clean.exr")
            self.assertEqual(rpf_blender.main(["--samples", "2", "-o", str(samples), "--filter", str(clean), "--preset", "fast"]), 0)
            self.assertEqual(sorted(path.name for path in Path(folder).iterdir()), ["a.exr", "clean.exr"])
            self.assertEqual(rpf_blender.main(["--samples", "0", "-o", str(samples)]), 1)


unittest.main(verbosity=2)
