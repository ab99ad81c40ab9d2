// Meshes as Python has them: arrays, objects that have arrays, files, and the class Mesh, which is
// a file that was read.
#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <string>

#include "host/python/arguments.h"
#include "host/python/arrays.h"
#include "host/read/read_limits.h"

namespace vkh::python {

using MeshPointer = std::shared_ptr<const Mesh>;

/// The class Mesh, and read().
void define_mesh(pybind11::module_& m);

/// A file that cannot be opened: Python sees OSError's class for it, such as FileNotFoundError.
struct FileFault {
  int code;
  std::string path;
};
/// Sets the Python exception.
void raise(const FileFault& fault);

/// What a mesh was given as. Nothing of Python's is in it.
struct MeshGiven {
  MeshPointer mesh;  ///< a Mesh; else
  std::string file;  ///< which is to be read; else
  RawMesh arrays;

  uint64_t bytes() const;  ///< of memory that it takes besides, about
};
/// A Mesh, a path, (vertices, faces), or an object that has them. A TypeError or ValueError for
/// what is none. `argument` is what the caller calls it, `name` is "A" or "B".
MeshGiven mesh_given(const char* argument, const std::string& name, const pybind11::object& object);
/// The keyword max_input.
ReadLimits limits_of(const Arguments& given);
/// Anywhere. Throws FileFault, what read_mesh and make_mesh throw.
MeshPointer made_mesh(MeshGiven given, ReadLimits limits);

/// Within a Call: the mesh of such an argument, now. Ctrl-C is heard while a file is read.
MeshPointer mesh_of(const char* argument, const std::string& name, const pybind11::object& object,
                    ReadLimits limits = {});

/// Where only so many values were given by position, and each is a mesh: what they are as
/// (vertices, faces), for signatures that have these apart. `apart`: their names.
pybind11::args spread(const pybind11::args& positional, const pybind11::kwargs& named,
                      const std::vector<const char*>& apart);
/// Of arguments that were spread.
MeshPointer mesh_of(const std::string& name, const pybind11::object& vertices,
                    const pybind11::object& faces);

}  // namespace vkh::python
