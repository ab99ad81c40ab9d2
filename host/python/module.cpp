// The Python module: vkhausdorff.distance and vkhausdorff.Solver.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <map>
#include <memory>

#include "host/decimal.h"
#include "host/error.h"
#include "host/float_environment.h"
#include "host/options.h"
#include "host/python/answer.h"
#include "host/python/arrays.h"
#include "host/python/session.h"

namespace vkh::python {
namespace {

namespace py = pybind11;
using py::literals::operator""_a;

/// What a run may cost and how narrow it has to be; the keywords of both functions.
struct Limits {
  py::object tol, time, waves, memory, disable, progress, enable;
  std::string preset;
};

// A string says more than a number can: "0.1%", "0.01abs"; the program's rules hold.
SolveOptions options_of(const Limits& limits) {
  const FloatEnvironment ours;
  SolveOptions options;
  if (py::isinstance<py::str>(limits.tol)) {
    const Tolerance tolerance = parse_tolerance(py::cast<std::string>(limits.tol));
    options.tolerance = tolerance.value;
    options.tolerance_is_absolute = tolerance.is_absolute;
  } else {
    options.tolerance = py::cast<double>(limits.tol);
  }
  if (!limits.time.is_none()) {
    options.time_limit_s = py::cast<double>(limits.time);
    if (!(options.time_limit_s >= 0)) throw UsageError("time must be 0 or more seconds");
  }
  if (!limits.waves.is_none()) options.wave_limit = py::cast<uint32_t>(limits.waves);
  if (py::isinstance<py::str>(limits.memory)) {
    options.memory_bytes = parse_memory(py::cast<std::string>(limits.memory));
  } else if (!limits.memory.is_none()) {
    options.memory_bytes = py::cast<uint64_t>(limits.memory);
  }
  options.preset = limits.preset;
  options.enabled = py::cast<std::vector<std::string>>(limits.enable);
  options.disabled = py::cast<std::vector<std::string>>(limits.disable);
  listen_to(limits.progress, options);
  return options;
}

/// One session a device, kept between calls of distance(): making one takes longer than most runs.
std::map<std::string, std::unique_ptr<Session>>& sessions() {
  static std::map<std::string, std::unique_ptr<Session>> kept;
  return kept;
}

Session& session_for(const std::string& device) {
  const auto known = sessions().find(device);
  if (known != sessions().end()) return *known->second;
  auto made = std::make_unique<Session>(device);  // without the GIL: another may be first
  return *sessions().try_emplace(device, std::move(made)).first->second;
}

// KeyboardInterrupt that came too late to be heard by a run is raised after it.
Answer answered(const std::function<Answer()>& answer) {
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  return answer();
}

Answer distance(const py::object& va, const py::object& fa, const py::object& vb,
                const py::object& fb, bool symmetric, const std::string& device,
                const Limits& limits) {
  const SolveOptions options = options_of(limits);
  const Mesh a = mesh_from("A", va, fa);
  const Mesh b = mesh_from("B", vb, fb);
  Session& session = session_for(device);
  if (symmetric) {
    SymmetricReport both;
    session.use([&](Solver& solver) { both = solver.symmetric(a, b, options); });
    return answered([&] { return answer_of(both); });
  }
  Report report;
  session.use([&](Solver& solver) { report = solver.distance(a, b, options); });
  return answered([&] { return answer_of(report); });
}

/// Mesh B, prepared on a device of its own session.
class PythonSolver {
 public:
  PythonSolver(const py::object& vb, const py::object& fb, const std::string& device) {
    Mesh b = mesh_from("B", vb, fb);
    session_ = std::make_shared<Session>(device);
    session_->use([&](Solver& solver) { prepared_.emplace(solver.prepare(std::move(b))); });
  }

  Answer distance(const py::object& va, const py::object& fa, const Limits& limits) {
    check_open();
    const SolveOptions options = options_of(limits);
    const Mesh a = mesh_from("A", va, fa);
    check_open();  // another thread may have closed it meanwhile
    const std::shared_ptr<Session> session = session_;
    Report report;
    session->use([&](Solver& solver) {
      if (!prepared_) throw py::value_error(kClosed);
      report = solver.distance(a, *prepared_, options);
    });
    return answered([&] { return answer_of(report); });
  }

  /// Waits for a run of another thread.
  void close() {
    const std::shared_ptr<Session> session = std::move(session_);
    if (session == nullptr) return;
    session->use([&](Solver&) { prepared_.reset(); });
  }
  ~PythonSolver() { close(); }
  PythonSolver(const PythonSolver&) = delete;
  PythonSolver& operator=(const PythonSolver&) = delete;

 private:
  static constexpr const char* kClosed = "this Solver is closed";
  void check_open() const {
    if (session_ == nullptr) throw py::value_error(kClosed);
  }

  std::shared_ptr<Session> session_;  // shared with the calls in flight on other threads
  std::optional<PreparedMesh> prepared_;
};

std::string text_of(const Answer& r) {
  const FloatEnvironment ours;
  std::string text = "<vkhausdorff.Result [";
  text += decimal(r.lower, 9, Rounding::kDown) + ", ";
  text += decimal(r.upper, 9, Rounding::kUp) + "] ";
  return text + status_name(r.status) + ">";
}

py::tuple point_of(const SurfacePoint& p) {
  return py::make_tuple(p.point.x, p.point.y, p.point.z);
}

void define_result(py::module_& m) {
  py::class_<Answer>(m, "Result", "A certified interval and what proves its lower end.")
      .def_readonly("lower", &Answer::lower, "lower <= distance, in exact arithmetic")
      .def_readonly("upper", &Answer::upper, "distance <= upper, in exact arithmetic")
      .def_property_readonly("closed", &Answer::closed, "whether upper - lower met the tolerance")
      .def_property_readonly(
          "status", [](const Answer& r) { return status_name(r.status); },
          "why the run ended: closed, precision, time, waves, memory or cancelled")
      .def_property_readonly(
          "witness_a", [](const Answer& r) { return point_of(r.witness_a); },
          "the point of A (x, y, z) that is farthest from B as far as found, proving lower; in a "
          "symmetric run the one that is closest to it if B has the farthest point")
      .def_property_readonly(
          "witness_b", [](const Answer& r) { return point_of(r.witness_b); },
          "the closest point of B to it (x, y, z); in a symmetric run likewise")
      .def_property_readonly(
          "face_a", [](const Answer& r) { return r.witness_a.face; }, "row of fa with the witness")
      .def_property_readonly(
          "face_b", [](const Answer& r) { return r.witness_b.face; }, "row of fb with its partner")
      .def_readonly("stats", &Answer::stats, "what the run was asked, did and cost")
      .def("__repr__", text_of);
}

void define_distance(py::module_& m) {
  m.def(
      "distance",
      [](const py::object& va, const py::object& fa, const py::object& vb, const py::object& fb,
         const py::object& tol, bool symmetric, const std::string& device, const py::object& time,
         const py::object& waves, const py::object& memory, const py::object& disable,
         const py::object& progress, const py::object& enable, const std::string& preset) {
        return distance(va, fa, vb, fb, symmetric, device,
                        {tol, time, waves, memory, disable, progress, enable, preset});
      },
      "va"_a, "fa"_a, "vb"_a, "fb"_a, "tol"_a = 1e-6, "symmetric"_a = false, py::kw_only(),
      "device"_a = "", "time"_a = py::none(), "waves"_a = py::none(), "memory"_a = py::none(),
      "disable"_a = py::make_tuple(), "progress"_a = py::none(), "enable"_a = py::make_tuple(),
      "preset"_a = "",
      "Encloses h(A,B), the largest distance of a point of A from B, or with symmetric=True\n"
      "max(h(A,B), h(B,A)), in a certified interval.\n\n"
      "va, vb: (n, 3) float32 or float64; fa, fb: (m, 3) integers. tol: a fraction of the\n"
      "diagonal of A's bounding box, or a string such as '0.1%' or '0.01abs'. time: seconds;\n"
      "memory: bytes or '2GiB'; device: '', 'gpu', 'cpu', an index or part of a name;\n"
      "progress(wave, lower, upper): return False to cancel. preset: 'default', 'paper' or\n"
      "'baseline-gpu'; enable, disable: switches by name, besides. The interval is true whatever "
      "ended\n"
      "the run. ValueError for bad input, DeviceError for the device. Ctrl-C ends a run.");
}

void define_solver(py::module_& m) {
  py::class_<PythonSolver>(m, "Solver",
                           "Mesh B on the device, its hierarchy built once, for many A's:\n"
                           "with Solver(vb, fb) as s: r = s.distance(va, fa)")
      .def(py::init<const py::object&, const py::object&, const std::string&>(), "vb"_a, "fb"_a,
           "device"_a = "")
      .def(
          "distance",
          [](PythonSolver& self, const py::object& va, const py::object& fa, const py::object& tol,
             const py::object& time, const py::object& waves, const py::object& memory,
             const py::object& disable, const py::object& progress, const py::object& enable,
             const std::string& preset) {
            return self.distance(va, fa,
                                 {tol, time, waves, memory, disable, progress, enable, preset});
          },
          "va"_a, "fa"_a, "tol"_a = 1e-6, py::kw_only(), "time"_a = py::none(),
          "waves"_a = py::none(), "memory"_a = py::none(), "disable"_a = py::make_tuple(),
          "progress"_a = py::none(), "enable"_a = py::make_tuple(), "preset"_a = "",
          "As vkhausdorff.distance, from A to the Solver's B.")
      .def("close", &PythonSolver::close, "Frees the device; what is called later is a ValueError.")
      .def("__enter__", [](py::object self) { return self; })
      .def("__exit__", [](PythonSolver& self, const py::args&) { self.close(); });
}

}  // namespace
}  // namespace vkh::python

PYBIND11_MODULE(vkhausdorff, m) {
  namespace py = pybind11;
  using namespace vkh::python;
  m.doc() = "Certified Hausdorff distance between triangle meshes, on the GPU (Vulkan).";
  m.attr("__version__") = VKH_VERSION;
  py::register_exception<vkh::DeviceError>(m, "DeviceError", PyExc_RuntimeError);
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const vkh::InputError& error) {
      PyErr_SetString(PyExc_ValueError, error.what());
    } catch (const vkh::UsageError& error) {
      PyErr_SetString(PyExc_ValueError, error.what());
    }
  });
  define_result(m);
  define_distance(m);
  define_solver(m);
  // Before the interpreter goes, and with it the threads of drivers.
  py::module_::import("atexit").attr("register")(py::cpp_function([] { sessions().clear(); }));
}
