"""Certified Hausdorff distance between triangle meshes, on the GPU (Vulkan)."""

from vkhausdorff import _core
from vkhausdorff._core import DeviceError, Result, Solver, __version__, distance

__all__ = ["DeviceError", "Result", "Solver", "__version__", "assert_within", "distance", "gate"]


def _arrays(mesh, name):
    """(vertices, faces) of a pair of arrays, or of what has them as attributes."""
    if isinstance(mesh, (tuple, list)) and len(mesh) == 2:
        return tuple(mesh)
    vertices = getattr(mesh, "vertices", None)
    faces = getattr(mesh, "faces", getattr(mesh, "triangles", None))
    if vertices is None or faces is None:
        raise TypeError(f"{name}: expected (vertices, faces), or an object that has .vertices and .faces, "
                        f"not {type(mesh).__name__}")
    return vertices, faces


def gate(a, b, max, *, tol=1e-7, symmetric=False, device="", time=None, waves=None, memory=None, disable=(),
         progress=None, enable=(), preset=""):
    """Whether every point of A is within max of B, proven either way: see the result's verdict.

    a, b: (vertices, faces), as distance() takes them, or objects with .vertices and .faces (or .triangles). max: a
    positive number in the coordinates' own unit, a string such as '0.1%' of A's diagonal, or a number for each face of A.
    symmetric: B within max of A, too. verdict: 'pass' (upper <= max), 'fail' (lower > max; the witness shows where) or
    'undecided': h is within tol, a fraction of A's diagonal, of max, or time, waves or memory ended. The run ends as soon
    as either is proven. The rest is as in distance().
    """
    return _core.gate(*_arrays(a, "a"), *_arrays(b, "b"), max, tol=tol, symmetric=symmetric, device=device, time=time,
                      waves=waves, memory=memory, disable=disable, progress=progress, enable=enable, preset=preset)


def assert_within(a, b, max, **options):
    """AssertionError unless it is proven that every point of A is within max of B. Takes what gate() takes."""
    __tracebackhide__ = True  # for pytest
    r = gate(a, b, max, **options)
    if r.verdict == "fail":
        back = options.get("symmetric") and r.stats["direction"] == "b_to_a"
        mesh, face, point = ("B", r.face_b, r.witness_b) if back else ("A", r.face_a, r.witness_a)
        raise AssertionError(f"FAIL: {point} on face {face} of {mesh} is at least {r.lower!r} from {'A' if back else 'B'}; "
                             f"max is {max!r}")
    if r.verdict != "pass":
        raise AssertionError(f"UNDECIDED ({r.status}): max {max!r} lies in [{r.lower!r}, {r.upper!r}]")
