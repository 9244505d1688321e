#!/usr/bin/env python3
"""Prints every relative link and image of a page that leads nowhere, and fails if there is one.

    links.py FOLDER    looks at all .md files of the project in FOLDER, build folders and packages of npm left out
"""
import os
import pathlib
import re
import sys

# The first group is what a link or an image points to, without title.
LINK = re.compile(r"\]\(([^()\s]+)(?:\s+\"[^\"]*\")?\)")
CODE = re.compile(r"^```.*?^```|^ {4}.*?$|`[^`\n]*`", re.MULTILINE | re.DOTALL)


def anchors(text):
    """Anchors of the headings, as GitHub names them."""
    headings = re.findall(r"^#+ +(.*?) *$", text, re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


def broken(page):
    text = CODE.sub("", page.read_text(encoding="utf-8"))
    for target in LINK.findall(text):
        path, _, anchor = target.partition("#")
        if re.match(r"[a-z]+:", path):
            continue
        place = (page.parent / path).resolve() if path else page
        if not place.exists():
            yield f"{page}: no such file: {target}"
        elif anchor and anchor not in anchors(place.read_text(encoding="utf-8")):
            yield f"{page}: no such heading: {target}"


def pages_below(root):
    for folder, folders, files in os.walk(root):
        folders[:] = [name for name in folders if name not in {"build", "out", ".git", "node_modules"}]
        yield from (pathlib.Path(folder, name) for name in files if name.endswith(".md"))


def main():
    root = pathlib.Path(sys.argv[1]).resolve()
    pages = sorted(pages_below(root))
    if not pages:
        sys.exit(f"{root}: no pages.")
    messages = [message for page in pages for message in broken(page)]
    print(*messages, sep="\n", end="\n" if messages else "")
    sys.exit(1 if messages else 0)


if __name__ == "__main__":
    main()
