"""Filtering and explaining: what runs long, with progress, and stops on Ctrl-C."""
from typing import Optional, Union

from . import _core
from .errors import UsageError
from .progress import Teller, teller


def _chosen(preset: Optional[str], profile: Optional[str], settings: Optional[_core.Settings]) -> _core.Settings:
    if sum(choice is not None for choice in (preset, profile, settings)) > 1:
        raise UsageError("filter: preset, profile and settings exclude each other; name one of them")
    if settings is not None:
        return settings
    if profile is None:
        return _core.preset_settings(preset or "balanced")
    if profile not in ("thesis", "paper"):
        raise UsageError(f"filter: there is no profile {profile!r}; thesis or paper is expected")
    published = _core.Settings()
    published.profile = _core.Profile[profile]
    return published


def _with(chosen: _core.Settings, **choices) -> _core.Settings:
    """A copy with what was chosen beside it, and a limit of memory."""
    settings = _core.Settings(chosen)
    for name, value in choices.items():
        if value is not None:
            setattr(settings, name, value)
    if settings.max_memory == 0:
        settings.max_memory = _core.available_memory() // 10 * 9
    return settings


def filter(samples: _core.Samples, preset: Optional[str] = None, backend: Optional[str] = None,
           progress: Union[bool, Teller] = True, *, settings: Optional[_core.Settings] = None, profile: Optional[str] = None,
           threads: Optional[int] = None, max_memory: Optional[int] = None, keep: bool = True) -> _core.Image:
    """Filters a frame, with the bits of the command.

    samples: an rpf.Samples. The filter works in its memory: with keep=False that of `samples`, which are gone afterwards,
        otherwise a copy (also where an array looks into them).
    preset: "fast", "balanced" or "high"; "balanced" where nothing else is asked for.
    profile: "paper" or "thesis": Random Parameter Filtering as published, in place of a preset.
    settings: rpf.Settings, in place of both: everything that can be chosen. It is not changed.
    backend: "auto" (OpenCL where a device is there), "opencl" or "cpu"; the bits are the same. "auto" if left out and
        there are no settings.
    progress: True: a bar where tqdm is installed; or a function that is called with rpf.Progress about twice a second, and
        ends the run by returning False.
    threads: 0: all cores that this process may use. max_memory: bytes; nine tenths of what the process can have if left out.

    -> rpf.Image: R, G, B (A), linear float32, [height, width, channels]; its `report` says what was done.

    Other Python threads run meanwhile. Ctrl-C acts within two seconds. Raises UsageError, InputError, DeviceError,
    MemoryLimitError; Cancelled where progress ended it.

    >>> import numpy as np, rpf
    >>> counts = np.full((8, 8), 4, np.uint32)                                   # [height, width]
    >>> y, x = np.repeat(np.indices((8, 8)).reshape(2, -1), 4, axis=1) + 0.5     # film positions in pixels
    >>> light = np.random.default_rng(1).random(256)
    >>> samples = rpf.Samples.from_channels(counts, {"R": light, "G": light, "B": light, "film.X": x, "film.Y": y})
    >>> image = rpf.filter(samples, preset="fast", backend="cpu")
    >>> image.pixels.shape, image.pixels.dtype.name, image.report.backend
    ((8, 8, 3), 'float32', 'cpu')
    """
    chosen = _chosen(preset, profile, settings)
    if settings is None and backend is None:
        backend = "auto"
    final = _with(chosen, backend=backend, threads=threads, max_memory=max_memory)
    with teller(progress, "filtering") as tell:
        return _core.run_filter(samples, final, keep, tell)


def explain(samples: _core.Samples, backend: str = "auto", progress: Union[bool, Teller] = True, *,
            settings: Optional[_core.Settings] = None, keep: bool = True) -> _core.Explanation:
    """Which random parameters make which pixels noisy, and what the published filter makes of it (docs/explain.md).

    settings: one pass of the published algorithm; explain_settings() if left out. The rest is as in filter().
    -> rpf.Explanation: `layers`, an Image with a channel for each layer, and `groups`.
    """
    final = _with(settings or _core.explain_settings(), backend=backend)
    with teller(progress, "explaining") as tell:
        return _core.run_explain(samples, final, keep, tell)
