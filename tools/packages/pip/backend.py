"""pip's way to setup.py: setuptools, from this machine where it has one, so that a build needs no network.

pip builds in an environment of its own, where nothing is installed but what pyproject.toml requires. So that requires nothing:
this looks for what a build needs where pip has hidden it, and asks pip for what the machine lacks.
"""

import importlib.metadata
import importlib.util
import re
import subprocess
import sys

SETUPTOOLS = 61  # the first that reads [project] of pyproject.toml


def hidden_folders() -> list[str]:
    """The folders in which this Python finds packages without pip's environment, -E, and does not now."""
    code = "import sys; print(*sys.path, sep='\\n')"
    told = subprocess.run([sys.executable, "-E", "-c", code], check=True, capture_output=True, text=True).stdout
    return [folder for folder in told.splitlines() if folder and folder not in sys.path]


def has_setuptools() -> bool:
    try:
        return int(re.match(r"\d+", importlib.metadata.version("setuptools"))[0]) >= SETUPTOOLS
    except importlib.metadata.PackageNotFoundError:
        return False


def has_pybind11() -> bool:
    """As a package of Python, or as the system's, which CMake finds."""
    if importlib.util.find_spec("pybind11") is not None:
        return True
    try:
        return subprocess.run(["pkg-config", "--exists", "pybind11 >= 2.10"]).returncode == 0
    except OSError:
        return False


def missing() -> list[str]:
    """What pip has to bring. What it does not bring can be imported from here on."""
    sys.path += hidden_folders()
    there = {f"setuptools>={SETUPTOOLS}": has_setuptools(), "wheel": importlib.util.find_spec("wheel") is not None,
             "pybind11>=2.10": has_pybind11()}
    return [requirement for requirement, is_there in there.items() if not is_there]


def setuptools_backend():
    """setuptools' own backend, once pip has brought what was missing."""
    missing()
    from setuptools import build_meta

    return build_meta


def get_requires_for_build_wheel(config_settings=None):
    return missing()


def get_requires_for_build_sdist(config_settings=None):
    return missing()


def prepare_metadata_for_build_wheel(metadata_directory, config_settings=None):
    return setuptools_backend().prepare_metadata_for_build_wheel(metadata_directory, config_settings)


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    return setuptools_backend().build_wheel(wheel_directory, config_settings, metadata_directory)


def build_sdist(sdist_directory, config_settings=None):
    return setuptools_backend().build_sdist(sdist_directory, config_settings)
