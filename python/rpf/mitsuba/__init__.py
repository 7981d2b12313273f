"""Every sample of a Mitsuba 3 rendering, with the random numbers that made it and the surfaces that it saw.

`rpf.filter(render_samples(scene, spp=8).records())` filters it; `python -m rpf.mitsuba scene.xml -o samples.exr` writes a file.
The mean of a pixel's samples is what `mi.render` gives with a box filter. Select a variant first: `select_variant()`.
"""
from .samples import SamplePlanes, write_samples
from .variant import select_variant
from .wavefront import render_reference, render_samples, render_to_file

__all__ = ["SamplePlanes", "render_reference", "render_samples", "render_to_file", "select_variant", "write_samples"]
