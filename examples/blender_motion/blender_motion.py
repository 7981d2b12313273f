"""A moving scene rendered by Cycles and filtered by every preset, beside Cycles' own denoiser and a reference: pictures and a table.

    blender -b -P examples/blender_motion/blender_motion.py -- build/release/rpf OUTPUT_FOLDER
or, with bpy from PyPI: python examples/blender_motion/blender_motion.py -- build/release/rpf OUTPUT_FOLDER
"""
import json
import math
import subprocess
import sys
from pathlib import Path

import bpy

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "integrations/blender"))
import rpf_blender  # pylint: disable=wrong-import-position

PRESETS = ("fast", "balanced", "high")
SIZE = (192, 108)
REFERENCE_SAMPLES = 512


def material(name, color, roughness, checker=None):
    made = bpy.data.materials.new(name)
    made.use_nodes = True
    nodes, shader = made.node_tree.nodes, made.node_tree.nodes["Principled BSDF"]
    shader.inputs["Base Color"].default_value = (*color, 1)
    shader.inputs["Roughness"].default_value = roughness
    if checker:
        texture = nodes.new("ShaderNodeTexChecker")
        texture.inputs["Scale"].default_value = checker
        texture.inputs["Color1"].default_value, texture.inputs["Color2"].default_value = (*color, 1), (0.08, 0.09, 0.1, 1)
        made.node_tree.links.new(nodes.new("ShaderNodeTexCoord").outputs["UV"], texture.inputs["Vector"])
        made.node_tree.links.new(texture.outputs["Color"], shader.inputs["Base Color"])
    return made


def move(thing, path, before, after):
    """Linear from frame 0 to frame 2; frame 1 is rendered."""
    for frame, value in ((0, before), (2, after)):
        setattr(thing, path, value)
        thing.keyframe_insert(path, frame=frame)
    for curve in thing.animation_data.action.fcurves:
        for point in curve.keyframe_points:
            point.interpolation = "LINEAR"


def build():
    """A wheel that turns, a ball that flies and one that rests, on a checkered floor under an area light."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene, add = bpy.context.scene, bpy.ops.mesh
    add.primitive_plane_add(size=24)
    bpy.context.object.data.materials.append(material("floor", (0.7, 0.68, 0.62), 0.6, checker=24))
    add.primitive_torus_add(location=(-1.7, 0.4, 1.2), rotation=(math.pi / 2, 0, 0), major_radius=0.9, minor_radius=0.3)
    wheel = bpy.context.object
    wheel.data.materials.append(material("wheel", (0.15, 0.45, 0.75), 0.35, checker=12))
    move(wheel, "rotation_euler", (math.pi / 2, -0.5, 0), (math.pi / 2, 0.5, 0))
    for location, color, roughness in (((0.6, -0.6, 0.7), (0.85, 0.25, 0.1), 0.2), ((2.3, 1.2, 0.9), (0.75, 0.7, 0.3), 0.5)):
        add.primitive_uv_sphere_add(location=location, radius=location[2], segments=64, ring_count=32)
        bpy.ops.object.shade_smooth()
        bpy.context.object.data.materials.append(material("ball", color, roughness))
    flying = bpy.data.objects["Sphere"]
    move(flying, "location", (-0.6, -0.9, 0.7), (1.8, -0.3, 1.1))
    bpy.ops.object.light_add(type="AREA", location=(2.5, -3, 5), rotation=(0.62, 0.35, 0))
    bpy.context.object.data.energy, bpy.context.object.data.size = 500, 2
    bpy.ops.object.camera_add(location=(0.2, -7, 2.4), rotation=(1.36, 0, 0))
    scene.camera = bpy.context.object
    scene.world = bpy.data.worlds.new("sky")
    scene.world.use_nodes = True
    scene.world.node_tree.nodes["Background"].inputs["Color"].default_value = (0.2, 0.27, 0.4, 1)
    scene.render.engine, scene.render.threads_mode, scene.render.threads = "CYCLES", "FIXED", 2
    scene.render.resolution_x, scene.render.resolution_y = SIZE
    scene.render.use_motion_blur, scene.render.motion_blur_shutter = True, 1
    scene.frame_set(1)
    return scene


def has_denoiser(scene):
    """Debian's Blender comes without Open Image Denoise."""
    try:
        scene.cycles.denoiser, scene.cycles.denoising_input_passes = "OPENIMAGEDENOISE", "RGB_ALBEDO_NORMAL"
    except TypeError:
        return False
    return True


def render(scene, path, samples, denoise=False, seed=0):
    """What Cycles itself makes of as many samples, with the same pixel filter."""
    scene.cycles.samples, scene.cycles.use_adaptive_sampling, scene.cycles.pixel_filter_type = samples, False, "BOX"
    scene.cycles.use_denoising, scene.cycles.seed = denoise, seed
    scene.render.image_settings.file_format, scene.render.image_settings.color_depth = "OPEN_EXR", "32"
    scene.render.filepath = str(path)
    bpy.ops.render.render(write_still=True)


def compare(rpf, scene, folder, samples, reference):
    """Renders and filters; writes the picture, returns rows of the table."""
    sample_file, images = folder / f"motion-{samples}.samples.exr", {}
    for _ in rpf_blender.run(scene, samples, sample_file, None, "balanced"):
        pass
    images["mean of the samples"] = ["--boxes", "none"]
    images |= {f"`--preset {preset}`": ["--preset", preset] for preset in PRESETS}
    paths = []
    for number, options in enumerate(images.values()):
        paths.append(folder / f"motion-{samples}-{number}.exr")
        subprocess.run([rpf, *options, "--quiet", sample_file, "-o", paths[-1]], check=True)
    if has_denoiser(scene):
        images["Cycles' Open Image Denoise"] = None
        paths.append(folder / f"motion-{samples}-oidn.exr")
        render(scene, paths[-1], samples, denoise=True)
    picture = folder / f"motion-{samples}.png"
    subprocess.run([rpf, "compare", paths[0], paths[2], paths[-1], reference, "--side-by-side", picture], check=True, stdout=subprocess.DEVNULL)
    found = subprocess.run([rpf, "compare", "--json", *paths, reference], check=True, stdout=subprocess.PIPE).stdout
    return list(zip(images, json.loads(found)["images"]))


def main(rpf, folder):
    folder.mkdir(parents=True, exist_ok=True)
    scene, reference = build(), folder / "motion-reference.exr"
    rpf_blender.executable = lambda: rpf
    render(scene, reference, REFERENCE_SAMPLES, seed=1)
    scene.cycles.seed = 0  # of the samples and of Cycles' own denoiser: both filter the same ones
    tables = {samples: compare(rpf, scene, folder, samples, reference) for samples in (4, 8)}
    lines = ["| | samples | relMSE | trimmed relMSE | FLIP | energy |", "|---|---|---|---|---|---|"]
    for samples, rows in tables.items():
        for name, m in rows:
            lines.append(f"| {name} | {samples} | {m['relMSE']:.4f} | {m['trimmed_relMSE']:.4f} | {m['FLIP']:.3f} | {m['energy']:.3f} |")
    Path(folder, "motion.md").write_text("\n".join(lines) + "\n", encoding="utf-8")
    print("\n".join(lines))


if __name__ == "__main__":
    arguments = sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else []
    if len(arguments) != 2:
        sys.exit(__doc__)
    main(str(Path(arguments[0]).resolve()), Path(arguments[1]).resolve())
