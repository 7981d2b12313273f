"""Raw sample files: read_samples and write_samples of docs/file-format.md, so that the document's code is the only copy."""
import re
from pathlib import Path

_DOCUMENT = (Path(__file__).resolve().parent.parent / "docs/file-format.md").read_text(encoding="utf-8")
exec(re.search(r"```python\n(.*?)```", _DOCUMENT, re.S).group(1))  # pylint: disable=exec-used


def first_samples(file, n):
    """Of a file that was read, the first n samples of every pixel."""
    header, counts, channels = file
    place = np.arange(counts.sum()) - np.repeat(np.cumsum(counts) - counts, counts)  # noqa: F821, of the document
    return header, np.minimum(counts, n), {name: values[place < n] for name, values in channels.items()}  # noqa: F821
