// vkhausdorff._core: the compiled part of the Python package vkhausdorff: distance, Solver, and
// gate for arrays.
#include <pybind11/pybind11.h>

#include "engine/vkhausdorff.h"
#include "host/python/errors.h"
#include "host/python/field.h"
#include "host/python/interpreter.h"
#include "host/python/keywords.h"
#include "host/python/many.h"
#include "host/python/python_tree.h"
#include "host/python/solver.h"
#include "vkhausdorff/device.h"

namespace vkh::python {
namespace {

namespace py = pybind11;

/// A function's text: its signature as inspect.signature reads it, whose last keywords are those of
/// the table, and what it does.
std::string documented(const std::string& begin, Functions function,
                       const std::vector<std::string>& own, const char* text) {
  return begin + keywords_text(function, own) + ")\n--\n\n" + text;
}

constexpr const char* kDistanceText =
    "Encloses h(A,B), the largest distance of a point of A from B, or with symmetric=True\n"
    "max(h(A,B), h(B,A)), in a certified interval. distance(a, b) takes two meshes: what "
    "read()\n"
    "returns, paths of files, (vertices, faces), or objects with .vertices and .faces.\n\n"
    "va, vb: (n, 3) float32, float64 or integers up to 2^53; fa, fb: (m, 3) integers. tol: "
    "a\n"
    "fraction of the diagonal of A's bounding box, or a string such as '0.1%' or '0.01abs'.\n"
    "time: seconds; memory: bytes or '2GiB'; device: '', 'gpu', 'cpu', 'native', an index,\n"
    "part of a name or a Device. progress(wave, lower, upper) hears the search alone;\n"
    "on_progress(fraction, lower, upper) all work: the fraction grows to 1, which comes "
    "last, "
    "and\n"
    "the interval of the answer narrows. Either may return False to cancel. preset: "
    "'default',\n"
    "'paper' or 'baseline-gpu'; enable, disable: lists of switches, besides. The interval "
    "is\n"
    "true no matter what ended it. TypeError or ValueError for wrong arguments, DeviceError "
    "for\n"
    "the device. Ctrl-C ends a run.\n\n"
    "field: also enclose the largest distance on each face of A (and of B if symmetric), to "
    "1 %\n"
    "of the largest, or to so much: a width as tol is. statistics: also enclose the mean "
    "over\n"
    "A's area, the root mean square, percentiles and the whole distribution. bands: "
    "distances "
    "in\n"
    "the coordinates' unit, or strings as tol's: also enclose the share of A's area within "
    "each.\n"
    "signed: also tell where A is over B, in front of its faces as they are oriented, and "
    "where\n"
    "under it; with statistics also the signed mean and percentiles. ValueError where two "
    "faces\n"
    "of B are oriented against each other.\n"
    "effort: the cells of each mesh that these may bound, besides each face once; the same\n"
    "number gives the same bits on a device. None: 4000000 on a CPU, 10000000 on a GPU.\n"
    "max_distance: leave out of the statistics what is farther from B, such as a scan's "
    "strays;\n"
    "survey.kept is the share that they are of. The distance and verdicts are of all of A.\n"
    "survey_time: the seconds that they may take of each mesh, besides time; None for no "
    "limit.\n\n"
    "certificate: a path that ends in .vhc: also write a proof of the interval, which "
    "vkh_check\n"
    "checks for files that have the arrays' faces, in their order. What it proves is in\n"
    "stats['certificate']; None, and no file, where the run ended before it had an upper "
    "bound.\n\n"
    "unit_a, unit_b: what A and B are in, 'um', 'mm', 'cm', 'm', 'in' or 'ft'; where they "
    "differ, A\n"
    "is converted to B's unit. transform: a matrix that then places A, four rows of four "
    "numbers,\n"
    "the last 0 0 0 1, or the path of a text file that has them; scale=True allows one that\n"
    "stretches by more than 1e-6. The rounding of both widens the interval. align: then lay "
    "A "
    "onto\n"
    "B as align() does; stats['transform'] has the matrix.\n\n"
    "points: True or 'a': A is points alone, an array (n, 3), an object that has .vertices "
    "or\n"
    ".points and no faces, or the path of such a file; 'b' says so of B, 'both' of both.";

void define_distance(py::module_& m) {
  m.def("distance", distance,
        documented("distance(va, fa, vb, fb, tol=1e-6, symmetric=False, *, progress=None, "
                   "on_progress=None, ",
                   kPyDistance, {"tol", "symmetric"},
                   (kDistanceText + more_text(kPyDistance, kDistanceText)).c_str())
            .c_str());
}

py::list devices() {
  const Call call;
  std::vector<DeviceDescription> all;
  {
    const WithoutGil outside;
    all = list_devices();
  }
  py::list devices;
  for (const DeviceDescription& d : all) {
    py::dict device = device_dict(d);
    device["usable"] = d.usable;
    device["reason"] = d.reason.empty() ? py::object(py::none()) : py::object(py::str(d.reason));
    devices.append(device);
  }
  return devices;
}

void define_devices(py::module_& m) {
  m.def("devices", devices,
        "devices()\n--\n\n"
        "The Vulkan devices here: a list of dicts of index, name, type, driver, api_version,\n"
        "memory_bytes, usable, and reason, why it is not usable, or None.");
}

void define_key(py::module_& m) {
  m.def("_key", key_of_keywords, "_key(function, **keywords)\n--\n\nFor tests.");
}

void define_gate(py::module_& m) {
  m.def("gate", gate,
        documented("gate(a, b, max, *, progress=None, on_progress=None, ", kPyGate, {"max"},
                   "Whether h(A,B) <= max, proven either way: the result's verdict.")
            .c_str());
}

void define_metrics(py::module_& m) {
  m.def("_metrics", metrics,
        documented("_metrics(a, b, *, progress=None, on_progress=None, ", kPyMetrics, {},
                   "As vkhausdorff.metrics, of meshes: a Result with stats['metrics'].")
            .c_str());
}

void define_simplify(py::module_& m) {
  m.def(
      "simplify", simplified,
      documented(
          "simplify(a, max, *, float32=False, ", kPySimplify, {"max"},
          "A mesh of fewer faces that is proven to be within max of A, both ways: a Simplified.\n\n"
          "a: a mesh, as gate() takes it; max: a positive number in the coordinates' unit, or a\n"
          "string such as '0.1%' of A's diagonal. one_way: limits the points of A alone.\n"
          "lock_borders: keeps each vertex of an edge that only one face has. float32: the "
          "vertices\n"
          "are float32, and judged so. time: seconds for the search; what passed by then is\n"
          "returned, and TimeoutError says that nothing did. The distance alone is proven, "
          "neither\n"
          "that the result is watertight nor how its faces are turned.")
          .c_str());
  m.def(
      "simplify_levels", simplified_levels,
      documented(
          "simplify_levels(a, max, *, levels=5, ratio=0.5, float32=False, ", kPySimplify, {"max"},
          "A chain of ever coarser meshes, each with its proven distance from A itself: a list of\n"
          "Simplified, the finest first.\n\n"
          "levels: how many at most; ratio: the share of faces from one to the next, the first\n"
          "having this share of A's. The chain ends before a level that is not proven to be within "
          "max\n"
          "of A, and is empty where the first is not. The other arguments are those of "
          "simplify();\n"
          "complete is False on the last level where time ended the chain, and TimeoutError says\n"
          "that there was none by then.")
          .c_str());
}

void define_align(py::module_& m) {
  m.def("align", align,
        "align(a, b, *, device='', points=None)\n--\n\n"
        "The rotation and shift that lay A onto B: a fit that is found, not proven the best.\n\n"
        "a, b, points: as distance() takes them. Returns an Alignment, whose matrix is for\n"
        "transform=; distance(a, b, align=True) does both. It begins where A lies, and with A's\n"
        "principal axes on B's; the nearest 80 % of A's samples decide, so that a scan may lack\n"
        "parts or have others. The same meshes give the same bits on the same device.");
}

void define_closest(py::module_& m) {
  m.def(
      "closest", closest,
      "closest(b, points, *, device='')\n--\n\n"
      "The point of mesh B closest to each point, and its distance in a certified interval.\n\n"
      "b: a mesh, as distance() takes it; points: (n, 3) float32, float64 or integers up to 2^53,\n"
      "in B's coordinates. Returns a Closest with arrays lower, upper, points and faces; also\n"
      "distances, points, faces = closest(b, points), the distances being upper. ValueError that\n"
      "names the row if a point is not finite. For many calls with one B: Solver(b).closest.\n"
      "device: as distance() takes it, or several between commas such as '0,1', or 'all', every\n"
      "GPU: each takes some of the points, and a point's answer is that of the one that took it.");
}

py::dict info_of(const py::object& self) {
  const Call call;
  return device_dict(made<PythonDevice>(self, "Device").session()->description());
}

void define_device(py::module_& m) {
  py::class_<PythonDevice>(
      m, "Device",
      "A device that stays open, for many Solvers and calls, one run at a time:\n"
      "with Device() as d: s = Solver(b, device=d); r = distance(a, b, device=d)\n"
      "After a DeviceError that says that it was lost, the next call opens it anew, and each\n"
      "Solver prepares its mesh again.")
      .def(py::init<const py::args&, const py::kwargs&>(), "__init__(self, device='')\n--\n\n")
      .def_property_readonly(
          "info", info_of,
          "a dict of index, name, type, driver, api_version and memory_bytes, as "
          "devices() has them")
      .def(
          "close", [](const py::object& self) { made<PythonDevice>(self, "Device").close(); },
          "close(self)\n--\n\n"
          "Frees the device and what its Solvers keep there; what is called later is a "
          "ValueError.\n"
          "Waits for runs of other threads. In a run's own callback it waits for nothing: that "
          "run\n"
          "is the last.")
      .def(
          "__enter__", [](py::object self) { return self; }, "__enter__(self)\n--\n\n")
      .def(
          "__exit__",
          [](const py::object& self, const py::args&) {
            made<PythonDevice>(self, "Device").close();
          },
          "__exit__(self, *error)\n--\n\n")
      .def("__repr__", [](const py::object& self) {
        return "<vkhausdorff.Device " + py::cast<std::string>(py::repr(info_of(self)["name"])) +
               ">";
      });
}

void define_solver(py::module_& m) {
  py::class_<PythonSolver>(m, "Solver",
                           "Mesh B on the device, its hierarchy built once, for many A's:\n"
                           "with Solver(vb, fb) as s: r = s.distance(va, fa)\n"
                           "Solver(b) and s.distance(a) take meshes, as vkhausdorff.distance.\n"
                           "device: one, or several as closest() takes them: B is on each,\n"
                           "closest() uses all, and distance() the first.")
      .def(py::init<const py::args&, const py::kwargs&>(),
           "__init__(self, vb, fb, device='')\n--\n\n")
      .def(
          "distance",
          [](const py::object& self, const py::args& positional, const py::kwargs& named) {
            return made<PythonSolver>(self, "Solver").distance(positional, named);
          },
          documented("distance(self, va, fa, tol=1e-6, *, progress=None, on_progress=None, ",
                     kPySolver, {"tol"}, "As vkhausdorff.distance, from A to the Solver's B.")
              .c_str())
      .def(
          "closest",
          [](const py::object& self, const py::args& positional, const py::kwargs& named) {
            return made<PythonSolver>(self, "Solver").closest(positional, named);
          },
          "closest(self, points)\n--\n\nAs vkhausdorff.closest, of the Solver's B.")
      .def(
          "close", [](const py::object& self) { made<PythonSolver>(self, "Solver").close(); },
          "close(self)\n--\n\n"
          "Frees the device; what is called later is a ValueError. Waits for runs of "
          "other threads.\nIn a run's own callback it waits for nothing: that run is the last. "
          "On a Device\nthat it was given it frees B alone, after the runs that have it.")
      .def(
          "__enter__", [](py::object self) { return self; }, "__enter__(self)\n--\n\n")
      .def(
          "__exit__",
          [](const py::object& self, const py::args&) {
            made<PythonSolver>(self, "Solver").close();
          },
          "__exit__(self, *error)\n--\n\n");
}

}  // namespace
}  // namespace vkh::python

PYBIND11_MODULE(_core, m) {
  namespace py = pybind11;
  using namespace vkh::python;
  const py::object own_name = m.attr("__name__");
  m.attr("__name__") = "vkhausdorff";  // the package's name, for all that is defined below
  m.doc() = "Certified Hausdorff distance between triangle meshes, on the GPU (Vulkan).";
  m.attr("__version__") = VKH_VERSION_STRING;
  define_errors(m);
  py::options quiet;
  // (*args, **kwargs) is no information: the texts have them, as inspect.signature reads them.
  quiet.disable_function_signatures();
  define_result(m);
  define_distance(m);
  define_devices(m);
  define_gate(m);
  define_key(m);
  define_metrics(m);
  define_align(m);
  define_closest(m);
  define_simplify(m);
  define_device(m);
  define_solver(m);
  define_mesh(m);
  define_many(m);
  define_field(m);
  m.attr("__name__") = own_name;
  watch_interpreter();
  py::module_::import("atexit").attr("register")(
      py::cpp_function([] { end_interpreter(end_streams, free_devices); }));
}
