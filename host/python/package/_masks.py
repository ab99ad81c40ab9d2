"""Surfaces of masks: the faces of voxels between the label and what is not it. Outside of the array is not the label.

A mask of two dimensions has a contour, the edges of pixels. It is measured as a wall as high as a pixel, without floor or
ceiling: the closest point of another wall is at the same height, so that distances are those of the contours, and a share
of a wall's area is the same share of its contour's length.
"""

from fractions import Fraction

import numpy as np

from vkhausdorff import _core
from vkhausdorff._meshes import refuse_masked

_ROUNDING = 2.0**-53


def is_mask(value):
    """Whether it is an array of three dimensions, or of two and booleans: no mesh is, nor are rows of coordinates."""
    return isinstance(value, np.ndarray) and (value.ndim == 3 or (value.ndim == 2 and value.dtype == bool))


def _label(name, mask):
    refuse_masked(name, mask)
    if mask.dtype.kind not in "biu":
        raise TypeError(f"{name}: expected booleans or whole numbers, not {mask.dtype}; make a mask first: image > level")
    return mask != 0


def _refuse_empty(name, label):
    if not label.any():
        raise ValueError(f"{name}: no voxel is set, so that there is no surface; empty='inf' gives inf in place of this")


def _quads(label):
    """The corners of each face between a voxel that is set and one that is not: (n, 4, 3) whole numbers, from outside
    counter-clockwise. Voxel i has the corners i and i + 1 along each axis."""
    padded = np.pad(label.reshape(label.shape + (1,) * (3 - label.ndim)), 1)
    quads = []
    for axis in range(label.ndim):
        ahead, behind = np.moveaxis(padded, axis, 0)[1:], np.moveaxis(padded, axis, 0)[:-1]
        u, v = np.eye(3, dtype=np.int64)[(axis + 1) % 3], np.eye(3, dtype=np.int64)[(axis + 2) % 3]
        for is_face, turn in ((behind & ~ahead, (0, 1, 2, 3)), (ahead & ~behind, (0, 3, 2, 1))):
            at = np.argwhere(np.moveaxis(is_face, 0, axis)).astype(np.int64)
            others = [i for i in range(3) if i != axis]
            at[:, others] -= 1  # of the padding; along the axis the pair of voxels is named by its first
            corners = np.stack([at, at + u, at + u + v, at + v], axis=1)
            quads.append(corners[:, turn])
    return np.concatenate(quads)


def _along_axes(shape, spacing, offset):
    """Coordinates of the corners along each axis, and the largest error of one: exact rational arithmetic finds it."""
    lines, errors = [], []
    for count, step, start in zip(shape, spacing, offset):
        exact = [Fraction(step) * Fraction(2 * k - 1, 2) + Fraction(start) for k in range(count + 1)]
        line = np.array([float(x) for x in exact])
        errors.append(max(abs(Fraction(x) - e) for x, e in zip(line.tolist(), exact)))
        lines.append(line)
    return lines, errors


def _length_up(errors):
    """A double no smaller than the length of a vector with these components."""
    return float(sum(errors)) * (1 + 2**-50)  # a sum of components is no smaller than their root of squares


def _placed(corners, shape, affine):
    """Coordinates of corners (n, 3), and how far each is from its exact place at most."""
    matrix, offset = affine[:3, :3], affine[:3, 3]
    if np.array_equal(matrix, np.diag(np.diag(matrix))):
        lines, errors = _along_axes(shape, np.diag(matrix).tolist(), offset.tolist())
        return np.stack([line[corners[:, i]] for i, line in enumerate(lines)], axis=1), _length_up(errors)
    centres = corners - 0.5  # exact
    places = np.zeros(centres.shape)
    for axis in range(3):
        places += centres[:, axis, None] * matrix[None, :, axis]
    places += offset
    # Three products and three sums, each rounded once, the first sum exactly: fewer than 6 roundings of the sum of sizes.
    sizes = np.abs(centres).max(axis=0) @ np.abs(matrix).T + np.abs(offset)
    return places, _length_up([6 * _ROUNDING * size * (1 + 2**-40) for size in sizes])


def _affine_of(spacing, affine, dimensions):
    refuse_masked("spacing", spacing)
    refuse_masked("affine", affine)
    if affine is None:
        steps = np.array([1.0] * dimensions if spacing is None else spacing, dtype=np.float64)
        if steps.shape != (dimensions,) or not (np.isfinite(steps).all() and (steps > 0).all()):
            raise ValueError(f"spacing: expected {'three' if dimensions == 3 else 'two'} positive numbers")
        heights = [steps.min()] * (3 - dimensions)  # of a contour's wall
        return np.diag([*steps, *heights, 1.0])
    if dimensions != 3:
        raise TypeError("affine: is of masks of three dimensions; spacing has the sizes of a pixel")
    if spacing is not None:
        raise TypeError("spacing: an affine has it; give one of the two")
    matrix = np.array(affine, dtype=np.float64)
    is_affine = matrix.shape == (4, 4) and np.isfinite(matrix).all() and matrix[3].tolist() == [0, 0, 0, 1]
    if not is_affine or np.linalg.det(matrix[:3, :3]) == 0:
        raise ValueError("affine: expected four rows of four numbers, the last 0 0 0 1, that maps voxels to space")
    return matrix


def _surface(name, mask, affine):
    label = _label(name, mask)
    _refuse_empty(name, label)
    quads = _quads(label)
    layers = label.shape + (1,) * (3 - label.ndim)
    shape = np.array(layers) + 1
    flat = np.ravel_multi_index(tuple(quads.reshape(-1, 3).T), shape)
    used, places = np.unique(flat, return_inverse=True)
    corners = np.stack(np.unravel_index(used, shape), axis=1)
    vertices, delta = _placed(corners, layers, affine)
    square = places.reshape(-1, 4).astype(np.uint32)
    if np.linalg.det(affine[:3, :3]) < 0:
        square = square[:, ::-1]
    return _core._surface(vertices, np.concatenate([square[:, [0, 1, 2]], square[:, [0, 2, 3]]]), delta)


def _refuse_shares_of_a_wall(dimensions, bands):
    """A wall's diagonal is not its contour's."""
    if dimensions == 2 and any(isinstance(band, str) and ("%" in band or "diag" in band) for band in bands):
        raise ValueError("bands: of masks of two dimensions they are lengths, not shares of a diagonal")


def surfaces(a, b, spacing, affine, bands, empty):
    """The surfaces of two masks on one grid, as Meshes, and which of the two have none. If one has none and that is no
    error, both Meshes are of one voxel."""
    for name, mask in (("a", a), ("b", b)):
        if not is_mask(mask):
            raise TypeError(f"{name}: expected a mask, an array of three dimensions or one of two and booleans, since the other one is one")
    if a.shape != b.shape:
        raise ValueError(f"b: expected a mask on the grid of the other one, {a.shape}, not {b.shape}")
    matrix = _affine_of(spacing, affine, a.ndim)
    _refuse_shares_of_a_wall(a.ndim, bands)
    missing = tuple(not _label(name, mask).any() for name, mask in (("a", a), ("b", b)))
    if empty == "inf" and any(missing):
        a = b = np.ones((1,) * a.ndim, dtype=bool)
    return (_surface("a", a, matrix), _surface("b", b, matrix)), missing
