"""Clang reads each source by itself without a warning. The product's units are read by clang_tidy_test.py, with the same warnings.

usage: clang_test.py BUILD SOURCE. Exit code 77: no clang here.
"""

import concurrent.futures
import json
import os
import pathlib
import shlex
import shutil
import subprocess
import sys

import alone


def command_of(entry: dict, compilers: dict) -> list[str]:
    """The entry's own flags and file, for clang, which then writes nothing."""
    words = shlex.split(entry["command"])
    file = entry["file"]
    words = words[next(i for i, word in enumerate(words) if word.startswith("-")):]
    kept = []
    skip = False
    for word in words:
        if skip or word in alone.GCC_ALONE or word in ("-c", "-MD", file):
            skip = False
        elif word in ("-o", "-MT", "-MF"):
            skip = True
        else:
            kept.append(word)
    language = "c" if file.endswith(".c") else "c++"
    return [*compilers[language], *kept, "-fsyntax-only", "-Werror", file]


def compilers() -> dict | None:
    """The words that start each compiler; None where one is missing."""
    found = {"c": shutil.which("clang"), "c++": shutil.which("clang++")}
    return {language: [path] for language, path in found.items()} if all(found.values()) else None


def check(entry: dict, compilers: dict) -> str:
    done = subprocess.run(command_of(entry, compilers), cwd=entry["directory"], capture_output=True, text=True)
    return done.stderr if done.returncode else ""


def main() -> int:
    build, source = (pathlib.Path(word).resolve() for word in sys.argv[1:3])
    found = compilers()
    if not found:
        print("clang_test: skipped, no clang")
        return 77
    build = alone.configure(build, source)
    entries = json.loads((build / "compile_commands.json").read_text())
    # Embedded kernels are arrays of numbers, and those of the build folder.
    entries = [e for e in entries if "generated" not in e["file"]]
    unique = list({e["file"]: e for e in entries}.values())
    if len(unique) < 200:
        print(f"clang_test: {build} compiles {len(unique)} files of {source}: too few to be all")
        return 1
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        wrong = 0
        for text in filter(None, pool.map(lambda e: check(e, found), unique)):
            print(text, flush=True)
            wrong += 1
    print(f"clang_test: {len(unique)} files, {wrong} with warnings or errors")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
