#include "host/python/mesh.h"

#include <pybind11/stl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <chrono>
#include <future>

#include "host/answer/one_of_many.h"
#include "host/answer/steps.h"
#include "host/base/float_environment.h"
#include "host/base/system.h"
#include "host/python/answer.h"
#include "host/python/interpreter.h"
#include "host/python/keywords.h"
#include "host/python/python_tree.h"
#include "host/python/session.h"
#include "host/read/file_mesh_builder.h"
#include "vkhausdorff/error.h"
#include "vkhausdorff/mesh_io.h"

namespace vkh::python {
namespace {

namespace py = pybind11;

/// The class Mesh.
struct FileMesh {
  MeshPointer mesh;
};

// The same error with Python's words for the program's options.
InputError in_python(const InputError& error) {
  constexpr std::string_view kOption = "--points";
  ErrorParts parts = error.parts();
  if (parts.expected == kAMesh)
    parts.expected =
        "a mesh of triangles (STL, OBJ, PLY); points=True measures points, 'b' those of the second "
        "mesh, 'both' those of both";
  if (const size_t at = parts.expected.find(kOption); at != std::string::npos)
    parts.expected.replace(at, kOption.size(), "points=True");
  return InputError(parts);
}

// The system's reason why a file could not be opened; 0: it can be.
int fault_of(const std::string& file) {
  struct stat about {};
  if (stat(file.c_str(), &about) != 0) return errno;
  if (S_ISDIR(about.st_mode)) return EISDIR;
  return access(file.c_str(), R_OK) == 0 ? 0 : errno;
}

ReadMesh read_file(const std::string& file, const ReadLimits& limits) {
  try {
    return read_one_of_many(file, limits);
  } catch (const InputError& error) {
    const int code = fault_of(file);
    if (code != 0) throw FileFault{code, file};
    throw in_python(error);
  }
}

// Reads on another thread, since only this one handles Ctrl-C.
MeshPointer read_now(const std::string& file, ReadLimits limits = {}) {
  constexpr std::chrono::milliseconds kStep(20);
  try {
    const WithoutGil outside;
    std::atomic<bool> goes_on = true;
    limits.keep_going = [&] { return goes_on.load(); };
    auto reading = std::async(std::launch::async, [&] {
      const FloatEnvironment ours;
      return std::make_shared<const ReadMesh>(read_file(file, limits));
    });
    try {
      while (reading.wait_for(kStep) == std::future_status::timeout) hear_signals();
    } catch (...) {
      goes_on = false;
      reading.wait();
      throw;
    }
    return reading.get();
  } catch (const Raised&) {
    throw py::error_already_set();
  }
}

bool is_path(const py::object& object) {
  return py::isinstance<py::str>(object) || py::hasattr(object, "__fspath__");
}

// The bytes by which the system knows a file.
std::string file_from(const char* argument, const py::object& object) {
  const auto path = py::reinterpret_steal<py::object>(PyOS_FSPath(object.ptr()));
  if (!path) throw py::error_already_set();
  const auto bytes = PyUnicode_Check(path.ptr())
                         ? py::reinterpret_steal<py::object>(PyUnicode_EncodeFSDefault(path.ptr()))
                         : path;
  if (!bytes) throw py::error_already_set();
  std::string file = py::cast<std::string>(py::reinterpret_borrow<py::bytes>(bytes));
  if (file.empty() || file.find('\0') != std::string::npos)
    refuse_value(argument, "the path of a file", object);
  return file;
}

bool is_pair(const py::object& object) {
  return (py::isinstance<py::tuple>(object) || py::isinstance<py::list>(object)) &&
         py::len(object) == 2;
}

py::object adapter(const char* name) {
  return py::module_::import("vkhausdorff._meshes").attr(name);
}

// Returns (vertices, faces); None for both if an object has none.
py::tuple arrays_of(const py::object& object) {
  if (is_pair(object)) return py::tuple(object);
  return py::tuple(adapter("arrays")(object));
}

bool has_arrays(const py::tuple& arrays) { return !arrays[0].is_none() && !arrays[1].is_none(); }

bool is_mesh(const py::object& object) {
  return py::isinstance<FileMesh>(object) || is_path(object) || has_arrays(arrays_of(object));
}

// Names the argument of a mesh that holds more than triangles.
py::tuple named_arrays_of(const char* argument, const py::object& object) {
  try {
    return arrays_of(object);
  } catch (const py::error_already_set& error) {
    if (!error.matches(PyExc_ValueError)) throw;
    throw py::value_error(std::string(argument) + ": " + std::string(py::str(error.value())));
  }
}

[[noreturn]] void refuse_mesh(const char* argument, const py::object& object) {
  const std::string given =
      object.is_none() ? "None" : std::string("a value of type ") + Py_TYPE(object.ptr())->tp_name;
  throw py::type_error(std::string(argument) +
                       ": expected (vertices, faces), an object that has .vertices and .faces, "
                       "a mesh of meshio, PyVista or VTK, or the path of a file, not " +
                       given + py::cast<std::string>(adapter("lack")(object)));
}

py::tuple checked_arrays(const char* argument, const py::object& object) {
  py::tuple arrays = named_arrays_of(argument, object);
  if (!has_arrays(arrays)) refuse_mesh(argument, object);
  return arrays;
}

py::array read_only(py::array array) {
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

template <class T, class Row>
py::array view_of(const std::vector<Row>& rows, const py::object& owner) {
  static_assert(sizeof(Row) == 3 * sizeof(T));
  return read_only(py::array_t<T>({static_cast<py::ssize_t>(rows.size()), py::ssize_t{3}},
                                  reinterpret_cast<const T*>(rows.data()), owner));
}

py::array file_faces_of(const Mesh& mesh) {
  const std::vector<uint32_t> faces = mesh.file_faces.of_all(mesh.faces.size());
  return read_only(py::array_t<uint32_t>(static_cast<py::ssize_t>(faces.size()), faces.data()));
}

// Packs runs for pickles: (runs, 2).
py::array runs_of(const FileFaces& faces) {
  const std::vector<FileFaces::Run>& runs = faces.runs();
  static_assert(sizeof(FileFaces::Run) == 2 * sizeof(uint32_t));
  return py::array_t<uint32_t>({static_cast<py::ssize_t>(runs.size()), py::ssize_t{2}},
                               reinterpret_cast<const uint32_t*>(runs.data()));
}

FileFaces file_faces_from(const py::object& state, size_t triangle_count) {
  const auto array = py::cast<py::array_t<uint32_t, py::array::c_style>>(state);
  if (array.ndim() != 2 || array.shape(1) != 2)
    throw py::value_error("this pickle is not of a vkhausdorff.Mesh");
  std::vector<FileFaces::Run> runs;
  for (py::ssize_t i = 0; i < array.shape(0); ++i) runs.push_back({array.at(i, 0), array.at(i, 1)});
  FileFaces faces(std::move(runs));
  if (!faces.is_valid(triangle_count))
    throw py::value_error("this pickle has faces that no mesh of a file has");
  return faces;
}

py::array triangles_of(const Triangulation& one) {
  return py::array_t<uint32_t>({static_cast<py::ssize_t>(one.triangles.size()), py::ssize_t{3}},
                               reinterpret_cast<const uint32_t*>(one.triangles.data()));
}

// Packs polygons for pickles.
py::tuple polygons_state(const Polygons& p) {
  py::list triangulations;
  for (const Triangulation& one : p.triangulations)
    triangulations.append(py::make_tuple(one.face, one.corners, one.axis, triangles_of(one)));
  return py::make_tuple(p.clipped, p.fanned, p.first_fanned, static_cast<int>(p.first_kind),
                        p.ambiguity, p.ambiguous_face, triangulations, p.any_triangulation);
}

Triangulation triangulation_from(const py::tuple& state) {
  Triangulation one{.face = py::cast<uint64_t>(state[0]),
                    .corners = py::cast<uint32_t>(state[1]),
                    .axis = py::cast<int>(state[2])};
  const auto triangles = py::cast<py::array_t<uint32_t, py::array::c_style>>(state[3]);
  const py::ssize_t count = one.axis == Triangulation::kOnlyFan ? 0 : py::ssize_t{one.corners} - 2;
  bool is_valid = one.corners > 3 && one.axis >= 0 && one.axis <= Triangulation::kOnlyFan &&
                  triangles.ndim() == 2 && triangles.shape(0) == count && triangles.shape(1) == 3;
  for (py::ssize_t i = 0; is_valid && i < count; ++i) {
    const UVec3 t{triangles.at(i, 0), triangles.at(i, 1), triangles.at(i, 2)};
    is_valid = t.x < one.corners && t.y < one.corners && t.z < one.corners;
    one.triangles.push_back(t);
  }
  if (!is_valid) throw py::value_error("this pickle has polygons that no mesh of a file has");
  return one;
}

Polygons polygons_from(const py::tuple& state) {
  const int kind = py::cast<int>(state[3]);
  if (kind < 0 || kind > static_cast<int>(PolygonKind::kIntricate))
    throw py::value_error("this pickle is not of a vkhausdorff.Mesh");
  Polygons p{.clipped = py::cast<uint64_t>(state[0]),
             .fanned = py::cast<uint64_t>(state[1]),
             .first_fanned = py::cast<uint64_t>(state[2]),
             .first_kind = static_cast<PolygonKind>(kind),
             .ambiguity = py::cast<double>(state[4]),
             .ambiguous_face = py::cast<uint64_t>(state[5]),
             .any_triangulation = py::cast<bool>(state[7])};
  for (const py::handle& one : py::cast<py::list>(state[6]))
    p.triangulations.push_back(triangulation_from(py::cast<py::tuple>(one)));
  return p;
}

const ReadMesh& mesh_in(const py::object& self) { return *made<FileMesh>(self, "Mesh").mesh; }

py::object path_in(const Mesh& mesh) {
  return py::reinterpret_steal<py::object>(PyUnicode_DecodeFSDefaultAndSize(
      mesh.name.data(), static_cast<py::ssize_t>(mesh.name.size())));
}

py::list notes_state(const ReadMesh& mesh) {
  py::list states;
  for (const Note& n : mesh.notes)
    states.append(py::make_tuple(std::string(code_name(n.code)), n.text, n.value, n.unit, n.face));
  return states;
}

std::vector<Note> notes_from(const py::list& states) {
  std::vector<Note> notes;
  for (const py::handle state : states) {
    const auto [code, text, value, unit, face] =
        py::cast<std::tuple<std::string, std::string, std::optional<double>, std::string,
                            std::optional<uint64_t>>>(state);
    const std::optional<NoteCode> known = code_named(code);
    if (!known) throw py::value_error("this pickle has a note that is not known here");
    notes.push_back({.code = *known, .text = text, .value = value, .unit = unit, .face = face});
  }
  return notes;
}

py::tuple state_of(const py::object& self) {
  const ReadMesh& mesh = mesh_in(self);
  return py::make_tuple(py::bytes(mesh.name), self.attr("vertices"), self.attr("faces"), mesh.delta,
                        mesh.unit, notes_state(mesh), mesh.counts.unreferenced,
                        mesh.counts.polygons, runs_of(mesh.file_faces),
                        polygons_state(mesh.polygons), mesh.has_all_bodies, mesh.are_points);
}

FileMesh mesh_from_state(const py::tuple& state) {
  const Call call;
  if (state.size() != 12) throw py::value_error("this pickle is not of a vkhausdorff.Mesh");
  const bool are_points = py::cast<bool>(state[11]);
  ReadMesh mesh = are_points ? make_points("a pickled Mesh", points_from(state[1]))
                             : mesh_from("a pickled Mesh", state[1], state[2]);
  mesh.name = py::cast<std::string>(state[0]);
  mesh.delta = py::cast<double>(state[3]);
  mesh.unit = py::cast<std::string>(state[4]);
  mesh.notes = notes_from(py::cast<py::list>(state[5]));
  mesh.counts.unreferenced = py::cast<uint64_t>(state[6]);
  mesh.counts.polygons = py::cast<uint64_t>(state[7]);
  mesh.file_faces = file_faces_from(state[8], mesh.faces.size());
  mesh.polygons = polygons_from(state[9]);
  mesh.has_all_bodies = py::cast<bool>(state[10]);
  return {std::make_shared<const ReadMesh>(std::move(mesh))};
}

// The array of points of an object that has .vertices or .points, or the object.
py::object points_array(const char* argument, const py::object& object) {
  try {
    return adapter("points")(object);
  } catch (const py::error_already_set& error) {
    if (!error.matches(PyExc_ValueError)) throw;
    throw py::value_error(std::string(argument) + ": " + std::string(py::str(error.value())));
  }
}

MeshPointer points_of(const char* argument, const std::string& name, const py::object& object) {
  std::vector<DVec3> points = points_from(points_array(argument, object));
  const WithoutGil outside;
  return std::make_shared<const ReadMesh>(make_points(name, std::move(points)));
}

void refuse_faces(const char* argument, const Mesh& mesh) {
  if (!mesh.are_points)
    throw py::value_error(std::string(argument) +
                          ": a Mesh with faces; expected points alone, as read(path, points=True) "
                          "returns them");
}

FileMesh read(const py::args& positional, const py::kwargs& named) {
  static const auto* signature =
      new Signature(signature_of(kPyRead, "read", {"path", "points"}, 1, 1));
  const Call call;
  const Arguments given(*signature, positional, named);
  const py::object& path = given.at("path");
  ReadLimits limits = request_of(kPyRead, "read", given).question.limits;
  limits.points = given.flag("points");
  if (is_path(path)) return {read_now(file_from("path", path), limits)};
  if (!limits.points)
    refuse_type("path", "the path of a mesh file; with points=True, or an array of points", path);
  return {points_of("path", "points", path)};
}

/// A mesh whose coordinates are each within `delta` of their exact place.
FileMesh surface_of(const py::object& vertices, const py::object& faces, double delta) {
  const Call call;
  Mesh mesh = mesh_from("a mask", vertices, faces);
  mesh.delta = delta;
  return {std::make_shared<const ReadMesh>(std::move(mesh))};
}

template <class Get>
auto of_mesh(Get get) {
  return [get](const py::object& self) { return get(mesh_in(self)); };
}

}  // namespace

py::object mesh_object(MeshPointer mesh) { return py::cast(FileMesh{std::move(mesh)}); }

constexpr const char* kReadText =
    "The Mesh of a file: OBJ, STL, PLY, OFF, glTF, GLB or 3MF, told by its content. OSError\n"
    "where it cannot be opened, ValueError with file and place where it is wrong. A part of\n"
    "a file never passes for the whole. max_input: bytes, or '100M': a larger file is refused,\n"
    "and one whose mesh takes more, 24 bytes a vertex and 12 a face. polygons: 'fan' measures\n"
    "the fan of a polygon whose outline crosses itself or encloses no area; else it is "
    "refused.\n"
    "bodies: 'all' measures everything as it lies, also modifiers, negative volumes, what is "
    "not\n"
    "printed, and hidden nodes; 'solid' what is printed as body, or shown. points: the file "
    "has\n"
    "no faces and is points alone: PLY, OBJ, OFF, XYZ, PTS or LAS; or path is an array (n, 3) "
    "of\n"
    "them. A file with faces is refused then.";

void define_mesh(py::module_& m) {
  py::class_<FileMesh>(m, "Mesh",
                       "A mesh file as it was read. It goes wherever a mesh is expected, and is "
                       "not\ncopied there. Never changes: its arrays are read-only.")
      .def_property_readonly(
          "vertices",
          [](const py::object& self) { return view_of<double>(mesh_in(self).vertices, self); },
          "(n, 3) float64, the vertices that a face uses; read-only")
      .def_property_readonly(
          "faces",
          [](const py::object& self) { return view_of<uint32_t>(mesh_in(self).faces, self); },
          "(m, 3) uint32, polygons fanned into triangles, in the file's order; read-only")
      .def_property_readonly(
          "file_faces", of_mesh(file_faces_of),
          "(m,) uint32, of each triangle the face of the file that it is of, counted from 0 "
          "before\n"
          "polygons are fanned, as the program prints it; made at each call, read-only")
      .def_property_readonly("path", of_mesh(path_in), "as it was given")
      .def_property_readonly("unit", of_mesh([](const Mesh& mesh) {
                               return mesh.unit.empty() ? std::optional<std::string>() : mesh.unit;
                             }),
                             "of the coordinates, where the file says it: 'mm', 'm', 'in'; else "
                             "None.\nLengths are never converted")
      .def_property_readonly("delta", of_mesh([](const Mesh& mesh) { return mesh.delta; }),
                             "no vertex is farther from its exact place: what transforms of a "
                             "scene round.\nIntervals are wider by it")
      .def_property_readonly("counts",
                             of_mesh([](const Mesh& mesh) { return counts_dict(mesh.counts); }),
                             "what was counted: vertices, faces, unreferenced, degenerate, "
                             "duplicate, polygons")
      .def_property_readonly("are_points",
                             of_mesh([](const Mesh& mesh) { return mesh.are_points; }),
                             "whether it is points alone: each is a face whose three corners it is")
      .def_property_readonly("notes",
                             of_mesh([](const ReadMesh& mesh) { return lines_of(mesh.notes); }),
                             "a line each, for people: what was left out, fanned or rounded")
      .def("__repr__", of_mesh([](const Mesh& mesh) {
             return "<vkhausdorff.Mesh " + py::cast<std::string>(py::repr(path_in(mesh))) + ", " +
                    std::to_string(mesh.faces.size()) + (mesh.are_points ? " points>" : " faces>");
           }))
      .def(py::pickle([](const py::object& self) { return state_of(self); },
                      [](const py::tuple& state) { return mesh_from_state(state); }));
  m.def("_surface", surface_of,
        "_surface(vertices, faces, delta): the Mesh of rounded coordinates, each off by up to "
        "delta.");
  m.def("read", read,
        ("read(path, *, points=False, " + keywords_text(kPyRead, {"points"}) + ")\n--\n\n" +
         kReadText)
            .c_str());
}

void raise(const FileFault& fault) {
  const auto path = py::reinterpret_steal<py::object>(PyUnicode_DecodeFSDefaultAndSize(
      fault.path.data(), static_cast<py::ssize_t>(fault.path.size())));
  errno = fault.code;
  PyErr_SetFromErrnoWithFilenameObject(PyExc_OSError, path.ptr());
}

uint64_t MeshGiven::bytes() const {
  if (mesh != nullptr) return 0;
  if (!file.empty()) return kBytesOfAByte * file_bytes(path_of(file));
  return mesh_bytes(arrays.vertices.size(), arrays.faces.size());
}

PointSides point_sides(const py::object& given) {
  constexpr const char* kExpected = "True for a, 'a', 'b' or 'both', or None";
  if (given.is_none()) return {};
  if (is_bool(given)) return {.a = py::cast<bool>(given)};
  const std::string text = text_from("points", kExpected, given);
  if (text != "a" && text != "b" && text != "both") refuse_value("points", kExpected, given);
  return {.a = text != "b", .b = text != "a"};
}

PointSides point_sides(const Arguments& given) {
  const py::object* points = given.find("points");
  return points == nullptr ? PointSides() : point_sides(*points);
}

MeshGiven mesh_given(const char* argument, const std::string& name, const py::object& object,
                     bool are_points) {
  if (py::isinstance<FileMesh>(object)) {
    MeshPointer mesh = made<FileMesh>(object, "Mesh").mesh;
    if (are_points) refuse_faces(argument, *mesh);
    return {.mesh = std::move(mesh), .file = {}, .arrays = {}};
  }
  if (is_path(object)) return {.mesh = {}, .file = file_from(argument, object), .arrays = {}};
  if (are_points) {
    std::vector<DVec3> points = points_from(points_array(argument, object));
    return {.mesh = {}, .file = {}, .arrays = {name, std::move(points), {}}, .are_points = true};
  }
  const py::tuple arrays = checked_arrays(argument, object);
  return {.mesh = {}, .file = {}, .arrays = raw_mesh_from(name, arrays[0], arrays[1])};
}

MeshPointer made_mesh(MeshGiven given, const ReadLimits& limits) {
  if (given.mesh != nullptr) return given.mesh;
  if (!given.file.empty()) return std::make_shared<const ReadMesh>(read_file(given.file, limits));
  RawMesh& raw = given.arrays;
  if (given.are_points)
    return std::make_shared<const ReadMesh>(make_points(raw.name, std::move(raw.vertices)));
  return std::make_shared<const ReadMesh>(
      make_mesh(raw.name, std::move(raw.vertices), std::move(raw.faces)));
}

std::optional<std::string> path_from(const char* argument, const py::object& given) {
  if (!is_path(given)) return std::nullopt;
  return file_from(argument, given);
}

MeshPointer mesh_of(const char* argument, const std::string& name, const py::object& object,
                    ReadLimits limits) {
  if (py::isinstance<FileMesh>(object)) {
    MeshPointer mesh = made<FileMesh>(object, "Mesh").mesh;
    if (limits.points) refuse_faces(argument, *mesh);
    return mesh;
  }
  if (is_path(object)) return read_now(file_from(argument, object), std::move(limits));
  if (limits.points) return points_of(argument, name, object);
  const py::tuple arrays = checked_arrays(argument, object);
  return std::make_shared<const ReadMesh>(mesh_from(name, arrays[0], arrays[1]));
}

namespace {

bool is_list_of_rows(const py::object& object) {
  return py::isinstance<py::array>(object) || py::isinstance<py::list>(object) ||
         py::isinstance<py::tuple>(object);
}

// If a mesh stands for two arguments, refuses values that are neither a mesh nor one of these.
void refuse_strange_meshes(const py::args& positional, const PointSides& points, bool is_b) {
  for (size_t i = 0; i < positional.size(); ++i) {
    const py::object given = positional[i];
    const bool are_points = i == 0 ? points.a : points.b;
    if (!are_points && !is_mesh(given) && !is_list_of_rows(given))
      refuse_mesh(is_b || i == 1 ? "b" : "a", given);
  }
}

// Refuses points without the word for them, beside a mesh: 'vb' would be missing otherwise.
void refuse_bare_points(const py::args& positional, const std::vector<const char*>& apart) {
  const auto is_whole = [](const py::object& object) {
    return py::isinstance<FileMesh>(object) || is_path(object) || is_pair(object);
  };
  if (positional.size() != 2 || apart.size() != 4) return;
  for (size_t i = 0; i < 2; ++i) {
    const py::object given = positional[i], other = positional[1 - i];
    if (!py::isinstance<py::array>(given) || !is_whole(other)) continue;
    throw py::type_error(std::string(i == 0 ? "a" : "b") +
                         ": expected a mesh, such as (vertices, faces); of points alone " +
                         (i == 0 ? "points=True" : "points='b'") + " says so");
  }
}

}  // namespace

py::args spread(const py::args& positional, const py::kwargs& named,
                const std::vector<const char*>& apart) {
  bool are_meshes = positional.size() == apart.size() / 2;
  for (size_t i = 0; i < apart.size(); ++i) are_meshes = are_meshes && !named.contains(apart[i]);
  const bool may_be_meshes = are_meshes;
  const PointSides sides =
      named.contains("points") ? point_sides(py::object(named["points"])) : PointSides();
  const auto is_points = [&](size_t i) { return i == 0 ? sides.a : sides.b; };
  for (size_t i = 0; are_meshes && i < positional.size(); ++i)
    are_meshes = is_points(i) || is_mesh(positional[i]);
  if (may_be_meshes && !are_meshes)
    refuse_strange_meshes(positional, sides, apart.front() == std::string_view("vb"));
  if (may_be_meshes && !are_meshes) refuse_bare_points(positional, apart);
  if (!are_meshes) return positional;
  py::list values;
  for (size_t i = 0; i < positional.size(); ++i) {
    py::object object = positional[i];
    if (is_points(i)) {
      values.append(object);
      values.append(py::none());
      continue;
    }
    if (is_path(object)) object = py::cast(FileMesh{read_now(file_from("path", object))});
    const bool is_whole = py::isinstance<FileMesh>(object);
    const py::tuple arrays = is_whole ? py::make_tuple(object, py::none()) : arrays_of(object);
    values.append(arrays[0]);
    values.append(arrays[1]);
  }
  return py::args(py::tuple(values));
}

MeshPointer mesh_of(const std::string& name, const py::object& vertices, const py::object& faces,
                    bool are_points) {
  const bool is_a = name == "A";
  if (are_points && !faces.is_none()) refuse_type(is_a ? "fa" : "fb", "None beside points", faces);
  if (are_points) return mesh_of(is_a ? "va" : "vb", name, vertices, ReadLimits{.points = true});
  if (faces.is_none() && py::isinstance<FileMesh>(vertices))
    return made<FileMesh>(vertices, "Mesh").mesh;
  return std::make_shared<const ReadMesh>(mesh_from(name, vertices, faces));
}

ShapedMesh kept(MeshPointer mesh) {
  const FloatEnvironment ours;
  return shaped(std::move(mesh));
}

}  // namespace vkh::python
