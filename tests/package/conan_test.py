"""Runs the Conan recipe's methods, with stand-ins for Conan, in Conan's order, as a shared library.

usage: conan_test.py SOURCE BUILD PACKAGE: PACKAGE is filled; BUILD may be a tree of the same sources.
"""

import importlib.util
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent


def recipe(source: pathlib.Path):
    sys.path.insert(0, str(HERE / "stand_in"))
    spec = importlib.util.spec_from_file_location("conanfile", source / "tools" / "packages" / "conan" / "conanfile.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def files_of(folder: pathlib.Path) -> dict:
    return {str(path.relative_to(folder)): path for path in folder.rglob("*") if path.is_file()}


def check_exported(module, conan, source: pathlib.Path) -> None:
    """The recipe's exports are enough to build from: all of these folders' sources, and only tracked files."""
    exported = files_of(pathlib.Path(conan.export_sources_folder))
    for folder in ("cmake", "engine", "shaders"):
        for path in (source / folder).rglob("*"):
            if path.is_file() and "__pycache__" not in path.parts:
                name = str(path.relative_to(source))
                assert name in exported, f"the recipe does not export {name}"
    for name in ("CMakeLists.txt", "LICENSE", "tools/embed_shaders.py"):
        assert name in exported, f"the recipe does not export {name}"


def main() -> None:
    source, build, package = (pathlib.Path(word).resolve() for word in sys.argv[1:4])
    sources = package.parent / "conan_sources"
    module = recipe(source)
    folders = {"recipe": str(source / "tools" / "packages" / "conan"), "sources": str(sources), "build": str(build),
               "package": str(package)}
    conan = module.VkHausdorff(folders, shared=True)
    conan.set_version()
    header = (source / "engine" / "vkhausdorff.h").read_text()
    for part, number in zip(("MAJOR", "MINOR", "PATCH"), conan.version.split("."), strict=True):
        assert f"#define VKH_VERSION_{part} {number}\n" in header, conan.version
    conan.export_sources()
    check_exported(module, conan, source)
    conan.configure()
    assert not hasattr(conan.options, "fPIC")
    conan.layout()
    conan.requirements()
    conan.source_folder = str(source)  # the tree was configured from there; the same files
    conan.generate()
    conan.build()
    conan.package()
    conan.package_info()
    engine = conan.cpp_info.components["engine"]
    assert conan.required and engine.requires == ["vulkan-headers::vulkan-headers"], engine.requires
    for library in engine.libs:
        assert (package / "lib" / f"lib{library}.so").exists(), library
    assert engine.properties["cmake_target_name"] == "VkHausdorff::engine"
    assert engine.system_libs == []
    static = module.VkHausdorff(folders)
    static.package_info()
    assert "stdc++" in static.cpp_info.components["engine"].system_libs
    print(f"conan_test: {conan.name} {conan.version}")


main()
