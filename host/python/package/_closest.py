"""The result of closest(), as Python shows it. vkhausdorff._core makes it."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from vkhausdorff._survey import Record, set_arrays


@dataclass(frozen=True, init=False, eq=False, repr=False)
class Closest(Record):
    """The points of a mesh that are closest to given points, by their rows: each distance lies in [lower, upper].

    lower, upper: float64 arrays of shape (n,), in the coordinates' unit, rounded outward. points: (n, 3), float64, each a
    point of the mesh, rounded to float64, whose distance lies in [lower, upper], too. faces: (n,), uint32, the rows of the
    mesh's faces that they lie on. All are read-only. It unpacks as distances, points, faces; distances are upper.
    """

    lower: npt.NDArray[np.float64]
    upper: npt.NDArray[np.float64]
    points: npt.NDArray[np.float64]
    faces: npt.NDArray[np.uint32]

    def __init__(self, lower: npt.ArrayLike, upper: npt.ArrayLike, points: npt.ArrayLike, faces: npt.ArrayLike) -> None:
        set_arrays(self, lower=(lower, np.float64), upper=(upper, np.float64), points=(points, np.float64), faces=(faces, np.uint32))

    def __reduce__(self):  # unpickled arrays could be written to
        return Closest, (self.lower, self.upper, self.points, self.faces)

    def __iter__(self) -> Iterator[npt.NDArray[Any]]:
        return iter((self.upper, self.points, self.faces))

    def _row(self):
        farthest = float(self.upper.max()) if len(self.upper) else None
        return {"points": len(self.lower), "farthest": farthest}

    def __repr__(self):
        return f"<vkhausdorff.Closest of {len(self.lower)} points>"
