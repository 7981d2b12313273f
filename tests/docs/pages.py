"""The project's pages of Markdown, as the tests of this folder read them. Every block of code is fenced and says its language:

- `sh` is run by commands_test.py, block after block in one folder a page, unless the line before it says otherwise:
    <!-- not run: REASON -->   it needs what a test does not have
    <!-- run by TEST -->       a test of that name in ctest reads it from the page and does it; clone.NAME: clone_test.py, in a fresh clone
- `text` is no code: formulas, trees, and synopses of `rpf`, whose options must be options of it
- any other is `run by TEST`, or is written where the page's commands look for it:
    <!-- file NAME -->
"""
import re
from dataclasses import dataclass

FENCED = re.compile(r"(?:^<!-- (?P<note>.*?) -->\n)?^```(?P<language>\w*)\n(?P<text>.*?)^```$", re.M | re.S)
INDENTED = re.compile(r"\n\n    (\S.*)")


@dataclass
class Block:
    language: str
    text: str
    note: str


def pages(project):
    """All of them, by their path in the project."""
    files = [*project.glob("*.md"), *(file for folder in ("docs", "examples", "integrations", "networks", "python", "training") for file in (project / folder).rglob("*.md"))]
    return {str(file.relative_to(project)): file.read_text(encoding="utf-8") for file in sorted(files)}


def blocks(page):
    return [Block(match["language"], match["text"], match["note"] or "") for match in FENCED.finditer(page)]


def run_by(project, test):
    """What a test of that name has to run: all blocks that say so, page after page."""
    found = [block.text for page in pages(project).values() for block in blocks(page) if block.note == f"run by {test}"]
    assert found, f"no page has <!-- run by {test} -->"
    return "".join(found)


def without_blocks(page):
    return FENCED.sub("", page)


def spans(page):
    """What stands between backticks in the running text."""
    return [" ".join(span.split()) for span in re.findall(r"`([^`]+)`", without_blocks(page))]


def links(page):
    text = re.sub(r"`[^`]+`", "code", without_blocks(page))
    return re.findall(r"\]\(([^()\s]+)\)", text) + re.findall(r'(?:src|href)="([^"]+)"', text)


def anchors(page):
    """Of its headings, as GitHub and GitLab make them."""
    found = []
    for heading in re.findall(r"^#+ +(.*?) *$", without_blocks(page), re.M):
        name = re.sub(r"[^\w\- ]", "", re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).lower()).replace(" ", "-")
        found.append(name if name not in found else f"{name}-{found.count(name)}")
    return found
