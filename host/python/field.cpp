#include "host/python/field.h"

#include <pybind11/numpy.h>

#include <string>
#include <vector>

#include "host/base/float_environment.h"
#include "host/base/output_file.h"
#include "host/python/arguments.h"
#include "host/python/interpreter.h"
#include "host/python/mesh.h"
#include "vkhausdorff/field_file.h"

namespace vkh::python {
namespace {

namespace py = pybind11;

using Numbers = py::array_t<double, py::array::c_style>;

std::vector<double> vector_of(const Numbers& numbers) {
  return {numbers.data(), numbers.data() + numbers.size()};
}

std::string file_name(const py::object& path) {
  constexpr const char* kExpected = "the path of a file that ends in .ply or .glb";
  std::optional<std::string> file = path_from("path", path);
  if (!file) refuse_type("path", kExpected, path);
  if (!file->ends_with(".ply") && !file->ends_with(".glb")) refuse_value("path", kExpected, path);
  return std::move(*file);
}

/// The contents of a file, except the bounds: (mesh, lower, upper, unit, against).
struct Source {
  MeshPointer mesh;
  Enclosure interval;
  std::string unit, against;
};

Source source_from(const py::tuple& given) {
  return {.mesh = mesh_of("mesh", "A", given[0]),
          .interval = {py::cast<double>(given[1]), py::cast<double>(given[2])},
          .unit = py::cast<std::string>(given[3]),
          .against = py::cast<std::string>(given[4])};
}

void save_field(const py::object& path, const Numbers& lower, const Numbers& upper,
                const py::tuple& about, const py::object& map) {
  const Call call;
  const std::string file = file_name(path);
  constexpr const char* kMaps = "'viridis', 'batlow' or 'cividis'";
  const ColourMap colours = parse_colour_map("map", text_from("map", kMaps, map));
  const Source source = source_from(about);
  const Field field{vector_of(lower), vector_of(upper)};
  if (source.mesh->faces.size() != field.face_count())
    throw py::value_error("mesh: expected " + std::to_string(field.face_count()) +
                          " faces, as the field has, not " +
                          std::to_string(source.mesh->faces.size()));
  const WithoutGil outside;
  const FloatEnvironment ours;
  const OutputFile output("path", file, {source.mesh->name});
  const FieldFile content{.mesh = *source.mesh,
                          .field = field,
                          .interval = source.interval,
                          .unit = source.unit,
                          .against = source.against,
                          .map = colours};
  output.write(file.ends_with(".glb") ? to_glb(content) : to_ply(content));
}

}  // namespace

void define_field(py::module_& m) { m.def("_save_field", save_field); }

}  // namespace vkh::python
