"""The program Blender, where it is installed: the commands of pages, word for word: docs/blender.md on three scenes (the mean of the samples is
what Cycles renders by itself), the example; and the add-on as a user installs it. Usage: blender_program_test.py RPF PROJECT BLENDER"""
import json
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

RPF, PROJECT, BLENDER = (Path(argument).resolve() for argument in sys.argv[1:])
if not BLENDER.exists():
    print("skipped: there is no program blender (Debian's package of that name will do)")
    sys.exit(77)
sys.path.insert(0, str(PROJECT / "tests" / "docs"))
from pages import blocks, pages  # noqa: E402

ADDON = PROJECT / "integrations" / "blender" / "rpf_blender.py"
SAMPLES = 8  # as on the page
MEAN = 1e-5  # largest difference of a pixel: what differs is the order of floating-point sums
SAVE = """import sys; sys.path.insert(0, {scenes!r})
import blender_scenes, bpy
scene = blender_scenes.make({kind!r})
bpy.ops.wm.save_as_mainfile(filepath={folder!r} + "/file.blend")
"""
RENDER = f"""import bpy
scene = bpy.context.scene
cycles, output = scene.cycles, scene.render.image_settings
cycles.samples, cycles.use_adaptive_sampling, cycles.use_denoising, cycles.pixel_filter_type = {SAMPLES}, False, False, "BOX"
if "BLUE_NOISE" in cycles.bl_rna.properties["sampling_pattern"].enum_items:
    cycles.sampling_pattern = "BLUE_NOISE"
output.file_format, output.color_depth = "OPEN_EXR", "32"
scene.render.filepath = {{folder!r}} + "/cycles.exr"
bpy.ops.render.render(write_still=True)
"""

INSTALL = """import bpy
bpy.ops.preferences.addon_install(filepath={addon!r})
bpy.ops.preferences.addon_enable(module="rpf_blender")
rpf = bpy.context.scene.rpf
rpf.samples, rpf.output, rpf.filtered = 2, {folder!r} + "/panel.rpf", {folder!r} + "/panel.exr"
assert bpy.ops.render.rpf() == {{"FINISHED"}}
assert tuple(bpy.data.images["panel.exr"].size) == (96, 54)
bpy.ops.preferences.addon_disable(module="rpf_blender")
assert not hasattr(bpy.types, "RENDER_OT_rpf") and not hasattr(bpy.types.Scene, "rpf")
"""


def run(folder, *command):
    # PWD: where Blender looks for files, whatever the folder is
    path = f"{BLENDER.parent}:{RPF.parent}:{os.environ['PATH']}"
    result = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False, env={**os.environ, "PATH": path, "RPF_EXECUTABLE": str(RPF), "PWD": folder,
                                 "BLENDER_USER_RESOURCES": f"{folder}/blender"})
    assert result.returncode == 0, result.stdout[-2000:] + result.stderr[-2000:]
    return result.stdout


def run_page(folder, place):
    commands = [block.text for block in blocks(pages(PROJECT)[place]) if block.note == "run by blender.program"]
    assert commands, f"{place} has <!-- run by blender.program --> no more"
    run(folder, "bash", "-euo", "pipefail", "-xc", "".join(commands))


def python(folder, script, *file):
    """Runs a script in Blender, whose exit status is 0 whatever a script does unless it is told."""
    return run(folder, BLENDER, "-b", "--python-exit-code", "1", *file, "--python-expr", script)


def make(kind, folder):
    """file.blend and rpf_blender.py, as a reader of the page has them."""
    (Path(folder) / "rpf_blender.py").symlink_to(ADDON)
    python(folder, SAVE.format(scenes=str(PROJECT / "tests" / "integrations"), kind=kind, folder=folder))


class BlenderProgramTest(unittest.TestCase):
    def test_the_mean_of_the_samples_is_what_cycles_renders(self):
        for kind in ("defocus", "motion", "pinhole"):
            with self.subTest(kind), tempfile.TemporaryDirectory(prefix="rpf blender ü ") as folder:
                make(kind, folder)
                before = (Path(folder) / "file.blend").read_bytes()
                run_page(folder, "docs/blender.md")
                self.assertEqual((Path(folder) / "file.blend").read_bytes(), before)
                python(folder, RENDER.format(folder=folder), "file.blend")
                run(folder, RPF, "samples.exr", "-o", "mean.exr", "--boxes", "none", "-q")
                compared = json.loads(run(folder, RPF, "compare", "--json", "mean.exr", "cycles.exr"))["images"][0]["largest_difference"]
                print(kind, compared)
                self.assertLess(max(channel["difference"] for channel in compared.values()), MEAN)
                self.assertTrue((Path(folder) / "clean.exr").exists())

    def test_the_example_compares_every_preset(self):
        with tempfile.TemporaryDirectory(prefix="rpf blender ü ") as folder:
            (Path(folder) / "build").mkdir()
            (Path(folder) / "build" / "release").symlink_to(RPF.parent)
            for name in ("examples", "integrations"):
                (Path(folder) / name).symlink_to(PROJECT / name)
            run_page(folder, "examples/blender_motion/README.md")
            table = (Path(folder) / "motion" / "motion.md").read_text()
            self.assertEqual([table.count(f"`--preset {preset}`") for preset in ("fast", "balanced", "high")], [2, 2, 2])
            self.assertTrue((Path(folder) / "motion" / "motion-8.png").exists())

    def test_the_add_on_is_installed_and_renders(self):
        with tempfile.TemporaryDirectory(prefix="rpf blender ü ") as folder:
            make("defocus", folder)
            python(folder, INSTALL.format(addon=str(ADDON), folder=folder), "file.blend")
            self.assertTrue((Path(folder) / "panel.exr").exists())


if __name__ == "__main__":
    print(run("/", BLENDER, "-b", "--version").splitlines()[0])
    unittest.main(argv=sys.argv[:1])
