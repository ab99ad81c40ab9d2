#!/usr/bin/env python3
"""What the README quotes is a file that a test compiles or runs, letter by letter. usage: readme_test.py README FILE... --parts-of FILE..."""
import pathlib
import re
import sys

readme = pathlib.Path(sys.argv[1]).read_text()
quoted = re.findall(r"^```\w+\n(.*?)^```$", readme, re.MULTILINE | re.DOTALL)
split = sys.argv.index("--parts-of")
files = {path: pathlib.Path(path).read_text() for path in sys.argv[2:split]}
parts = [pathlib.Path(path).read_text() for path in sys.argv[split + 1 :]]
missing = [path for path, text in files.items() if text not in quoted]
for path in missing:
    print(f"{sys.argv[1]}: does not quote {path} as it is")
strangers = [
    text for text in quoted if text not in files.values() and not any(text in whole for whole in parts)
]
for text in strangers:
    print(f"{sys.argv[1]}: quotes what no test compiles or runs:\n{text}")
sys.exit(1 if missing or strangers else 0)
