"""Renders a Mitsuba scene and writes every sample to a raw sample file.

Usage: python -m rpf.mitsuba scene.xml -o samples.rpf [--spp 8] [--size 640x360] [--seed 0] [--sensor 0] [-D NAME=VALUE]...
"""
import argparse
import sys

import mitsuba as mi

from . import render_samples, select_variant, write_samples


def _size(text):
    width, _, height = text.partition("x")
    if not (width.isdigit() and height.isdigit() and int(width) and int(height)):
        raise argparse.ArgumentTypeError(f"{text!r} is no size; write it as 640x360")
    return [int(width), int(height)]


def _definition(text):
    name, equals, value = text.partition("=")
    if not equals:
        raise argparse.ArgumentTypeError(f"{text!r} is no definition; write it as name=value")
    return name, value


def _arguments():
    parser = argparse.ArgumentParser(prog="python -m rpf.mitsuba", description=__doc__.splitlines()[0])
    parser.add_argument("scene", help="scene.xml")
    parser.add_argument("-o", "--output", required=True, help="raw sample file, by convention named .rpf")
    parser.add_argument("--spp", type=int, default=0, help="samples a pixel; the scene's number if left out")
    parser.add_argument("--size", type=_size, help="of the film in pixels, such as 640x360; takes a crop window away")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--sensor", type=int, default=0, help="index of the camera")
    parser.add_argument("-D", dest="definitions", type=_definition, action="append", default=[], metavar="NAME=VALUE",
                        help="value of a scene's $NAME")
    return parser.parse_args()


def _resize(sensor, size):
    parameters = mi.traverse(sensor)
    parameters["film.size"], parameters["film.crop_size"], parameters["film.crop_offset"] = size, size, [0, 0]
    parameters.update()


def main():
    arguments = _arguments()
    select_variant()
    try:
        scene = mi.load_file(arguments.scene, **dict(arguments.definitions))
        if not 0 <= arguments.sensor < len(scene.sensors()):
            raise ValueError(f"{arguments.scene} has {len(scene.sensors())} sensors; there is no number {arguments.sensor}")
        sensor = scene.sensors()[arguments.sensor]
        if arguments.size:
            _resize(sensor, arguments.size)
        if not sensor.film().rfilter().is_box_filter():
            print("rpf.mitsuba: samples have no pixel filter; the picture differs from the one with this film's", file=sys.stderr)
        write_samples(arguments.output, render_samples(scene, arguments.spp, arguments.seed, sensor))
    except (OSError, RuntimeError, ValueError) as error:
        print(f"rpf.mitsuba: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
