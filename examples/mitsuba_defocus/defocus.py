"""Defocus with Mitsuba 3: the presets and Open Image Denoise on the same samples, against a reference. Writes a page.

Usage: python examples/mitsuba_defocus/defocus.py [--reference SPP] [-o FOLDER]
Needs `pip install '.[mitsuba]' pyoidn` at the root of the project; without pyoidn its rows are left out.
"""
import argparse
from pathlib import Path

import mitsuba as mi
import numpy as np

import rpf
from rpf.mitsuba import render_reference, render_samples, select_variant

SIZE = (320, 180)
COUNTS = (4, 8)
PRESETS = ("fast", "balanced", "high")
MEAN, OIDN, REFERENCE = "plain mean", "Open Image Denoise", "reference"


def defocus_scene():
    """Three rows of balls on a checkered floor, sharp in the middle, under an area light. -> dict for mi.load_dict"""
    to_world = mi.ScalarTransform4f
    floor = {"type": "checkerboard", "to_uv": mi.ScalarTransform3f().scale(16), "color0": {"type": "rgb", "value": [0.2, 0.2, 0.25]},
             "color1": {"type": "rgb", "value": [0.7, 0.65, 0.6]}}
    scene = {
        "type": "scene", "integrator": {"type": "path", "max_depth": 6},
        "sensor": {"type": "thinlens", "fov": 35, "aperture_radius": 0.15, "focus_distance": 6.2,
                   "to_world": to_world().look_at(origin=[0, 1.7, -6], target=[0, 0.5, 0], up=[0, 1, 0]),
                   "film": {"type": "hdrfilm", "width": SIZE[0], "height": SIZE[1], "rfilter": {"type": "box"}},
                   "sampler": {"type": "independent"}},
        "floor": {"type": "rectangle", "to_world": to_world().scale(12).rotate([1, 0, 0], -90), "bsdf": {"type": "diffuse", "reflectance": floor}},
        "light": {"type": "rectangle", "to_world": to_world().translate([1, 5, -1]).rotate([1, 0, 0], 90).scale(1.2),
                  "emitter": {"type": "area", "radiance": {"type": "rgb", "value": [14, 13, 12]}}},
        "sky": {"type": "constant", "radiance": {"type": "rgb", "value": [0.15, 0.2, 0.3]}}}
    materials = [{"type": "diffuse", "reflectance": {"type": "rgb", "value": [0.7, 0.2, 0.15]}},
                 {"type": "roughconductor", "material": "Al", "alpha": 0.15},
                 {"type": "diffuse", "reflectance": {"type": "rgb", "value": [0.2, 0.45, 0.6]}}]
    for row, z in enumerate((-3, 0, 4)):
        for column, x in enumerate((-1.3, 0, 1.3)):
            scene[f"ball{row}{column}"] = {"type": "sphere", "center": [x * (1 + 0.15 * z), 0.45, z], "radius": 0.45,
                                           "bsdf": materials[(row + column) % 3]}
    return scene


def denoised(planes):
    """Open Image Denoise on the means of color, albedo and normal; None where it is not installed."""
    try:
        import pyoidn
    except ImportError:
        return None
    color, albedo, normal = (planes.mean([f"{group}{c}" for c in letters]).astype(np.float32)
                             for group, letters in (("", "RGB"), ("feature.albedo.", "RGB"), ("feature.N.", "XYZ")))
    return pyoidn.denoise(color, albedo=albedo, normal=normal, hdr=True)


def pictures(scene, spp):
    """Renders the samples once. -> name -> [height, width, 3] of all methods on them"""
    planes = render_samples(scene, spp, seed=spp)
    samples = planes.records()
    found = {MEAN: planes.mean(), **{f"`{preset}`": rpf.filter(samples, preset).pixels for preset in PRESETS}}
    other = denoised(planes)
    return found if other is None else {**found, OIDN: other}


def image_of(pixels):
    return rpf.Image(np.ascontiguousarray(pixels, np.float32))


def best(errors):
    """A sentence that says who wins."""
    name = min(errors, key=lambda n: errors[n].trimmed_relmse)
    ours = min((n for n in errors if n not in (MEAN, OIDN)), key=lambda n: errors[n].trimmed_relmse)
    ratio = errors[ours].trimmed_relmse / errors[name].trimmed_relmse
    return f"{name} has the lowest error" + (f"; that of {ours}, the best preset, is {ratio:.2g} times as high." if ratio > 1 else ".")


def page(tables, reference_spp, residual):
    lines = ["# Defocus with Mitsuba 3", "", "    pip install '.[mitsuba]' pyoidn        # at the root of the project",
             f"    python examples/mitsuba_defocus/defocus.py --reference {reference_spp}", "",
             "[defocus.py](defocus.py) builds the scene, renders every sample, gives the same samples to each preset and to Open Image Denoise",
             "(color, albedo and normal, averaged, not prefiltered), and writes this page.", "",
             f"![all methods](defocus.jpg)", "", f"*{COUNTS[0]} samples a pixel, from the left: {', '.join(shown(tables[COUNTS[0]]))}.*", "",
             f"Trimmed relMSE / FLIP, energy against a reference of {reference_spp:,} samples a pixel (its own relMSE: {residual:.2g}). "
             f"{SIZE[0]}x{SIZE[1]}; lower is better, energy 1 is best.", "", "| | " + " | ".join(f"{spp} samples" for spp in tables) + " |",
             "|---" * (len(tables) + 1) + "|"]
    for name in tables[COUNTS[0]]:
        cells = [f"{e.trimmed_relmse:.4f} / {e.flip:.3f}, {e.energy:.3f}" for e in (errors[name] for errors in tables.values())]
        lines.append(f"| {name} | " + " | ".join(cells) + " |")
    return "\n".join([*lines, "", *[f"With {spp} samples, {best(errors)}" for spp, errors in tables.items()], ""])


def shown(errors):
    return [*errors, REFERENCE]


def write_sheet(path, images, columns=3):
    """All pictures on one sheet, row by row, with the sRGB curve."""
    blank = [np.zeros_like(images[0])] * (-len(images) % columns)
    rows = [np.concatenate((images + blank)[k:k + columns], 1) for k in range(0, len(images), columns)]
    sheet = mi.Bitmap(np.concatenate(rows).astype(np.float32))
    sheet.convert(mi.Bitmap.PixelFormat.RGB, mi.Struct.Type.UInt8, srgb_gamma=True).write(str(path), quality=85)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--reference", type=int, default=2048, help="samples a pixel of the reference")
    parser.add_argument("-o", "--output", type=Path, default=Path(__file__).parent, help="folder of README.md and defocus.jpg")
    chosen = parser.parse_args()
    chosen.output.mkdir(parents=True, exist_ok=True)
    select_variant()
    scene = mi.load_dict(defocus_scene())
    reference, variance = render_reference(scene, chosen.reference, seed=1000)
    found = {spp: pictures(scene, spp) for spp in COUNTS}
    tables = {spp: {name: rpf.compare(image_of(p), image_of(reference)) for name, p in all_of.items()} for spp, all_of in found.items()}
    residual = float(np.mean(variance / (reference**2 + 0.01)))
    write_sheet(chosen.output / "defocus.jpg", [*found[COUNTS[0]].values(), reference])
    (chosen.output / "README.md").write_text(page(tables, chosen.reference, residual))


if __name__ == "__main__":
    main()
