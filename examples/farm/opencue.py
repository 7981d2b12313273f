"""pycuerun opencue.py: a layer of OpenCue, by PyOutline; nobody ran it here, for want of a Cuebot.

OpenCue puts the frames of a chunk in the place of #FRAMESPEC#, in the form that --frames takes ("1-10", "1-9x2").
Threads and memory are those of the proc: rpf reads CUE_THREADS and CUE_MEMORY. The pattern is that of C, for OpenCue
replaces words between # signs. A frame that is retried begins its chunk again, and --skip-existing leaves it what is done.
"""
from outline import Outline, cuerun
from outline.modules.shell import Shell

outline = Outline("rpf", frame_range="1-100")
outline.add_layer(Shell("filter", chunk=10, threads=4, threadable=True, command=[
    "rpf", "/show/in.%04d.exr", "-o", "/show/out.%04d.exr", "--frames", "#FRAMESPEC#", "--skip-existing", "--skip-bad-frames"]))
cuerun.launch(outline)
