"""The engine for Conan 2: conan create tools/packages/conan

Conan, which has to fetch vulkan-headers, has not been run; tests/package/engine_test.sh builds with these
options. glslangValidator, spirv-opt, spirv-val and python3 come from the system.
"""

import os
import re

from conan import ConanFile
from conan.tools.build import stdcpp_library
from conan.tools.cmake import CMake, CMakeDeps, CMakeToolchain, cmake_layout
from conan.tools.files import copy, load

SOURCES = ("CMakeLists.txt", "LICENSE", "cmake/*", "engine/*", "shaders/*", "tools/*.py")


class VkHausdorff(ConanFile):
    name = "vkhausdorff"
    description = "Certified Hausdorff distance between triangle meshes on Vulkan: the engine's C API"
    license = "Apache-2.0"
    topics = ("vulkan", "geometry", "mesh", "hausdorff")
    package_type = "library"
    settings = "os", "arch", "compiler", "build_type"
    options = {"shared": [True, False], "fPIC": [True, False]}
    default_options = {"shared": False, "fPIC": True}

    def _root(self):
        return os.path.join(self.recipe_folder, "..", "..", "..")

    def set_version(self):
        header = load(self, os.path.join(self._root(), "engine", "vkhausdorff.h"))
        self.version = ".".join(re.findall(r"^#define VKH_VERSION_(?:MAJOR|MINOR|PATCH) (\d+)$", header, re.M))

    def export_sources(self):
        for pattern in SOURCES:
            copy(self, pattern, self._root(), self.export_sources_folder)

    def configure(self):
        if self.options.shared:
            self.options.rm_safe("fPIC")

    def layout(self):
        cmake_layout(self)

    def requirements(self):
        self.requires("vulkan-headers/[>=1.3.231]", transitive_headers=True)

    def generate(self):
        toolchain = CMakeToolchain(self)
        toolchain.cache_variables["VKH_HOST"] = False
        toolchain.generate()
        CMakeDeps(self).generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def package(self):
        CMake(self).install()

    def package_info(self):
        self.cpp_info.set_property("cmake_file_name", "VkHausdorff")
        self.cpp_info.set_property("pkg_config_name", "vkhausdorff")
        engine = self.cpp_info.components["engine"]
        engine.set_property("cmake_target_name", "VkHausdorff::engine")
        engine.libs = ["vkhausdorff"]
        engine.requires = ["vulkan-headers::vulkan-headers"]
        if not self.options.shared:
            engine.system_libs = ["m", "pthread"]
            runtime = stdcpp_library(self)
            if runtime:
                engine.system_libs.append(runtime)
