"""clang-tidy 14 (.clang-tidy) finds nothing in the product and its examples, as the build folder compiles them, nor does
clang with the build's warnings.

Rooms are read as the units that the build makes of them (cmake/Unity.cmake): most of the cost is
the standard library's headers. clang_test.py reads each file by itself.

usage: clang_tidy_test.py BUILD SOURCE [FILE...]. Exit code 77: no clang-tidy 14 here; others know
other checks. FILE: these alone, each by itself.
"""

import concurrent.futures
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

import alone

FOLDERS = ("engine", "host", "check", "examples")  # not the tests and tools: they would take as long again
# Errors that the checks must find, so that a configuration that finds nothing is noticed.
BAIT = """\
#include <string>
#include <vector>
int f(int a, int b, int c, int d, int e, int g) { return a + b + c + d + e; }
long long wide(int a, int b) { return a * b; }
int hidden(int a) { for (int i = 0; i < a; ++i) { int a = i; a += i; } return a; }
void copies(std::vector<std::string> all) { for (const std::string one : all) (void)one.size(); }
"""
BITES = ("clang-diagnostic-unused-parameter", "readability-function-size", "bugprone-implicit-widening-of-multiplication-result", "performance-for-range-copy", "clang-diagnostic-shadow")


def program() -> str | None:
    for name in ("clang-tidy-14", "clang-tidy"):
        path = shutil.which(name)
        if path and "version 14." in subprocess.run([path, "--version"], capture_output=True, text=True).stdout:
            return path
    return None


def checks(file: str, source: pathlib.Path) -> bool:
    return any(pathlib.Path(file).is_relative_to(source / folder) for folder in FOLDERS)


def command(build: pathlib.Path, files: list[str], *more: str) -> list[str]:
    # The build's commands are GCC's.
    return [program(), "--quiet", "-p", str(build), "--extra-arg=-Wno-unused-command-line-argument", *more, *files]


def findings(build: pathlib.Path, file: str) -> str:
    more = ["--checks=-bugprone-suspicious-include"] if is_unit(file) else []  # a unit includes sources
    done = subprocess.run(command(build, [file], *more), capture_output=True, text=True)
    return (done.stdout or done.stderr) if done.returncode else ""


def is_unit(file: str) -> bool:
    return pathlib.Path(file).parent.name == "Unity"


def sources_in(file: str) -> list[str]:
    """The sources that are read with a file of the build."""
    return re.findall(r'(?m)^#include "(.*)"$', pathlib.Path(file).read_text()) if is_unit(file) else [file]


def missed(source: pathlib.Path) -> list[str]:
    """The checks that miss the deliberate errors."""
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "bait.cpp"
        file.write_text(BAIT)
        done = subprocess.run(command(source, [str(file)], f"--config-file={source / '.clang-tidy'}")
                              + ["--", "-std=c++20", "-Wextra", "-Wshadow"], capture_output=True, text=True)
        return [check for check in BITES if check not in done.stdout] if done.returncode else list(BITES)


def main() -> int:
    build, source = (pathlib.Path(word).resolve() for word in sys.argv[1:3])
    if program() is None:
        print("clang_tidy_test: skipped, no clang-tidy 14")
        return 77
    silent = missed(source)
    if silent:
        print("clang_tidy_test: finds nothing in a file that breaks", *silent)
        return 1
    if sys.argv[3:]:
        build = alone.configure(build, source)
        ours = [str(pathlib.Path(word).resolve()) for word in sys.argv[3:]]
    else:
        files = {entry["file"] for entry in json.loads((build / "compile_commands.json").read_text())}
        ours = [f for f in files if any(checks(part, source) for part in sources_in(f))]
    read = {part for f in ours for part in sources_in(f)}
    if not sys.argv[3:] and len(read) < 40:
        print(f"clang_tidy_test: {build} compiles {len(read)} sources of {source}: too few to be all")
        return 1
    largest_first = sorted(ours, key=lambda f: -sum(pathlib.Path(part).stat().st_size for part in sources_in(f)))
    with concurrent.futures.ThreadPoolExecutor(int(os.environ.get("VKH_JOBS", os.cpu_count()))) as pool, tempfile.TemporaryDirectory() as folder:
        alone.write_for_clang(build, pathlib.Path(folder))
        wrong = 0
        for text in filter(None, pool.map(lambda f: findings(pathlib.Path(folder), f), largest_first)):
            print(text, flush=True)
            wrong += 1
    print(f"clang_tidy_test: {len(read)} sources in {len(ours)} units, {wrong} units with findings")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
