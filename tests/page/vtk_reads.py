"""Prints VTK's contents of out.ply and out.glb, as JSON. Run by the interpreter that has VTK; see
readers_test.py.

usage: vtk_reads.py FOLDER
"""

import json
import sys

import vtk
from vtk.util.numpy_support import vtk_to_numpy

FOLDER = sys.argv[1]


def arrays_of(data):
    names = [data.GetArrayName(i) for i in range(data.GetNumberOfArrays())]
    return {name: vtk_to_numpy(data.GetArray(name)).tolist() for name in names if data.GetArray(name)}


def read(reader, name):
    reader.SetFileName(f"{FOLDER}/{name}")
    reader.Update()
    return reader.GetOutput()


def main():
    ply = read(vtk.vtkPLYReader(), "out.ply")
    blocks = read(vtk.vtkGLTFReader(), "out.glb").NewIterator()
    glb = blocks.GetCurrentDataObject()
    json.dump({"ply": {"points": vtk_to_numpy(ply.GetPoints().GetData()).tolist(),
                       "of_points": arrays_of(ply.GetPointData()), "of_faces": arrays_of(ply.GetCellData())},
               "glb": {"points": vtk_to_numpy(glb.GetPoints().GetData()).tolist(), "of_points": arrays_of(glb.GetPointData()),
                       "placed": arrays_of(glb.GetFieldData())["globalTransform"]}}, sys.stdout)


main()
