"""One version everywhere: the header's. usage: versions_test.py BUILD SOURCE PROGRAM PYTHON|none (its module: PYTHONPATH)"""

import json
import pathlib
import re
import subprocess
import sys

build, source = (pathlib.Path(word).resolve() for word in sys.argv[1:3])
program, python = sys.argv[3:5]


def output(*words: str) -> str:
    return subprocess.run(words, check=True, capture_output=True, text=True, cwd=source).stdout.strip()


def found(path: pathlib.Path, pattern: str) -> str:
    match = re.search(pattern, path.read_text(), re.M)
    return match[1] if match else f"nothing like {pattern}"


header = (source / "engine" / "vkhausdorff.h").read_text()
parts = [found(source / "engine" / "vkhausdorff.h", rf"^#define VKH_VERSION_{part} (\d+)$") for part in ("MAJOR", "MINOR", "PATCH")]
version = ".".join(parts)
said = {
    "VKH_VERSION_STRING": found(source / "engine" / "vkhausdorff.h", r'^#define VKH_VERSION_STRING "(.*)"$'),
    "CMake": found(build / "CMakeCache.txt", r"^CMAKE_PROJECT_VERSION:STATIC=(.*)$"),
    "find_package": found(build / "VkHausdorffConfigVersion.cmake", r'^set\(PACKAGE_VERSION "(.*)"\)'),
    "vkhausdorff.pc": found(build / "vkhausdorff.pc", r"^Version: (.*)$"),
    "vkhausdorff-host.pc": found(build / "vkhausdorff-host.pc", r"^Version: (.*)$"),
    "cpack": found(build / "CPackConfig.cmake", r'^set\(CPACK_PACKAGE_VERSION "(.*)"\)'),
    "vkhausdorff --version": output(program, "--version").removeprefix("vkhausdorff "),
    "the vcpkg port": json.loads((source / "tools/packages/vcpkg/vkhausdorff/vcpkg.json").read_text())["version"],
}
if python != "none":
    said["Python"] = output(python, "-B", "-c", "import vkhausdorff; print(vkhausdorff.__version__)")
wrong = {name: text for name, text in said.items() if text != version}
for name, text in wrong.items():
    print(f"versions_test: {name} says {text}, vkhausdorff.h {version}")
print(f"versions_test: {version}, {len(said)} places")
sys.exit(1 if wrong else 0)
