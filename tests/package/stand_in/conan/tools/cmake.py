import os
import subprocess


def cmake_layout(conanfile):
    pass


class CMakeDeps:
    def __init__(self, conanfile):
        pass

    def generate(self):
        pass


class CMakeToolchain:
    def __init__(self, conanfile):
        self.cache_variables = conanfile.toolchain = {}

    def generate(self):
        pass


class CMake:
    def __init__(self, conanfile):
        self.file = conanfile

    def configure(self):
        flag = lambda value: ("ON" if value else "OFF") if isinstance(value, bool) else value
        # The settings of Conan's tool chain: the options `shared` and fPIC.
        variables = {"CMAKE_BUILD_TYPE": "Release", "BUILD_SHARED_LIBS": bool(self.file.options.shared), **self.file.toolchain}
        subprocess.run(["cmake", "-S", self.file.source_folder, "-B", self.file.build_folder,
                        *(f"-D{name}={flag(value)}" for name, value in variables.items())], check=True)

    def build(self):
        subprocess.run(["cmake", "--build", self.file.build_folder, "-j", os.environ["VKH_JOBS"]], check=True)

    def install(self):
        subprocess.run(["cmake", "--install", self.file.build_folder, "--prefix", self.file.package_folder], check=True)
