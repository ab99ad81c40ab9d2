// NumPy arrays to meshes. Everything that is wrong with an array is a ValueError that names it and
// says what was expected.
#pragma once

#include <pybind11/numpy.h>

#include <string>

#include "host/mesh/mesh.h"

namespace vkh::python {

/// vertices: (n, 3) float32, float64, or integers that float64 has exactly; faces: (m, 3) of any
/// integer type. Copied: nothing of the arrays is kept. Within a Call. `name` is "A" or "B", for
/// messages.
Mesh mesh_from(const std::string& name, const pybind11::object& vertices,
               const pybind11::object& faces);

}  // namespace vkh::python
