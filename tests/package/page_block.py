"""Prints a block of code of a page, which the comment <!-- NAME --> stands above: what a page shows is what a test runs.

usage: page_block.py PAGE NAME
"""

import pathlib
import re
import sys

page, name = sys.argv[1:]
found = re.findall(rf"^<!-- {re.escape(name)} -->\n```\w+\n(.*?)^```$", pathlib.Path(page).read_text(), re.M | re.S)
if len(found) != 1:
    sys.exit(f"page_block: {page} has {len(found)} blocks under <!-- {name} -->, not one")
print(found[0], end="")
