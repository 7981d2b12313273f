"""Renders a Mitsuba scene, writes every sample to a file, and filters them if --filter says so.

Example: python -m rpf.mitsuba scene.xml -o samples.exr --spp 8 --filter clean.exr
"""
import argparse
import os
import re
import sys

import mitsuba as mi
import numpy as np

import rpf  # what is compiled is loaded when it is first used: rendering to .rpf does without

from ..errors import Error, InputError, UsageError
from . import render_to_file, select_variant


def _size(text):
    width, _, height = text.partition("x")
    if not (width.isdigit() and height.isdigit() and int(width) and int(height)):
        raise argparse.ArgumentTypeError(f"{text!r} is no size; write it as 640x360")
    return [int(width), int(height)]


def _crop(text):
    numbers = re.fullmatch(r"(\d+)x(\d+)\+(\d+)\+(\d+)", text)
    if numbers is None:
        raise argparse.ArgumentTypeError(f"{text!r} is no window; width, height, x and y are expected, as in 320x180+100+50")
    width, height, x, y = map(int, numbers.groups())
    return (x, y, width, height)


def _definition(text):
    name, equals, value = text.partition("=")
    if not equals:
        raise argparse.ArgumentTypeError(f"{text!r} is no definition; write it as name=value")
    return name, value


def _arguments(arguments):
    parser = argparse.ArgumentParser(prog="python -m rpf.mitsuba", description=__doc__.splitlines()[0])
    parser.add_argument("scene", help="scene.xml")
    parser.add_argument("-o", "--output", required=True, help="sample file: .exr is deep OpenEXR, .rpf raw floats")
    counts = parser.add_mutually_exclusive_group()
    counts.add_argument("--spp", type=int, default=0, help="samples a pixel; the scene's number if left out")
    counts.add_argument("--density", metavar="IMAGE", help="samples of each pixel, as `rpf density` and `rpf adapt` say")
    parser.add_argument("--size", type=_size, help="of the film in pixels, such as 640x360; takes a crop window away")
    parser.add_argument("--crop", type=_crop, help="render this part of the film only, such as 320x180+100+50")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--sensor", type=int, default=0, help="index of the camera")
    parser.add_argument("-D", dest="definitions", type=_definition, action="append", default=[], metavar="NAME=VALUE",
                        help="value of a scene's $NAME")
    parser.add_argument("--filter", metavar="IMAGE", help="filter the samples, and write the picture here")
    parser.add_argument("--preset", help="which network filters: fast, balanced (the default) or high")
    chosen = parser.parse_args(arguments)
    if chosen.preset and not chosen.filter:
        parser.error("--preset is for filtering: name the picture with --filter")
    if not chosen.output.endswith((".exr", ".rpf")):
        parser.error(f"-o {chosen.output}: samples are written as .exr or .rpf")
    return chosen


def _place(sensor, size, crop):
    """Size and crop window of the film."""
    parameters = mi.traverse(sensor)
    if size:
        parameters["film.size"], parameters["film.crop_size"], parameters["film.crop_offset"] = size, size, [0, 0]
    if crop:
        x, y, width, height = crop
        film = [int(v) for v in parameters["film.size"]]
        if not (0 < width <= film[0] - x and 0 < height <= film[1] - y):
            raise UsageError(f"--crop {width}x{height}+{x}+{y} is not inside the film of {film[0]}x{film[1]} pixels")
        parameters["film.crop_size"], parameters["film.crop_offset"] = [width, height], [x, y]
    parameters.update()


def _load(arguments):
    """-> scene, sensor"""
    try:
        scene = mi.load_file(arguments.scene, **dict(arguments.definitions))
    except (OSError, RuntimeError) as failure:
        raise InputError(f"{arguments.scene}: {failure}") from failure
    if not 0 <= arguments.sensor < len(scene.sensors()):
        raise UsageError(f"--sensor {arguments.sensor}: {arguments.scene} has {len(scene.sensors())}, counted from 0")
    sensor = scene.sensors()[arguments.sensor]
    if arguments.size or arguments.crop:
        _place(sensor, arguments.size, arguments.crop)
    return scene, sensor


def _density(path):
    """[height, width] the first channel of an image; None without one."""
    if path is None:
        return None
    try:
        return np.atleast_3d(np.array(mi.Bitmap(path)))[..., 0]
    except RuntimeError as failure:
        raise InputError(f"--density {path}: {failure}") from failure


def _check_compiled(arguments):
    """Before the work: what is compiled, and the preset's name."""
    if arguments.output.endswith(".rpf") and not arguments.filter:
        return
    try:
        from .. import _core
    except ImportError as failure:
        raise UsageError(f"writing .exr and --filter need the compiled part of rpf ({failure}): `pip install .` at the root of the "
                         "project, for this Python; or write .rpf") from failure
    _core.preset_settings(arguments.preset or "balanced")


def _render(arguments):
    scene, sensor = _load(arguments)
    if not sensor.film().rfilter().is_box_filter():
        print("rpf.mitsuba: samples have no pixel filter; the picture differs from the one with this film's", file=sys.stderr)
    raw = arguments.output if arguments.output.endswith(".rpf") else f"{arguments.output}.{os.getpid()}.rpf"
    try:
        render_to_file(raw, scene, arguments.spp, arguments.seed, sensor, density=_density(arguments.density))
        if raw != arguments.output:
            rpf.convert(raw, arguments.output)
    finally:
        if raw != arguments.output and os.path.exists(raw):
            os.remove(raw)


def _filter(arguments):
    settings = rpf.preset_settings(arguments.preset or "balanced")
    settings.backend = "auto"
    image = rpf.filter(rpf.read(arguments.output), settings=settings, keep=False)
    rpf.write(arguments.filter, image)
    for note in image.report.notes:
        print(f"rpf.mitsuba: {note.count} {note.what}", file=sys.stderr)


def main(arguments=None):
    arguments = _arguments(arguments)
    try:
        _check_compiled(arguments)
        select_variant()
        _render(arguments)
        if arguments.filter:
            _filter(arguments)
    except (OSError, RuntimeError, ValueError) as failure:
        print(f"rpf.mitsuba: {failure}", file=sys.stderr)
        return failure.exit_code if isinstance(failure, Error) else 4 if isinstance(failure, OSError) else 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
