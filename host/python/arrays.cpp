#include "host/python/arrays.h"

#include <cstring>
#include <limits>
#include <vector>

#include "host/float_environment.h"

namespace vkh::python {
namespace {

namespace py = pybind11;

[[noreturn]] void refuse(const std::string& what, const std::string& wrong,
                         const std::string& expected) {
  throw py::value_error(what + ": " + wrong + "; expected " + expected);
}

// Text of a Python object, such as a shape or a dtype.
std::string text_of(const py::object& object) { return py::cast<std::string>(py::str(object)); }

// Whatever NumPy takes for an array, of three columns. Rows of none are left to make_mesh.
py::array array_from(const std::string& what, const py::object& object,
                     const std::string& expected) {
  py::array array = py::array::ensure(object);
  if (!array) {
    PyErr_Clear();
    refuse(what, "no array can be made of " + text_of(py::type::of(object)), expected);
  }
  if (array.ndim() != 2 || array.shape(1) != 3)
    refuse(what, "an array of shape " + text_of(array.attr("shape")), expected);
  return array;
}

// A row-major copy in native byte order, where it is not that already.
template <class T>
py::array_t<T, py::array::c_style | py::array::forcecast> as(const py::array& array) {
  return py::array_t<T, py::array::c_style | py::array::forcecast>(array);
}

std::vector<glm::dvec3> vertices_from(const std::string& name, const py::object& object) {
  const std::string what = name + "'s vertices";
  const std::string expected = "an array of shape (n, 3) of float32 or float64";
  const py::array given = array_from(what, object, expected);
  // Wider floats would be rounded, and what is certified would not be what was given.
  const bool is_float = given.dtype().kind() == 'f' &&
                        (given.dtype().itemsize() == 4 || given.dtype().itemsize() == 8);
  if (!is_float) refuse(what, "an array of " + text_of(given.dtype()), expected);
  const auto array = as<double>(given);
  static_assert(sizeof(glm::dvec3) == 3 * sizeof(double));
  std::vector<glm::dvec3> vertices(static_cast<size_t>(array.shape(0)));
  if (!vertices.empty())
    std::memcpy(vertices.data(), array.data(), vertices.size() * sizeof(glm::dvec3));
  return vertices;
}

template <class Integer>
std::vector<glm::uvec3> indices_from(const std::string& what, const py::array& given,
                                     size_t vertex_count) {
  const auto array = as<Integer>(given);
  const Integer* index = array.data();
  std::vector<glm::uvec3> faces(static_cast<size_t>(array.shape(0)));
  for (size_t f = 0; f < faces.size(); ++f) {
    for (int corner = 0; corner < 3; ++corner, ++index) {
      // Compared as unsigned 64-bit numbers, so that negative ones are out of range, too.
      if (static_cast<uint64_t>(*index) >= vertex_count)
        refuse(what, "face " + std::to_string(f) + " has index " + std::to_string(*index),
               "indices below " + std::to_string(vertex_count));
      faces[f][corner] = static_cast<uint32_t>(*index);
    }
  }
  return faces;
}

std::vector<glm::uvec3> faces_from(const std::string& name, const py::object& object,
                                   size_t vertex_count) {
  const std::string what = name + "'s faces";
  const std::string expected = "an array of shape (m, 3) of integers";
  const py::array given = array_from(what, object, expected);
  const char kind = given.dtype().kind();
  if (kind == 'i') return indices_from<int64_t>(what, given, vertex_count);
  if (kind == 'u') return indices_from<uint64_t>(what, given, vertex_count);
  refuse(what, "an array of " + text_of(given.dtype()), expected);
}

}  // namespace

Mesh mesh_from(const std::string& name, const py::object& vertices, const py::object& faces) {
  const FloatEnvironment ours;  // float32 to float64, too, may flush
  std::vector<glm::dvec3> points = vertices_from(name, vertices);
  if (points.size() >= std::numeric_limits<uint32_t>::max())
    refuse(name + "'s vertices", std::to_string(points.size()) + " of them", "fewer than 2^32 - 1");
  std::vector<glm::uvec3> corners = faces_from(name, faces, points.size());
  const py::gil_scoped_release release;  // cleaning a large mesh takes a while
  return make_mesh(name, std::move(points), std::move(corners));
}

}  // namespace vkh::python
