"""Renders a frame with Cycles sample by sample, with the random numbers that made each, and filters it with rpf (docs/blender.md).

An add-on of one file (Edit > Preferences > Add-ons > Install from Disk), and a script:
    blender -b file.blend -P rpf_blender.py -- --samples 8 -o samples.exr --filter clean.exr
"""
import argparse
import contextlib
import json
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import bpy
import numpy as np

bl_info = {"name": "RPF: filter of samples", "author": "rpf", "version": (0, 1, 0), "blender": (3, 4, 0), "category": "Render",
           "location": "Properties > Render > RPF", "description": "Renders samples with Cycles and filters them"}
PRESETS = ("fast", "balanced", "high")
NOT_COVERED = ("Not covered: pixel filters wider than a pixel (a box is rendered), second hits, volumes, panoramic and orthographic cameras. "
               "Not exact: polygonal blades, numbers behind transparent first hits. GPU untested")


class RpfError(Exception):
    """What a user can do something about."""


# ---- Cycles' random numbers: the blue-noise pattern of kernel/sample/pattern.h (Cycles 4.2 to 4.5), on arrays of uint32 ----------------
def _reversed_bits(n):
    for shift, mask in ((1, 0x55555555), (2, 0x33333333), (4, 0x0F0F0F0F), (8, 0x00FF00FF)):
        n = ((n >> np.uint32(shift)) & np.uint32(mask)) | ((n & np.uint32(mask)) << np.uint32(shift))
    return (n >> np.uint32(16)) | (n << np.uint32(16))


def _owen(n, seed, base4=False):
    """Owen scrambling of numbers whose bits are reversed, in base 2 or 4."""
    def carry(n):
        return n ^ ((n >> np.uint32(1)) & (n << np.uint32(1)) & np.uint32(0x55555555)) if base4 else n
    seed = np.uint32(seed)
    n = carry(n ^ n * np.uint32(0x3D20ADEA)) + seed
    n = carry(n * ((seed >> np.uint32(16)) | np.uint32(1)))
    n = n ^ n * np.uint32(0x05526C56)
    return n ^ n * np.uint32(0x53A22864)


def _hash_dimension(i):
    i ^= i >> 16
    i = i * 0x21F0AAAD & 0xFFFFFFFF
    i ^= i >> 15
    i = i * 0xD35A2D97 & 0xFFFFFFFF
    return i ^ i >> 15 ^ 0xE6FE3BEB


def _hash_seed(key):
    """Jenkins' lookup3 of one word: the last rounds."""
    words = [0xDEADBEEF + 17 + key, 0xDEADBEEF + 17, 0xDEADBEEF + 17]
    for step, shift in enumerate((14, 11, 25, 16, 4, 14, 24)):
        to, by = (2, 1) if step % 3 == 0 else (0, 2) if step % 3 == 1 else (1, 0)
        rotated = words[by] << shift | (words[by] & 0xFFFFFFFF) >> (32 - shift)
        words[to] = ((words[to] ^ words[by]) - rotated) & 0xFFFFFFFF
    return words[2]


def _sobol_table(dimension):
    """Direction numbers of the first three dimensions (Joe and Kuo), each with its bits reversed."""
    m = ([1] * 32, [1], [1, 3])[dimension]
    while len(m) < 32:
        m.append(2 * m[-1] ^ m[-1] if dimension == 1 else 2 * m[-1] ^ 4 * m[-2] ^ m[-2])
    return [1 << bit if dimension == 0 else int(f"{m[bit]:0{bit + 1}b}"[::-1], 2) for bit in range(32)]


_SETS = {2: (0xF8ADE99A, (0xE0AAAF76, 0x94964D4E)), 3: (0xCAA726AC, (0x9E78E391, 0x67C33241, 0x78C395C5))}
FILM, TIME_LENS, LIGHT, BSDF = (0, 2), (1, 3), (17, 3), (19, 3)  # dimension, count; 16 dimensions a bounce


def cycles_numbers(x, y, sample, samples, seed, which):
    """Random numbers [count, len(x)] in [0,1) of a pixel (from the bottom left) and a sample: kernel/sample/sobol_burley.h."""
    dimension, count = which
    morton = np.zeros_like(x, np.uint32)
    for bit in range(16):
        morton |= ((y >> bit & 1) << 2 * bit | (x >> bit & 1) << (2 * bit + 1)).astype(np.uint32)
    index = _reversed_bits(_owen(_reversed_bits(morton), _hash_seed(seed), base4=True)) * np.uint32(samples) + np.uint32(sample)
    shuffle, scrambles = _SETS[count]
    seed = _hash_dimension(dimension)
    index = _reversed_bits(_owen(_reversed_bits(index), seed ^ shuffle))
    numbers = []
    for component, scramble in enumerate(scrambles):
        value = np.zeros_like(index)
        for bit, direction in enumerate(_sobol_table(component)):
            value ^= (index >> np.uint32(bit) & np.uint32(1)) * np.uint32(direction)
        value = _reversed_bits(_owen(value, seed ^ scramble))
        numbers.append(value.astype(np.float32) * np.float32(1 / 4294967808))
    return np.stack(numbers)


# ---- the lens: a disk, concentric (kernel/sample/mapping.h) ----------------------------------------------------------------
def disk_of_square(u, v):
    a, b = 2 * u.astype(float) - 1, 2 * v.astype(float) - 1
    wide = a * a > b * b
    r, other = np.where(wide, a, b), np.where(wide, b, a)
    phi = np.pi / 4 * np.divide(other, r, out=np.zeros_like(r), where=r != 0)
    phi = np.where(wide, phi, np.pi / 2 - phi)
    return r * np.cos(phi), r * np.sin(phi)


def square_of_disk(x, y):
    r = np.hypot(x, y)
    wide = np.abs(x) > np.abs(y)
    with np.errstate(divide="ignore", invalid="ignore"):
        ratio = np.where(wide, np.arctan(y / x), np.arctan(x / y)) * 4 / np.pi
    ratio = np.nan_to_num(ratio)
    a = np.where(wide, np.copysign(r, x), np.copysign(r, y) * ratio)
    b = np.where(wide, np.copysign(r, x) * ratio, np.copysign(r, y))
    return (a + 1) / 2, (b + 1) / 2


class Camera:
    """A perspective camera at the scene's frame: rays in its own space, whose axes Cycles takes without their scale."""

    def __init__(self, scene):
        camera = scene.camera
        if camera is None or camera.type != "CAMERA" or camera.data.type != "PERSP":
            raise RpfError("the scene needs a perspective camera; panoramic and orthographic ones are not covered")
        evaluated = camera.evaluated_get(bpy.context.evaluated_depsgraph_get()) if scene == bpy.context.scene else camera
        location, rotation, _ = evaluated.matrix_world.decompose()
        self.matrix = np.eye(4)
        self.matrix[:3, :3], self.matrix[:3, 3] = np.array(rotation.to_matrix()), location
        data = evaluated.data
        frame = np.array([corner[:] for corner in data.view_frame(scene=scene)])
        frame /= -frame[:, 2:]
        self.low, self.high = frame.min(0)[:2], frame.max(0)[:2]  # of the film, at the distance 1
        self.near, self.far = data.clip_start, data.clip_end
        dof = data.dof
        self.radius = data.lens * 1e-3 / (2 * max(dof.aperture_fstop, 1e-5)) if dof.use_dof else 0
        self.ratio = dof.aperture_ratio
        self.focus = dof.focus_distance
        if dof.focus_object:
            target = np.array(dof.focus_object.evaluated_get(bpy.context.evaluated_depsgraph_get()).matrix_world.translation)
            self.focus = abs((target - self.matrix[:3, 3]) @ self.matrix[:3, 2])

    def rays(self, film, lens):
        """Origins and unit directions [3, n] in camera space. film: 0 to 1 of the whole frame, from the bottom left."""
        through = np.stack([self.low[i] + film[i] * (self.high[i] - self.low[i]) for i in (0, 1)] + [-np.ones_like(film[0])])
        if lens is None or not self.radius:
            origin = np.zeros_like(through)
            direction = through
        else:
            x, y = disk_of_square(*lens)
            origin = np.stack([x * self.radius / self.ratio, y * self.radius, np.zeros_like(x)])
            direction = through * self.focus - origin
        return origin, direction / np.linalg.norm(direction, axis=0), np.linalg.norm(through, axis=0)

    def film_and_lens(self, point, direction):
        """The inverse: of a ray through point -> film, lens (None for a pinhole)."""
        origin = point - direction * (point[2] / direction[2])
        focus = self.focus if self.radius else 1.0
        through = (origin - direction * (focus / direction[2])) / focus
        film = np.stack([(through[i] - self.low[i]) / (self.high[i] - self.low[i]) for i in (0, 1)])
        lens = square_of_disk(origin[0] * self.ratio / self.radius, origin[1] / self.radius) if self.radius else None
        return film, lens

    def positions(self, film, lens, mist, depth):
        """World positions [3, n]: where the distance from the camera (mist) and along the ray (depth) agree, else NaN."""
        origin, direction, slope = self.rays(film, lens)
        along = (origin * direction).sum(0)
        with np.errstate(invalid="ignore"):
            distance = -along + np.sqrt(along**2 - (origin**2).sum(0) + (mist * self.far) ** 2)
            agree = np.abs(distance - (depth + self.near * slope)) < 2e-3 * distance
        points = self.matrix[:3, :3] @ (origin + direction * distance) + self.matrix[:3, 3:]
        return np.where(agree, points, np.nan)


# ---- settings that are changed and put back --------------------------------------------------------------------------------
class Settings:
    """Changes settings; restore() puts all of them back, in the order in which they were remembered."""

    def __init__(self):
        self.old = []

    def set(self, owner, **values):
        known = [name for of, name, _ in self.old if of == owner]  # layers share a world
        values = {name: value for name, value in values.items() if hasattr(owner, name)}
        self.old += [(owner, name, getattr(owner, name)) for name in values if name not in known]  # before one changes another
        for name, value in values.items():
            setattr(owner, name, value)

    def restore(self):
        for owner, name, value in self.old:
            with contextlib.suppress(ReferenceError):
                setattr(owner, name, value)
        self.old = []


def _sampling(cycles, samples):
    """What makes Cycles' samples ours, of scene.cycles. Before 4.5 it had no subset: each frame is the sequence's one sample from its offset."""
    has_subset = hasattr(cycles, "use_sample_subset")
    has_blue_noise = "BLUE_NOISE" in cycles.bl_rna.properties["sampling_pattern"].enum_items
    return {"samples": samples if has_subset else 1, "use_adaptive_sampling": False, "use_denoising": False, "use_animated_seed": False,
            "time_limit": 0, "sampling_pattern": "BLUE_NOISE" if has_blue_noise else cycles.sampling_pattern,
            "auto_scrambling_distance": False, "scrambling_distance": 1, "use_guiding": False,
            "pixel_filter_type": "BOX", "use_sample_subset": True, "sample_subset_length": 1, "sample_offset": 0}


def _prepare(settings, scene, samples):
    """Settings of a scene for frames of one sample, written as multilayer files."""
    # Setting the format changes the others: it is remembered, so restored, before them.
    settings.set(scene.render.image_settings, file_format="OPEN_EXR_MULTILAYER", color_mode="RGBA", color_depth="32", exr_codec="NONE",
                 color_management="FOLLOW_SCENE")
    settings.set(scene.render, filepath="", use_file_extension=True, use_overwrite=True, use_placeholder=False, use_compositing=False,
                 use_sequencer=False, use_persistent_data=True, use_crop_to_border=True, use_single_layer=False, use_freestyle=False)
    settings.set(scene.cycles, **_sampling(scene.cycles, samples))


def _prepare_layers(settings, scene, camera):
    for layer in _layers(scene):
        settings.set(layer, samples=0, use_pass_combined=True, use_pass_z=True, use_pass_normal=True, use_pass_uv=True, use_pass_mist=True)
        settings.set(layer.cycles, denoising_store_passes=True)
        world = getattr(layer, "world_override", None) or scene.world
        if world:
            settings.set(world.mist_settings, start=0, depth=camera.far, falloff="LINEAR")


def _layers(scene):
    return [layer for layer in scene.view_layers if layer.use]


# ---- frames as multilayer OpenEXR files ------------------------------------------------------------------------------------
def read_passes(path):
    """An uncompressed scan-line file -> name of the channel -> [height, width] float32."""
    data = Path(path).read_bytes()
    at, header = 8, {}
    if int.from_bytes(data[5:7], "little") & 0x18:
        raise RpfError(f"{path} has several parts; this version of Blender writes another format than 4.5")

    def text(at):
        end = data.index(b"\0", at)
        return data[at:end].decode(), end + 1
    while data[at]:
        name, at = text(at)
        _, at = text(at)
        size = int.from_bytes(data[at:at + 4], "little")
        header[name], at = data[at + 4:at + 4 + size], at + 4 + size
    if header["compression"] != b"\0":
        raise RpfError(f"{path} is compressed, against the setting")
    x0, y0, x1, y1 = np.frombuffer(header["dataWindow"], "<i4")
    width, height = x1 - x0 + 1, y1 - y0 + 1
    fields, channels, c = [("line", "<i4", 2)], header["channels"], 0
    while channels[c]:
        end = channels.index(b"\0", c)
        fields.append((channels[c:end].decode(), "<f2" if channels[end + 1] == 1 else "<f4", int(width)))
        c = end + 17
    rows = np.frombuffer(data, np.dtype(fields), height, at + 1 + 8 * int(height))
    return {name: rows[name].astype(np.float32) for name, *_ in fields[1:]}


def _render(scene, folder):
    """Renders and reads one frame."""
    path = Path(folder, "frame.exr")
    path.unlink(missing_ok=True)
    scene.render.filepath = str(path)
    if "FINISHED" not in bpy.ops.render.render(write_still=True, scene=scene.name) or not path.exists():
        raise RpfError("Cycles rendered nothing, or it was stopped")
    return read_passes(path)


class Window:
    """The rendered part of the frame, in pixels; y counts from the bottom, as in Cycles."""

    def __init__(self, scene, size):
        render = scene.render
        self.full = [int(render.resolution_x * render.resolution_percentage / 100), int(render.resolution_y * render.resolution_percentage / 100)]
        border = (render.border_min_x, render.border_min_y) if render.use_border else (0, 0)
        self.x, self.y = int(np.float32(border[0]) * np.float32(self.full[0])), int(np.float32(border[1]) * np.float32(self.full[1]))
        self.width, self.height = size
        rows, columns = np.mgrid[self.y + self.height - 1:self.y - 1:-1, self.x:self.x + self.width] if self.y else             np.meshgrid(np.arange(self.height)[::-1], np.arange(self.x, self.x + self.width), indexing="ij")
        self.px, self.py = columns.ravel(), rows.ravel()

    def data_window(self):
        return [self.x, self.full[1] - self.y - self.height, self.width, self.height]

    def fractions(self, film):
        return np.stack([(self.px + film[0]) / self.full[0], (self.py + film[1]) / self.full[1]])


def numbers_of(window, sample, samples, seed, lens, time):
    """Recomputed: film [2, n] inside the pixel, and the random slots."""
    def draw(which):
        return cycles_numbers(window.px, window.py, sample, samples, seed, which)
    film = draw(FILM) if sample else np.full((2, len(window.px)), 0.5, np.float32)
    film = np.where(film > 1023 / 1024, (1 - film) * 1024, film)  # the last cell of Cycles' table of the filter leads back to 0
    slots = {}
    if lens or time:
        t, u, v = draw(TIME_LENS)
        if lens:
            slots |= {"random.lens.U": u, "random.lens.V": v}
        if time:
            slots["random.time"] = t
    for group, which in (("light", LIGHT), ("bsdf", BSDF)):
        slots[f"random.{group}.U"], slots[f"random.{group}.V"], _ = draw(which)
    return film, slots


# ---- the check: a plane before the camera that tells where it was hit --------------------------------------------------------
_PLANE_DISTANCE, _SLIDE = 10.0, 8.0  # it slides _SLIDE a frame, in its own plane


def _plane_size(camera):
    """Large enough wherever it slid to; not larger, because rounding grows with it."""
    return 2.4 * _PLANE_DISTANCE * float(np.abs([camera.low, camera.high]).max()) + 4 * camera.radius + 4 * _SLIDE


def _plane_material():
    material = bpy.data.materials.new("rpf plane")
    material.use_nodes = True
    nodes, link = material.node_tree.nodes, material.node_tree.links.new
    nodes.clear()
    coordinates, geometry = nodes.new("ShaderNodeTexCoord"), nodes.new("ShaderNodeNewGeometry")
    turned = nodes.new("ShaderNodeVectorTransform")
    turned.vector_type, turned.convert_from, turned.convert_to = "VECTOR", "WORLD", "OBJECT"
    link(geometry.outputs["Incoming"], turned.inputs[0])
    emission, surface = nodes.new("ShaderNodeEmission"), nodes.new("ShaderNodeOutputMaterial")
    link(emission.outputs[0], surface.inputs["Surface"])
    for name, output in (("where", coordinates.outputs["Object"]), ("whence", turned.outputs[0]), ("slid", coordinates.outputs["UV"])):
        node = nodes.new("ShaderNodeOutputAOV")
        setattr(node, "aov_name" if hasattr(node, "aov_name") else "name", f"rpf {name}")
        link(output, node.inputs["Color"])
    return material


def _plane(scene, half):
    """A plane that follows the camera, at _PLANE_DISTANCE before it. Its uv slides with a shape key."""
    mesh = bpy.data.meshes.new("rpf plane")
    mesh.from_pydata([(x, y, -_PLANE_DISTANCE) for x, y in ((-half, -half), (half, -half), (half, half), (-half, half))], [], [(0, 1, 2, 3)])
    mesh.uv_layers.new(name="UVMap").data.foreach_set("uv", [0, 0, 1, 0, 1, 1, 0, 1])
    mesh.materials.append(_plane_material())
    plane = bpy.data.objects.new("rpf plane", mesh)
    scene.collection.objects.link(plane)
    for kind in ("COPY_LOCATION", "COPY_ROTATION"):
        plane.constraints.new(kind).target = scene.camera
    plane.shape_key_add(name="Basis")
    key = plane.shape_key_add(name="slid")
    for point in key.data:
        point.co.x += 2 * _SLIDE
    for offset, value in ((-1, 0.0), (1, 1.0)):
        key.value = value
        key.keyframe_insert("value", frame=scene.frame_current + offset)
    for curve in _curves(mesh.shape_keys.animation_data.action):
        for point in curve.keyframe_points:
            point.interpolation = "LINEAR"
    return plane


def _curves(action):
    return action.fcurves if hasattr(action, "fcurves") else action.layers[0].strips[0].channelbags[0].fcurves


_COPIED = ("resolution_x", "resolution_y", "resolution_percentage", "pixel_aspect_x", "pixel_aspect_y", "use_border", "border_min_x",
           "border_max_x", "border_min_y", "border_max_y", "use_motion_blur", "motion_blur_shutter", "fps", "fps_base",
           "threads_mode", "threads")


def _shutter_position(scene):
    """What has the setting: of Cycles in Blender 3."""
    return scene.render if hasattr(scene.render, "motion_blur_position") else scene.cycles


@contextlib.contextmanager
def _plane_scene(scene, camera, samples):
    before = {kind: set(getattr(bpy.data, kind)) for kind in ("scenes", "objects", "meshes", "materials", "actions", "shape_keys")}
    copy = bpy.data.scenes.new("rpf plane")
    try:
        copy.render.engine, copy.camera, copy.world = "CYCLES", scene.camera, None
        copy.frame_start, copy.frame_end = scene.frame_start, scene.frame_end
        copy.frame_set(scene.frame_current, subframe=scene.frame_subframe)
        for name in _COPIED:
            setattr(copy.render, name, getattr(scene.render, name))
        _shutter_position(copy).motion_blur_position = _shutter_position(scene).motion_blur_position
        copy.cycles.seed, copy.cycles.device, copy.cycles.max_bounces = scene.cycles.seed, "CPU", 0
        _prepare(Settings(), copy, samples)
        for name in ("where", "whence", "slid"):
            copy.view_layers[0].aovs.add().name = f"rpf {name}"
        _plane(copy, _plane_size(camera) / 2)
        yield copy
    finally:
        for kind in ("scenes", "objects", "meshes", "materials", "actions"):
            for made in set(getattr(bpy.data, kind)) - before[kind]:
                getattr(bpy.data, kind).remove(made)


def measure(plane_scene, camera, window, sample, folder):
    """What the plane says of a sample: film [2, n] inside the pixel, lens (U, V) or None, time in [0,1)."""
    plane_scene.cycles.sample_offset = sample
    passes = _render(plane_scene, folder)

    def aov(name):
        return np.stack([next(v for k, v in passes.items() if k.endswith(f"rpf {name}.{c}")).ravel().astype(float) for c in "RGB"])
    where, slid = aov("where"), aov("slid")
    film, lens = camera.film_and_lens(where, -aov("whence"))
    film = np.stack([film[0] * window.full[0] - window.px, film[1] * window.full[1] - window.py])
    offset = where[0] - (slid[0] - 0.5) * _plane_size(camera)  # in [0, 2 _SLIDE] over the frames -1 to 1
    shutter = plane_scene.render.motion_blur_shutter
    begin = {"START": 0, "CENTER": -shutter / 2, "END": -shutter}[_shutter_position(plane_scene).motion_blur_position]
    return film, lens, (offset / _SLIDE - 1 - begin) / shutter


TOLERANCE = {"film": 2e-3, "lens": 2e-3, "time": 1e-2}  # of numbers; what Cycles' tables and floats cost is a tenth of that


def disagreement(measured, film, slots):
    """Largest difference of film, lens and time between plane and recomputation, but for one pixel in a thousand."""
    def largest(a, b):
        return float(np.quantile(np.abs(np.asarray(a) - np.asarray(b)), 0.999))
    found = {"film": largest(measured[0], film)}
    if "random.lens.U" in slots:
        found["lens"] = largest(measured[1], (slots["random.lens.U"], slots["random.lens.V"]))
    if "random.time" in slots:
        found["time"] = largest(measured[2], slots["random.time"])
    return found


# ---- samples ---------------------------------------------------------------------------------------------------------------
def _features(passes, layer, camera, window, film, slots):
    """Color and features of a sample of a layer: slot -> [n]."""
    def plane(name, *components):
        for component in components:
            values = passes.get(f"{layer.name}.{name}.{component}")
            if values is not None:
                return values.ravel()
        raise RpfError(f"Cycles wrote no pass {name} for the view layer {layer.name}")
    color = {c: plane("Combined", c) for c in "RGBA"}
    values = {f"feature.N.{c}": plane("Normal", c) for c in "XYZ"}
    length = np.sqrt(sum(v.astype(float) ** 2 for v in values.values()))
    hit = length > 0.1  # Cycles writes Depth for sample 0 only, a normal for every sample that hit a surface
    with np.errstate(invalid="ignore", divide="ignore"):
        values = {name: np.where(hit, v / length, np.nan) for name, v in values.items()}
    values |= {f"feature.albedo.{c}": np.clip(plane("Denoising Albedo", c), 0, 1) for c in "RGB"}
    values |= {f"feature.uv.{c}": plane("UV", c) for c in "UV"}
    if camera is not None:
        lens = (slots["random.lens.U"], slots["random.lens.V"]) if "random.lens.U" in slots else None
        points = camera.positions(window.fractions(film), lens, plane("Mist", "Z", "V").astype(float), plane("Denoising Depth", "Z", "V", "X"))
        values |= {f"feature.P.{c}": points[i] for i, c in enumerate("XYZ")}
    return color | {"feature.hit": hit.astype(np.float32)} | {name: np.where(hit, v, np.nan) for name, v in values.items()}


def _camera_moves(scene):
    if not scene.render.use_motion_blur:
        return False
    frame, part, shutter = scene.frame_current, scene.frame_subframe, scene.render.motion_blur_shutter
    places = []
    for offset in (-shutter, 0, shutter):
        time = frame + part + offset
        scene.frame_set(int(np.floor(time)), subframe=float(time - np.floor(time)))
        places.append(np.array(scene.camera.evaluated_get(bpy.context.evaluated_depsgraph_get()).matrix_world))
    scene.frame_set(frame, subframe=part)
    return any(np.abs(place - places[1]).max() > 1e-6 for place in places)


def _refuse(scene, samples):
    if scene.render.engine != "CYCLES":
        raise RpfError(f"the scene is rendered by {scene.render.engine}; choose Cycles")
    if not 1 <= samples <= 1024:
        raise RpfError(f"{samples} samples a pixel; 4 to 16 are meant, 1 to 1024 possible")
    if scene.render.use_multiview:
        raise RpfError("stereoscopy is not covered; turn it off")
    if not _layers(scene):
        raise RpfError("no view layer is rendered; turn one on")


def _inside(film):
    return np.clip(film, 0, 1 - 2**-12)  # Cycles' table of the box ends at the pixel's edge, give or take a rounding


def render_samples(scene, samples, say=print):
    """Renders; a generator that yields the part that is done, and returns name of the view layer -> (window, channels).

    Every setting is as before when it ends, also by an error or by close()."""
    _refuse(scene, samples)
    camera, moves, settings = Camera(scene), _camera_moves(scene), Settings()
    use_lens, use_time = camera.radius > 0, scene.render.use_motion_blur
    with tempfile.TemporaryDirectory(prefix="rpf-blender-") as folder:
        try:
            _prepare(settings, scene, samples)
            _prepare_layers(settings, scene, camera)
            frames = []
            for sample in range(samples):  # all frames in a row: another scene between them would undo the persistent data
                scene.cycles.sample_offset = sample
                frames.append(_render(scene, folder))
                yield (sample + 1) / (samples + 2)
        finally:
            settings.restore()
        window = Window(scene, next(iter(frames[0].values())).shape[::-1])
        numbers = [numbers_of(window, k, samples, scene.cycles.seed, use_lens, use_time) for k in range(samples)]
        with _plane_scene(scene, camera, samples) as plane:
            measured = measure(plane, camera, window, samples - 1, folder)
            wrong = {name: size for name, size in disagreement(measured, *numbers[-1]).items() if size > TOLERANCE[name]}
            if wrong:
                say(f"rpf: this camera or version of Cycles draws other numbers ({wrong}); film, lens and time are measured, light and bsdf left out")
                numbers = [_measured_numbers(measure(plane, camera, window, k, folder), use_lens, use_time) for k in range(samples)]
    return {layer.name: _channels(frames, numbers, layer, None if moves else camera, window) for layer in _layers(scene)}, window


def _measured_numbers(measured, use_lens, use_time):
    film, lens, time = measured
    slots = {"random.lens.U": lens[0], "random.lens.V": lens[1]} if use_lens else {}
    if use_time:
        slots["random.time"] = time
    return film, {name: np.clip(values, 0, 1 - 2**-24) for name, values in slots.items()}


def _channels(frames, numbers, layer, camera, window):
    records = []
    for passes, (film, slots) in zip(frames, numbers):
        film = _inside(film)
        place = {"film.X": window.px + film[0], "film.Y": window.full[1] - (window.py + film[1])}
        records.append(_features(passes, layer, camera, window, film, slots) | place | slots)
    if all(record["A"].min() == 1 for record in records):  # no transparent film
        for record in records:
            del record["A"]
    return {name: np.stack([record[name] for record in records], 1).astype(np.float32).ravel() for name in records[0]}


# ---- files and the filter -----------------------------------------------------------------------------------------------------
def write_raw(path, window, samples, channels, metadata):
    """A raw sample file (docs/file-format.md)."""
    header = {"format": "rpf-raw-samples", "version": 1, "dataWindow": window.data_window(), "displayWindow": [0, 0, *window.full],
              "channels": list(channels), "metadata": metadata}
    with open(path, "wb") as file:
        file.write(json.dumps(header).encode() + b"\n")
        np.full(window.width * window.height, samples, "<u4").tofile(file)
        for values in channels.values():
            values.astype("<f4").tofile(file)


def executable():
    """The command rpf: of the add-on's preferences, of RPF_EXECUTABLE, or on PATH."""
    addon = bpy.context.preferences.addons.get(__name__) if bpy.context.preferences else None
    chosen = (addon.preferences.executable if addon and addon.preferences else "") or os.environ.get("RPF_EXECUTABLE") or "rpf"
    found = shutil.which(bpy.path.abspath(chosen))
    if not found:
        raise RpfError(f'the command "{chosen}" is not there; name it in the preferences of the add-on or in RPF_EXECUTABLE')
    return found


def _rpf(*arguments):
    result = subprocess.run([executable(), *map(str, arguments)], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
    if result.returncode:
        raise RpfError(f"rpf ended with {result.returncode}: {result.stdout.strip()[-500:]}")


def _named(path, layer, several):
    """The file of a view layer: its name stands in it where there are several."""
    path = Path(bpy.path.abspath(str(path))).absolute()
    return path.with_name(f"{path.stem}.{bpy.path.clean_name(layer)}{path.suffix}") if several else path


def run(scene, samples, output, filtered, preset, say=print):
    """Renders, writes and filters. A generator as render_samples; returns the filtered files, one a view layer."""
    if not str(output).endswith((".exr", ".rpf")):
        raise RpfError(f'"{output}" is no sample file; its name ends in .exr or .rpf')
    if filtered or str(output).endswith(".exr"):
        executable()  # before the work
    layers, window = yield from render_samples(scene, samples, say)
    metadata = {"rpf:seed": scene.cycles.seed, "rpf:renderer": f"Blender {bpy.app.version_string} Cycles"}
    results = []
    for layer, channels in layers.items():
        path = _named(output, layer, len(layers) > 1)
        raw = path.with_name(f".{path.stem}.{os.getpid()}.rpf")
        try:
            write_raw(raw, window, samples, channels, metadata)
            if path.suffix == ".exr":
                _rpf("convert", raw, "-o", path)
            else:
                os.replace(raw, path)
        finally:
            raw.unlink(missing_ok=True)
        if filtered:
            results.append(_named(filtered, layer, len(layers) > 1))
            _rpf(path, "-o", results[-1], "--preset", preset, "-q")
    yield 1.0
    return results


# ---- the panel ----------------------------------------------------------------------------------------------------------------
class RpfPreferences(bpy.types.AddonPreferences):
    bl_idname = __name__
    executable: bpy.props.StringProperty(name="Command rpf", subtype="FILE_PATH", description="Left empty: RPF_EXECUTABLE, then PATH")

    def draw(self, _context):
        self.layout.prop(self, "executable")


class RpfSettings(bpy.types.PropertyGroup):
    samples: bpy.props.IntProperty(name="Samples", default=8, min=1, max=1024, soft_max=32, description="Samples a pixel")
    output: bpy.props.StringProperty(name="Output", default="//samples.exr", subtype="FILE_PATH", description="Sample file, .exr or .rpf")
    filtered: bpy.props.StringProperty(name="Filtered", default="//filtered.exr", subtype="FILE_PATH", description="Filtered image")
    preset: bpy.props.EnumProperty(name="Preset", default="balanced", items=[(p, p.capitalize(), "") for p in PRESETS])


class RENDER_OT_rpf(bpy.types.Operator):
    """Renders samples with Cycles and filters them. Esc stops after the current sample; every setting is put back"""
    bl_idname = "render.rpf"
    bl_label = "Render and filter"
    steps = timer = None

    def _steps(self, scene):
        chosen = scene.rpf
        self.results = yield from run(scene, chosen.samples, bpy.path.abspath(chosen.output), bpy.path.abspath(chosen.filtered), chosen.preset,
                                      lambda text: self.report({"WARNING"}, text))

    def execute(self, context):
        try:
            for _ in self._steps(context.scene):
                pass
        except (RpfError, OSError, RuntimeError) as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        return self._show(context)

    def invoke(self, context, _event):
        if bpy.app.background:
            return self.execute(context)
        self.steps = self._steps(context.scene)
        context.window_manager.progress_begin(0, 1)
        self.timer = context.window_manager.event_timer_add(0.01, window=context.window)
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        if event.type == "ESC":
            return self._end(context, {"CANCELLED"})
        if event.type != "TIMER":
            return {"RUNNING_MODAL"}
        try:
            context.window_manager.progress_update(next(self.steps))
        except StopIteration:
            return self._end(context, self._show(context))
        except (RpfError, OSError, RuntimeError) as error:
            self.report({"ERROR"}, str(error))
            return self._end(context, {"CANCELLED"})
        return {"RUNNING_MODAL"}

    def _end(self, context, result):
        self.steps.close()  # puts the settings back
        context.window_manager.event_timer_remove(self.timer)
        context.window_manager.progress_end()
        return result

    def _show(self, context):
        images = [bpy.data.images.load(str(path), check_existing=True) for path in self.results]
        for image in images:
            image.reload()
        if not bpy.app.background:
            areas = [area for window in context.window_manager.windows for area in window.screen.areas if area.type == "IMAGE_EDITOR"]
            if not areas:
                bpy.ops.wm.window_new()
                areas = [context.window_manager.windows[-1].screen.areas[0]]
                areas[0].type = "IMAGE_EDITOR"
            areas[0].spaces.active.image = images[0]
        return {"FINISHED"}


class RENDER_PT_rpf(bpy.types.Panel):
    bl_label, bl_space_type, bl_region_type, bl_context = "RPF", "PROPERTIES", "WINDOW", "render"
    bl_options = {"DEFAULT_CLOSED"}

    @classmethod
    def poll(cls, context):
        return context.engine == "CYCLES"

    def draw(self, context):
        self.layout.use_property_split = True
        for name in ("samples", "output", "filtered", "preset"):
            self.layout.prop(context.scene.rpf, name)
        self.layout.operator(RENDER_OT_rpf.bl_idname, icon="RENDER_STILL")
        column = self.layout.column(align=True)
        for sentence in NOT_COVERED.split(". "):
            column.label(text=sentence)


_CLASSES = (RpfPreferences, RpfSettings, RENDER_OT_rpf, RENDER_PT_rpf)


def register():
    for kind in _CLASSES:
        bpy.utils.register_class(kind)
    bpy.types.Scene.rpf = bpy.props.PointerProperty(type=RpfSettings)


def unregister():
    del bpy.types.Scene.rpf
    for kind in reversed(_CLASSES):
        bpy.utils.unregister_class(kind)


# ---- headless -------------------------------------------------------------------------------------------------------------------
def main(arguments):
    parser = argparse.ArgumentParser(prog="blender -b file.blend -P rpf_blender.py --", description=__doc__.splitlines()[0], epilog=NOT_COVERED)
    parser.add_argument("--samples", type=int, default=8, help="samples a pixel (8)")
    parser.add_argument("-o", "--output", required=True, help="sample file, .exr or .rpf")
    parser.add_argument("--filter", metavar="IMAGE", help="filter them too, into this image")
    parser.add_argument("--preset", choices=PRESETS, default="balanced")
    chosen = parser.parse_args(arguments)
    try:
        for _ in run(bpy.context.scene, chosen.samples, chosen.output, chosen.filter, chosen.preset, lambda text: print(text, file=sys.stderr)):
            pass
    except (RpfError, OSError, RuntimeError) as error:
        print(f"rpf_blender: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    if "--" in sys.argv:
        sys.exit(main(sys.argv[sys.argv.index("--") + 1:]))
    register()
