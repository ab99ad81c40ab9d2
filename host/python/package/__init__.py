"""Certified Hausdorff distance between triangle meshes, on the GPU (Vulkan)."""

from vkhausdorff import _core, _keywords
from vkhausdorff._align import Alignment
from vkhausdorff._closest import Closest
from vkhausdorff._core import Device, DeviceError, Mesh, Solver, __version__, align, closest, devices, distance, read, simplify, simplify_levels
from vkhausdorff._many import distances
from vkhausdorff._metrics import Metrics, metrics
from vkhausdorff._result import Result, Witness
from vkhausdorff._simplify import Simplified
from vkhausdorff._survey import Field, Interval, SidedPoint, Signed, SignedField, Survey

__all__ = ["Alignment", "Closest", "Device", "DeviceError", "Field", "Interval", "Mesh", "Metrics", "Result", "SidedPoint", "Signed", "SignedField", "Simplified",
           "Solver", "Survey", "Witness",
           "__version__", "align", "assert_within", "closest", "devices", "distance", "distances", "gate", "metrics", "read", "simplify",
           "simplify_levels"]


@_keywords.takes_keywords_of(_core.gate)
def gate(a, b, max, **options):
    """Decides whether every point of A is within max of B, proven either way: see the result's verdict.

    a, b: (vertices, faces), as distance() takes them, objects with .vertices and .faces (or .triangles), what read()
    returns, or paths of files. max: a positive number in the coordinates' own unit, a string such as '0.1%' of A's
    diagonal, or a number for each face of A; or '+0.25abs,-0.4abs', for points over B, in front of its
    faces, and for points under it. symmetric: B within max of A, too. verdict: 'pass' (upper <= max), 'fail'
    (lower > max; the witness shows where) or 'undecided': h is within tol, a fraction of A's diagonal, of max, or time,
    waves or memory ended. The run ends as soon as either is proven. area: the share of A's area that is to be within max,
    such as 0.995 or '99.5%', instead of all of it; in a symmetric run of B's, too. With field, each face is to be proven
    within max or beyond, too. worst: after the verdict, go on to the farthest point, to a thousandth of its distance or for
    60 waves; without it, the witness of 'fail' is only known to be beyond max. The rest is as in distance().
    """
    return _core.gate(a, b, max, **options)


def _say_area(r, max):
    """The reason why the share of the area that was asked is not proven."""
    sides = [("A", "B", r.survey), *([("B", "A", r.survey_back)] if r.survey_back is not None else [])]

    def known(side):  # the least upper end fails if one does, and the least lower end is not within if one is not
        share = side[2].area_within(max) if side[2].bands is not None else (0, 1)
        return share[1] if r.verdict == "fail" else share[0]

    a, b, survey = min(sides, key=known)
    if survey.bands is None:
        return f"UNDECIDED: nothing is known of {a}'s area"
    share, asked = survey.area_within(max), r.stats["area"]
    if r.verdict == "fail":
        return f"FAIL: at most {share.upper!r} of {a}'s area is within {max!r} of {b}; {asked!r} was asked"
    return f"UNDECIDED: from {share.lower!r} to {share.upper!r} of {a}'s area is within {max!r} of {b}; {asked!r} was asked"


def assert_within(a, b, max, **options):
    """Raises AssertionError unless it is proven that every point of A is within max of B. Takes what gate() takes."""
    __tracebackhide__ = True  # pytest reads it
    r = gate(a, b, max, **options)
    if options.get("area") is not None and r.verdict != "pass":
        raise AssertionError(_say_area(r, max))
    if r.verdict == "fail":
        back = options.get("symmetric") and r.stats["direction"] == "b_to_a"
        mesh, face, point = ("B", r.face_b, r.witness_b) if back else ("A", r.face_a, r.witness_a)
        raise AssertionError(f"FAIL: {point} on face {face} of {mesh} is at least {r.lower!r} from {'A' if back else 'B'}; "
                             f"max is {max!r}")
    if r.verdict != "pass":
        raise AssertionError(f"UNDECIDED ({r.status}): max {max!r} lies in [{r.lower!r}, {r.upper!r}]")
