"""Removes the noise of Monte Carlo renderings with a few samples a pixel, looking at every sample.

>>> import rpf
>>> samples = rpf.read("examples/dof-spheres.samples.exr")
>>> image = rpf.filter(samples, preset="fast")
>>> rpf.write("filtered.exr", image)                                                           # doctest: +SKIP
>>> round(rpf.compare(image, rpf.read_image("examples/dof-spheres.reference.exr")).energy, 1)
1.0

docs/python.md has the rest. What is compiled is loaded when it is first used: rpf.mitsuba can render and write without it.
"""
from typing import TYPE_CHECKING

from .errors import Cancelled, DeviceError, Error, InputError, MemoryLimitError, OutputError, UsageError

if TYPE_CHECKING:
    from ._core import (DeviceInfo, Explanation, Image, ImageError, InputNote, LargestDifference, Method, PassReport, Profile,
                        Progress, Report, Samples, Settings, compare, convert, devices, explain_settings, method_settings, needed_slots,
                        preset_settings, presets, read, read_image, version, write)
    from .filtering import explain, filter

_COMPILED = ["DeviceInfo", "Explanation", "Image", "ImageError", "InputNote", "LargestDifference", "Method", "PassReport",
             "Profile", "Progress", "Report", "Samples", "Settings", "compare", "convert", "devices", "explain_settings", "method_settings",
             "needed_slots", "preset_settings", "presets", "read", "read_image", "version", "write"]
_RUNS = ["explain", "filter"]

__all__ = ["Cancelled", "DeviceError", "Error", "InputError", "MemoryLimitError", "OutputError", "UsageError", *_COMPILED, *_RUNS]


def __getattr__(name: str) -> object:
    if name not in (*_COMPILED, *_RUNS):
        raise AttributeError(f"module 'rpf' has no attribute {name!r}")
    from . import _core, filtering
    value = getattr(filtering if name in _RUNS else _core, name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
