"""Spoils certificates of small meshes: all checkers have to answer the same, and to accept nothing that is wrong.

usage: attack_test.py [--pairs N] [--seed S] [--seconds T] [--full] [unittest's own]
VKH_CHECK and VKH_CHECK_PROVEN are programs; without them vkh_check.py alone is asked. Files of faults are kept in VKH_ATTACK_KEEP.
"""

import argparse
import copy
import os
import random
import sys
import tempfile
import time
import unittest

import make_certificate
import pairs
import spoil
import truth
from checkers import PROGRAM, Checkers, vkh_check

KEEP = os.environ.get("VKH_ATTACK_KEEP", os.path.join(tempfile.gettempdir(), "vkh_attack"))
OPTIONS = argparse.Namespace(pairs=70, seed=1, seconds=0.0, mutants=60)


class Attack:
    """One pair, its certificate and the truth about it."""

    def __init__(self, rng, checkers):
        self.rng, self.checkers = rng, checkers
        self.a, self.b, *convex, self.what = pairs.pair(rng)
        files = [pairs.obj(mesh, rng.random() < 0.5) for mesh in (self.a, self.b)]
        checkers.meshes(*files)
        size = max(abs(x) for mesh in (self.a, self.b) for face in mesh for p in face for x in p)
        deltas = [rng.choice((0.0, 0.0, size * 1e-9, size * 0.1)) for _ in range(2)] if rng.random() < 0.3 else (0.0, 0.0)
        self.model = make_certificate.make(self.a, self.b, rng, rng.random() < 0.5, rng.choice((0.0, 0.01, 0.2)),
                                           rng.choice((3, 20, 60)), deltas, [f if rng.random() < 0.5 else None for f in files],
                                           rng.choice((1, 2, 2)))
        if self.model is None:
            return
        self.model.counts = list(self.model.faces)
        for direction in self.model.directions:
            direction.before = direction.lower
        self.truth = [truth.Pair(self.a, self.b, convex[1]), truth.Pair(self.b, self.a, convex[0])][:len(self.model.directions)]
        if len(self.truth) == 1:
            self.truth.append(None)

    def of(self, name):
        x = name != "A,B"
        if self.truth[x] is None:
            self.truth[x] = truth.Pair(self.b, self.a, False)
        return self.truth[x]

    def ask(self, data, expected, what):
        """Every accepted claim has to be true."""
        answer = self.checkers.ask(data, expected, f"{what} of {self.what}")
        if answer is None or answer[0] != 0:
            return None
        for lower, name, upper in answer[1]:
            if self.of(name).refutes(make_certificate.Fraction(lower), make_certificate.Fraction(upper)):
                self.checkers.fault(f"{what} of {self.what}: accepted, but wrong: {lower} <= h({name}) <= {upper}")
        return answer[2]

    def squeeze(self, model, certificate, what):
        """The best that a certificate of one direction proves is accepted, and nothing beyond it."""
        delta, scale = sum(map(make_certificate.Fraction, model.deltas)), certificate.scale ** 2
        best = truth.upper_double(certificate.farthest / scale, delta)
        lower = truth.lower_double(certificate.nearest / scale, delta)
        if best is None or best < lower or len(model.directions) != 1 or not model.directions[0].lower or not lower:
            return
        d = model.directions[0]
        d.lower, d.upper = lower, best
        self.ask(make_certificate.encode(model), spoil.PROVEN, f"{what}, then tightened")
        d.upper = spoil.nudge(best, 0.0)
        self.ask(make_certificate.encode(model), spoil.NOT_PROVEN, f"{what}, then with too little an upper bound")
        d.lower, d.upper = spoil.nudge(lower, 2 * best), spoil.nudge(best, 2 * best)
        self.ask(make_certificate.encode(model), spoil.NOT_PROVEN, f"{what}, then with too much of a lower bound")

    def run(self, mutants):
        if self.model is None:
            return
        self.ask(make_certificate.encode(self.model), spoil.PROVEN, "nothing")
        for _ in range(mutants):
            how = self.rng.choice(spoil.MODELS if self.rng.random() < 0.7 else spoil.BYTES)
            model = copy.deepcopy(self.model)
            if how in spoil.BYTES:
                self.ask(*how(self.rng, model), how.__name__)
                continue
            expected = how(self.rng, model)
            if expected is None:
                continue
            try:
                data = make_certificate.encode(model)
            except make_certificate.struct.error:
                continue  # not a number of the format
            certificate = self.ask(data, expected, how.__name__)
            if certificate is not None and expected == spoil.ANY:
                self.squeeze(model, certificate, how.__name__)


class Cases(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.checkers = Checkers(self.folder.name, KEEP)

    def tearDown(self):
        self.folder.cleanup()

    def settle(self):
        self.assertEqual(self.checkers.faults[:5], [], f"{len(self.checkers.faults)} faults")

    def test_spoiled_ones(self):
        end, done = time.monotonic() + OPTIONS.seconds, 0
        while done < OPTIONS.pairs or time.monotonic() < end:
            Attack(random.Random(f"{OPTIONS.seed} {done}"), self.checkers).run(OPTIONS.mutants)
            done += 1
        print(f"{done} pairs, {self.checkers.count} certificates, of which proven {self.checkers.codes.get(0, 0)}, refused "
              f"{self.checkers.codes.get(1, 0)}, broken {self.checkers.codes.get(4, 0)}; "
              f"{PROGRAM or 'vkh_check.py alone'}; {self.checkers.proven_count} to vkh_check_proven", flush=True)
        self.settle()

    def test_every_truncation(self):
        attack = Attack(random.Random(5), self.checkers)
        data = make_certificate.encode(attack.model)
        attack.ask(data, spoil.PROVEN, "all of it")
        for length in range(len(data)):
            attack.ask(data[:length], spoil.BROKEN, f"{length} bytes")
        self.settle()

    def test_formats(self):
        rng = random.Random(3)
        for _ in range(5):
            a, b = (pairs.apart(pairs.soup(rng), (0, 0, 0), 1.0) for _ in range(2))
            a, b = ([tuple(tuple(round(x * 1024) / 1024 for x in p) for p in face) for face in mesh] for mesh in (a, b))  # floats, too
            data = make_certificate.encode(make_certificate.make(a, b, rng, True))
            for ending, write in (("obj", pairs.obj), ("obj", lambda m: pairs.obj(m, True)), ("off", pairs.off), ("stl", pairs.stl),
                                  ("stl", pairs.text_stl)):
                self.checkers.meshes(write(a), write(b), ending)
                self.checkers.ask(data, spoil.PROVEN, f"as {ending}")
                if a != b:
                    self.checkers.meshes(write(b), write(a), ending)
                    self.checkers.ask(data, spoil.NOT_PROVEN, f"exchanged, as {ending}")
        self.settle()

    def test_polygons(self):
        text = b"v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 9 9 9\nf 1 2 3 4\n"
        text_off = b"OFF 5 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n9 9 9\n4 0 1 2 3\n"
        a, b, c, d = (0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (1.0, 1.0, 0.0), (0.0, 1.0, 0.0)
        for square, code in ([(a, b, c), (a, c, d)], {0}), ([(b, c, d), (b, d, a)], {1}), ([(a, c, d), (a, b, c)], {1}):
            other = pairs.apart(square, (0.0, 0.0, 0.5), 1.0)
            data = make_certificate.encode(make_certificate.make(square, other, random.Random(1)))
            for ending, first, write in (("obj", text, pairs.obj), ("off", text_off, pairs.off)):
                self.checkers.meshes(first, write(other), ending)
                self.checkers.ask(data, code, f"a polygon, as {ending}")
        self.settle()

    def test_polygons_that_are_not_convex(self):
        corners = "v 0 0 0\nv 4 0 0\nv 1 1 0\nv 0 4 0\n"
        convex = vkh_check.triangles_of(*vkh_check.read_obj((corners + "f 1 2 4\n").encode()), None)
        self.assertEqual(len(convex), 1)
        for face in ("1 2 3 4", "1 2 4 3", "2 1 4 3", "1 4 2 3"):
            points_and_polygons = vkh_check.read_obj((corners + f"f {face}\n").encode())
            with self.assertRaisesRegex(ValueError, "not convex"):  # version 1
                vkh_check.triangles_of(*points_and_polygons, None)
            with self.assertRaisesRegex(vkh_check.Other, "not convex"):
                vkh_check.triangles_of(*points_and_polygons, {})

    def test_a_part_too_far_from_all(self):
        """h(A,B) is the height of a peak in a part that the tree may not leave out."""
        rng = random.Random(9)
        a = [((0.0, 0.0, 1.0), (1.0, 0.0, 1.0), (0.0, 1.0, 9.0))]
        b = [((0.0, 0.0, 0.0), (4.0, 0.0, 0.0), (0.0, 4.0, 0.0))]
        self.checkers.meshes(pairs.obj(a), pairs.obj(b))
        model = make_certificate.make(a, b, rng)
        direction = model.directions[0]
        direction.lower, direction.upper, direction.witness = 1.0, 5.0, [0, 0, 0, 0]
        for op in range(3):
            for tree in ([op, [3, 0], [3, 0]], [4 + op, 0, 0, 65535, 65535], [4 + op, 0, 0, 0, 0], [4 + op, 0, 0, 0, 65535]):
                direction.blocks = [[tree]]
                self.checkers.ask(make_certificate.encode(model), {1}, f"{tree}")
        self.settle()


if __name__ == "__main__":
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument("--pairs", type=int, default=OPTIONS.pairs)
    parser.add_argument("--mutants", type=int, default=OPTIONS.mutants)
    parser.add_argument("--seed", type=int, default=OPTIONS.seed)
    parser.add_argument("--seconds", type=float, default=0.0)
    parser.add_argument("--full", action="store_true")
    OPTIONS, rest = parser.parse_known_args()
    if OPTIONS.full:
        OPTIONS.pairs *= 12
    unittest.main(argv=[sys.argv[0], *rest])
