"""Certified Hausdorff distance between triangle meshes, on the GPU (Vulkan)."""

from collections.abc import Callable, Iterable, Iterator
from os import PathLike
from types import TracebackType
from typing import Any, Literal, NamedTuple, Protocol, SupportsFloat, SupportsIndex, Union, overload

import numpy as np
import numpy.typing as npt

__all__ = [
    "Alignment", "Closest", "Device", "DeviceError", "Field", "Interval", "Mesh", "Metrics", "Result", "SidedPoint", "Signed", "SignedField", "Simplified", "Solver", "Survey", "Witness", "__version__",
    "align", "assert_within", "closest", "devices", "distance", "distances", "gate", "metrics", "read", "simplify",
    "simplify_levels",
]
__version__: str

_Names = Union[list[str], tuple[str, ...], set[str], frozenset[str]]
_Number = Union[SupportsFloat, SupportsIndex]
_Path = Union[str, PathLike[str]]
_Bands = Union[list[Any], tuple[_Number | str, ...], npt.NDArray[Any]]
_Status = Literal["closed", "precision", "time", "waves", "memory", "cancelled", "limit", "pruned"]
_Verdict = Literal["pass", "fail", "undecided"]
_Preset = Literal["", "default", "paper", "baseline-gpu"]
_Map = Literal["viridis", "batlow", "cividis"]
_Unit = Literal["um", "mm", "cm", "m", "in", "ft"]
# progress(wave, lower, upper): False cancels the run.
_Progress = Callable[[int, float, float], Any]
# on_progress(fraction, lower, upper): False cancels all that is left.
_OnProgress = Callable[[float, float, float], Any]

class _WithFaces(Protocol):
    @property
    def vertices(self) -> Any: ...
    @property
    def faces(self) -> Any: ...

class _WithTriangles(Protocol):
    @property
    def vertices(self) -> Any: ...
    @property
    def triangles(self) -> Any: ...

# The meshes of meshio, PyVista and VTK.
class _WithCells(Protocol):
    points: Any
    @property
    def cells_dict(self) -> Any: ...

class _WithRegularFaces(Protocol):
    @property
    def points(self) -> Any: ...
    @property
    def regular_faces(self) -> Any: ...

class _WithPolys(Protocol):
    def GetPoints(self) -> Any: ...
    def GetPolys(self) -> Any: ...

_Mesh = Union[
    tuple[npt.ArrayLike, npt.ArrayLike],
    _WithFaces,
    _WithTriangles,
    _WithCells,
    _WithRegularFaces,
    _WithPolys,
    "Mesh",
    str,
    PathLike[str],
]

# Points alone, with points=: an array (n, 3), or an object that has .vertices or .points and no faces.
class _WithVertices(Protocol):
    @property
    def vertices(self) -> Any: ...

class _WithPoints(Protocol):
    @property
    def points(self) -> Any: ...

_Measured = Union[_Mesh, npt.NDArray[Any], _WithVertices, _WithPoints]
_Points = Union[bool, Literal["a", "b", "both"], None]

class DeviceError(RuntimeError): ...

class _Bounds(NamedTuple):
    lower: float
    upper: float

class Interval(_Bounds):
    """An enclosure: its value lies in [lower, upper], in exact arithmetic."""

    estimate: float | None
    jump: bool
    def __new__(cls, lower: float, upper: float, estimate: float | None = None, jump: bool = False) -> Interval: ...
    def __contains__(self, value: object) -> bool: ...

class Field:
    """Bounds of each face, by its row: the largest distance of a point of it lies between lower and upper."""

    lower: npt.NDArray[np.float64]
    upper: npt.NDArray[np.float64]
    signed: SignedField | Any
    def __init__(self, lower: npt.ArrayLike, upper: npt.ArrayLike, signed: SignedField | None = None) -> None: ...
    def save(self, path: _Path, mesh: _Mesh | None = None, *, map: _Map = "viridis") -> None: ...
    def __len__(self) -> int: ...

class SignedField(Field):
    """Bounds of each face, by its row: the signed distances of all its points lie between lower and upper."""

    @property
    def side(self) -> npt.NDArray[np.int8]: ...

class SidedPoint(NamedTuple):
    """A point of a mesh with a proven side."""

    point: tuple[float, float, float]
    face: int
    lower: float

class Alignment:
    """The place of a mesh on another that a fit found, which is not proven the best."""

    matrix: npt.NDArray[np.float64]
    rms: float
    share: float
    samples: int
    poor: bool
    rival: float | None
    mirrored: float | None
    def __init__(self, matrix: npt.ArrayLike, rms: float, share: float, samples: int, poor: bool, rival: float | None,
                 mirrored: float | None = None) -> None: ...

class Closest:
    """The points of a mesh that are closest to given points, by their rows: each distance lies in [lower, upper]."""

    lower: npt.NDArray[np.float64]
    upper: npt.NDArray[np.float64]
    points: npt.NDArray[np.float64]
    faces: npt.NDArray[np.uint32]
    def __init__(self, lower: npt.ArrayLike, upper: npt.ArrayLike, points: npt.ArrayLike, faces: npt.ArrayLike) -> None: ...
    def __iter__(self) -> Iterator[npt.NDArray[Any]]: ...

class Signed:
    """The sides of the other mesh on which a mesh lies."""

    over: Interval
    under: Interval
    inside: Literal["proven", "open", "crossing", "winding", "undecided"]
    open_edges: int
    areas: dict[str, Any] | Any
    mean: Interval | Any
    percentiles: dict[float, Interval]
    over_field: Field | Any
    under_field: Field | Any
    over_witness: SidedPoint | Any
    under_witness: SidedPoint | Any
    inside_out: Literal["none", "part", "all"]
    def to_dict(self) -> dict[str, Any]: ...

class Simplified:
    """A mesh of fewer faces that is proven to be within max of A."""

    vertices: npt.NDArray[np.float64]
    faces: npt.NDArray[np.uint32]
    interval: Interval
    a_to_b: Interval
    b_to_a: Interval | None
    complete: bool
    tried: int
    def __init__(
        self,
        vertices: npt.ArrayLike,
        faces: npt.ArrayLike,
        interval: tuple[float, float],
        a_to_b: tuple[float, float],
        b_to_a: tuple[float, float] | None,
        complete: bool,
        tried: int,
    ) -> None: ...
    def __iter__(self) -> Iterator[Any]: ...

class Survey:
    """The known bounds of the distances of all of a mesh from the other one."""

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
    stats: dict[str, Any]
    signed: Signed | Any
    points: int | Any
    kept: Interval | Any
    def area_within(self, distance: _Number | str) -> Interval: ...
    def to_dict(self) -> dict[str, Any]: ...

class Mesh:
    """A mesh file as it was read."""

    @property
    def vertices(self) -> npt.NDArray[np.float64]: ...
    @property
    def faces(self) -> npt.NDArray[np.uint32]: ...
    @property
    def file_faces(self) -> npt.NDArray[np.uint32]: ...
    @property
    def path(self) -> str: ...
    @property
    def unit(self) -> str | None: ...
    @property
    def delta(self) -> float: ...
    @property
    def counts(self) -> dict[str, int]: ...
    @property
    def are_points(self) -> bool: ...
    @property
    def notes(self) -> list[str]: ...

class Witness(NamedTuple):
    """The point that proves lower, and the closest point that was found of the other mesh."""

    mesh: Literal["a", "b"]
    face: int
    barycentric: tuple[float, float, float]
    point: tuple[float, float, float]
    nearest_face: int
    nearest: tuple[float, float, float]

class Result:
    """A certified interval and what proves its lower end.

    `| Any`: None where the call did not ask for it, which no checker is to ask about at each use.
    """

    @property
    def lower(self) -> float: ...
    @property
    def upper(self) -> float: ...
    @property
    def closed(self) -> bool: ...
    @property
    def status(self) -> _Status: ...
    @property
    def verdict(self) -> _Verdict | None: ...
    @property
    def witness_a(self) -> tuple[float, float, float]: ...
    @property
    def witness_b(self) -> tuple[float, float, float]: ...
    @property
    def face_a(self) -> int: ...
    @property
    def face_b(self) -> int: ...
    @property
    def gap(self) -> float: ...
    @property
    def interval(self) -> Interval: ...
    @property
    def witness(self) -> Witness: ...
    def to_frame(self) -> Any: ...
    @property
    def notes(self) -> list[dict[str, Any]]: ...
    @property
    def stats(self) -> dict[str, Any]: ...
    @property
    def field(self) -> Field | Any: ...
    @property
    def field_back(self) -> Field | Any: ...
    @property
    def mean(self) -> Interval | Any: ...
    @property
    def rms(self) -> Interval | Any: ...
    @property
    def percentiles(self) -> dict[float, Interval] | Any: ...
    @property
    def signed(self) -> Signed | Any: ...
    def area_within(self, distance: _Number | str) -> Interval: ...
    @property
    def survey_met(self) -> bool | None: ...
    @property
    def survey(self) -> Survey | Any: ...
    @property
    def survey_back(self) -> Survey | Any: ...
    @property
    def index(self) -> int | None: ...
    @property
    def id(self) -> Any: ...
    @property
    def error(self) -> Exception | None: ...
    def to_dict(self) -> dict[str, Any]: ...

class Device:
    """A device that stays open, for many Solvers and calls, one run at a time."""

    def __init__(self, device: str | SupportsIndex = "") -> None: ...
    @property
    def info(self) -> dict[str, Any]: ...
    def close(self) -> None: ...
    def __enter__(self) -> Device: ...
    def __exit__(
        self,
        *error: type[BaseException] | BaseException | TracebackType | None,
    ) -> None: ...

class Solver:
    """Mesh B on the device, its BVH built once, for many A's."""

    @overload
    def __init__(self, b: _Mesh, /, *, device: str | SupportsIndex | Device = "") -> None: ...
    @overload
    def __init__(self, vb: npt.ArrayLike, fb: npt.ArrayLike, device: str | SupportsIndex | Device = "") -> None: ...
    @overload
    def distance(
        self,
        a: _Measured,
        /,
        *,
        tol: _Number | str = 1e-6,
        time: _Number | None = None,
        waves: SupportsIndex | None = None,
        memory: SupportsIndex | str | None = None,
        disable: _Names = (),
        progress: _Progress | None = None,
        enable: _Names = (),
        preset: _Preset = "",
        field: bool | _Number | str = False,
        statistics: bool = False,
        signed: bool = False,
        bands: _Bands = (),
        effort: SupportsIndex | None = None,
        survey_time: _Number | None = None,
        certificate: _Path | None = None,
        unit_a: _Unit | None = None,
        unit_b: _Unit | None = None,
        transform: npt.ArrayLike | _Path | None = None,
        scale: bool = False,
        align: bool = False,
        on_progress: _OnProgress | None = None,
        max_distance: _Number | str | None = None,
        points: Union[bool, Literal["a"], None] = None,
    ) -> Result: ...
    @overload
    def distance(
        self,
        va: npt.ArrayLike,
        fa: npt.ArrayLike,
        tol: _Number | str = 1e-6,
        *,
        time: _Number | None = None,
        waves: SupportsIndex | None = None,
        memory: SupportsIndex | str | None = None,
        disable: _Names = (),
        progress: _Progress | None = None,
        enable: _Names = (),
        preset: _Preset = "",
        field: bool | _Number | str = False,
        statistics: bool = False,
        signed: bool = False,
        bands: _Bands = (),
        effort: SupportsIndex | None = None,
        survey_time: _Number | None = None,
        certificate: _Path | None = None,
        unit_a: _Unit | None = None,
        unit_b: _Unit | None = None,
        transform: npt.ArrayLike | _Path | None = None,
        scale: bool = False,
        align: bool = False,
        on_progress: _OnProgress | None = None,
        max_distance: _Number | str | None = None,
        points: Union[bool, Literal["a"], None] = None,
    ) -> Result: ...
    def closest(self, points: npt.ArrayLike) -> Closest: ...
    def close(self) -> None: ...
    def __enter__(self) -> Solver: ...
    def __exit__(
        self,
        *error: type[BaseException] | BaseException | TracebackType | None,
    ) -> None: ...

@overload
def distance(
    a: _Measured,
    b: _Measured,
    /,
    *,
    tol: _Number | str = 1e-6,
    symmetric: bool = False,
    device: str | SupportsIndex | Device = "",
    time: _Number | None = None,
    waves: SupportsIndex | None = None,
    memory: SupportsIndex | str | None = None,
    disable: _Names = (),
    progress: _Progress | None = None,
    enable: _Names = (),
    preset: _Preset = "",
    field: bool | _Number | str = False,
    statistics: bool = False,
    signed: bool = False,
    bands: _Bands = (),
    effort: SupportsIndex | None = None,
    survey_time: _Number | None = None,
    certificate: _Path | None = None,
    unit_a: _Unit | None = None,
    unit_b: _Unit | None = None,
    transform: npt.ArrayLike | _Path | None = None,
    scale: bool = False,
    align: bool = False,
    on_progress: _OnProgress | None = None,
    max_distance: _Number | str | None = None,
    points: _Points = None,
) -> Result: ...
@overload
def distance(
    va: npt.ArrayLike,
    fa: npt.ArrayLike,
    vb: npt.ArrayLike,
    fb: npt.ArrayLike,
    tol: _Number | str = 1e-6,
    symmetric: bool = False,
    *,
    device: str | SupportsIndex | Device = "",
    time: _Number | None = None,
    waves: SupportsIndex | None = None,
    memory: SupportsIndex | str | None = None,
    disable: _Names = (),
    progress: _Progress | None = None,
    enable: _Names = (),
    preset: _Preset = "",
    field: bool | _Number | str = False,
    statistics: bool = False,
    signed: bool = False,
    bands: _Bands = (),
    effort: SupportsIndex | None = None,
    survey_time: _Number | None = None,
    certificate: _Path | None = None,
    unit_a: _Unit | None = None,
    unit_b: _Unit | None = None,
    transform: npt.ArrayLike | _Path | None = None,
    scale: bool = False,
    align: bool = False,
    on_progress: _OnProgress | None = None,
    max_distance: _Number | str | None = None,
    points: _Points = None,
) -> Result: ...
def align(a: _Measured, b: _Measured, *, device: str | SupportsIndex | Device = "", points: _Points = None) -> Alignment: ...
def closest(b: _Mesh, points: npt.ArrayLike, *, device: str | SupportsIndex | Device = "") -> Closest: ...
def simplify(
    a: _Mesh,
    max: _Number | str,
    *,
    one_way: bool = False,
    lock_borders: bool = False,
    float32: bool = False,
    time: _Number | None = None,
    device: str | SupportsIndex | Device = "",
) -> Simplified: ...
def simplify_levels(
    a: _Mesh,
    max: _Number | str,
    *,
    levels: SupportsIndex = 5,
    ratio: _Number = 0.5,
    one_way: bool = False,
    lock_borders: bool = False,
    float32: bool = False,
    time: _Number | None = None,
    device: str | SupportsIndex | Device = "",
) -> list[Simplified]: ...
class _Results(Iterator[Result]):
    def __next__(self) -> Result: ...
    def close(self) -> None: ...
    def __enter__(self) -> _Results: ...
    def __exit__(
        self,
        *error: type[BaseException] | BaseException | TracebackType | None,
    ) -> None: ...

def devices() -> list[dict[str, Any]]: ...
def distances(
    pairs: Iterable[tuple[_Mesh, _Mesh] | tuple[Any, _Mesh, _Mesh] | _Mesh | tuple[str | int, _Mesh]],
    *,
    against: _Mesh | None = None,
    tol: _Number | str | None = None,
    symmetric: bool = False,
    max: _Number | str | None = None,
    device: str | SupportsIndex = "",
    time: _Number | None = None,
    waves: SupportsIndex | None = None,
    memory: SupportsIndex | str | None = None,
    disable: _Names = (),
    enable: _Names = (),
    preset: _Preset = "",
    together: SupportsIndex | None = None,
    lanes: SupportsIndex | None = None,
    ahead: SupportsIndex | None = None,
    max_input: SupportsIndex | str | None = None,
    polygons: Literal["refuse", "fan", "any"] = "refuse",
    bodies: Literal["solid", "all"] = "solid",
    field: bool | _Number | str = False,
    statistics: bool = False,
    signed: bool = False,
    bands: _Bands = (),
    effort: SupportsIndex | None = None,
    survey_time: _Number | None = None,
    unit_a: _Unit | None = None,
    unit_b: _Unit | None = None,
    transform: npt.ArrayLike | _Path | None = None,
    scale: bool = False,
    align: bool = False,
    points: _Points = None,
    on_progress: _OnProgress | None = None,
    max_distance: _Number | str | None = None,
) -> _Results: ...
def gate(
    a: _Measured,
    b: _Measured,
    max: _Number | str | npt.ArrayLike,
    *,
    tol: _Number | str = 1e-7,
    symmetric: bool = False,
    device: str | SupportsIndex | Device = "",
    time: _Number | None = None,
    waves: SupportsIndex | None = None,
    memory: SupportsIndex | str | None = None,
    disable: _Names = (),
    progress: _Progress | None = None,
    enable: _Names = (),
    preset: _Preset = "",
    field: bool | _Number | str = False,
    statistics: bool = False,
    signed: bool = False,
    bands: _Bands = (),
    area: _Number | str | None = None,
    effort: SupportsIndex | None = None,
    survey_time: _Number | None = None,
    certificate: _Path | None = None,
    unit_a: _Unit | None = None,
    unit_b: _Unit | None = None,
    transform: npt.ArrayLike | _Path | None = None,
    scale: bool = False,
    align: bool = False,
    worst: bool = False,
    on_progress: _OnProgress | None = None,
    max_distance: _Number | str | None = None,
    points: _Points = None,
) -> Result: ...
class Metrics:
    """Figures of two surfaces, each an Interval with an estimate."""

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
    normal_consistency: Interval | None
    precision_normals: dict[float | str, Interval]
    recall_normals: dict[float | str, Interval]
    f1_normals: dict[float | str, Interval]
    # hd95 and hd95_pooled, by the percentile.
    def __getattr__(self, name: str) -> Interval: ...
    def to_dict(self) -> dict[str, Any]: ...
    def to_frame(self) -> Any: ...

def metrics(
    a: _Mesh | npt.NDArray[Any],
    b: _Mesh | npt.NDArray[Any],
    *,
    percentile: _Number | str = 95,
    bands: _Bands = (),
    spacing: npt.ArrayLike | None = None,
    affine: npt.ArrayLike | None = None,
    tol: _Number | str = 1e-6,
    device: str | SupportsIndex | Device = "",
    time: _Number | None = None,
    waves: SupportsIndex | None = None,
    memory: SupportsIndex | str | None = None,
    disable: _Names = (),
    progress: _Progress | None = None,
    enable: _Names = (),
    preset: _Preset = "",
    effort: SupportsIndex | None = None,
    survey_time: _Number | None = None,
    unit_a: _Unit | None = None,
    unit_b: _Unit | None = None,
    transform: npt.ArrayLike | _Path | None = None,
    scale: bool = False,
    on_progress: _OnProgress | None = None,
    figures: _Names = (),
    normals: _Number | None = None,
    empty: Literal["error", "inf"] = "error",
) -> Metrics: ...
def assert_within(a: _Measured, b: _Measured, max: _Number | str | npt.ArrayLike, **options: Any) -> None: ...
def read(path: str | PathLike[str] | npt.NDArray[Any], *, max_input: SupportsIndex | str | None = None,
         polygons: Literal["refuse", "fan", "any"] = "refuse", bodies: Literal["solid", "all"] = "solid",
         points: bool = False) -> Mesh: ...
