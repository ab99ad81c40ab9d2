#!/usr/bin/env python3
"""The shipped files are hardened: reads ELF files with readelf.

usage: hardening_test.py COMPILER MEASURES FILE...
MEASURES: the ones that the build found possible (cmake/Hardening.cmake), separated by commas.
Exits with 77 where there is no readelf, or the files are no ELF files.
"""

import shutil
import subprocess
import sys
import tempfile
from pathlib import Path


def readelf(option, path):
    return subprocess.run(["readelf", "-W", option, path], capture_output=True, text=True, check=True).stdout


def measures_of(path):
    """The measures that a file has."""
    headers, dynamic, symbols = readelf("-l", path), readelf("-d", path), readelf("--dyn-syms", path)
    found = set()
    if "GNU_RELRO" in headers and "NOW" in dynamic:
        found.add("relro")
    if "Elf file type is DYN" in headers:
        found.add("pie")  # or a shared library
    if "__stack_chk_fail" in symbols:
        found.add("stack")
    if any(name.split("@")[0].endswith("_chk") for line in symbols.splitlines() for name in line.split()[7:]):
        found.add("fortify")
    if not any("GNU_STACK" in line and " RWE " in line for line in headers.splitlines()):
        found.add("data is no code")
    return found


def soft_program(compiler, folder):
    source = Path(folder, "soft.cpp")
    source.write_text("int main() { return 0; }\n")
    program = Path(folder, "soft")
    made = subprocess.run([compiler, source, "-o", program, "-no-pie", "-fno-stack-protector", "-Wl,-z,norelro,-z,lazy",
                           "-Wl,-z,execstack"], capture_output=True, check=False)
    return program if made.returncode == 0 else None


def main():
    compiler, measures, *files = sys.argv[1:]
    if shutil.which("readelf") is None:
        print("SKIP: no readelf (package binutils)")
        return 77
    if any(Path(path).read_bytes()[:4] != b"\x7fELF" for path in files):
        print("SKIP: no ELF files")
        return 77
    wanted = {*filter(None, measures.split(",")), "data is no code"}
    failed = False
    for path in files:
        found = measures_of(path)
        print(f"{path}: {', '.join(sorted(found))}")
        for measure in sorted(wanted - found):
            print(f"{path}: NOT {measure}")
            failed = True
    with tempfile.TemporaryDirectory() as folder:
        program = soft_program(compiler, folder)
        if program is not None and measures_of(program):
            print(f"this test finds {measures_of(program)} in a program that has none of it")
            failed = True
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
