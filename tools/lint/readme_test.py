#!/usr/bin/env python3
"""What README and the users' pages quote is part of a file that a test compiles or runs, letter by letter; their links
lead somewhere; a README has at most 120 lines, a page 150; commands and their output end where an A4 sheet does.
usage: readme_test.py README PAGE... --from FILE... --folder FOLDER
A comment above a block names its FILE. Every FILE is quoted or linked by one of the pages. Links of all pages in FOLDER,
and beside README, are followed."""
import pathlib
import re
import sys

LONGEST_README, LONGEST_PAGE = 120, 150
SHEET = 86  # characters of code on A4, as GitHub prints it; the rest is cut off

from_at, folder_at = sys.argv.index("--from"), sys.argv.index("--folder")
readme, *users = map(pathlib.Path, sys.argv[1:from_at])
root = readme.parent
sources = {pathlib.Path(path).resolve(): pathlib.Path(path).read_text() for path in sys.argv[from_at + 1 : folder_at]}
pages = [readme, *root.glob("[A-Z]*.md"), *pathlib.Path(sys.argv[folder_at + 1]).rglob("*.md")]
faults, used = [], set()


def quoted(page):
    """The blocks of code, and the comments right above them or nothing."""
    return re.findall(r"^(?:<!-- ([^\n]*) -->\n)?```\w+\n(.*?)^```$", page.read_text(), re.MULTILINE | re.DOTALL)


def anchors(page):
    """The anchors that GitHub makes of headings."""
    for title in re.findall(r"^#+ (.*)$", page.read_text(), re.MULTILINE):
        yield re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-")


for page in (readme, *users):
    for name, text in quoted(page):
        found = [path for path, source in sources.items() if text in source and (not name or path == (root / name).resolve())]
        if not found:
            faults.append(f"{page}: quotes what is not in {name or 'any file that a test compiles or runs'}:\n{text}")
        used.update(found)
    longest = LONGEST_README if page == readme else LONGEST_PAGE
    if len(page.read_text().splitlines()) > longest:
        faults.append(f"{page}: more than {longest} lines")
    commands = re.findall(r"^ {4}(.*)$", re.sub(r"^```.*?^```$", "", page.read_text(), flags=re.MULTILINE | re.DOTALL), re.MULTILINE)
    faults += [f"{page}: wider than a sheet: {line}" for line in commands if len(line) > SHEET]
for page in set(pages):
    for link in re.findall(r"\]\(([^)\s]+)\)", page.read_text()):
        if re.match(r"\w+:", link):
            continue
        path, _, anchor = link.partition("#")
        target = (page.parent / path).resolve() if path else page
        if not target.exists():
            faults.append(f"{page}: links to {link}, which is not there")
        elif anchor and anchor not in anchors(target):
            faults.append(f"{page}: links to {link}, which has no such heading")
        used.add(target)
faults += [f"{path}: neither quoted nor linked by a page" for path in sources if path not in used]

print(*faults, sep="\n", end="\n" if faults else "")
sys.exit(1 if faults else 0)
