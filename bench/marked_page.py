"""Pages of docs/ whose tables are written by scripts, between marks."""
from pathlib import Path


def replace(page, name, rows):
    """Puts the rows between the marks <!-- name --> and <!-- end -->."""
    begin = page.index(f"<!-- {name} -->") + len(f"<!-- {name} -->")
    end = page.index("<!-- end -->", begin)
    return page[:begin] + "\n" + "\n".join(rows) + "\n" + page[end:]


def write_table(path, name, rows):
    """The same in a file."""
    path = Path(path)
    path.write_text(replace(path.read_text(encoding="utf-8"), name, rows), encoding="utf-8")
