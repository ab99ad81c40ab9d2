"""Meshes of the Python module's tests: vertices and faces."""
import numpy as np

SQUARE = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], dtype=np.float64)
SQUARE_FACES = np.array([[0, 1, 2], [0, 2, 3]])


def grid(cells, height=0.0, bend=0.1):
    """A wavy height field: (n, 3) float64, (m, 3) int64."""
    t = np.linspace(-1, 1, cells + 1)
    x, y = np.meshgrid(t, t, indexing="ij")
    vertices = np.stack([x, y, bend * np.sin(5 * x) * np.cos(4 * y) + height], axis=-1).reshape(-1, 3)
    corner = np.arange((cells + 1) ** 2).reshape(cells + 1, cells + 1)[:-1, :-1].ravel()
    right, above = corner + 1, corner + cells + 1
    return vertices, np.concatenate([np.stack([corner, right, above], 1), np.stack([right, above + 1, above], 1)])
