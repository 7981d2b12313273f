"""How far a run is, on standard error or in a notebook: with tqdm, where that is installed."""
import contextlib
import sys
from collections.abc import Callable, Iterator
from typing import Optional, Union

from ._core import Progress

Teller = Callable[[Progress], Optional[bool]]


@contextlib.contextmanager
def teller(progress: Union[bool, Teller], what: str) -> Iterator[Optional[Teller]]:
    """What a run calls between tiles; None where nobody wants to know."""
    if callable(progress):
        yield progress
        return
    try:
        from tqdm.auto import tqdm
    except ImportError:
        tqdm = None
    if not progress or tqdm is None:
        yield None
        return
    hidden = False if "ipykernel" in sys.modules else None  # None: where standard error is no terminal
    with tqdm(total=100, desc=what, unit="%", leave=False, disable=hidden) as bar:
        def tell(now: Progress) -> None:
            bar.update(round(100 * now.fraction) - bar.n)
        yield tell
