// Converts NumPy arrays to meshes. Every error in an array is a ValueError that names it and what
// was expected.
#pragma once

#include <pybind11/numpy.h>

#include <string>
#include <vector>

#include "vkhausdorff/mesh.h"

namespace vkh::python {

/// The input of make_mesh.
struct RawMesh {
  std::string name;
  std::vector<glm::dvec3> vertices;
  std::vector<glm::uvec3> faces;
};

/// vertices: (n, 3) float32, float64, or integers that float64 has exactly; faces: (m, 3) of any
/// integer type. Arrays are copied: nothing of them is kept. `name` is "A" or "B", for messages.
RawMesh raw_mesh_from(const std::string& name, const pybind11::object& vertices,
                      const pybind11::object& faces);
/// Refuses a masked array that hides values, or a list of some: NumPy would show them.
void refuse_masked(const std::string& what, const pybind11::object& given);
/// Takes points as vertices are taken; there may be none.
std::vector<DVec3> points_from(const pybind11::object& points);
/// Does the same as raw_mesh_from and makes the mesh, within a Call.
Mesh mesh_from(const std::string& name, const pybind11::object& vertices,
               const pybind11::object& faces);

}  // namespace vkh::python
