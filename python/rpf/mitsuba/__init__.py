"""Every sample of a Mitsuba 3 rendering, with the random numbers that made it and the surfaces that it saw.

`render_samples(scene, spp=8)` gives what `rpf` filters; `python -m rpf.mitsuba scene.xml -o samples.rpf` writes it to a file.
The mean of a pixel's samples is what `mi.render` gives with a box filter. Select a variant first: `select_variant()`.
"""
from .samples import Samples, write_samples
from .variant import select_variant
from .wavefront import render_reference, render_samples

__all__ = ["Samples", "render_reference", "render_samples", "select_variant", "write_samples"]
