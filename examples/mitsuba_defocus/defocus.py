"""A scene with defocus, rendered by Mitsuba 3 with a few samples a pixel and filtered by everything there is: one page.

    pip install '.[mitsuba,progress]' pyoidn      # at the root of the project; pyoidn is Open Image Denoise, left out where missing
    python examples/mitsuba_defocus/defocus.py -o defocus

The folder then has index.html, which carries all pictures, and picture.jpg. --reference 2048 takes a while; less will do to look at.
"""
import argparse
import base64
import subprocess
import sys
from pathlib import Path

import mitsuba as mi
import numpy as np

import rpf
from rpf.mitsuba import render_reference, render_samples, select_variant, write_samples

OIDN = Path(__file__).parents[2] / "bench/oidn_point.py"
BALLS = [(-1.5, -2.6, "gold"), (-0.8, -1.1, 0.1), (0.0, 0.3, "glossy"), (0.9, 1.6, 0.6), (-0.5, 2.4, 0.35), (1.5, 3.2, "copper")]


def _color(*rgb):
    return {"type": "rgb", "value": list(rgb)}


def _material(kind):
    if kind == "glossy":
        return {"type": "plastic", "diffuse_reflectance": _color(0.15, 0.25, 0.6)}
    if isinstance(kind, str):
        return {"type": "roughconductor", "material": {"gold": "Au", "copper": "Cu"}[kind], "alpha": 0.15}
    return {"type": "diffuse", "reflectance": _color(0.75 * kind + 0.2, 0.6 - 0.5 * kind, 0.3)}


def defocus_scene(width, height):
    """Balls on a checkered floor, the third one in focus; a light of area above, a dim sky."""
    at = mi.ScalarTransform4f
    scene = {"type": "scene", "integrator": {"type": "path", "max_depth": 5},
             "floor": {"type": "rectangle", "to_world": at().rotate([1, 0, 0], -90).scale(12),
                       "bsdf": {"type": "diffuse", "reflectance": {"type": "checkerboard", "to_uv": at().scale([24, 24, 1]),
                                                                   "color0": _color(0.25, 0.22, 0.2), "color1": _color(0.7, 0.68, 0.6)}}},
             "light": {"type": "rectangle", "to_world": at().translate([-2, 6, 2]).rotate([1, 0, 0], 90).scale(1.2),
                       "emitter": {"type": "area", "radiance": _color(18, 16, 14)}},
             "sky": {"type": "constant", "radiance": _color(0.12, 0.16, 0.24)},
             "sensor": {"type": "thinlens", "fov": 32, "aperture_radius": 0.16, "focus_distance": 5.6,
                        "to_world": at().look_at([0.6, 1.7, 5.7], [0, 0.4, 0], [0, 1, 0]),
                        "film": {"type": "hdrfilm", "width": width, "height": height, "rfilter": {"type": "box"}},
                        "sampler": {"type": "independent"}}}
    for number, (x, z, kind) in enumerate(BALLS):
        scene[f"ball{number}"] = {"type": "sphere", "center": [x, 0.45, z], "radius": 0.45, "bsdf": _material(kind)}
    return mi.load_dict(scene)


def open_image_denoise(planes, folder):
    """Denoised means of the samples: name -> Image. Empty, and a word why, where pyoidn is not installed."""
    source, noisy, clean = (folder / name for name in ("oidn.rpf", "noisy.rpf", "clean.rpf"))
    write_samples(source, planes)
    try:
        subprocess.run([sys.executable, OIDN, source, noisy, clean, "1"], check=True, stdout=subprocess.DEVNULL)
        names = {"Open Image Denoise": noisy, "Open Image Denoise, features denoised first": clean}
        return {name: plain_mean(rpf.read(file)) for name, file in names.items()}
    except subprocess.CalledProcessError:
        print("Open Image Denoise is left out: pip install pyoidn", file=sys.stderr)
        return {}
    finally:
        for path in (source, noisy, clean):
            path.unlink(missing_ok=True)


def plain_mean(samples):
    settings = rpf.Settings()
    settings.box_widths = []
    return rpf.filter(samples, settings=settings, progress=False)


def everything(scene, spp, folder):
    """name -> Image, all of the same samples."""
    planes = render_samples(scene, spp, seed=1)
    samples = planes.records()
    images = {f"mean of {spp} samples": plain_mean(samples)}
    images.update({f"rpf, {preset}": rpf.filter(samples, preset) for preset, _ in rpf.presets()})
    return {**images, **open_image_denoise(planes, folder)}


def table(images, reference):
    """[(name, relMSE without the worst 0.1 % of the pixels, FLIP, energy)]"""
    errors = [(name, rpf.compare(image, reference)) for name, image in images.items()]
    return [(name, error.trimmed_relmse, error.flip, error.energy) for name, error in errors]


def page(results, reference, spp_of_reference):
    """All pictures and numbers in one file."""
    def figure(name, image):
        data = base64.b64encode(image._repr_png_()).decode()
        return f'<figure><img src="data:image/png;base64,{data}"><figcaption>{name}</figcaption></figure>'

    parts = ["<!doctype html><meta charset=utf-8><title>Defocus</title><style>body{font:15px sans-serif;max-width:1010px;margin:2em auto}"
             "figure{display:inline-block;margin:4px}td,th{padding:2px 12px;text-align:right}td:first-child{text-align:left}</style>",
             f"<h1>Defocus, Mitsuba 3</h1><p>All of the same samples. The reference has {spp_of_reference} samples a pixel. 0 is the best "
             "relMSE and FLIP, 1 the best energy; the lowest error is bold.</p>"]
    for spp, images in results.items():
        rows = table(images, reference)
        best = [min(row[k] for row in rows) for k in (1, 2)]
        cells = ["".join(f"<td>{'<b>' * (row[k] == best[k - 1])}{row[k]:.4f}{'</b>' * (row[k] == best[k - 1])}</td>" for k in (1, 2))
                 for row in rows]
        parts.append(f"<h2>{spp} samples a pixel</h2><table><tr><th><th>relMSE (trimmed)<th>FLIP<th>energy</tr>")
        parts += [f"<tr><td>{row[0]}</td>{cell}<td>{row[3]:.3f}</td></tr>" for row, cell in zip(rows, cells)] + ["</table>"]
        parts += [figure(name, image) for name, image in images.items()]
    return "\n".join([*parts, "<h2>Reference</h2>", figure(f"{spp_of_reference} samples a pixel", reference)])


def picture(results, reference):
    """Mean and rpf above, Open Image Denoise (where it is) and reference below."""
    images = list(results[min(results)].items())
    shown = [images[0][1], dict(images)["rpf, balanced"], dict(images).get("Open Image Denoise", reference), reference]
    pixels = [image.pixels[..., :3] for image in shown]
    return rpf.Image(np.ascontiguousarray(np.concatenate([np.concatenate(pixels[:2], 1), np.concatenate(pixels[2:], 1)])))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("-o", "--output", type=Path, required=True, help="folder")
    parser.add_argument("--size", type=int, nargs=2, default=[320, 180], metavar=("WIDTH", "HEIGHT"))
    parser.add_argument("--spp", type=int, nargs="+", default=[4, 8])
    parser.add_argument("--reference", type=int, default=2048, help="samples a pixel of the reference")
    arguments = parser.parse_args()
    arguments.output.mkdir(exist_ok=True)
    select_variant()
    scene = defocus_scene(*arguments.size)
    results = {spp: everything(scene, spp, arguments.output) for spp in arguments.spp}
    reference = rpf.Image(render_reference(scene, arguments.reference, seed=1000)[0].astype(np.float32))
    (arguments.output / "index.html").write_text(page(results, reference, arguments.reference))
    rpf.write(arguments.output / "picture.jpg", picture(results, reference))
    for spp, images in results.items():
        for row in table(images, reference):
            print("{:2} samples  {:45} relMSE {:.4f}  FLIP {:.4f}  energy {:.3f}".format(spp, *row))


if __name__ == "__main__":
    main()
