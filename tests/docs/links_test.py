"""No link of a page is dead, none of its anchors; every page of docs/ can be reached from the README; sources name pages that there
are. Addresses elsewhere are not asked. Usage: links_test.py PROJECT"""
import re
import sys
import unittest
from pathlib import Path

from pages import anchors, links, pages

PROJECT = Path(sys.argv[1]).resolve()
SOURCES = ("bench", "cmake", "examples", "include", "integrations", "kernels", "python", "src", "tests", "training")


def dead_links(place, page, others):
    """Of a page at `place`: those that lead to nothing, or to no heading of the other pages."""
    dead = []
    for link in links(page):
        path, _, anchor = link.partition("#")
        target = (PROJECT / place).parent / path if path else PROJECT / place
        name = str(target.resolve().relative_to(PROJECT)) if target.resolve().is_relative_to(PROJECT) else ""
        if not re.match(r"\w+:", link) and (not name or not target.exists() or anchor and anchor not in anchors(others.get(name, ""))):
            dead.append(f"{place}: {link}")
    return dead


def reachable(place, others):
    """The pages that a reader comes to from `place`."""
    found, waiting = set(), [place]
    while waiting:
        here = waiting.pop()
        found.add(here)
        targets = {((PROJECT / here).parent / link.partition("#")[0]).resolve() for link in links(others[here])}
        waiting += [place for place in others if PROJECT / place in targets and place not in found]
    return found


class LinksTest(unittest.TestCase):
    pages = pages(PROJECT)

    def test_lead_somewhere(self):
        self.assertEqual([link for place, page in self.pages.items() for link in dead_links(place, page, self.pages)], [])

    def test_reach_every_page_of_docs_from_the_readme(self):
        self.assertEqual({place for place in self.pages if place.startswith("docs/")} - reachable("README.md", self.pages), set())

    def test_of_sources_name_pages_that_there_are(self):
        missing = []
        for file in (file for folder in SOURCES for file in sorted((PROJECT / folder).rglob("*")) if file.suffix in (".h", ".c", ".cpp", ".cl", ".py", ".cmake", ".sh")):
            for name, anchor in re.findall(r"\b(docs/[\w-]+\.md)(?:#([\w-]+))?", file.read_text(encoding="utf-8")):
                if anchor not in ["", *anchors(self.pages.get(name, ""))] or name not in self.pages:
                    missing.append(f"{file.relative_to(PROJECT)}: {name}#{anchor}")
        self.assertEqual(missing, [])

    def test_dead_ones_are_found(self):
        others = {"docs/commands.md": "# The page\n## A `b` (c), d\n## Two\n## Two\n", "README.md": ""}
        for link in ("missing.md", "#absent", "commands.md#absent", "../../outside", "images/none.png"):
            self.assertEqual(dead_links("docs/commands.md", f"[text]({link})", others), [f"docs/commands.md: {link}"])
        for link in ("#a-b-c-d", "../README.md", "#two-1", "https://example.org/x#y"):
            self.assertEqual(dead_links("docs/commands.md", f"[text]({link}) `[y](missing)`\n```text\n[x](missing)\n```\n", others), [])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
