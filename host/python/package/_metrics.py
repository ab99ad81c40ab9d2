"""Metrics of two surfaces by the names that papers use: vkhausdorff.metrics()."""

from dataclasses import dataclass, field, fields, replace
from math import inf, nan
from typing import Any

from vkhausdorff import _core, _masks
from vkhausdorff._keywords import takes_keywords_of
from vkhausdorff._result import Result
from vkhausdorff._survey import Interval, html_table, interval, plain_figures


@dataclass(frozen=True)
class Metrics:
    """Figures of two surfaces, each an Interval with an estimate. Lengths are in the coordinates' unit, chamfer_l2 squared.

    percentile: of hd_p and hd_p_pooled, which are also called by it: hd95, hd95_pooled. nsd, precision, recall and f1 are
    {distance as it was given: Interval} of shares, from 0 to 1, for each of bands. With normals=, normal_consistency is an
    Interval, and precision_normals, recall_normals and f1_normals are of area whose normals agree, too; otherwise they are
    None and empty. met: whether all requested figures are as narrow as asked; unmet: the names of the ones that are not.
    result: the Result of both directions from which they were made; None if a mask is empty.
    """

    percentile: float
    hausdorff: Interval
    hd_p: Interval
    hd_p_pooled: Interval
    masd: Interval
    assd: Interval
    rms: Interval
    chamfer_l1: Interval
    chamfer_l2: Interval
    nsd: dict[float | str, Interval]
    precision: dict[float | str, Interval]
    recall: dict[float | str, Interval]
    f1: dict[float | str, Interval]
    met: bool
    unmet: tuple[str, ...]
    result: Result
    normal_consistency: Interval | None = None
    precision_normals: dict[float | str, Interval] = field(default_factory=dict)
    recall_normals: dict[float | str, Interval] = field(default_factory=dict)
    f1_normals: dict[float | str, Interval] = field(default_factory=dict)

    __hash__ = None

    def __getattr__(self, name: str) -> Interval:
        if name.startswith("hd") and name[2:].removesuffix("_pooled") == f"{self.percentile:g}":
            return self.hd_p_pooled if name.endswith("_pooled") else self.hd_p
        raise AttributeError(f"no figure is called {name!r}; the percentile is {self.__dict__.get('percentile')!r}")

    def _rows(self):
        """Each figure with its name and its Interval; shares with their distance."""
        for name in _LENGTHS:
            yield name.replace("_p", f"{self.percentile:g}", 1) if name.startswith("hd_p") else name, getattr(self, name)
        if self.normal_consistency is not None:
            yield "normal_consistency", self.normal_consistency
        for name in _SHARES:
            for distance, interval in getattr(self, name).items():
                yield f"{name}@{distance}", interval

    def to_dict(self) -> dict[str, Any]:
        """All of it as plain values, which json.dumps takes."""
        return {"percentile": self.percentile, "met": self.met, "unmet": list(self.unmet), **plain_figures(dict(self._rows()))}

    def to_frame(self) -> Any:
        """A pandas.DataFrame of one row: each figure's estimate by its name, with its ends beside, as hd95_lower."""
        import pandas

        return pandas.DataFrame([self._row()])

    def _row(self):
        row = {}
        for name, e in self._rows():
            row[name], row[f"{name}_lower"], row[f"{name}_upper"] = e.estimate, e.lower, e.upper
        return {**row, "met": self.met}

    def _repr_html_(self):
        return html_table({**{name: f"{e.lower!r} to {e.upper!r}" for name, e in self._rows()}, "met": self.met})

    def __repr__(self):
        return f"<vkhausdorff.Metrics {', '.join(f'{name}={tuple(e)}' for name, e in self._rows())}{'' if self.met else ', not met'}>"


Metrics.__module__ = "vkhausdorff"
_LENGTHS = tuple(one.name for one in fields(Metrics) if one.type is Interval)
_SHARES = tuple(one.name for one in fields(Metrics) if one.type == dict[float | str, Interval])


def _made(result):
    found = result.stats.pop("metrics")
    asked = found.get("figures") or [*_LENGTHS, "normal_consistency", *_SHARES]
    lengths = {name: one for name, one in found.items() if isinstance(one, dict)}
    within = {given: {name: one for name, one in shares.items() if isinstance(one, dict)}
              for given, shares in zip(found["bands"], found["within"])}
    unmet = [name for name, one in lengths.items() if not one["met"] and name in asked]
    unmet += [f"{name}@{given}" for given, shares in within.items() for name, one in shares.items() if not one["met"] and name in asked]
    shares = {name: {given: interval(shares[name]) for given, shares in within.items() if name in shares} for name in _SHARES}
    return Metrics(percentile=found["percentile"], **{name: interval(one) for name, one in lengths.items()}, **shares, met=not unmet,
                   unmet=tuple(unmet), result=result)


def _without_surface(named, no_a, no_b):
    """The figures of masks of which one or both are empty, under the names that another pair's have."""
    known = nan if no_a and no_b else 0.0
    of_shares = {"precision": nan if no_a else known, "recall": nan if no_b else known}
    of_shares |= {f"{name}_normals": share for name, share in of_shares.items()}

    def exactly(value):
        return Interval(value, value, value)

    lengths = {name: exactly(nan if no_a and no_b else inf) for name in _LENGTHS}
    shares = {
        name: {distance: exactly(of_shares.get(name, known)) for distance in getattr(named, name)} for name in _SHARES
    }
    consistency = None if named.normal_consistency is None else exactly(nan)
    return replace(named, **lengths, **shares, normal_consistency=consistency, met=True, unmet=(), result=None)


@takes_keywords_of(_core._metrics)
def metrics(a, b, *, spacing=None, affine=None, empty="error", **options):
    """Encloses the figures of two surfaces that papers report: HD95, ASSD, Chamfer distances, surface Dice, F-scores.

    a, b: meshes, as distance() takes them; or two masks on one grid, arrays of three dimensions that are not 0 where the
    label is, whose surfaces are the faces of voxels between label and not-label; or of two dimensions and booleans, whose
    contours are the edges of pixels, and shares are of their length. percentile: of hd_p, a number of per cent such
    as 95; below 1 it is a string, '0.5%'. bands: distances in
    the coordinates' unit, or strings such as '0.5%' of A's diagonal: the shares of area within each are nsd (of both),
    precision (of A), recall (of B) and f1. spacing: of masks, the sizes of a voxel, 1 by default; or affine: four rows that
    map the number of a voxel's middle to space, as NIfTI's. figures: names such as 'f1' or 'hd95' that alone are sought,
    which takes less time; all by default. normals: an angle in degrees within which normals agree, for
    figures of normals. empty: of masks, 'error', or 'inf': if one is empty, lengths are inf, shares 0 and
    those of the empty one nan; of two that are empty all is nan. The rest is as in distance(). Returns
    Metrics. ValueError if a surface has no area.
    """
    if empty not in ("error", "inf"):
        raise ValueError(f"empty: expected 'error' or 'inf', not {empty!r}")
    missing = (False, False)
    if _masks.is_mask(a) or _masks.is_mask(b):
        (a, b), missing = _masks.surfaces(a, b, spacing, affine, options.get("bands", ()), empty)
        options |= {"effort": 0} if any(missing) else {}  # the voxel only names the figures
    elif spacing is not None or affine is not None:
        raise TypeError(f"{'affine' if spacing is None else 'spacing'}: is of masks, arrays of three dimensions")
    made = _made(_core._metrics(a, b, **options))
    return _without_surface(made, *missing) if any(missing) else made
