"""The Python package: pyproject.toml says what it is, CMake builds it, `cmake --install --component wheel` gives its files.

CMAKE_ARGS: more arguments for CMake. VKH_BUILD_DIR: the folder to build in, to be kept.
"""

import os
import pathlib
import re
import shlex
import subprocess
import sys

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = pathlib.Path(__file__).resolve().parent


def version() -> str:
    header = (ROOT / "engine" / "vkhausdorff.h").read_text()
    return ".".join(re.findall(r"^#define VKH_VERSION_(?:MAJOR|MINOR|PATCH) (\d+)$", header, re.M))


def pybind11() -> list[str]:
    """Where CMake finds pip's pybind11; a system's it finds by itself."""
    try:
        import pybind11 as package
    except ImportError:
        return []
    return [f"-Dpybind11_DIR={package.get_cmake_dir()}"]


class CMakeBuild(build_ext):
    def run(self) -> None:
        if self.inplace:
            raise SystemExit("no editable install: the module lies in the build folder, which may be on PYTHONPATH")
        build = os.environ.get("VKH_BUILD_DIR") or str(pathlib.Path(self.build_temp).resolve())
        target = pathlib.Path(self.build_lib).resolve()
        subprocess.run(
            ["cmake", "-S", str(ROOT), "-B", build, "-DCMAKE_BUILD_TYPE=Release", "-DVKH_HOST=ON", "-DVKH_PYTHON=ON",
             "-DVKH_EXAMPLES=OFF", "-DVKH_INSTALL=ON", "-DBUILD_SHARED_LIBS=OFF",
             f"-DVKH_PYTHON_EXECUTABLE={sys.executable}", *pybind11(), *shlex.split(os.environ.get("CMAKE_ARGS", ""))],
            check=True)
        jobs = str(self.parallel or os.cpu_count() or 1)
        subprocess.run(["cmake", "--build", build, "--target", "vkh_python", "--config", "Release", "-j", jobs], check=True)
        subprocess.run(["cmake", "--install", build, "--component", "wheel", "--prefix", str(target)], check=True)


setup(
    version=version(),
    packages=["vkhausdorff"],
    package_dir={"vkhausdorff": "host/python/package"},
    package_data={"vkhausdorff": ["py.typed", "*.pyi"]},
    # A name alone: it makes the wheel one for this Python and this machine.
    ext_modules=[Extension("vkhausdorff._core", [])],
    cmdclass={"build_ext": CMakeBuild},
)
