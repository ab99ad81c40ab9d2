#!/usr/bin/env python3
"""The quotations in README and guide are files that a test compiles or runs, letter by letter;
their links lead somewhere; a README has at most 120 lines.
usage: readme_test.py README GUIDE --whole FILE... --parts-of FILE... --pages FOLDER
Every FILE of --whole stands in the GUIDE as it is; other quotations are parts of some FILE."""
import pathlib
import re
import sys

LONGEST_README = 120

whole_at, parts_at, pages_at = (sys.argv.index(word) for word in ("--whole", "--parts-of", "--pages"))
readme, guide = map(pathlib.Path, sys.argv[1:whole_at])
whole = {path: pathlib.Path(path).read_text() for path in sys.argv[whole_at + 1 : parts_at]}
sources = [*whole.values(), *(pathlib.Path(path).read_text() for path in sys.argv[parts_at + 1 : pages_at])]
pages = [readme, *readme.parent.glob("[A-Z]*.md"), *pathlib.Path(sys.argv[pages_at + 1]).rglob("*.md")]
faults = []


def quoted(page):
    return re.findall(r"^```\w+\n(.*?)^```$", page.read_text(), re.MULTILINE | re.DOTALL)


def anchors(page):
    """The anchors that GitHub makes of headings."""
    for title in re.findall(r"^#+ (.*)$", page.read_text(), re.MULTILINE):
        yield re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-")


faults += [f"{guide}: does not quote {path} as it is" for path, text in whole.items() if text not in quoted(guide)]
for page in (readme, guide):
    for text in quoted(page):
        if not any(text in source for source in sources):
            faults.append(f"{page}: quotes what no test compiles or runs:\n{text}")
if len(readme.read_text().splitlines()) > LONGEST_README:
    faults.append(f"{readme}: more than {LONGEST_README} lines")
for page in set(pages):
    for link in re.findall(r"\]\(([^)\s]+)\)", page.read_text()):
        if re.match(r"\w+:", link):
            continue
        path, _, anchor = link.partition("#")
        target = (page.parent / path) if path else page
        if not target.exists():
            faults.append(f"{page}: links to {link}, which is not there")
        elif anchor and anchor not in anchors(target):
            faults.append(f"{page}: links to {link}, which has no such heading")

print(*faults, sep="\n", end="\n" if faults else "")
sys.exit(1 if faults else 0)
