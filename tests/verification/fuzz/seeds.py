#!/usr/bin/env python3
"""Writes what the fuzzers start from: the small malformed files, a folder for each reader, and random bytes.

usage: seeds.py FOLDER"""

import pathlib
import random
import shutil
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / 'files/malformed'))

import gltf  # noqa: E402
import las  # noqa: E402
import obj  # noqa: E402
import off  # noqa: E402
import ply  # noqa: E402
import stl  # noqa: E402
import threemf  # noqa: E402
import xyz  # noqa: E402

MOST_BYTES = 1536  # in larger files a fuzzer changes unimportant bytes


def reader_of(case):
    """The readers' names are those of read_fuzz.cpp."""
    extension = case.name.rsplit('.', 1)[1]
    if extension == 'ply':
        return 'ply-binary' if b'format binary' in case.content[:64] else 'ply-ascii'
    if extension == 'stl':
        return 'stl-binary' if b'\0' in case.content else 'stl-ascii'
    return extension


def main(folder):
    shutil.rmtree(folder, ignore_errors=True)
    for part in (gltf, las, obj, off, ply, stl, threemf, xyz):
        for case in part.all_cases():
            if len(case.content) > MOST_BYTES:
                continue
            for reader in {reader_of(case), 'any'} - {'3mf'}:
                (folder / reader).mkdir(parents=True, exist_ok=True)
                (folder / reader / case.name).write_bytes(case.content)
    (folder / '3mf').mkdir()  # its model part alone
    for name, model in threemf.models():
        (folder / '3mf' / name).write_bytes(model.encode())
    numbers = random.Random(1)  # any bytes are an input of the C API, and short ones are mostly zeros
    (folder / 'api').mkdir()
    for i in range(64):
        (folder / 'api' / f'random_{i}').write_bytes(numbers.randbytes(256))


if __name__ == '__main__':
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(pathlib.Path(sys.argv[1]))
