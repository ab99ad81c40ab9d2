"""vkh_check on certificates that are written here by hand, with squared distances that are known or computed in fractions.

usage: vkh_check_test.py VKH_CHECK [NM]
VKH_CHECK_PROVEN, if it is set, has to answer the same.
"""

import base64
import hashlib
import math
import os
import pathlib
import random
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest
from fractions import Fraction

PROGRAM = sys.argv[1]
PROVEN_CHECKER = os.environ.get("VKH_CHECK_PROVEN", "")
PROVEN, REFUSED, USAGE, BROKEN = 0, 1, 2, 4
FLAT = [((0, 0, 0), (1, 0, 0), (0, 1, 0))]
HIGH = [((0, 0, .25), (1, 0, .25), (0, 1, .25))]
TETRAHEDRON = [((0, 0, 0), (1, 0, 0), (0, 1, 0)), ((0, 0, 0), (1, 0, 0), (0, 0, 1)), ((0, 0, 0), (0, 1, 0), (0, 0, 1)),
               ((1, 0, 0), (0, 1, 0), (0, 0, 1))]


def above(x):
    return math.nextafter(x, math.inf)


def below(x):
    return math.nextafter(x, -math.inf)


def off(mesh):
    rows = [" ".join(repr(float(x)) for x in corner) for face in mesh for corner in face]
    rows += [f"3 {3 * i} {3 * i + 1} {3 * i + 2}" for i in range(len(mesh))]
    return "\n".join([f"OFF\n{3 * len(mesh)} {len(mesh)} 0", *rows, ""])


def corners_hash(mesh):
    return hashlib.sha256(b"".join(struct.pack("<d", x + 0.0) for face in mesh for corner in face for x in corner)).digest()


def number(difference):
    code = 2 * difference if difference >= 0 else -2 * difference - 1
    out = b""
    while code >= 128:
        out += bytes([128 | code & 127])
        code >>= 7
    return out + bytes([code])


def leaf(difference=0):
    return b"\x03" + number(difference)


def cut(corner, s, r, p, q):
    """Takes p and q in 256ths."""
    return bytes([4 + corner]) + number(s) + number(r) + struct.pack("<HH", 256 * p, 256 * q)


READ_AS_IT_IS = struct.pack("<IIdQddQQ", 0, 0, 0, 0, 1, 1, 0, 0)


def halved(corner, first, second):
    return bytes([corner]) + first + second


def block(*faces):
    body = b"".join(faces)
    return struct.pack("<II", len(faces), len(body)) + body


def direction(lower, upper, blocks, witness=(0, 0, 0, 0)):
    return struct.pack("<ddIIQQ", lower, upper, *witness) + b"".join(blocks)


def root_down(square):
    """The largest double whose square is not above."""
    x = math.sqrt(square)
    while Fraction(x) ** 2 > square:
        x = below(x)
    while Fraction(above(x)) ** 2 <= square:
        x = above(x)
    return x


def root_up(square):
    x = root_down(square)
    return x if Fraction(x) ** 2 == square else above(x)


class Check(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)

    def file(self, name, mesh):
        path = self.folder / name
        path.write_text(mesh if isinstance(mesh, str) else off(mesh))
        return path

    def certificate(self, a, b, directions, delta=(0, 0), files=None):
        """The bytes, for written meshes, too."""
        names = [self.file("a.off", a), self.file("b.off", b)]
        files = files or [hashlib.sha256(name.read_bytes()).digest() for name in names]
        return (struct.pack("<8sIIQQdd", b"VHCERT02", len(directions), 0, len(a), len(b), *delta) + b"".join(files) +
                corners_hash(a) + corners_hash(b) + 2 * READ_AS_IT_IS + b"".join(directions))

    def run_it(self, data, *more, names=("a.off", "b.off")):
        path = self.folder / "c.vhc"
        path.write_bytes(data)
        return subprocess.run([PROGRAM, path, *(self.folder / name for name in names), *more], capture_output=True, text=True,
                              timeout=60, check=False)

    def expect(self, code, data, said="", *more, **names):
        done = self.run_it(data, *more, **names)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        self.assertIn(said, done.stdout + done.stderr)
        lines = done.stderr.splitlines()
        self.assertEqual(len(lines), 0 if code == PROVEN else 1)
        self.assertEqual(done.stdout == "", code != PROVEN)
        if PROVEN_CHECKER:
            self.ask_the_proven_one(code, data, **names)
        return done.stdout

    def ask_the_proven_one(self, code, data, **names):
        """vkh_check_proven answers the same, for corners that can be had."""
        corners = [self.folder / "a.corners", self.folder / "b.corners"]
        if self.run_it(data, "--corners", *corners, **names).returncode == 0:
            done = subprocess.run([PROVEN_CHECKER, self.folder / "c.vhc", *corners], capture_output=True, text=True, timeout=60)
            self.assertEqual(done.returncode, code, done.stdout + done.stderr)

    def test_one_triangle_over_another(self):
        def of(lower, upper):
            return self.certificate(HIGH, FLAT, [direction(lower, upper, [block(leaf())], (0, 1, 1, 0) if lower else (0, 0, 0, 0))])
        out = self.expect(PROVEN, of(.25, .25), "proven: 0.25 <= h(A,B) <= 0.25\n")
        self.assertIn("at best, of the corners as given: 2.5e-1 <= h(A,B) <= 2.5e-1\n", out)
        self.expect(PROVEN, of(.125, .5), "proven: 0.125 <= h(A,B) <= 0.5\n", "--threads", "1")
        self.expect(PROVEN, of(0, .5), "2.5e-1")
        self.expect(REFUSED, of(.125, below(.25)), "refused: h(A,B): face 0, leaf 0: farther than upper from triangle 0")
        self.expect(REFUSED, of(above(.25), 1), "refused: h(A,B): the witness is nearer than lower to triangle 0")
        self.assertEqual(self.expect(PROVEN, of(.25, .25), "", "--quiet"), "proven: 0.25 <= h(A,B) <= 0.25\n")

    def test_an_ulp_is_too_much(self):
        random.seed(5)
        for _ in range(20):
            a = [tuple(tuple(random.uniform(-1, 1) for _ in range(2)) + (random.uniform(2, 3),) for _ in range(3))]
            square = max(Fraction(c[2]) ** 2 for c in a[0])
            b = [((-9, -9, 0), (30, -9, 0), (-9, 30, 0))]
            near = min(Fraction(c[2]) ** 2 for c in a[0])
            least = [Fraction(c[2]) ** 2 for c in a[0]].index(near)
            witness = (0, 3, 8 if least == 1 else 0, 8 if least == 2 else 0)
            for lower, upper, code in [(root_down(near), root_up(square), PROVEN), (above(root_down(near)), 9, REFUSED),
                                       (root_down(near), below(root_up(square)), REFUSED)]:
                self.expect(code, self.certificate(a, b, [direction(lower, upper, [block(leaf())], witness)]))

    def test_where_the_nearest_point_is(self):
        """Distances from a corner, an edge and the inside; from triangles that are segments and
        points."""
        for triangle, point, square in [
                (FLAT[0], (-3, -4, 0), 25), (FLAT[0], (.5, -2, 0), 4), (FLAT[0], (1, 1, 0), Fraction(1, 2)),
                (FLAT[0], (.25, .25, 7), 49), (FLAT[0], (5, -1, 2), 21),
                (((0, 0, 0), (1, 0, 0), (4, 0, 0)), (3, 2, 0), 4), (((4, 0, 0), (0, 0, 0), (1, 0, 0)), (5, 2, 0), 5),
                (((1, 1, 1), (1, 1, 1), (1, 1, 1)), (3, 2, 3), 9), (((1, 1, 1), (1, 1, 1), (2, 1, 1)), (3, 2, 3), 6),
                (((0, 0, 0), (2.0**-1074, 0, 0), (0, 2.0**-1074, 0)), (3, 4, 0), None),
                (((0, 0, 0), (2.0**900, 0, 0), (0, 2.0**900, 0)), (3, 4, 5), 25)]:
            with self.subTest(triangle=triangle, point=point):
                a = [(point, point, point)]
                square = square if square is not None else (25 - Fraction(8, 2**1074) + Fraction(1, 4**1074))
                up, down = root_up(square), root_down(square)
                for lower, upper, code in [(down, up, PROVEN), (above(down), above(up), REFUSED), (down, below(up), REFUSED)]:
                    if upper < lower:
                        continue
                    self.expect(code, self.certificate(a, [triangle], [direction(lower, upper, [block(leaf())], (0, 2, 1, 2))]))

    def test_extreme_coordinates(self):
        tiny, huge = 2.0**-1074, 2.0**1000
        for z in (tiny, 2.0**-1022, 1e-300, 1.5, huge):
            a = [((0, 0, z), (1, 0, z), (0, 1, z))]
            data = [self.certificate(a, FLAT, [direction(lower, upper, [block(leaf())], (0, 62, 1, 2**62 - 1))])
                    for lower, upper in [(z, z), (z, below(z)), (above(z), above(z))]]
            self.expect(PROVEN, data[0])
            self.expect(BROKEN, data[1], "lower is more than upper")
            self.expect(REFUSED, data[2])

    def test_halved(self):
        """A roof over two triangles: only its halves are near one of them each."""
        a = [((-4, 0, 1), (4, 0, 1), (0, 4, 1))]
        b = [((-4, 0, 0), (0, 0, 0), (0, 4, 0)), ((0, 0, 0), (4, 0, 0), (0, 4, 0))]

        def of(*faces):
            return self.certificate(a, b, [direction(1, 1, [block(*faces)], (0, 1, 1, 0))])
        # Opposite corner 2: j = 0, k = 1; the first half keeps corner 0 and has m for corner 1.
        out = self.expect(PROVEN, of(halved(2, leaf(0), leaf(1))), "2 leaves")
        self.expect(REFUSED, of(halved(2, leaf(1), leaf(-1))), "face 0, leaf 0: farther")
        self.expect(REFUSED, of(halved(2, leaf(0), leaf(0))), "face 0, leaf 1: farther than upper from triangle 0")
        self.expect(REFUSED, of(leaf(0)), "farther")
        deep = leaf(0)
        for _ in range(99):
            deep = halved(0, deep, leaf(0))
        self.expect(PROVEN, of(halved(2, deep, leaf(1))))
        self.expect(BROKEN, of(halved(2, halved(1, deep, leaf(0)), leaf(1))), "halved more than 100 times")

    def test_each_corner_to_halve_at(self):
        """Halves of halves, found again in fractions."""
        random.seed(9)
        for _ in range(20):
            a = [tuple(tuple(random.randint(-50, 50) / 8 for _ in range(3)) for _ in range(3))]
            b = [((-90, -90, 0), (300, -90, 0), (-90, 300, 0)), ((-90, -90, 5), (300, -90, 5), (-90, 300, 5))]
            largest, last = 0, 0

            def tree(part, depth):
                nonlocal largest, last
                if depth == 0:
                    s = random.randint(0, 1)
                    largest = max([largest, *((c[2] - 5 * s) ** 2 for c in part)])
                    out, last = leaf(s - last), s
                    return out
                i = random.randint(0, 2)
                j, k = (i + 1) % 3, (i + 2) % 3
                middle = tuple((x + y) / 2 for x, y in zip(part[j], part[k]))
                first, second = list(part), list(part)
                first[k] = second[j] = middle
                return bytes([i]) + tree(first, depth - 1) + tree(second, random.randint(0, depth - 1))
            face = tree([tuple(map(Fraction, c)) for c in a[0]], 6)
            for upper, code in [(root_up(largest), PROVEN), (below(root_up(largest)), REFUSED)]:
                self.expect(code, self.certificate(a, b, [direction(0, upper, [block(face)])]))

    def test_cut(self):
        """S is under o and a little more of the face, R under the rest."""
        a = [((0, 0, 1), (8, 0, 1), (0, 8, 1))]
        small, big = ((0, 0, 0), (2, 0, 0), (0, 4, 0)), ((-40, 84, 0), (2, 0, 0), (60, -30, 0))
        for corner in range(3):
            turned = [tuple(a[0][(i - corner) % 3] for i in range(3))]  # corner o has the index `corner`

            def of(p, q, s=0, r=1, upper=1.0):
                return self.certificate(turned, [small, big], [direction(0, upper, [block(cut(corner, s, r - s, p, q))])])
            self.expect(PROVEN, of(64, 128), "1 of them cut")
            self.expect(REFUSED, of(65, 128), "triangle 0")
            self.expect(REFUSED, of(64, 129), "triangle 0")
            self.expect(REFUSED, of(63, 128), "triangle 1")
            self.expect(REFUSED, of(64, 127), "triangle 1")
            self.expect(REFUSED, of(128, 64))
            self.expect(REFUSED, of(64, 128, 1, 0))
            self.expect(REFUSED, of(64, 128, upper=below(1.0)))

    def test_both_directions_and_blocks(self):
        numbers = [leaf(0), leaf(1), leaf(1), leaf(1)]
        same = direction(0, 0, [block(*numbers)])
        single = direction(0, 0, [block(leaf(i)) for i in range(4)])
        out = self.expect(PROVEN, self.certificate(TETRAHEDRON, TETRAHEDRON, [same, single]))
        self.assertTrue(out.startswith("proven: 0 <= h(A,B) <= 0\nproven: 0 <= h(B,A) <= 0\n"), out)
        wrong = direction(0, .5, [block(leaf(0)), block(leaf(1)), block(leaf(3)), block(leaf(2))])
        for _ in range(5):
            self.expect(REFUSED, self.certificate(TETRAHEDRON, TETRAHEDRON, [same, wrong]), "h(B,A): face 2, leaf 0")

    def test_many_faces(self):
        a = [((i, 0, 1), (i + 1, 0, 1), (i, 1, 1)) for i in range(3000)]
        b = [((i, 0, 0), (i + 1, 0, 0), (i, 1, 0)) for i in range(3000)]
        faces = [leaf(0), *[leaf(1)] * 2999]
        blocks = [block(*faces[:1000]), block(leaf(1000), *faces[1:2000])]
        self.expect(PROVEN, self.certificate(a, b, [direction(1, 1, blocks, (2999, 3, 1, 2))]), "3000 faces, 3000 leaves")
        self.expect(REFUSED, self.certificate(a, b, [direction(1, 1, [block(*faces[:2999], leaf(0))])]),
                    "face 2999, leaf 0: farther than upper from triangle 2998")

    @unittest.skipUnless(PROVEN_CHECKER, "of the proven checker alone: vkh_check reads no such mesh")
    def test_corners_that_are_not_finite(self):
        for x, code in ((2.0, PROVEN), (math.inf, BROKEN), (-math.inf, BROKEN), (math.nan, BROKEN)):
            mesh = [((0, 0, 0), (1, 0, 0), (0, 1, x))]
            path, corners = self.folder / "c.vhc", self.folder / "corners"
            path.write_bytes(self.certificate(mesh, mesh, [direction(0, 0, [block(leaf())])]))
            corners.write_bytes(struct.pack("<9d", *(y for corner in mesh[0] for y in corner)))
            done = subprocess.run([PROVEN_CHECKER, path, corners, corners], capture_output=True, text=True, timeout=60, check=False)
            self.assertEqual(done.returncode, code, done.stdout + done.stderr)
            self.assertIn("proven:" if code == PROVEN else "not finite", done.stdout + done.stderr)

    def test_delta(self):
        def of(lower, upper, delta):
            return self.certificate(HIGH, FLAT, [direction(lower, upper, [block(leaf())], (0, 0, 0, 0))], delta)
        self.expect(PROVEN, of(.0625, .4375, (.125, .0625)))
        self.expect(REFUSED, of(.0625, below(.4375), (.125, .0625)), "farther than upper")
        self.expect(REFUSED, of(above(.0625), .4375, (.125, .0625)), "nearer than lower")
        self.expect(REFUSED, of(0.1, .125, (.125, .0625)), "upper is less than both deltas")
        # The rounding of a scene's transforms has to be reported.
        third = struct.pack("<9f", 0, 0, .1, 1, 0, .1, 0, 1, .1)
        uri = "data:application/octet-stream;base64," + base64.b64encode(third).decode()
        (self.folder / "a.gltf").write_text(
            '{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0,"scale":[0.1,0.3,0.7]}],'
            '"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"accessors":[{"bufferView":0,"componentType":5126,'
            '"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,1]}],"bufferViews":[{"buffer":0,"byteLength":36}],'
            '"buffers":[{"byteLength":36,"uri":"' + uri + '"}]}')
        done = self.run_it(self.certificate(HIGH, FLAT, [direction(0, 9, [block(leaf())])], (1, 0), [bytes(32)] * 2),
                           names=("a.gltf", "b.off"))
        self.assertEqual(done.returncode, REFUSED, done.stderr)

    def test_other_meshes(self):
        claim = [direction(0, .25, [block(leaf())])]
        good = self.certificate(HIGH, FLAT, claim)
        self.expect(PROVEN, good)
        self.expect(REFUSED, good, "another file (SHA-256)", names=("b.off", "a.off"))
        self.file("a.off", off(HIGH) + "\n")
        self.expect(REFUSED, good, "a.off: is another file (SHA-256)")
        nameless = self.certificate(HIGH, FLAT, claim, files=[bytes(32)] * 2)
        self.file("a.off", off(HIGH) + "\n")
        self.expect(PROVEN, nameless)
        self.file("a.off", off(FLAT))
        self.expect(REFUSED, nameless, "a.off: has other corners (SHA-256)")
        self.file("a.off", off(HIGH + HIGH))
        self.expect(REFUSED, nameless, "a.off: has another number of faces")
        self.file("a.off", "OFF\n1 2")
        self.expect(BROKEN, nameless, "a.off: ")
        self.expect(BROKEN, nameless, "a.of", names=("a.of", "b.off"))
        minus = [((0.0, -0.0, .25), (1, 0, .25), (-0.0, 1, .25))]
        self.expect(PROVEN, self.certificate(minus, FLAT, claim))

    def test_broken(self):
        def of(body, lower=0.0, upper=9.0, witness=(0, 0, 0, 0)):
            return self.certificate(HIGH, FLAT, [direction(lower, upper, [body], witness)])
        good = of(block(leaf()), .125, 1, (0, 1, 1, 1))
        self.expect(PROVEN, good)
        for size in range(len(good)):
            self.assertEqual(self.run_it(good[:size]).returncode, BROKEN)
        self.expect(BROKEN, good + b"\0", "more bytes")
        for name, data in [
                ("VHCERT03", b"VHCERT03" + good[8:]), ("VHCERT00", b"VHCERT00" + good[8:]), ("directions 0", good[:8] + b"\0" + good[9:]),
                ("directions 3", good[:8] + b"\3" + good[9:]), ("not 0", good[:12] + b"\1" + good[13:]),
                ("no faces", good[:16] + bytes(8) + good[24:]), ("many faces", good[:16] + struct.pack("<Q", 2**28 + 1) + good[24:]),
                ("delta < 0", good[:32] + struct.pack("<d", -1) + good[40:]), ("delta -0", good[:32] + struct.pack("<d", -0.0) + good[40:]),
                ("delta nan", good[:32] + struct.pack("<d", math.nan) + good[40:]),
                ("upper inf", of(block(leaf()), 0, math.inf)), ("upper nan", of(block(leaf()), 0, math.nan)),
                ("lower < 0", of(block(leaf()), -1, 1)), ("lower > upper", of(block(leaf()), 2, 1)),
                ("e", of(block(leaf()), .1, 1, (0, 63, 0, 0))), ("j + k", of(block(leaf()), .1, 1, (0, 1, 2, 1))),
                ("j + k wraps", of(block(leaf()), .1, 1, (0, 1, 2**64 - 1, 2))), ("witness", of(block(leaf()), .1, 1, (1, 0, 0, 0))),
                ("lower 0 and a witness", of(block(leaf()), 0, 1, (0, 1, 1, 0))),
                ("block of none", of(struct.pack("<II", 0, 0) + block(leaf()))), ("two faces", of(block(leaf(), leaf()))),
                ("bytes more", of(struct.pack("<II", 1, 3) + leaf() + b"\0")), ("bytes less", of(struct.pack("<II", 1, 1) + leaf())),
                ("bytes many", of(struct.pack("<II", 1, 2**32 - 1) + leaf())), ("kind 7", of(block(b"\7\0"))),
                ("no such triangle", of(block(leaf(1)))), ("negative triangle", of(block(leaf(-1)))),
                ("six bytes", of(block(b"\3" + b"\x80" * 5 + b"\0"))), ("too long a number", of(block(b"\3\x80\0"))),
                ("half a halving", of(block(b"\0" + leaf()))), ("half a cut", of(block(b"\4\0\0\0\0\0")))]:
            with self.subTest(name):
                self.expect(BROKEN, data, "c.vhc: byte ")

    def test_any_bytes(self):
        random.seed(3)
        good = self.certificate(TETRAHEDRON, TETRAHEDRON, [direction(0, .5, [block(leaf(0), leaf(1), halved(1, leaf(1), cut(0, 0, 0, 3, 4)), leaf(1))])])
        for _ in range(150):
            data = bytearray(good)
            for _ in range(random.randint(1, 3)):
                data[random.randrange(8, len(data))] = random.choice([0, 1, 3, 4, 127, 128, 255, random.randrange(256)])
            self.assertIn(self.run_it(bytes(data)).returncode, (PROVEN, REFUSED, BROKEN))

    def test_usage(self):
        for words in ([], ["a", "b"], ["a", "b", "c", "d"], ["a", "b", "c", "--threads", "0"], ["a", "b", "c", "--threads"],
                      ["a", "b", "c", "--fast"]):
            done = subprocess.run([PROGRAM, *words], capture_output=True, text=True, timeout=60, check=False)
            self.assertEqual((done.returncode, done.stdout), (USAGE, ""))
            self.assertIn("vkh_check: ", done.stderr)
        done = subprocess.run([PROGRAM, "none.vhc", "a", "b"], capture_output=True, text=True, timeout=60, check=False)
        self.assertEqual((done.returncode, done.stderr), (BROKEN, "vkh_check: none.vhc: cannot be read\n"))

    @unittest.skipIf(shutil.which("nm") is None, "no nm")
    def test_nothing_of_the_solver_is_in_it(self):
        symbols = subprocess.run(["nm", "-C", PROGRAM], capture_output=True, text=True, check=True).stdout
        self.assertIn("vkh::read_mesh", symbols)
        for name in ("vkhCmd", "vkhCreate", "vkh::gpu", "vkh::Solver", "vkh::solve", "vkh::Device", "vkh::verify"):
            self.assertNotIn(name, symbols)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
