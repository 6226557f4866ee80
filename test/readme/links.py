#!/usr/bin/env python3
"""Checks that each relative link in the *.md files of the repository leads to a file, and to a heading of it.

    test/readme/links.py
"""
import functools
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
NOT_OURS = {"build", "node_modules", ".git"}
LINK = re.compile(r"\[(?:[^\]\[]|\[[^\]]*\])*\]\(([^)\s]+)\)")
HEADING = re.compile(r"^#{1,6} +(.*?) *#*$", re.MULTILINE)
CODE = re.compile(r"^ *```.*?^ *```$|`[^`\n]*`", re.MULTILINE | re.DOTALL)
FENCED = re.compile(r"^ *```.*?^ *```$", re.MULTILINE | re.DOTALL)


@functools.cache
def anchors(page):
    """Returns the anchors of a page, as GitHub makes them."""
    found, seen = set(), {}
    for heading in HEADING.findall(FENCED.sub("", page.read_text())):
        text = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading)
        anchor = re.sub(r"[^\w\- ]", "", text.lower()).replace(" ", "-")
        count = seen[anchor] = seen.get(anchor, -1) + 1
        found.add(f"{anchor}-{count}" if count else anchor)
    return found


def fault(page, target):
    """Returns why the link leads nowhere, or None."""
    path, _, anchor = target.partition("#")
    goal = (page.parent / path).resolve() if path else page
    if not goal.exists():
        return "no such file"
    if anchor and goal.suffix == ".md" and anchor not in anchors(goal):
        return "no such heading"
    return None


def main():
    pages = [page for page in sorted(ROOT.rglob("*.md")) if not NOT_OURS & set(page.relative_to(ROOT).parts)]
    links = broken = 0
    for page in pages:
        for target in LINK.findall(CODE.sub("`", page.read_text())):
            if re.match(r"[a-z]+:", target):
                continue  # another site
            links += 1
            why = fault(page, target)
            if why:
                broken += 1
                print(f"{page.relative_to(ROOT)}: {target}: {why}")
    print(f"{len(pages)} pages, {links} links, {broken} broken")
    return 1 if broken or links < 50 else 0


if __name__ == "__main__":
    sys.exit(main())
