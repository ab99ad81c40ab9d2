"""The result of align(), as Python shows it. vkhausdorff._core makes it."""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from vkhausdorff._survey import Record, set_arrays


@dataclass(frozen=True, init=False, eq=False, repr=False)
class Alignment(Record):
    """The place of A on B that a fit found, which is not proven the best.

    matrix: (4, 4), float64, read-only: a rotation and a shift, which transform= takes. rms: the root mean square distance
    from B of A's samples that count there, in the coordinates' unit; share: of the samples, those within three deviations,
    which count; samples: how many there are. poor: the fit is far from B for its size, or few samples count. rival: where
    another place is about as good, such as for a symmetric part, the rms of the nearest 80 % there; otherwise None. mirrored:
    where A's mirror image would lie far closer, the rms of all its samples there; otherwise None.
    """

    matrix: npt.NDArray[np.float64]
    rms: float
    share: float
    samples: int
    poor: bool
    rival: float | None
    mirrored: float | None

    def __init__(self, matrix: npt.ArrayLike, rms: float, share: float, samples: int, poor: bool, rival: float | None,
                 mirrored: float | None = None) -> None:
        set_arrays(self, matrix=(matrix, np.float64))
        for name, value in (("rms", rms), ("share", share), ("samples", samples), ("poor", poor), ("rival", rival), ("mirrored", mirrored)):
            object.__setattr__(self, name, value)

    def __reduce__(self):  # an unpickled array could be written to
        return Alignment, (self.matrix, self.rms, self.share, self.samples, self.poor, self.rival, self.mirrored)

    def _row(self):
        row = {"rms": self.rms, "share": self.share, "samples": self.samples, "poor": self.poor, "rival": self.rival}
        return {**row, **{f"matrix row {i}": " ".join(map(repr, line)) for i, line in enumerate(self.matrix.tolist())}}

    def __repr__(self):
        return f"<vkhausdorff.Alignment: {self.share:.1%} of {self.samples} samples, rms {self.rms:.4g}>"
