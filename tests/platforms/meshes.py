"""Generated pairs, as files in the four formats, under names that are no ASCII."""

import math
import pathlib
import random
import struct

FOLDER = "Maße 測量"


def sheet(rng, n, noise, shift):
    """A bumpy height field of n by n quads: vertices and triangles."""
    vertices = [(x / n + rng.uniform(-noise, noise) / n, y / n,
                 0.2 * math.sin(5 * x / n) * math.cos(4 * y / n) + rng.uniform(-noise, noise) + shift)
                for y in range(n + 1) for x in range(n + 1)]
    faces = []
    for y in range(n):
        for x in range(n):
            a = y * (n + 1) + x
            faces += [(a, a + 1, a + n + 2), (a, a + n + 2, a + n + 1)]
    return vertices, faces


def soup(rng, n, size, far):
    """Triangles without neighbours, around `far`."""
    vertices, faces = [], []
    for i in range(n):
        centre = [far + rng.uniform(-1, 1) for _ in range(3)]
        vertices += [tuple(c + rng.uniform(-size, size) for c in centre) for _ in range(3)]
        faces.append((3 * i, 3 * i + 1, 3 * i + 2))
    return vertices, faces


def sphere(n, radius):
    """A sphere of 2 n n faces, by meridians and circles of latitude."""
    rings = [(radius * math.sin(math.pi * i / n), radius * math.cos(math.pi * i / n)) for i in range(n + 1)]
    around = [(math.cos(2 * math.pi * j / n), math.sin(2 * math.pi * j / n)) for j in range(n)]
    vertices = [(r * x, r * y, z) for r, z in rings for x, y in around]
    faces = []
    for a in range(n * n):
        b = a + 1 if (a + 1) % n else a + 1 - n
        faces += [(a, b, b + n), (a, b + n, a + n)]
    return vertices, faces


def as_obj(vertices, faces):
    lines = [f"v {x!r} {y!r} {z!r}" for x, y, z in vertices]
    lines += [f"f {a + 1} {b + 1} {c + 1}" for a, b, c in faces]
    return ("\r\n".join(lines) + "\r\n").encode()  # as Windows' editors end lines


def as_off(vertices, faces):
    lines = ["OFF", f"{len(vertices)} {len(faces)} 0"]
    lines += [f"{x!r} {y!r} {z!r}" for x, y, z in vertices] + [f"3 {a} {b} {c}" for a, b, c in faces]
    return ("\n".join(lines) + "\n").encode()


def as_stl(vertices, faces):
    corners = [struct.pack("<12fH", 0, 0, 0, *(x for i in face for x in vertices[i]), 0) for face in faces]
    return b"\x1a" * 80 + struct.pack("<I", len(faces)) + b"".join(corners)  # 1a ends a file that is read as text


def as_ply(vertices, faces):
    head = (f"ply\nformat binary_little_endian 1.0\nelement vertex {len(vertices)}\nproperty double x\nproperty double y\n"
            f"property double z\nelement face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n")
    return (head.encode() + b"".join(struct.pack("<3d", *v) for v in vertices)
            + b"".join(struct.pack("<B3i", 3, *f) for f in faces))


def write_long(folder):
    """Two files whose distance takes seconds: everywhere it is nearly the same."""
    names = ["inner.ply", "outer.ply"]
    for name, n, radius in zip(names, (400, 407), (1, 1.1)):
        (folder / name).write_bytes(as_ply(*sphere(n, radius)))
    return names


FORMATS = (("obj", as_obj), ("ply", as_ply), ("stl", as_stl), ("off", as_off))


def write(folder: pathlib.Path, count: int = 10) -> list[tuple[str, str]]:
    """The names of A and B of `count` pairs, from `folder`."""
    (folder / FOLDER).mkdir(parents=True, exist_ok=True)
    pairs = []
    for i in range(count):
        rng, k = random.Random(1000 + i), i % 10
        if k % 3 == 2:
            both = soup(rng, 60, 0.3, 2.0 ** (3 * k)), soup(rng, 80, 0.3, 2.0 ** (3 * k))
        else:
            both = sheet(rng, 8 + k, 0.01, 0), sheet(rng, 7 + k, 0.02, 0.05 * (i % 2))
        names = []
        for side, mesh in zip("AB", both):
            extension, encode = FORMATS[(i + (side == "B")) % 4]
            name = f"{FOLDER}/{i} {side}ö📐.{extension}"
            (folder / name).write_bytes(encode(*mesh))
            names.append(name)
        pairs.append(tuple(names))
    return pairs
