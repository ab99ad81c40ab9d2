"""The result of simplify(), as Python shows it. vkhausdorff._core makes it."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from vkhausdorff._survey import Interval, Record, set_arrays


@dataclass(frozen=True, init=False, eq=False, repr=False)
class Simplified(Record):
    """A mesh of fewer faces that is proven to be within max of A. It may be passed wherever a mesh may.

    vertices: (n, 3), float64, each a vertex of A; faces: (m, 3), uint32. Both are read-only. interval: the larger of both
    distances, or of A's alone with one_way; interval.upper <= max. a_to_b, b_to_a: each direction's interval; b_to_a is
    pruned by the other one, and may be wide; None with one_way. complete: False if time ended the search. tried: meshes
    that were judged. It unpacks as vertices, faces, interval.
    """

    vertices: npt.NDArray[np.float64]
    faces: npt.NDArray[np.uint32]
    interval: Interval
    a_to_b: Interval
    b_to_a: Interval | None
    complete: bool
    tried: int

    def __init__(self, vertices: npt.ArrayLike, faces: npt.ArrayLike, interval: tuple[float, float], a_to_b: tuple[float, float],
                 b_to_a: tuple[float, float] | None, complete: bool, tried: int) -> None:
        set_arrays(self, vertices=(vertices, np.float64), faces=(faces, np.uint32))
        for name, ends in (("interval", interval), ("a_to_b", a_to_b), ("b_to_a", b_to_a)):
            object.__setattr__(self, name, None if ends is None else Interval(*ends))
        object.__setattr__(self, "complete", bool(complete))
        object.__setattr__(self, "tried", int(tried))

    def __reduce__(self):  # unpickled arrays could be written to
        return Simplified, (self.vertices, self.faces, self.interval, self.a_to_b, self.b_to_a, self.complete, self.tried)

    def __iter__(self) -> Iterator[Any]:
        return iter((self.vertices, self.faces, self.interval))

    def _row(self):
        row = {"vertices": len(self.vertices), "faces": len(self.faces)}
        for name in ("interval", "a_to_b", "b_to_a"):
            ends = getattr(self, name)
            row[name] = None if ends is None else f"{ends.lower!r} to {ends.upper!r}"
        return {**row, "complete": self.complete, "tried": self.tried}

    def __repr__(self):
        return f"<vkhausdorff.Simplified of {len(self.faces)} faces, within {self.interval.upper!r} of A>"
