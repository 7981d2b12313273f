"""Pages of docs/ whose tables are written by scripts, between marks."""


def replace(page, name, rows):
    """Puts the rows between the marks <!-- name --> and <!-- end -->."""
    begin = page.index(f"<!-- {name} -->") + len(f"<!-- {name} -->")
    end = page.index("<!-- end -->", begin)
    return page[:begin] + "\n" + "\n".join(rows) + "\n" + page[end:]
