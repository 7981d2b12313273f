"""read_samples and write_samples of docs/file-format.md, so that the document's code is the only copy."""
import re
from pathlib import Path

_DOCUMENT = (Path(__file__).resolve().parent.parent / "docs/file-format.md").read_text(encoding="utf-8")
exec(re.search(r"```python\n(.*?)```", _DOCUMENT, re.S).group(1))  # pylint: disable=exec-used
