"""Points and triangles of meshes: of objects that have .vertices and .faces (trimesh) or .triangles (Open3D), and of meshio,
PyVista and VTK. Anything else that those hold is refused by name, since a surface of which a part was left out would be
measured as if it were whole."""

import numpy as np

_NO_SURFACE = {"vertex", "line"}  # what meshio has beside faces in files of meshers


def refuse_masked(what, given):
    """ValueError if it hides values under a mask of NumPy's, which an array that is made of it would show."""
    parts = given if isinstance(given, (list, tuple)) else (given,)
    hidden = sum(int(np.ma.getmaskarray(part).sum()) for part in parts if isinstance(part, np.ma.MaskedArray))
    if hidden:
        raise ValueError(f"{what}: a mask hides {hidden} of its values; expected an array without a mask: give the rows that "
                         "count, or .data for all")


def _refuse(found, remedy):
    raise ValueError(f"expected triangles, not {found}: {remedy}")


def _of_meshio(mesh):
    others = sorted(set(mesh.cells_dict) - _NO_SURFACE - {"triangle"})
    if others:
        _refuse(f"cells of type {', '.join(others)}", "triangulate the surface first")
    if "triangle" not in mesh.cells_dict:
        return None, None
    return mesh.points, mesh.cells_dict["triangle"]


def _of_pyvista(mesh):
    try:
        faces = mesh.regular_faces
    except ValueError:
        faces = None
    if faces is None or (len(faces) and faces.shape[1] != 3):
        _refuse("polygons", "call .triangulate()")
    if getattr(mesh, "n_strips", 0):
        _refuse("strips", "call .triangulate()")
    return mesh.points, faces


def _of_vtk(mesh):
    from vtkmodules.util.numpy_support import vtk_to_numpy

    if mesh.GetNumberOfStrips():
        _refuse("strips", "use vtkTriangleFilter")
    polygons = mesh.GetPolys()
    if polygons.GetNumberOfCells() == 0:
        return None, None
    offsets = vtk_to_numpy(polygons.GetOffsetsArray())
    if not np.array_equal(np.diff(offsets), np.full(len(offsets) - 1, 3)):
        _refuse("polygons", "use vtkTriangleFilter")
    return vtk_to_numpy(mesh.GetPoints().GetData()), vtk_to_numpy(polygons.GetConnectivityArray()).reshape(-1, 3)


def points(given):
    """Returns the array of points of an object that has .vertices or .points and no triangles, or what was given."""
    found = next((getattr(given, name) for name in ("vertices", "points") if hasattr(given, name)), None)
    if found is None:
        return given
    faces = next((getattr(given, name) for name in ("faces", "triangles", "regular_faces") if hasattr(given, name)), ())
    cells = getattr(given, "cells_dict", None) or {}
    if len(faces if faces is not None else ()) or set(cells) - {"vertex"}:
        raise ValueError("expected points alone, not a mesh with faces: give its array of points to measure these alone")
    return found


def _faces(mesh):
    faces = getattr(mesh, "faces", None)
    return getattr(mesh, "triangles", None) if faces is None else faces


def lack(given):
    """Says, for the end of a message, what an object has of a mesh and what it lacks, if it has anything."""
    has_vertices, has_faces = getattr(given, "vertices", None) is not None, _faces(given) is not None
    if has_vertices and not has_faces:
        return " that has .vertices and neither .faces nor .triangles"
    return " that has faces and no .vertices" if has_faces and not has_vertices else ""


def arrays(mesh):
    """Returns (points, triangles), or (None, None) for an object that has none."""
    vertices = getattr(mesh, "vertices", None)
    if vertices is not None:
        return vertices, _faces(mesh)
    if hasattr(mesh, "cells_dict") and hasattr(mesh, "points"):
        return _of_meshio(mesh)
    if hasattr(mesh, "regular_faces") and hasattr(mesh, "points"):
        return _of_pyvista(mesh)
    if hasattr(mesh, "GetPolys") and hasattr(mesh, "GetPoints"):
        return _of_vtk(mesh)
    return None, None
