#!/usr/bin/env python3
"""What the README quotes is a file that a test compiles or runs, letter by letter. usage: readme_test.py README FILE..."""
import pathlib
import re
import sys

readme = pathlib.Path(sys.argv[1]).read_text()
quoted = re.findall(r"^```\w+\n(.*?)^```$", readme, re.MULTILINE | re.DOTALL)
files = {path: pathlib.Path(path).read_text() for path in sys.argv[2:]}
missing = [path for path, text in files.items() if text not in quoted]
for path in missing:
    print(f"{sys.argv[1]}: does not quote {path} as it is")
strangers = [text for text in quoted if text not in files.values()]
for text in strangers:
    print(f"{sys.argv[1]}: quotes what no test compiles or runs:\n{text}")
sys.exit(1 if missing or strangers else 0)
