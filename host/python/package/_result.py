"""The result of a pair, as Python shows it. vkhausdorff._core makes its parts."""

from typing import Any, Literal, NamedTuple

from vkhausdorff import _core
from vkhausdorff._survey import Field, Interval, Signed, Survey, html_table


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


_FACE, _POINT = 0, 2
_NOWHERE = (0, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0))


class _Parts(NamedTuple):
    """What a Result is made of, in the order that its pickles have since 0.3.0.

    A witness: its face, its barycentric weights, its point.
    """

    lower: float = 0.0
    upper: float = 0.0
    status: str = "closed"
    verdict: str | None = None
    witness_a: tuple = _NOWHERE
    witness_b: tuple = _NOWHERE
    survey: Survey | None = None
    survey_back: Survey | None = None
    stats: dict = {}
    index: int | None = None
    id: Any = None
    error: Exception | None = None
    notes: list = []

    def is_known(self):
        """Whether these are parts that some version makes, and not those of another object."""
        of_types = ((self.lower, float), (self.upper, float), (self.status, str), (self.verdict, (str, type(None))),
                    (self.witness_a, tuple), (self.witness_b, tuple), (self.stats, dict), (self.notes, list))
        return all(isinstance(part, kind) for part, kind in of_types)


class _Part(property):
    """A property of a Result: the part of its name; or of a part, which may be None, the member of its name, or the one at a place.

    of_failed: a pair that failed has it, too.
    """

    def __init__(self, text, *, of=None, at=None, of_failed=False):
        super().__init__(self._read, doc=text)
        self._of, self._at, self._of_failed = of, at, of_failed

    def __set_name__(self, owner, name):
        self._name = name

    def _read(self, result):
        parts = result._whole() if self._of_failed else result._answer()
        whole = parts if self._of is None else getattr(parts, self._of)
        if whole is None:
            return None
        return getattr(whole, self._name) if self._at is None else whole[self._at]


def _same_errors(x, y):
    """An exception is equal to itself alone, and so is compared by its text."""
    return type(x) is type(y) and str(x) == str(y)


class Result:
    """A certified interval and what proves its lower end.

    `| Any`: None where the call did not ask for it, which no checker is to ask about at each use.
    """

    __slots__ = ("__weakref__", "_parts")

    lower: float = _Part("lower <= distance, in exact arithmetic")
    upper: float = _Part("distance <= upper, in exact arithmetic")
    status: Literal["closed", "precision", "time", "waves", "memory", "cancelled", "limit", "pruned"] = _Part(
        "why the run ended: closed, precision, time, waves, memory, cancelled, or limit where the limit of gate() was decided")
    verdict: Literal["pass", "fail", "undecided"] | None = _Part(
        "of gate(): 'pass', 'fail' or 'undecided', the first two proven; else None")
    witness_a: tuple[float, float, float] = _Part(
        "the point of A (x, y, z) that is farthest from B as far as found, proving lower; in a symmetric run the one that is closest "
        "to it if B has the farthest point", of="witness_a", at=_POINT)
    witness_b: tuple[float, float, float] = _Part(
        "the closest point of B to it (x, y, z); in a symmetric run likewise", of="witness_b", at=_POINT)
    face_a: int = _Part("row of fa with the witness", of="witness_a", at=_FACE)
    face_b: int = _Part("row of fb with its partner", of="witness_b", at=_FACE)
    notes: list[dict[str, Any]] = _Part(
        "what is odd about the pair or its files: a list of dicts of code, text, value, unit, file and face")
    stats: dict[str, Any] = _Part("what the run was asked, did and cost")
    survey: Survey | Any = _Part("the Survey of A, which has all of these; None if nothing was asked")
    survey_back: Survey | Any = _Part("the Survey of B, in a symmetric run")
    field: Field | Any = _Part(
        "with field: .lower and .upper, float64 arrays of shape (faces of A,), in the coordinates' unit: the largest distance of a "
        "point of the face lies between; else None", of="survey")
    mean: Interval | Any = _Part("with statistics: the Interval of the mean distance over A's area; else None", of="survey")
    rms: Interval | Any = _Part("likewise of the root mean square", of="survey")
    figures: dict[str, Interval] | Any = _Part(
        "with statistics or signed: {name: Interval} of all figures of A, such as 'mean', 'p95', 'within_0.5', 'over' and "
        "'signed_mean'; else None, and in the pickle of a version without them", of="survey")
    percentiles: dict[float, Interval] | Any = _Part(
        "with statistics: {share: Interval} of the least distance that so much of A's area is within, for 0.5, 0.9, 0.95 and 0.99; "
        "else None", of="survey")
    signed: Signed | Any = _Part(
        "with signed, or limits of two sides: the Signed of A, which says where it is over B, in front of its faces, and where "
        "under it; else None", of="survey")
    index: int | None = _Part("of distances(): the pair's place in the iterable, from 0; else None", of_failed=True)
    id: Any = _Part("of distances(): what the pair was called, as it was given; else None", of_failed=True)
    error: Exception | None = _Part(
        "of distances(): the exception that the pair ended with, else None. If there is one, every other member of the result "
        "raises it", of_failed=True)

    def __init__(self):
        raise TypeError("cannot create a Result: distance(), gate() and distances() return it")

    def _whole(self):
        """Its parts, those of a pair that failed, too."""
        try:
            return self._parts
        except AttributeError:
            raise TypeError("this Result was never made: Result.__init__ was not called") from None

    def _answer(self):
        """Its parts. Raises the exception that stands instead of an answer."""
        parts = self._whole()
        if parts.error is not None:
            raise parts.error
        return parts

    @property
    def closed(self) -> bool:
        """whether upper - lower met the tolerance"""
        return self.status == "closed"

    @property
    def interval(self) -> Interval:
        """the Interval (lower, upper)"""
        return Interval(self.lower, self.upper)

    @property
    def gap(self) -> float:
        """(upper - lower) / the diagonal of A's bounding box, rounded up"""
        return self.stats["gap"]

    @property
    def witness(self) -> Witness:
        """the Witness: mesh, face, barycentric and point, and of the other mesh nearest_face and nearest"""
        parts = self._answer()
        is_of_a = parts.stats.get("direction", "a_to_b") == "a_to_b"
        at, other = (parts.witness_a, parts.witness_b) if is_of_a else (parts.witness_b, parts.witness_a)
        return Witness("a" if is_of_a else "b", *at, other[_FACE], other[_POINT])

    @property
    def field_back(self) -> Field | Any:
        """as field, for the faces of B and their distances from A, in a symmetric run"""
        return None if self.survey_back is None else self.survey_back.field

    @property
    def survey_met(self) -> bool | None:
        """whether all became as narrow as was asked, before survey_time ended; None if nothing was"""
        surveys = [one for one in (self.survey, self.survey_back) if one is not None]
        return all(one.met for one in surveys) if surveys else None

    def area_within(self, distance: "_Number | str") -> Interval:
        """The Interval of the share of A's area, from 0 to 1, that is within this distance of B.

        A number, in the coordinates' unit: narrow at one of bands, true at any. Or a string that was one of bands. ValueError
        without statistics or bands.
        """
        if self.survey is None:
            raise ValueError("area_within(): ask for it with statistics=True or bands=(...)")
        return self.survey.area_within(distance)

    def _is_upper_sought(self):
        """After a FAIL the upper end was not, unless the question is about a share of the area, or the farthest point is known."""
        return self.verdict != "fail" or "area" in self.stats or _core._is_farthest_known(self.lower, self.upper)

    def _row(self):
        """Its figures as one flat row."""
        witness = self.witness
        row = {"lower": self.lower, "upper": self.upper, "gap": self.gap, "status": self.status, "verdict": self.verdict,
               "witness_mesh": witness.mesh, "witness_face": witness.face}
        row.update({f"witness_{axis}": value for axis, value in zip("xyz", witness.point)})
        for name, enclosure in (self.figures or {}).items():
            row[f"{name}_lower"], row[f"{name}_upper"] = enclosure
        row["notes"] = "; ".join(f"{note['code']}: {note['text']}" for note in self.notes)
        return row

    def to_frame(self) -> Any:
        """A pandas.DataFrame of one row: lower, upper, gap, status, verdict, the witness, A's figures and notes."""
        import pandas

        return pandas.DataFrame([self._row()])

    def to_dict(self) -> dict[str, Any]:
        """All of it as plain values, which json.dumps takes."""
        place = {} if self.index is None else {"index": self.index, "id": self.id}
        if self.error is not None:
            return {**place, "error": {"type": type(self.error).__name__, "message": str(self.error)}}
        names = ("lower", "upper", "closed", "status", "verdict", "witness_a", "witness_b", "face_a", "face_b")
        surveys = {name: one and one.to_dict() for name, one in (("survey", self.survey), ("survey_back", self.survey_back))}
        return {**place, **{name: getattr(self, name) for name in names}, **surveys, "notes": self.notes, "stats": self.stats}

    def _repr_html_(self):
        """The row as a table, for notebooks, without an upper end that was not sought."""
        if self.error is not None:
            return None
        left_out = () if self._is_upper_sought() else ("upper", "gap")
        return html_table({name: value for name, value in self._row().items() if name not in left_out})

    def __repr__(self):
        if self.error is not None:
            return f"<vkhausdorff.Result without an answer: {type(self.error).__name__}: {self.error}>"
        lower, upper = _core._outward(self.lower, self.upper)
        return f"<vkhausdorff.Result {f'[{lower}, {upper}]' if self._is_upper_sought() else f'at least {lower}'} {self.status}>"

    def _proven(self):
        """What is proven of the pair, without its cost."""
        return self._whole()[: _Parts._fields.index("stats")]

    def __eq__(self, other):
        if not isinstance(other, Result):
            return NotImplemented
        return self._proven() == other._proven() and _same_errors(self.error, other.error)

    def __hash__(self):
        return hash(self._whole()[:2])

    def __getstate__(self):
        return tuple(self._whole())

    def __setstate__(self, state):
        is_whole = isinstance(state, tuple) and len(state) == len(_Parts._fields)
        parts = _Parts(*state) if is_whole else None
        if parts is None or not parts.is_known():
            raise ValueError("this pickle is not of a vkhausdorff.Result")
        self._parts = parts


def made(**parts):
    """Makes a Result. vkhausdorff._core calls it with the parts that there are."""
    result = Result.__new__(Result)
    result._parts = _Parts(**parts)
    return result


for _cls in (Witness, Result):
    _cls.__module__ = "vkhausdorff"
