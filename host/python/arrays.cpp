#include "host/python/arrays.h"

#include <array>
#include <cstring>
#include <limits>
#include <type_traits>
#include <vector>

#include "host/base/float_environment.h"
#include "host/python/interpreter.h"

namespace vkh::python {
namespace {

namespace py = pybind11;

[[noreturn]] void refuse(const std::string& what, const std::string& wrong,
                         const std::string& expected) {
  throw py::value_error(what + ": " + wrong + "; expected " + expected);
}

// Text of a Python object, such as a shape or a dtype.
std::string in_words(const py::object& object) { return py::cast<std::string>(py::str(object)); }

// Makes an array of anything that NumPy accepts as one.
py::array array_from(const std::string& what, const py::object& object,
                     const std::string& expected) {
  if (object.is_none()) refuse(what, "None", expected);
  refuse_masked(what, object);
  py::array array = py::array::ensure(object);
  if (!array) {
    PyErr_Clear();
    refuse(what, "no array can be made of " + in_words(py::type::of(object)), expected);
  }
  return array;
}

bool has_columns(const py::array& array, py::ssize_t count) {
  return array.ndim() == 2 && array.shape(1) == count;
}

// Refuses anything but three columns. make_mesh refuses arrays without rows.
void check_columns(const std::string& what, const py::array& array, const std::string& expected) {
  if (!has_columns(array, 3))
    refuse(what, "an array of shape " + in_words(array.attr("shape")), expected);
}

// Makes a row-major copy in native byte order, unless the array is that already.
template <class T>
py::array_t<T, py::array::c_style | py::array::forcecast> as(const py::array& array) {
  return py::array_t<T, py::array::c_style | py::array::forcecast>(array);
}

// The rows of an array, copied before they are looked at: another thread may write to it meanwhile,
// even while this one has the GIL.
template <class T>
std::vector<std::array<T, 3>> rows_of(const py::array& given) {
  const auto array = as<T>(given);
  std::vector<std::array<T, 3>> rows(static_cast<size_t>(array.size()) / 3);
  if (!rows.empty()) std::memcpy(rows.data(), array.data(), rows.size() * sizeof(rows[0]));
  return rows;
}

std::vector<glm::dvec3> floats_from(const py::array& given) {
  const auto array = as<double>(given);
  static_assert(sizeof(glm::dvec3) == 3 * sizeof(double));
  std::vector<glm::dvec3> vertices(static_cast<size_t>(array.size()) / 3);
  if (!vertices.empty())
    std::memcpy(vertices.data(), array.data(), vertices.size() * sizeof(glm::dvec3));
  return vertices;
}

// An array of points, by the words for it in messages.
struct PointsName {
  std::string what, row;
};

// Accepts only integers that float64 holds exactly: others would be rounded, and the certified
// points would not be the given ones.
template <class Integer>
std::vector<glm::dvec3> integers_from(const PointsName& name, const py::array& given) {
  constexpr Integer kMost = Integer{1} << 53;
  const std::vector<std::array<Integer, 3>> rows = rows_of<Integer>(given);
  std::vector<glm::dvec3> vertices(rows.size());
  for (size_t v = 0; v < rows.size(); ++v) {
    for (int axis = 0; axis < 3; ++axis) {
      const Integer value = rows[v][static_cast<size_t>(axis)];
      const bool is_small = value <= kMost && (std::is_unsigned_v<Integer> || value >= -kMost);
      if (!is_small)
        refuse(name.what, name.row + " " + std::to_string(v) + " has " + std::to_string(value),
               "integers of at most 2^53, which float64 has exactly");
      vertices[v][axis] = static_cast<double>(value);
    }
  }
  return vertices;
}

std::vector<glm::dvec3> named_points_from(const PointsName& name, const py::object& object) {
  const std::string expected = "an array of shape (n, 3) of float32, float64 or integers";
  const py::array given = array_from(name.what, object, expected);
  const std::string hint =
      has_columns(given, 2) ? " (points of a plane: add a column of zeros)" : "";
  check_columns(name.what, given, expected + hint);
  const char kind = given.dtype().kind();
  if (kind == 'i') return integers_from<int64_t>(name, given);
  if (kind == 'u') return integers_from<uint64_t>(name, given);
  // Wider floats would be rounded, too.
  const bool is_float =
      kind == 'f' && (given.dtype().itemsize() == 4 || given.dtype().itemsize() == 8);
  if (!is_float) refuse(name.what, "an array of " + in_words(given.dtype()), expected);
  return floats_from(given);
}

template <class Integer>
std::vector<glm::uvec3> indices_from(const std::string& what, const py::array& given,
                                     size_t vertex_count) {
  const std::vector<std::array<Integer, 3>> rows = rows_of<Integer>(given);
  std::vector<glm::uvec3> faces(rows.size());
  for (size_t f = 0; f < faces.size(); ++f) {
    for (int corner = 0; corner < 3; ++corner) {
      const Integer index = rows[f][static_cast<size_t>(corner)];
      // Compared as unsigned 64-bit numbers, so that negative ones are out of range, too.
      if (static_cast<uint64_t>(index) >= vertex_count)
        refuse(what, "face " + std::to_string(f) + " has index " + std::to_string(index),
               "indices below " + std::to_string(vertex_count));
      faces[f][corner] = static_cast<uint32_t>(index);
    }
  }
  return faces;
}

std::vector<glm::uvec3> faces_from(const std::string& name, const py::object& object,
                                   size_t vertex_count) {
  const std::string what = name + "'s faces";
  const std::string expected = "an array of shape (m, 3) of integers";
  const py::array given = array_from(what, object, expected);
  check_columns(what, given, expected);
  const char kind = given.dtype().kind();
  if (kind == 'i') return indices_from<int64_t>(what, given, vertex_count);
  if (kind == 'u') return indices_from<uint64_t>(what, given, vertex_count);
  refuse(what, "an array of " + in_words(given.dtype()), expected);
}

}  // namespace

void refuse_masked(const std::string& what, const py::object& given) {
  py::module_::import("vkhausdorff._meshes").attr("refuse_masked")(what, given);
}

std::vector<DVec3> points_from(const py::object& points) {
  const FloatEnvironment ours;
  return named_points_from({"points", "row"}, points);
}

RawMesh raw_mesh_from(const std::string& name, const py::object& vertices,
                      const py::object& faces) {
  const FloatEnvironment ours;  // float32 to float64, too, may flush
  std::vector<glm::dvec3> points = named_points_from({name + "'s vertices", "vertex"}, vertices);
  if (points.size() >= std::numeric_limits<uint32_t>::max())
    refuse(name + "'s vertices", std::to_string(points.size()) + " of them", "fewer than 2^32 - 1");
  std::vector<glm::uvec3> corners = faces_from(name, faces, points.size());
  return {name, std::move(points), std::move(corners)};
}

Mesh mesh_from(const std::string& name, const py::object& vertices, const py::object& faces) {
  const FloatEnvironment ours;
  RawMesh raw = raw_mesh_from(name, vertices, faces);
  const WithoutGil outside;  // cleaning a large mesh takes a while
  return make_mesh(name, std::move(raw.vertices), std::move(raw.faces));
}

}  // namespace vkh::python
