"""The results of a survey of a mesh, as Python shows them. vkhausdorff._core makes them."""

from dataclasses import dataclass, field as _member, fields
from html import escape
from itertools import chain
from numbers import Real
from typing import Any, Literal, NamedTuple

import numpy as np
import numpy.typing as npt

from vkhausdorff import _core


def html_table(row):
    """A row of figures by their names as a table, for notebooks; without figures that have no value."""
    cells = "".join(f"<tr><th>{escape(name)}</th><td>{escape(str(value))}</td></tr>" for name, value in row.items()
                    if value not in (None, ""))
    return f"<table>{cells}</table>"


def plain_figures(figures):
    """Intervals by their names as plain values."""
    return {name: {"lower": e.lower, "upper": e.upper, "estimate": e.estimate, "jump": e.jump} for name, e in figures.items()}


def set_arrays(record, **arrays):
    """Sets members of a frozen dataclass, each given with its type, to arrays of its own that are read-only."""
    for name, (values, kind) in arrays.items():
        own = np.array(values, dtype=kind)
        own.setflags(write=False)
        object.__setattr__(record, name, own)


class Record:
    """A dataclass of arrays and figures: it is equal to one with the same, and notebooks show _row() of it."""

    __hash__ = None

    def __eq__(self, other):
        if type(other) is not type(self):
            return NotImplemented
        return all(np.array_equal(getattr(self, member.name), getattr(other, member.name)) for member in fields(self))

    def _repr_html_(self):
        return html_table(self._row())


class _Bounds(NamedTuple):
    lower: float
    upper: float


class Interval(_Bounds):
    """An enclosure: its value lies in [lower, upper], in exact arithmetic. A tuple of two: lower, upper = interval.

    estimate: what the value probably is, within both, or None; it proves nothing, and is no part of equality. jump: of a
    percentile or a share, whether the distribution leaps there, so that no effort narrows it.
    """

    estimate: float | None = None
    jump: bool = False

    def __new__(cls, lower: float, upper: float, estimate: float | None = None, jump: bool = False) -> "Interval":
        made_one = super().__new__(cls, lower, upper)
        made_one.estimate = estimate
        made_one.jump = jump
        return made_one

    def __reduce__(self):
        return Interval, (self.lower, self.upper, self.estimate, self.jump)

    def __contains__(self, value: object) -> bool:
        return self.lower <= value <= self.upper


@dataclass(frozen=True, init=False, eq=False, repr=False)
class Field:
    """Bounds of each face, by its row: the largest distance of a point of it lies between lower and upper.

    lower, upper: float64 arrays of shape (faces,), read-only, in the coordinates' unit, rounded outward. signed: where
    sides were asked for, the SignedField of the same faces, else None. A Field of a result keeps the mesh that was
    measured, for save(); a pickle of it does not.
    """

    lower: npt.NDArray[np.float64]
    upper: npt.NDArray[np.float64]
    signed: "SignedField | Any" = None
    _source = None  # of save(): (mesh, lower, upper, unit, name of the other mesh)

    def __init__(self, lower: npt.ArrayLike, upper: npt.ArrayLike, signed: "SignedField | None" = None) -> None:
        set_arrays(self, lower=(lower, np.float64), upper=(upper, np.float64))
        object.__setattr__(self, "signed", signed)

    def __reduce__(self):  # unpickled arrays could be written to
        return type(self), (self.lower, self.upper, self.signed)

    def save(self, path: "_Path", mesh: "_Mesh | None" = None, *, map: "_Map" = "viridis") -> None:
        """Writes the mesh with these bounds and colours of its faces, to be looked at: what the program's --field writes.

        path: ends in .ply or .glb, which is the format, both binary. mesh: as distance() takes it, with as many faces; None
        for the mesh that was measured, as it was placed. map: 'viridis', 'batlow' or 'cividis', from 0 to the largest upper.
        ValueError if there is no mesh, or for another ending; OSError if the file cannot be written.
        """
        source = self._source
        if mesh is not None:
            about = source[1:] if source is not None else (_largest(self.lower), _largest(self.upper), "", b"the other mesh")
            source = (mesh, *about)
        if source is None:
            raise ValueError("mesh: give the one that was measured; a Field that was made by hand or unpickled has none")
        _core._save_field(path, self.lower, self.upper, source, map)

    def __len__(self) -> int:
        return len(self.lower)

    def __eq__(self, other):
        if not isinstance(other, Field):
            return NotImplemented
        is_same = np.array_equal(self.lower, other.lower) and np.array_equal(self.upper, other.upper)
        return is_same and self.signed == other.signed

    __hash__ = None

    def __repr__(self):
        return f"<vkhausdorff.{type(self).__name__} of {len(self)} faces>"


class SignedField(Field):
    """Bounds of each face, by its row: the signed distances of all its points lie between lower and upper.

    They are negative under the other mesh. Where no side is proven both signs are possible. side: an int8 array, 1 where the
    whole face is over the other mesh, -1 where it is under it, 0 where it has points of both sides or without a proven one.
    """

    @property
    def side(self) -> npt.NDArray[np.int8]:
        is_over, is_under = (self.lower >= 0) & (self.upper > 0), (self.upper <= 0) & (self.lower < 0)
        return is_over.astype(np.int8) - is_under.astype(np.int8)


class SidedPoint(NamedTuple):
    """A point of a mesh with a proven side: its place, the row of its face, and a distance that it is at least away."""

    point: tuple[float, float, float]
    face: int
    lower: float


def _plain(value):
    """A member as plain values: an Interval as its two ends, a point by its members' names."""
    if isinstance(value, dict):
        return {name: _plain(one) for name, one in value.items()}
    if isinstance(value, SidedPoint):
        return _plain(value._asdict())
    if isinstance(value, Signed):
        return value.to_dict()
    if isinstance(value, Field):
        signed = {} if value.signed is None else {"signed": _plain(value.signed)}
        return {"lower": value.lower.tolist(), "upper": value.upper.tolist(), **signed}
    return list(value) if isinstance(value, tuple) else value


def _plain_rows(key, name, rows):
    """Figures, each with what it is of, as plain values."""
    return [{key: at, name: list(e), "estimate": e.estimate, "jump": e.jump} for at, e in rows]


def _largest(values):
    return float(values.max()) if len(values) else 0.0


def _field(bounds, source, signed=None):
    """Makes a Field of a result."""
    if bounds is None:
        return None
    field = Field(*bounds, signed)
    object.__setattr__(field, "_source", source)
    return field


@dataclass(frozen=True, eq=True)
class Signed:
    """The sides of the other mesh on which a mesh lies: over it, in front of its faces as they are oriented, or under it.

    over, under: Intervals of the largest distance of a point on that side; upper covers what has no side. inside: whether
    the other mesh has a proven inside, or why not: 'open', 'crossing', 'winding' or 'undecided'; open_edges: of it.
    inside_out: whether its faces look inward, so that over means inside it: 'none', 'part' or 'all' of them. areas:
    Intervals of shares of the area, {'over', 'under', 'unsigned': {reason: Interval}}, or None. mean, percentiles: of the
    signed distance, which is negative under the other mesh; with statistics. over_field, under_field: with field, a Field of
    each side. over_witness, under_witness: a SidedPoint far on each side, or None.
    """

    over: Interval
    under: Interval
    inside: Literal["proven", "open", "crossing", "winding", "undecided"]
    open_edges: int
    areas: dict[str, Any] | Any
    mean: Interval | Any
    percentiles: dict[float, Interval]
    over_field: Field | Any
    under_field: Field | Any
    over_witness: SidedPoint | Any = None
    under_witness: SidedPoint | Any = None
    inside_out: Literal["none", "part", "all"] = "none"

    __hash__ = None

    def to_dict(self) -> dict[str, Any]:
        """All of it as plain values, which json.dumps takes."""
        plain = {one.name: _plain(getattr(self, one.name)) for one in fields(self) if one.name not in ("over_field", "under_field")}
        plain["percentiles"] = [{"share": share, "distance": distance} for share, distance in plain["percentiles"].items()]
        return plain


# The members of a Survey that statistics bring.
_STATISTICS = ("area", "points", "kept", "mean", "rms", "percentiles", "bands", "curve")


@dataclass(frozen=True, repr=False)
class Survey:
    """The known bounds of the distances of all of a mesh from the other one. Lengths are in the coordinates' unit.

    upper: no distance is above it. field: a Field, or None. Statistics, or None: area, of the mesh, to nearest; mean
    and rms, weighted by area, Intervals; percentiles, {share: Interval} of the least distance that so much of the area is
    within; bands, {distance as it was given: Interval} of the share of the area within it; curve, [(distance, Interval)],
    the same for distances that ascend from 0 to the largest. met: whether all is as narrow as was asked. ended: why the
    survey ended, 'met', 'effort' (that many cells were bounded), 'bits' (no split would narrow more), 'time' (survey_time
    ended it early: the next run may differ), 'cancelled' or 'memory'. stats: its effort and cost. signed: a Signed, or None.
    points: of a mesh of points, how many: area is 0, and all figures and shares weigh points alike; otherwise None.
    kept: with max_distance, the Interval of the share of the mesh that is within it, of which figures are; otherwise None.
    figures: {name: Interval} of all of these: 'mean', 'rms', 'p95', 'within_0.5', 'kept', 'over', 'signed_mean' and so on; None
    in the pickle of a version that had none, since names are made where an answer is, with the limits as they were typed.
    """

    upper: float
    field: Field | Any
    area: float | Any
    mean: Interval | Any
    rms: Interval | Any
    percentiles: dict[float, Interval] | Any
    bands: dict[float | str, Interval] | Any
    curve: list[tuple[float, Interval]] | Any
    met: bool
    ended: Literal["met", "effort", "bits", "time", "cancelled", "memory"]
    stats: dict[str, Any] = _member(compare=False)
    signed: Signed | Any = None
    points: int | Any = None
    kept: Interval | Any = None
    figures: dict[str, Interval] | Any = None

    __hash__ = None

    def area_within(self, distance: "_Number | str") -> Interval:
        """The Interval of the share of the area, from 0 to 1, that is within this distance of the other mesh.

        A number, in the coordinates' unit: narrow at one of bands, true at any. Or a string that was one of bands.
        ValueError without statistics.
        """
        if self.bands is None:
            raise ValueError("area_within(): ask for it with statistics=True or bands=(...); a mesh without area has none")
        if isinstance(distance, str):
            if distance in self.bands:
                return self.bands[distance]
            raise ValueError(f"distance: {distance!r} is not one of bands, which are {', '.join(map(repr, self.bands)) or 'none'}")
        expected = "expected a number, 0 or more, or a string that was one of bands"
        if not isinstance(distance, Real) or isinstance(distance, (bool, np.bool_)):
            raise TypeError(f"distance: {expected}, not a value of type {type(distance).__name__}")
        t = float(distance)
        if not t >= 0:
            raise ValueError(f"distance: {expected}, not {t!r}")
        return self._within(t)

    def _within(self, t):
        """Area that is surely within less is within t; area that is not even within more is not."""
        known = chain(self.curve, ((d, share) for d, share in self.bands.items() if not isinstance(d, str)))
        lower, upper = float(t >= self.upper), 1.0
        for d, share in known:
            if d <= t:
                lower = max(lower, share.lower)
            if d >= t:
                upper = min(upper, share.upper)
        return Interval(lower, upper)

    def to_dict(self) -> dict[str, Any]:
        """All of it as plain values, which json.dumps takes."""
        plain = {one.name: _plain(getattr(self, one.name)) for one in fields(self) if one.name not in _STATISTICS}
        plain["figures"] = plain_figures(self.figures or {})
        plain["statistics"] = None if self.bands is None else self._plain_statistics()
        return plain

    def _plain_statistics(self):
        known = {name: getattr(self, name) for name in _STATISTICS}
        estimates = {f"{name}_estimate": value.estimate for name, value in known.items() if isinstance(value, Interval)}
        rows = {"percentiles": _plain_rows("share", "distance", self.percentiles.items()),
                "bands": _plain_rows("distance", "share", self.bands.items()), "curve": _plain_rows("distance", "share", self.curve)}
        return {**{name: _plain(value) for name, value in known.items()}, **estimates, **rows}

    def __repr__(self):
        words = [f"{self.field!r}"] if self.field is not None else []
        words += [f"mean={tuple(self.mean)}", f"rms={tuple(self.rms)}"] if self.bands is not None else []
        return f"<vkhausdorff.Survey {', '.join(words)}{'' if self.met else ', not met'}>"


for _cls in (Interval, Field, SignedField, SidedPoint, Signed, Survey):
    _cls.__module__ = "vkhausdorff"  # the package's names, for pickles too


def interval(found, jump=None):
    """The Interval of an enclosure's members; jump: where they stand beside it."""
    return Interval(found["lower"], found["upper"], found.get("estimate"), (found if jump is None else jump).get("jump", False))


def _intervals(found):
    return {name: interval(one) for name, one in found.items()}


def _sided_point(found):
    return found and SidedPoint(tuple(found["point"]), found["face"], found["lower"])


def _signed(found, over_field, under_field, source):
    if found is None:
        return None

    def field(side, bounds):
        ends = found[side]
        about = source and (source[0], ends["lower"], ends["upper"], *source[3:])
        return _field(bounds, about)

    areas = found["areas"]
    if areas is not None:
        areas = {"over": interval(areas["over"]), "under": interval(areas["under"]), "unsigned": _intervals(areas["unsigned"])}
    return Signed(interval(found["over"]), interval(found["under"]), found["inside"], found["edges"]["open"], areas,
                  found["mean"] and interval(found["mean"]),
                  {one["share"]: interval(one["distance"]) for one in found["percentiles"]},
                  field("over", over_field), field("under", under_field), _sided_point(found["over_witness"]),
                  _sided_point(found["under_witness"]), found.get("inside_out", "none"))


def _signed_field(signed):
    if signed is None or signed.over_field is None:
        return None
    return SignedField(0.0 - signed.under_field.upper, signed.over_field.upper)


def _statistics(found, bands):
    """What a Survey has of the members of statistics; bands: the distances as they were given."""
    if found is None:
        return dict.fromkeys(_STATISTICS)
    plain = {name: interval(one) if isinstance(one, dict) else one for name, one in found.items() if name in _STATISTICS}
    return {**plain, "percentiles": {one["share"]: interval(one["distance"], one) for one in found["percentiles"]},
            "bands": {given: interval(one["share"], one) for given, one in zip(bands, found["bands"])},
            "curve": [(one["distance"], interval(one["share"], one)) for one in found["curve"]]}


def made(*, survey, figures, upper, bands, statistics=None, signed=None, field=None, over_field=None, under_field=None, source=None):
    """Makes a Survey from the members of the answer's JSON. source: what Field.save() needs."""
    signed = _signed(signed, over_field, under_field, source)
    met, ended = survey.pop("met"), survey.pop("ended")
    return Survey(upper=upper, field=_field(field, source, _signed_field(signed)), met=met, ended=ended, stats=survey, signed=signed,
                  figures=_intervals(figures), **_statistics(statistics, bands))
