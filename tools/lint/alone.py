"""The commands that compile each file by itself, although the build compiles rooms
(cmake/Unity.cmake).

A second tree is configured without unity beside the build, and never built: its commands name the
headers that the build has generated.
"""

import json
import pathlib
import subprocess

# Options that GCC has and clang has not.
GCC_ALONE = ("-Wno-restrict", "-Wno-stringop-overflow", "-Wno-subobject-linkage", "-fno-gnu-unique", "--param=inline-unit-growth=400")
CACHED = ("CMAKE_BUILD_TYPE", "CMAKE_C_COMPILER", "CMAKE_CXX_COMPILER", "VKH_TESTS", "VKH_EXAMPLES", "VKH_WERROR", "VKH_PYTHON")


def cached(build: pathlib.Path) -> dict[str, str]:
    values = {}
    for line in (build / "CMakeCache.txt").read_text().splitlines():
        name, _, value = line.partition("=")
        values[name.partition(":")[0]] = value
    return values


def configure(build: pathlib.Path, source: pathlib.Path) -> pathlib.Path:
    """Returns a folder whose compile_commands.json has every source file of the build."""
    folder, values = build / "alone", cached(build)
    options = [f"-D{name}={values[name]}" for name in CACHED if values.get(name)]
    subprocess.run(["cmake", "-S", source, "-B", folder, "-G", values["CMAKE_GENERATOR"], *options, "-DVKH_UNITY=OFF", "-DVKH_PRECOMPILE=OFF",
                    f"-DVKH_KERNELS={build}/generated/kernels"], check=True, stdout=subprocess.DEVNULL)
    commands = folder / "compile_commands.json"
    entries = json.loads(commands.read_text())
    for entry in entries:
        entry["command"] = entry["command"].replace(f"{folder}/generated", f"{build}/generated")
    commands.write_text(json.dumps(entries, indent=1))
    return folder


def write_for_clang(build: pathlib.Path, folder: pathlib.Path) -> None:
    """Writes the build's compile_commands.json into the folder, without options that clang does not have."""
    entries = json.loads((build / "compile_commands.json").read_text())
    for entry in entries:
        entry["command"] = " ".join(word for word in entry["command"].split(" ") if word not in GCC_ALONE)
    (folder / "compile_commands.json").write_text(json.dumps(entries, indent=1))
