// The meshes that Python may pass: arrays, objects with arrays, files, and the class Mesh, which
// holds a file that was read.
#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <optional>
#include <string>

#include "host/answer/steps.h"
#include "host/python/arguments.h"
#include "host/python/arrays.h"
#include "vkhausdorff/mesh_io.h"
#include "vkhausdorff/read_limits.h"

namespace vkh::python {

using MeshPointer = std::shared_ptr<const ReadMesh>;

/// shaped(), in the floating-point environment that it needs.
ShapedMesh kept(MeshPointer mesh);

/// A Mesh of the package's.
pybind11::object mesh_object(MeshPointer mesh);

/// Defines the class Mesh, and read().
void define_mesh(pybind11::module_& m);

/// A file that cannot be opened: Python sees OSError's class for it, such as FileNotFoundError.
struct FileFault {
  int code;
  std::string path;
};
/// Sets the Python exception.
void raise(const FileFault& fault);

/// A mesh as it was given. It holds nothing of Python's.
struct MeshGiven {
  MeshPointer mesh;  ///< a Mesh; otherwise
  std::string file;  ///< to be read; otherwise
  RawMesh arrays;
  bool are_points = false;  ///< of arrays: there are only vertices, and no faces

  uint64_t bytes() const;  ///< the approximate memory that making the mesh takes
};
/// Which meshes of a call are points alone.
struct PointSides {
  bool a = false, b = false;
};
/// Reads a value of the keyword points: None, False, True for A's, "a", "b" or "both".
PointSides point_sides(const pybind11::object& given);
/// Reads the keyword of a call that may have it.
PointSides point_sides(const Arguments& given);

/// Takes a Mesh, a path, (vertices, faces), or an object that has them. Throws a TypeError or
/// ValueError for anything else. `argument` is the caller's name of it, `name` is "A" or "B".
/// `are_points`: takes an array of points, or an object that has .vertices or .points alone, in
/// place of the last two.
MeshGiven mesh_given(const char* argument, const std::string& name, const pybind11::object& object,
                     bool are_points = false);
/// Makes the mesh on any thread. Throws FileFault, what read_mesh and make_mesh throw.
MeshPointer made_mesh(MeshGiven given, const ReadLimits& limits);

/// The path that a str or an os.PathLike names; none for other objects. Throws ValueError that
/// names `argument` for a path of no file.
std::optional<std::string> path_from(const char* argument, const pybind11::object& given);

/// Makes the mesh of such an argument now, within a Call; points with limits.points. Ctrl-C works
/// while a file is read.
MeshPointer mesh_of(const char* argument, const std::string& name, const pybind11::object& object,
                    ReadLimits limits = {});

/// Splits meshes that were given by position as (vertices, faces), for signatures that have
/// vertices and faces as arguments of their own, if the number of values by position fits. `apart`:
/// the names of these arguments.
pybind11::args spread(const pybind11::args& positional, const pybind11::kwargs& named,
                      const std::vector<const char*>& apart);
/// Makes the mesh of arguments that were spread. Points have None as their faces.
MeshPointer mesh_of(const std::string& name, const pybind11::object& vertices,
                    const pybind11::object& faces, bool are_points = false);

}  // namespace vkh::python
