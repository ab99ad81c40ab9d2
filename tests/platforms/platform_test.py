"""The program, the sweep and the kernels' tests on another platform or driver, against the program here, bit for bit.

usage: platform_test.py windows|arm64|libcxx|nehalem|swiftshader|lavapipe128|lavapipe256|lavapipe512 --native BUILD [--only GROUP[,GROUP...]] [--sweep N]

Each group is a line: what was compared and how long it took. Exit code 77, with the reason: the compiler, the emulator
or the platform's driver is not here.
"""

import argparse
import csv
import functools
import json
import os
import pathlib
import pty
import re
import select
import shutil
import signal
import subprocess
import sys
import time

import meshes
from emulated import Arm64, Lavapipe, Libcxx, Nehalem, Platform, Skip, SwiftShader, Windows

SOURCE = pathlib.Path(__file__).resolve().parents[2]
TESTS = SOURCE / "tests"
PAIRS = SOURCE.parent / "shared" / "pairs"
# Quick ones: on a CPU of this machine each takes a third of a second.
NAMES = [f"decimation_thingi10k_{x}" for x in ("96582_vcg50", "107100_vcg50", "65004_vcg50", "37881_vcg50", "243015_mo50")] + [
    f"tetwild_thingi10k_{x}_tetwild" for x in ("49220", "73340", "100036", "96582", "49884")]
KERNELS = ["kernel_sort_test", "kernel_bvh_test", "kernel_query_test"]
HOST = ["system_test", "float_environment_test", "mesh_io_test", "mesh_decimals_test", "decimal_test",
        "pipeline_cache_test", "default_pair_test", "mesh_test"]
CANCELLED = b'"status":"cancelled"'


def expect(holds: bool, what: str) -> None:
    if not holds:
        raise AssertionError(what)


def told(done: subprocess.CompletedProcess) -> str:
    return f"exit code {done.returncode}\n{done.stdout[-3000:].decode(errors='replace')}{done.stderr[-3000:].decode(errors='replace')}"


def without_times(text: bytes) -> dict:
    """The parts that must be equal: all of an answer or a result line but the clock's part and the device's name.
    How many waves are recorded, and so how often a stage is timed, is the clock's, too."""
    answer = json.loads(text)
    for key in ("device", "driver", "host", "started", "times", "run"):
        answer.pop(key, None)
    for one in (*answer.get("directions", []), *answer.get("inputs", [])):
        one.pop("times", None)
        for key in ("sha256", "files"):  # not every platform's build has them
            one.pop(key, None)
        for stage in one.get("stages", []):
            stage.pop("gpu_ms")
            stage.pop("times")
    return answer


def differences_of_lines(here: str, there: str, at: str) -> list[str]:
    """Those of two result lines. A build that hashes no files has no keys."""
    x, y = without_times(here.encode()), without_times(there.encode())
    if "" in (x["key"], y["key"]):
        x.pop("key")
        y.pop("key")
    return differences(x, y, at)


def differences(x, y, at="") -> list[str]:
    if isinstance(x, dict) and isinstance(y, dict) and x.keys() == y.keys():
        return [d for key in x for d in differences(x[key], y[key], f"{at}.{key}")]
    if isinstance(x, list) and isinstance(y, list) and len(x) == len(y):
        return [d for i, (p, q) in enumerate(zip(x, y)) for d in differences(p, q, f"{at}[{i}]")]
    return [] if x == y else [f"{at}: {x} here, {y} there"]


class Run:
    def __init__(self, platform: Platform, native: pathlib.Path, sweep: int):
        self.platform = platform
        self.native = native / "vkhausdorff"
        self.sweep = sweep

    def here(self, *arguments: str, folder) -> subprocess.CompletedProcess:
        return subprocess.run([self.native, *arguments], cwd=folder, capture_output=True, timeout=300)

    def same(self, *arguments: str, folder: pathlib.Path) -> dict:
        """One command on both platforms: the same exit code and, except for times, the same answer."""
        there = self.platform.run("vkhausdorff", *arguments, "--json", folder=folder)
        here = self.here(*arguments, "--json", folder=folder)
        expect(here.returncode == there.returncode and here.returncode in (0, 3), told(there))
        said = [line for line in there.stderr.splitlines() if not re.match(rb"\d+ %  \[", line)]
        expect(not said and there.stdout.endswith(b"}\n") and there.stdout.count(b"\n") == 1
               and b"\r" not in there.stdout, f"not one line: {told(there)}")
        found = differences(without_times(here.stdout), without_times(there.stdout))
        expect(not found, f"{arguments}:\n" + "\n".join(found[:20]))
        return json.loads(there.stdout)

    def doctor(self) -> str:
        done = self.platform.run("vkhausdorff", "doctor")
        expect(done.returncode == 0 and done.stdout.count(b"passed") == 2, told(done))
        lines = done.stdout.decode().splitlines()
        subgroup = getattr(self.platform, "subgroup", None)
        expect(subgroup is None or f"subgroups of {subgroup};" in done.stdout.decode(), told(done))
        return next(line.split("  ")[-1].strip() for line in lines if line.startswith("driver"))

    def demo(self) -> str:
        answer = self.same("demo", "--verify", folder=self.platform.build)
        way = answer["directions"][0]
        expect(way["verified"]["witness"] and way["verified"]["coverage"], "--verify")
        interval, counts = answer["interval"], way["counts"]
        return f"[{interval['lower_hex']}, {interval['upper_hex']}], {counts['candidates']} candidates, {counts['queries']} queries"

    def manifest(self) -> str:
        if not PAIRS.exists():
            return "left out: no folder ../shared/pairs"
        with open(PAIRS / "manifest.csv") as file:
            rows = {row["pair"]: row for row in csv.DictReader(file)}
        names = NAMES[::3] if self.platform.is_emulated else NAMES
        for name in names:
            self.same("distance", rows[name]["file_a"], rows[name]["file_b"], folder=PAIRS)
        return f"{len(names)} pairs, all bits and counts equal"

    def generated(self) -> str:
        folder = self.platform.build / "pairs"
        shutil.rmtree(folder, ignore_errors=True)
        pairs = meshes.write(folder)
        for i, (a, b) in enumerate(pairs):
            self.same("distance", a, b, *(["--symmetric"] if i % 5 == 0 else []), folder=folder)
        return f"{len(pairs)} pairs in OBJ, PLY, STL and OFF, all bits and counts equal"

    def without_vulkan(self) -> str:
        """Distances both ways, sides, figures and normals, by --device native; some pairs have no sides, and say so."""
        folder = self.platform.build / "pairs"
        pairs = meshes.write(folder, 60)
        (folder / "list.csv").write_text("id,a,b\n" + "".join(f"{i},{a},{b}\n" for i, (a, b) in enumerate(pairs)), encoding="utf-8")
        for name, words in (("signed", ("--symmetric", "--signed", "--tol=1e-9")), ("metrics", ("--metrics", "--normals=20", "--bands=1%"))):
            lines = []
            for run, out in ((functools.partial(self.platform.run, "vkhausdorff"), "there.jsonl"), (self.here, "here.jsonl")):
                (folder / out).unlink(missing_ok=True)
                done = run("batch", "list.csv", *words, "--effort=500", "--device=native", f"--out={out}", folder=folder)
                expect(done.returncode in (0, 3, 4), told(done))
                lines.append(sorted((folder / out).read_text(encoding="utf-8").splitlines()))
            there, here = lines
            expect(len(there) == len(here) == len(pairs), told(done))
            found = [d for x, y in zip(here, there) for d in differences_of_lines(x, y, name)]
            expect(not found, "\n".join(found[:20]))
        return f"{len(pairs)} pairs by --device native: distances, sides, figures and normals, all bits equal"

    def table(self) -> str:
        """The text for people, except for the line of times; and a file beside it, whose name is no
        ASCII."""
        folder = self.platform.build / "pairs"
        a, b = meshes.write(folder)[0]
        answer = folder / meshes.FOLDER / "Ergebnis 結果.json"
        for older in ("", "older"):
            answer.write_text(older)
            words = ["distance", a, b, "--tol", "1e-4", f"--json={answer.relative_to(folder)}"]
            there = self.platform.run("vkhausdorff", *words, folder=folder)
            written = answer.read_bytes()
            here = self.here(*words, folder=folder)
            expect(there.returncode == 0 and here.returncode == 0, told(there))
            plain = [re.sub(rb"(?m)^  (times|device|off) .*$", b"", text.stdout) for text in (there, here)]
            expect(plain[0] == plain[1], plain[0].decode() + plain[1].decode())
            expect(not differences(without_times(written), without_times(answer.read_bytes())), "the file differs")
        left = {path.name for path in (folder / meshes.FOLDER).iterdir()}
        expect(not any(name.startswith(".vkhausdorff") for name in left), f"left over: {left}")
        lost = self.platform.run("vkhausdorff", "distance", a, b, f"--json={a}", folder=folder)
        expect(lost.returncode == 2 and b"would overwrite the input" in lost.stderr, told(lost))
        gone = self.platform.run("vkhausdorff", "distance", "nö.obj", b, folder=folder)
        expect(gone.returncode == 4 and gone.stderr.startswith("vkhausdorff: nö.obj: no such file".encode())
               and gone.stderr.count(b"\n") == 1, told(gone))
        return "the same table, file and refusals"

    def kernels(self) -> str:
        return self.doctests(KERNELS)

    def presets(self) -> str:
        """Every kernel, under every set of switches; and the C API's frames."""
        return self.doctests(["presets_test", "api_frames_test", "api_tasks_test", "api_address_test"])

    def host(self) -> str:
        return self.doctests(HOST)

    def doctests(self, names: list[str]) -> str:
        assertions = 0
        for name in names:
            room = next(TESTS.glob(f"*/{name}.cpp")).parent.name  # tests/programs.cmake
            done = self.platform.run(f"{self.platform.tests}/{room}_tests", f"--source-file=*/{name}.cpp")
            counted = re.search(rb"assertions: +(\d+) \| +(\d+) passed", done.stdout)
            expect(done.returncode == 0 and counted is not None, f"{name}: {told(done)}")
            assertions += int(counted[2])
        return f"{len(names)} tests, {assertions} assertions"

    def suite(self) -> str:
        """All of the tests that `tools/test` runs by default, in that platform's own tree."""
        done = subprocess.run(["ctest", "--test-dir", self.platform.build, "-j", str(os.cpu_count()), "-LE", "full|nightly",
                               "--no-tests=error", "--output-on-failure"], env=self.platform.environment, capture_output=True, timeout=3600)
        expect(done.returncode == 0, told(done))
        return re.search(rb"(\d+% tests passed, 0 tests failed out of \d+)", done.stdout)[1].decode()

    def api(self) -> str:
        done = self.platform.run(f"{self.platform.tests}/api_c11")
        expect(done.returncode == 0, told(done))
        return "the C API from C11"

    def sweeping(self) -> str:
        done = self.platform.run("tools/vkh_sweep", "--count", str(self.sweep), "--seed", "17")
        summary = done.stdout.decode().strip().splitlines()[-1:]
        expect(done.returncode == 0 and " 0 violations" in summary[0], told(done))
        spoilt = self.platform.run("tools/vkh_sweep", "--count", "6", "--seed", "11", "--spoil", "1e-4")
        expect(b"misses the reference" in spoilt.stdout, f"spoilt bounds pass: {told(spoilt)}")
        return summary[0].removeprefix("sweep: ")

    def interrupt(self) -> str:
        """Ctrl-C: exit code 3 and a true interval. Asked again later where the program had not yet begun."""
        words = self.platform.words("vkhausdorff", ["distance", *meshes.write_long(self.platform.build), "--tol", "1e-13", "--json"])
        seen = ""
        for wait in (1.5, 2.5, 4, 6, 12, 30, 60):
            running = subprocess.Popen(words, env=self.platform.environment, cwd=self.platform.build,
                                       stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
            time.sleep(wait)
            running.send_signal(signal.SIGINT)
            try:
                out, err = running.communicate(timeout=60)
            except subprocess.TimeoutExpired:  # a signal before its handler is lost
                running.kill()
                out, err = running.communicate()
            if running.returncode == 3 and CANCELLED in out:
                answer = json.loads(out)
                interval = answer["interval"]
                expect(interval["upper"] is None or interval["lower"] <= interval["upper"], "no interval")
                return f"after {wait} s: {answer['stop_reason']}"
            seen += f"\nafter {wait} s: exit code {running.returncode} {out[:200]!r} {err[:200]!r}"
        raise AssertionError("Ctrl-C does not end a run with its interval:" + seen)

    def console(self) -> str:
        """A terminal gets the line that redraws itself, names as they are, and no other escapes."""
        folder = self.platform.build / "pairs"
        a, _ = meshes.write(folder)[0]
        master, slave = pty.openpty()
        words = self.platform.words("vkhausdorff", ["distance", a, meshes.write(folder)[1][1], "--tol", "1e-9"])
        running = subprocess.Popen(words, env=self.platform.environment | {"TERM": "xterm"}, cwd=folder, stdin=slave, stdout=slave,
                                   stderr=slave, start_new_session=True)
        os.close(slave)
        shown, deadline = b"", time.time() + 120
        while time.time() < deadline:
            ready, _, _ = select.select([master], [], [], 0.5)
            try:
                part = os.read(master, 65536) if ready else b""
            except OSError:  # the terminal's last user has left
                break
            shown += part
            if not ready and running.poll() is not None:
                break
        os.close(master)
        code = running.wait(timeout=30)
        shown = re.sub(rb"(\x1b\[K)?\x1b\[1C", b" ", shown)  # Wine's console draws spaces as steps of the cursor
        text = re.sub(r"\x1b\[[0-9;?]*[A-Za-z]|\x1b\][^\x07]*\x07", "", shown.decode(errors="replace"))
        expect(code in (0, 3) and "interval" in text, f"exit code {code}: {shown[-600:]!r}")
        expect("wave" in text and "candidates" in text, f"no line of progress: {text[:600]!r}")
        # A character beyond 16 bits has no cell in Wine's console.
        expect(a.split("📐")[0] in text, f"names are not as they are: {text[-900:]!r}")
        return "a terminal: the line of progress, the table"


NATIVELY = {"without_vulkan": Run.without_vulkan}
GROUPS = {"doctor": Run.doctor, "demo": Run.demo, "manifest": Run.manifest, "generated": Run.generated, "table": Run.table,
          "api": Run.api, "host": Run.host, "interrupt": Run.interrupt, "kernels": Run.kernels, "sweep": Run.sweeping}
GROUPS_OF = {"windows": GROUPS | {"console": Run.console},
             "libcxx": {name: GROUPS[name] for name in ("doctor", "demo", "manifest", "generated", "table", "sweep")}
             | {"suite": Run.suite},
             # Emulated, the kernels' tests and the generated pairs would take minutes: --only has them run.
             "arm64": {name: GROUPS[name] for name in ("doctor", "demo", "manifest", "sweep")} | NATIVELY,
             "nehalem": NATIVELY}
OF_DRIVERS = {"doctor": Run.doctor, "demo": Run.demo, "manifest": Run.manifest, "generated": Run.generated, "api": Run.api,
              "kernels": Run.kernels, "presets": Run.presets, "sweep": Run.sweeping}
DRIVERS = {"swiftshader": SwiftShader,
           **{f"lavapipe{bits}": functools.partial(Lavapipe, bits) for bits in (128, 256, 512)}}
PLATFORMS = {"windows": Windows, "arm64": Arm64, "libcxx": Libcxx, "nehalem": Nehalem, **DRIVERS}
NEEDS = {"kernels": ["engine_tests"], "host": ["unit_tests", "files_tests"], "api": ["api_c11"], "sweep": ["vkh_sweep"], "suite": ["all"]}  # and the program


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("platform", choices=PLATFORMS)
    parser.add_argument("--native", type=pathlib.Path, required=True)
    parser.add_argument("--only", default="")
    parser.add_argument("--sweep", type=int, default=0)
    arguments = parser.parse_args()
    groups = GROUPS_OF.get(arguments.platform, OF_DRIVERS)
    if arguments.only:
        every = GROUPS | OF_DRIVERS | GROUPS_OF["windows"] | NATIVELY
        groups = {name: every[name] for name in arguments.only.split(",")}
    try:
        platform = PLATFORMS[arguments.platform](SOURCE, arguments.native.resolve())
        run = Run(platform, arguments.native.resolve(), arguments.sweep or (8 if platform.is_emulated else 60))
        start = time.time()
        platform.compile(["vkhausdorff", *(target for name in groups for target in NEEDS.get(name, []))])
        print(f"{platform.name}: built in {time.time() - start:.0f} s", flush=True)
        with platform.ready():
            print(f"{platform.name}: {', '.join(platform.versions)}", flush=True)
            for name, group in groups.items():
                start = time.time()
                print(f"{platform.name}: {name}: {group(run)} ({time.time() - start:.1f} s)", flush=True)
    except Skip as missing:
        print(f"platform_test: skipped {arguments.platform}: {missing}")
        return 77
    except (AssertionError, subprocess.TimeoutExpired) as failure:
        print(f"platform_test: {arguments.platform}: {failure}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
