#!/usr/bin/env python3
"""Writes the corpus of malformed files into a folder, and manifest.tsv: name, outcome, words.

usage: write.py FOLDER
The outcome is R for a refusal in one line that names the file, A and a count of faces otherwise; Q and P are the same
for a file that is read as points.
The words have to stand in the refusal or in a note."""

import pathlib
import sys

import gltf
import las
import obj
import off
import ply
import stl
import threemf
import xyz


def main(folder):
    folder.mkdir(parents=True, exist_ok=True)
    cases = [case for part in (gltf, las, obj, off, ply, stl, threemf, xyz) for case in part.all_cases()]
    names = {case.name for case in cases}
    if len(names) != len(cases):
        sys.exit('write.py: two cases of one name')
    for case in cases:
        (folder / case.name).write_bytes(case.content)
    rows = [f'{case.name}\t{case.expected}\t{case.says}\n' for case in cases]
    (folder / 'manifest.tsv').write_text(''.join(rows))


if __name__ == '__main__':
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(pathlib.Path(sys.argv[1]))
