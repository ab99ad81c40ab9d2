"""The checkers at once: VKH_CHECK and VKH_CHECK_PROVEN, if they are set, and check/vkh_check.py, in this process."""

import decimal
import os
import pathlib
import re
import struct
import subprocess
import sys
from fractions import Fraction

ROOT = pathlib.Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "check"))
import vkh_check  # noqa: E402

PROGRAM = os.environ.get("VKH_CHECK", "")
PROVEN = os.environ.get("VKH_CHECK_PROVEN", "")
SECONDS = 30
CLAIM = re.compile(r"^proven: (\S+) <= h\((A,B|B,A)\) <= (\S+)$", re.MULTILINE)
EXACT = re.compile(r"exactly, squared, in units of 4\^(-?\d+): (\d+)/(\d+) <= (\d+)/(\d+) \(witness\); (\d+)/(\d+) \(leaves\) <= (\d+)/(\d+)")


def numbers(text):
    """A checker's output about its proof."""
    return [(decimal.Decimal(lower), way, decimal.Decimal(upper)) for lower, way, upper in CLAIM.findall(text)]


class Checkers:
    """Disagreements and wrong answers are in `faults`; the files of each are kept in a folder of their own."""

    def __init__(self, folder, keep):
        self.folder, self.keep, self.faults, self.count, self.codes = pathlib.Path(folder), pathlib.Path(keep), [], 0, {}
        self.certificate, self.proven_count = self.folder / "c.vhc", 0

    def meshes(self, a, b, ending="obj"):
        self.paths = [self.folder / f"{name}.{ending}" for name in "ab"]
        for path, data in zip(self.paths, (a, b)):
            path.write_bytes(data)
        self.meshes_read, self.latest, self.written = {}, {}, {}

    def read(self, path, given):
        """vkh_check.read_mesh with a cache."""
        key = path, type(given), repr(given)  # no polygons of a mesh are {} as those of points are
        if key not in self.meshes_read:
            try:
                self.meshes_read[key] = vkh_check.read_mesh(path, given)
            except ValueError as error:
                self.meshes_read[key] = error
        if isinstance(self.meshes_read[key], ValueError):
            raise self.meshes_read[key]
        self.latest[path] = self.meshes_read[key][0]
        return self.meshes_read[key]

    def corners(self):
        """The files of both meshes' corners, as they were read last."""
        out = []
        for path in map(str, self.paths):
            out.append(path + ".corners")
            if path in self.latest and self.latest[path] is not self.written.get(path):
                self.written[path] = self.latest[path]
                flat = [x + 0.0 for face in self.latest[path] for p in face for x in p]  # -0 becomes 0
                pathlib.Path(out[-1]).write_bytes(struct.pack(f"<{len(flat)}d", *flat))
        return out

    def proven_checker(self, code, text):
        """A fault of vkh_check_proven, or None. It begins with corners: what is wrong with files and polygons is not its question."""
        if code and (text == "it is of another mesh" or "cannot be read" in text or text.startswith(str(self.folder))):
            return None
        self.proven_count += 1
        done = subprocess.run([PROVEN, self.certificate, *self.corners()], capture_output=True, timeout=SECONDS)
        return None if done.returncode == code else f"vkh_check_proven answers {done.returncode}: {done.stderr.decode()[-500:]}"

    def fault(self, what):
        folder = self.keep / f"{len(self.faults):04}"
        folder.mkdir(parents=True, exist_ok=True)
        for path in (self.certificate, *self.paths):
            (folder / path.name).write_bytes(path.read_bytes())
        (folder / "what.txt").write_text(what + "\n")
        self.faults.append(f"{folder}: {what}")

    def python(self, data):
        """The exit code, the text and the certificate."""
        try:
            certificate = vkh_check.Certificate(data, [str(path) for path in self.paths], self.read)
        except ValueError as error:
            return 4, str(error), None
        return (1, certificate.refusal, None) if certificate.refusal else (0, "\n".join(certificate.said), certificate)

    def program(self):
        try:
            done = subprocess.run([PROGRAM, self.certificate, *self.paths, "--threads", "1"], capture_output=True, timeout=SECONDS)
        except subprocess.TimeoutExpired:
            return "hangs", "", ""
        return done.returncode, done.stdout.decode(errors="replace"), done.stderr.decode(errors="replace")

    def ask(self, data, expected, what):
        """The verdict of both on these bytes; None if they disagree. Accepted claims come as (lower, name, upper)."""
        self.count += 1
        self.certificate.write_bytes(data)
        try:
            code, text, certificate = self.python(data)
        except Exception as error:  # any exception is a fault of the checker
            return self.fault(f"{what}: vkh_check.py raises {error!r}")
        self.codes[code] = self.codes.get(code, 0) + 1
        if code not in expected:
            return self.fault(f"{what}: {sorted(expected)} expected, vkh_check.py answers {code}: {text}")
        if PROGRAM:
            answer, out, error = self.program()
            if answer not in (0, 1, 4) or "runtime error" in error or "Sanitizer" in error:
                return self.fault(f"{what}: vkh_check: {answer}: {error[-3000:]}")
            if answer != code:
                return self.fault(f"{what}: vkh_check.py answers {code}: {text}; vkh_check {answer}: {out}{error}")
            if code == 0 and numbers(out) != numbers(text):
                return self.fault(f"{what}: vkh_check.py proves {text}; vkh_check {out}")
            if code == 0:
                exact = EXACT.findall(out)
                if exact and not self.is_same(exact[-1], certificate):
                    return self.fault(f"{what}: other squares: {exact[-1]}, {text}")
        fault = self.proven_checker(code, text) if PROVEN else None
        if fault:
            return self.fault(f"{what}: vkh_check.py answers {code}: {text}; {fault}")
        return code, [] if certificate is None else CLAIM.findall(text), certificate

    @staticmethod
    def is_same(exact, certificate):
        """The exact squares of both checkers, for the last direction."""
        unit, witness_claim, one, witness, two, leaves, three, *_ = map(int, exact)
        unit = Fraction(4) ** unit / 1
        scale = certificate.scale ** 2
        return (Fraction(leaves, three) * unit * scale == certificate.farthest
                and (certificate.nearest == 0 or Fraction(witness, two) * unit * scale == certificate.nearest))
