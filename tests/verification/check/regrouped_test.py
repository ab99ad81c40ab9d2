"""A driver that regroups sums, although they are decorated: what of its false intervals is noticed?

usage: regrouped_test.py BUILD [COUNT]

The test layer gives the driver shaders with four sums regrouped, the residuals of certified.h: (x.hi + x.lo) - (y.hi + y.lo) for
((x.hi - y.hi) - y.lo) + x.lo. That is what associativity would allow. The interval of a pair is false where it misses that of
the driver as it is. The writer of certificates must raise a false upper bound, and say so; vkh_check must refuse a false lower
one. `doctor` must refuse the driver.
"""

import json
import os
import pathlib
import random
import subprocess
import sys
import tempfile

BUILD = pathlib.Path(sys.argv[1]).resolve()
COUNT = int(sys.argv[2]) if len(sys.argv) > 2 else 25
LAYERS = {"VK_LAYER_PATH": f"{BUILD}/layer:/usr/share/vulkan/explicit_layer.d", "VK_INSTANCE_LAYERS": "VK_LAYER_VKH_test"}
REGROUPED = LAYERS | {"VKH_LAYER_REGROUP": "1"}
LEAST_FALSE = 0.5  # of the pairs: otherwise the test shows nothing


def sheet(path, rng, n, height):
    """A bumpy square of 2 n n faces."""
    lines = [f"v {x / n!r} {y / n!r} {height + 0.2 * rng.random()!r}" for y in range(n + 1) for x in range(n + 1)]
    for y in range(n):
        for x in range(n):
            a = y * (n + 1) + x + 1
            lines += [f"f {a} {a + 1} {a + n + 2}", f"f {a} {a + n + 2} {a + n + 1}"]
    path.write_text("\n".join(lines) + "\n")


def run(*words, **environment):
    return subprocess.run([str(word) for word in words], env=os.environ | environment, capture_output=True, text=True, timeout=300)


def distance(a, b, tolerance, *words, **environment):
    """The interval, the certificate's claim, and the notes."""
    done = run(BUILD / "vkhausdorff", "distance", a, b, "--json", "--tol", tolerance, *words, **environment)
    if done.returncode not in (0, 3):
        sys.exit(f"regrouped_test: {done.args}: exit code {done.returncode}\n{done.stderr}")
    answer = json.loads(done.stdout)
    way = answer["directions"][0]
    bounds = [float.fromhex(way["interval"][name]) for name in ("lower_hex", "upper_hex")]
    proven = float.fromhex(way["certificate"]["upper_hex"]) if "certificate" in way else None
    return *bounds, proven, " ".join(note["text"] for note in answer["notes"])


class Tally:
    def __init__(self):
        self.false_lower = self.false_upper = self.false = self.refused = self.raised = 0
        self.faults = []

    def add(self, name, truth, found, code):
        lower, upper, proven, notes = found
        false_lower, false_upper = lower > truth[1], upper < truth[0]
        self.false_lower += false_lower
        self.false_upper += false_upper
        self.false += false_lower or false_upper
        self.refused += code != 0
        self.raised += proven > upper
        if code not in (0, 1, 4):
            self.faults.append(f"{name}: vkh_check: exit code {code}")
        if false_upper and (proven < truth[0] or "the certificate proves less" not in notes):
            self.faults.append(f"{name}: {proven} is said to be proven, h is at least {truth[0]}; notes: {notes}")
        if code == 0 and (lower > truth[1] or proven < truth[0]):
            self.faults.append(f"{name}: [{lower}, {proven}] is accepted, but h is in {truth[:2]}")


def main():
    tally = Tally()
    doctor = run(BUILD / "vkhausdorff", "doctor", **REGROUPED)
    if doctor.returncode != 5 or "regroups sums" not in doctor.stdout:
        tally.faults.append(f"doctor: exit code {doctor.returncode}: {doctor.stdout}")
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch)
        a, b, certificate = (folder / name for name in ("a.obj", "b.obj", "ab.vhc"))
        for seed in range(COUNT):
            rng = random.Random(seed)
            sheet(a, rng, rng.randint(1, 4), 0)
            sheet(b, rng, rng.randint(1, 4), rng.uniform(0.3, 3))
            truth = distance(a, b, "1e-9", **LAYERS)
            certificate.unlink(missing_ok=True)
            found = distance(a, b, "1e-8", "--certificate", certificate, **REGROUPED)
            tally.add(f"pair {seed}", truth, found, run(BUILD / "vkh_check", certificate, a, b).returncode)
    print(*tally.faults, sep="\n", end="\n" if tally.faults else "")
    print(f"regrouped_test: {COUNT} pairs, {tally.false} intervals false ({tally.false_lower} lower, {tally.false_upper} upper); "
          f"{tally.raised} raised by the writer, {tally.refused} refused; {len(tally.faults)} faults")
    return 1 if tally.faults or tally.false < LEAST_FALSE * COUNT else 0


if __name__ == "__main__":
    sys.exit(main())
