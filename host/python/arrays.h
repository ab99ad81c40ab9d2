// NumPy arrays to meshes. Everything that is wrong with an array is a ValueError that names it and
// says what was expected.
#pragma once

#include <pybind11/numpy.h>

#include <string>
#include <vector>

#include "host/mesh/mesh.h"

namespace vkh::python {

/// What make_mesh takes.
struct RawMesh {
  std::string name;
  std::vector<glm::dvec3> vertices;
  std::vector<glm::uvec3> faces;
};

/// vertices: (n, 3) float32, float64, or integers that float64 has exactly; faces: (m, 3) of any
/// integer type. Copied: nothing of the arrays is kept. `name` is "A" or "B", for messages.
RawMesh raw_mesh_from(const std::string& name, const pybind11::object& vertices,
                      const pybind11::object& faces);
/// Likewise, within a Call.
Mesh mesh_from(const std::string& name, const pybind11::object& vertices,
               const pybind11::object& faces);

}  // namespace vkh::python
