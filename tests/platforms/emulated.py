"""Platforms whose programs run on this machine: how they are built and started. Other drivers of the machine are
here, too."""

import contextlib
import os
import pathlib
import shutil
import subprocess


class Skip(Exception):
    """A named part of the machine is missing."""


def need(*names: str) -> str:
    """The first of these programs that is there."""
    for name in names:
        path = shutil.which(name)
        if path:
            return path
    raise Skip(f"no {names[0]} here (tools/setup --full)")


def first_line(*words: str) -> str:
    out = subprocess.run(words, capture_output=True, text=True, timeout=60).stdout
    return out.splitlines()[0] if out else "?"


class Platform:
    """A cross-build of this tree, by its preset, and the runner of its programs."""

    is_emulated = False  # another processor's instructions

    def __init__(self, name: str, source: pathlib.Path, native: pathlib.Path):
        self.name = name
        self.source = source
        self.native = native  # this machine's build, whose kernels are the same
        self.build = source / "out" / name
        # The environment without the tests' validation layer and all else that the caller's shell
        # has set up.
        self.environment = {k: v for k, v in os.environ.items()
                            if k in ("PATH", "HOME", "TMPDIR", "VK_DRIVER_FILES", "VK_ICD_FILENAMES")}
        self.environment["LC_ALL"] = "C.UTF-8"  # names of files are UTF-8 for Wine and Python, too

    suffix = ""
    tests = "tests/platforms/cross"
    limit = 300  # seconds, for one program
    versions: list[str] = []

    def compile(self, targets: list[str]) -> None:
        launcher = [f"-DCMAKE_{language}_COMPILER_LAUNCHER=ccache" for language in ("C", "CXX") if shutil.which("ccache")]
        generator = [] if (self.build / "CMakeCache.txt").exists() else ["-G", "Ninja"]
        for words in (["cmake", "--preset", self.name, *generator, *launcher, f"-DVKH_KERNELS={self.native}/generated/kernels"],
                      ["cmake", "--build", str(self.build), "-j", str(os.cpu_count()), "--target", *targets]):
            done = subprocess.run(words, cwd=self.source, capture_output=True, text=True, timeout=3600)
            if done.returncode:
                raise AssertionError(f"{' '.join(words)}\n{done.stdout[-4000:]}{done.stderr[-2000:]}")

    def words(self, program: str, arguments: list[str]) -> list[str]:
        return [*self.starter, str(self.build / (program + self.suffix)), *arguments]

    def run(self, program: str, *arguments: str, folder=None) -> subprocess.CompletedProcess:
        return subprocess.run(self.words(program, list(arguments)), cwd=folder or self.build, env=self.environment,
                              capture_output=True, timeout=self.limit, stdin=subprocess.DEVNULL)

    starter: list[str] = []


class Windows(Platform):
    """Windows, by mingw-w64, under Wine, whose winevulkan calls this machine's Vulkan loader."""

    suffix = ".exe"

    def __init__(self, source: pathlib.Path, native: pathlib.Path):
        super().__init__("windows", source, native)
        compiler = need("x86_64-w64-mingw32-g++-posix")
        wine = need("wine64", "/usr/lib/wine/wine64", "wine")
        need("Xvfb")
        self.starter = [wine]
        self.versions = [first_line(wine, "--version"), first_line(compiler, "--version")]
        self.prefix = self.build / "wine"
        self.environment |= {"WINEPREFIX": str(self.prefix), "WINEDEBUG": "-all", "WINEARCH": "win64",
                             "WINEDLLOVERRIDES": "mscoree,mshtml=;winemenubuilder.exe=d"}

    @contextlib.contextmanager
    def ready(self):
        """A display, without which Wine has no Vulkan; and a folder that Wine takes for a machine."""
        reading, writing = os.pipe()
        display = subprocess.Popen(["Xvfb", "-displayfd", str(writing), "-screen", "0", "640x480x24", "-nolisten", "tcp"],
                                   pass_fds=[writing], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(writing)
        try:
            with os.fdopen(reading) as answer:
                number = answer.readline().strip()
            if not number:
                raise Skip("Xvfb does not start")
            self.environment["DISPLAY"] = f":{number}"
            # Server and services start here and stay. Services that a test's program started would
            # hold its output, and its reader would wait for them to end, which takes them twenty
            # seconds.
            self.prefix.mkdir(parents=True, exist_ok=True)
            self.tell_server("-p")
            subprocess.run([*self.starter, "wineboot"], env=self.environment, cwd=self.build, timeout=300,
                           stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            yield
        finally:
            self.tell_server("-k")
            display.terminate()
            display.wait(timeout=30)

    def tell_server(self, word: str) -> None:
        server = shutil.which("wineserver") or shutil.which("wineserver-stable") or "/usr/lib/wine/wineserver"
        if pathlib.Path(server).exists():  # it keeps its output open
            subprocess.run([server, word], env=self.environment, timeout=60, stdin=subprocess.DEVNULL,
                           stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


class Arm64(Platform):
    """ARM64, by a cross-compiler, under qemu-user, with ARM64's own loader and lavapipe in a
    folder."""

    limit = 1200  # twenty times slower than the machine itself
    is_emulated = True

    def __init__(self, source: pathlib.Path, native: pathlib.Path):
        super().__init__("arm64", source, native)
        compiler = need("aarch64-linux-gnu-g++")
        self.emulator = need("qemu-aarch64-static", "qemu-aarch64")
        self.sysroot = self.build / "sysroot"
        self.versions = [first_line(self.emulator, "--version"), first_line(compiler, "--version")]
        driver = "/usr/share/vulkan/icd.d/lvp_icd.aarch64.json"  # in the sysroot
        libraries = "/usr/lib/aarch64-linux-gnu:/lib/aarch64-linux-gnu"
        self.environment |= {"VK_DRIVER_FILES": driver, "VK_ICD_FILENAMES": driver,
                             "MESA_SHADER_CACHE_DIR": str(self.build / "mesa"),
                             "XDG_CACHE_HOME": str(self.build / "cache")}
        self.starter = [self.emulator, "-L", str(self.sysroot), "-E", f"LD_LIBRARY_PATH={libraries}"]

    @contextlib.contextmanager
    def ready(self):
        script = pathlib.Path(__file__).with_name("arm64_sysroot.sh")
        done = subprocess.run([script, self.sysroot], capture_output=True, text=True, timeout=600)
        if done.returncode == 77:
            raise Skip(done.stderr.strip().splitlines()[-1])
        if done.returncode:
            raise AssertionError(done.stderr)
        self.versions += (self.sysroot / "versions").read_text().replace("\t", " ").splitlines()
        yield


class Libcxx(Platform):
    """Clang with LLVM's C++ library: no extension of GNU's, and nothing of libstdc++ (docs/platforms.md)."""

    tests = "tests"

    def __init__(self, source: pathlib.Path, native: pathlib.Path):
        super().__init__("libcxx", source, native)
        compiler = need("clang++-19")
        library = pathlib.Path(compiler).resolve().parents[1] / "include/c++/v1/__config"
        if not library.exists():
            raise Skip("no libc++-19-dev here (tools/setup --full)")
        self.versions = [first_line(compiler, "--version")]

    @contextlib.contextmanager
    def ready(self):
        yield


class Driver(Platform):
    """This build on another driver of this machine. Tests run with the newer validation layer, where it is there."""

    tests = "tests"

    def __init__(self, name: str, source: pathlib.Path, build: pathlib.Path):
        super().__init__(name, source, build)
        self.build = build
        self.drivers = source / "out" / "drivers"
        self.environment |= {"VKH_VALIDATION": "1", "NODEVICE_SELECT": "1"}
        self.versions = []
        if self.has_second():
            self.environment["VK_LAYER_PATH"] = str(self.drivers)
            self.versions = [(self.drivers / "version").read_text().strip()]

    def has_second(self) -> bool:
        return (self.drivers / "version").exists()

    def need_second(self) -> None:
        if not self.has_second():
            raise Skip("no second driver and layer in out/drivers (tools/second_driver gets them)")

    def compile(self, targets: list[str]) -> None:
        missing = [t for t in ("vkhausdorff", "tools/vkh_sweep", "tests/api_c11") if not (self.build / t).exists()]
        if missing:
            raise AssertionError(f"not built: {', '.join(missing)}")

    @contextlib.contextmanager
    def ready(self):
        yield


class Nehalem(Driver):
    """This build on an x86-64 without AVX and fused products, under qemu-user: without Vulkan, whose driver would compile for
    this machine."""

    limit = 1200
    is_emulated = True

    def __init__(self, source: pathlib.Path, build: pathlib.Path):
        super().__init__("nehalem", source, build)
        emulator = need("qemu-x86_64-static", "qemu-x86_64")
        self.starter = [emulator, "-cpu", "Nehalem"]
        self.versions = [first_line(emulator, "--version")]


class SwiftShader(Driver):
    """A CPU driver of another maker: subgroups of 4, no push descriptors, synchronization2 in its core."""

    def __init__(self, source: pathlib.Path, build: pathlib.Path):
        super().__init__("swiftshader", source, build)
        self.need_second()
        icd = str(self.drivers / "vk_swiftshader_icd.json")
        self.environment |= {"VK_DRIVER_FILES": icd, "VK_ICD_FILENAMES": icd}


class Lavapipe(Driver):
    """lavapipe with vectors of a given number of bits, on any processor: subgroups of 4, 8 or 16."""

    def __init__(self, bits: int, source: pathlib.Path, build: pathlib.Path):
        super().__init__(f"lavapipe{bits}", source, build)
        # Mesa 22.3 caches machine code by words that leave the width out: it would run code that another width left
        # there.
        self.environment |= {"LP_NATIVE_VECTOR_WIDTH": str(bits), "MESA_SHADER_CACHE_DIR": str(build / f"mesa{bits}")}
        self.subgroup = bits // 32
