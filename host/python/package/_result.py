"""What Python adds to a Result of vkhausdorff._core: values that are made of others."""

from typing import Any, Literal, NamedTuple

from vkhausdorff._core import Result
from vkhausdorff._survey import Interval, html_table


class Witness(NamedTuple):
    """The point that proves lower: it lies on `mesh`, 'a' or 'b', and no point of the other mesh is nearer than lower.

    face, its row; barycentric, its weights of that face's corners; point, its coordinates. nearest_face and nearest are
    the closest point that was found of the other mesh.
    """

    mesh: Literal["a", "b"]
    face: int
    barycentric: tuple[float, float, float]
    point: tuple[float, float, float]
    nearest_face: int
    nearest: tuple[float, float, float]


def _witness(r: Result) -> Witness:
    if r.stats.get("direction", "a_to_b") == "a_to_b":
        return Witness("a", r.face_a, r._barycentric_a, r.witness_a, r.face_b, r.witness_b)
    return Witness("b", r.face_b, r._barycentric_b, r.witness_b, r.face_a, r.witness_a)


def _row(r: Result) -> dict[str, Any]:
    """The figures of a result as one flat row."""
    row = {"lower": r.lower, "upper": r.upper, "gap": r.gap, "status": r.status, "verdict": r.verdict,
           "witness_mesh": r.witness.mesh, "witness_face": r.witness.face}
    row.update({f"witness_{axis}": value for axis, value in zip("xyz", r.witness.point)})
    for name, enclosure in (r.figures or {}).items():
        row[f"{name}_lower"], row[f"{name}_upper"] = enclosure
    row["notes"] = "; ".join(f"{note['code']}: {note['text']}" for note in r.notes)
    return row


def _to_frame(self):
    """A pandas.DataFrame of one row: lower, upper, gap, status, verdict, the witness, A's figures and notes."""
    import pandas

    return pandas.DataFrame([_row(self)])


def _repr_html(r: Result) -> str | None:
    """The same row as a table, for notebooks, without an upper end that was not sought."""
    if r.error is not None:
        return None
    left_out = () if r._is_upper_sought else ("upper", "gap")
    return html_table({name: value for name, value in _row(r).items() if name not in left_out})


_repr_html.__name__ = "_repr_html_"
Result.gap = property(lambda r: r.stats["gap"], doc="(upper - lower) / the diagonal of A's bounding box, rounded up")
Result.interval = property(lambda r: Interval(r.lower, r.upper), doc="the Interval (lower, upper)")
Result.witness = property(_witness, doc=Witness.__doc__)
Result.to_frame = _to_frame
Result._repr_html_ = _repr_html
Witness.__module__ = "vkhausdorff"
