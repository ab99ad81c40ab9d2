#include "host/python/solver.h"

#include <pybind11/stl.h>

#include <chrono>
#include <functional>
#include <map>

#include "host/answer/asked_pair.h"
#include "host/base/float_environment.h"
#include "host/base/output_file.h"
#include "host/python/interpreter.h"
#include "host/python/keywords.h"
#include "vkhausdorff/align.h"
#include "vkhausdorff/error.h"
#include "vkhausdorff/frame.h"
#include "vkhausdorff/levels.h"
#include "vkhausdorff/simplify.h"
#include "vkhausdorff/together.h"

namespace vkh::python {
namespace {

namespace py = pybind11;

constexpr const char* kSelector =
    "'', 'gpu', 'cpu', 'native', an index such as 0 or part of a name";
constexpr const char* kDevice =
    "'', 'gpu', 'cpu', 'native', an index such as 0, part of a name or a Device";
constexpr const char* kDevices =
    "'', 'gpu', 'cpu', 'native', an index such as 0, part of a name, several of these between "
    "commas, 'all' "
    "or a Device";

// One session for each choice of devices, kept between calls of distance(): making one takes longer
// than most runs. It is never destroyed, but freed: see interpreter.cpp.
std::map<std::vector<std::string>, std::shared_ptr<Session>>& sessions() {
  static auto* kept = new std::map<std::vector<std::string>, std::shared_ptr<Session>>;
  return *kept;
}

std::shared_ptr<Session> session_for(const std::vector<std::string>& devices) {
  const auto known = sessions().find(devices);
  if (known != sessions().end()) return known->second;
  auto made =
      std::make_shared<Session>(devices, "Device");  // without the GIL: another may be first
  return sessions().try_emplace(devices, std::move(made)).first->second;
}

/// The session of a Device; null if `device` is not a Device.
std::shared_ptr<Session> shared_session(const Arguments& given) {
  const py::object* device = given.find("device");
  if (device == nullptr || !py::isinstance<PythonDevice>(*device)) return nullptr;
  return made<PythonDevice>(*device, "Device").session();
}

/// Reads the keyword `device`, and keeps the session between calls.
std::shared_ptr<Session> session_of(const Arguments& given) {
  std::shared_ptr<Session> shared = shared_session(given);
  return shared != nullptr ? shared : session_for({given.device(kDevice)});
}

/// Does the same for calls that may ask for several devices.
std::shared_ptr<Session> session_over(const Arguments& given) {
  std::shared_ptr<Session> shared = shared_session(given);
  return shared != nullptr ? shared : session_for(given.devices(kDevices));
}

/// Reads a function's keyword: None if it was not given.
py::object callback_of(const Arguments& given, const char* name, const char* expected) {
  const py::object* callback = given.find(name);
  if (callback == nullptr || callback->is_none()) return py::none();
  if (PyCallable_Check(callback->ptr()) == 0) refuse_type(name, expected, *callback);
  return *callback;
}

/// Checks the place of a certificate before anything is run.
std::unique_ptr<OutputFile> certificate_file(const Outputs& outputs) {
  if (!outputs.certificate) return nullptr;
  return std::make_unique<OutputFile>("certificate", *outputs.certificate,
                                      std::vector<std::string>{});
}

/// A call: its question, its meshes, and its outputs other than the result.
struct Given {
  Question question;
  py::object progress, on_progress;
  std::unique_ptr<OutputFile> certificate;
  MeshPointer a;
  ShapedMesh b;

  Given(Functions function, const char* command, const Arguments& given, MeshPointer mesh_a,
        ShapedMesh mesh_b)
      : progress(callback_of(given, "progress", "a function of wave, lower and upper, or None")),
        on_progress(
            callback_of(given, "on_progress", "a function of fraction, lower and upper, or None")),
        a(std::move(mesh_a)),
        b(std::move(mesh_b)) {
    Request asked = request_of(function, command, given);
    certificate = certificate_file(asked.outputs);
    question = std::move(asked.question);
  }
};

/// Asks Python between submissions, in the floating-point environment of the caller.
class Listener {
 public:
  /// `known` has its meshes.
  Listener(const Given& given, const Answer& known)
      : given_(given), meter_(given.question, known) {}

  Observer observer() {
    return {.goes_on = [this] { return goes_on(); },
            .search =
                [this](const Progress& p) {
                  meter_.hear(p);
                  take(ours_.outside([&] { return hear(given_.progress, p); }));
                  report();
                  return !is_cancelled_;
                },
            .cells =
                [this](const SideCount& side) {
                  meter_.hear_cells(side);
                  report();
                },
            .leaves =
                [this](const SideCount& side) {
                  is_proving_ = true;
                  meter_.hear_leaves(side);
                  report();
                },
            .found = [this](const Answer& answer) { meter_.take(answer); }};
  }
  /// Reports that all work is done, unless the caller cancelled it.
  void end(const Answer& answer) {
    meter_.end(answer);
    report();
  }

 private:
  // The keyword `time` is for the search and the certificate, and survey_time for the rest.
  bool goes_on() {
    if (!is_cancelled_) ours_.outside(hear_signals);
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start_;
    const bool is_late = is_proving_ && spent.count() >= given_.question.budget.time_limit_s;
    return !is_cancelled_ && !is_late;
  }
  void report() {
    if (is_cancelled_ || given_.on_progress.is_none()) return;
    take(ours_.outside([&] { return hear(given_.on_progress, meter_.done()); }));
  }
  void take(bool goes_on) { is_cancelled_ = is_cancelled_ || !goes_on; }

  const Given& given_;
  WorkMeter meter_;
  FloatEnvironment ours_;
  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  bool is_cancelled_ = false, is_proving_ = false;
};

/// Writes the certificate's file, if there is a proof, and its size into the result. Warns if it
/// proves less than the interval. Arrays are in no file, so that its hashes are those of their
/// corners alone.
void write_certificate(const Given& given, const AskedPair& pair, const py::object& certificate) {
  if (certificate.is_none()) return;
  const Answer& answer = pair.answer();
  const std::string text = certificate_text(answer, {*pair.a(), *pair.b()});
  given.certificate->write(text);
  certificate["bytes"] = text.size();
  const bool is_less = answer.proof_a->upper > answer.a_to_b.upper ||
                       (answer.proof_b && answer.proof_b->upper > answer.b_to_a->upper);
  if (!is_less) return;
  const char* warning =
      "the certificate proves less than upper says: see stats['certificate']['upper']";
  if (PyErr_WarnEx(PyExc_RuntimeWarning, warning, 1) != 0) throw py::error_already_set();
}

/// Lays A onto B on the device, if that is asked for.
void fit(AskedPair& pair, Solver& solver, const PreparedMesh* prepared) {
  FloatEnvironment ours;
  const auto goes_on = [&ours] {
    ours.outside(hear_signals);
    return true;
  };
  pair.fit(solver, {.goes_on = goes_on}, prepared);
}

py::object answered(const Given& given, Session& session, Session::Key key = 0) {
  AskedPair pair(given.question);
  {
    const FloatEnvironment ours;
    pair.take(given.a, given.b);
  }
  const auto work = [&](Solver& solver, const PreparedMesh* prepared) {
    fit(pair, solver, prepared);
    Listener listener(given, pair.answer());
    Solver* const solvers[] = {&solver};
    pair.solve(solvers, listener.observer(), prepared);
    pair.finish(solver, listener.observer(), prepared);
    listener.end(pair.answer());
  };
  session.use(work, key);
  // Raises a KeyboardInterrupt that came too late for a run after it.
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  const py::dict parts = parts_of(given.question, pair.answer(), pair.a(), pair.b());
  if (given.certificate) write_certificate(given, pair, parts["stats"]["certificate"]);
  return result_of(parts);
}

// A row-major copy: (n,), or (n, 3) of points.
template <class T, class Row>
py::array array_of(const std::vector<Row>& rows) {
  const auto count = static_cast<py::ssize_t>(rows.size());
  const auto* first = reinterpret_cast<const T*>(rows.data());
  if constexpr (sizeof(Row) == sizeof(T)) {
    return py::array_t<T>(count, first);
  } else {
    return py::array_t<T>({count, py::ssize_t{sizeof(Row) / sizeof(T)}}, first);
  }
}

py::object closest_of(const ClosestPoints& found) {
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  return py::module_::import("vkhausdorff._closest")
      .attr("Closest")(array_of<double>(found.lower), array_of<double>(found.upper),
                       array_of<double>(found.points), array_of<uint32_t>(found.faces));
}

bool goes_on(size_t) {
  hear_signals();
  return true;
}

py::object simplified_of(const Simplified& found) {
  const auto ends = [](double lower, double upper) { return py::make_tuple(lower, upper); };
  const Deviation& d = found.deviation;
  py::object back = py::none();
  if (d.b_to_a) back = ends(d.b_to_a->lower, d.b_to_a->upper);
  return py::module_::import("vkhausdorff._simplify")
      .attr("Simplified")(array_of<double>(found.mesh.vertices),
                          array_of<uint32_t>(found.mesh.faces),
                          ends(d.interval.lower, d.interval.upper),
                          ends(d.a_to_b.lower, d.a_to_b.upper), back, found.complete, found.tried);
}

/// Reads the keywords of simplify(), except the device.
SimplifyOptions simplify_options(const Arguments& given, const Mesh& a) {
  const Request asked = request_of(kPySimplify, "simplify", given);
  const Question& question = asked.question;
  constexpr const char* kExpected =
      "a positive number, in the coordinates' unit, or a string such as '0.1%' or '0.01abs'";
  if (!question.max) refuse_type("max", kExpected, given.at("max"));
  if (question.max_sides) refuse_value("max", kExpected, given.at("max"));
  const FloatEnvironment ours;
  SimplifyOptions options;
  options.max = limit_in_files(*question.max, "max", a.unit, diagonal_of(a));
  options.one_way = asked.simplify.one_way;
  options.lock_borders = asked.simplify.lock_borders;
  options.rounds_to_float = given.flag("float32");
  options.time_limit_s = question.budget.time_limit_s;
  options.goes_on = [] { return goes_on(0); };
  return options;
}

[[noreturn]] void raise_too_late() {
  PyErr_SetString(PyExc_TimeoutError, "no mesh within max was found in the time");
  throw py::error_already_set();
}

/// Reads the keywords of simplify_levels() that simplify() does not have.
LevelsOptions levels_options(const Arguments& given) {
  constexpr const char* kLevels = "a whole number from 1";
  LevelsOptions options;
  if (given.find("levels") != nullptr) {
    const std::optional<uint64_t> levels = given.whole("levels", kLevels);
    if (!levels || *levels == 0) refuse_value("levels", kLevels, given.at("levels"));
    options.levels = static_cast<size_t>(*levels);
  }
  constexpr const char* kRatio = "a number between 0 and 1";
  if (given.find("ratio") == nullptr) return options;
  const std::optional<double> ratio = given.number("ratio", kRatio);
  if (!ratio || !(*ratio > 0 && *ratio < 1)) refuse_value("ratio", kRatio, given.at("ratio"));
  options.ratio = *ratio;
  return options;
}

}  // namespace

py::object align(const py::args& positional, const py::kwargs& named) {
  static const auto* signature = new Signature{"align", {"a", "b", "device", "points"}, 2, 2};
  const Call call;
  const Arguments given(*signature, positional, named);
  const std::shared_ptr<Session> session = session_of(given);
  const PointSides points = point_sides(given);
  const MeshPointer a = mesh_of("a", "A", given.at("a"), ReadLimits{.points = points.a});
  const MeshPointer b = mesh_of("b", "B", given.at("b"), ReadLimits{.points = points.b});
  Alignment found;
  session->use([&](Solver& solver, const PreparedMesh*) {
    found = vkh::align(solver, *a, *b, {.goes_on = goes_on});
  });
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  const FoundFit& fit = found.fit;
  return py::module_::import("vkhausdorff._align")
      .attr("Alignment")(matrix_rows(found.matrix), fit.rms, fit.share, fit.samples, fit.is_poor,
                         fit.rival, fit.mirrored);
}

py::object closest(const py::args& positional, const py::kwargs& named) {
  static const auto* signature = new Signature{"closest", {"b", "points", "device"}, 2, 2};
  const Call call;
  const Arguments given(*signature, positional, named);
  const std::shared_ptr<Session> session = session_over(given);
  const MeshPointer b = mesh_of("b", "B", given.at("b"));
  const std::vector<DVec3> points = points_from(given.at("points"));
  ClosestPoints found;
  session->use_all([&](auto solvers, auto) { found = closest_over(solvers, *b, points, goes_on); });
  return closest_of(found);
}

py::object simplified(const py::args& positional, const py::kwargs& named) {
  static const auto* signature =
      new Signature(signature_of(kPySimplify, "simplify", {"a", "max", "float32", "device"}, 2, 2));
  const Call call;
  const Arguments given(*signature, positional, named);
  const std::shared_ptr<Session> session = session_of(given);
  const MeshPointer a = mesh_of("a", "A", given.at("a"));
  const SimplifyOptions options = simplify_options(given, *a);
  Simplified found;
  session->use([&](Solver& s, const PreparedMesh*) { found = vkh::simplify(s, *a, options); });
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  if (!found.found && found.complete)
    throw py::value_error("float32: A itself, rounded to it, is farther than max");
  if (!found.found) raise_too_late();
  return simplified_of(found);
}

py::object simplified_levels(const py::args& positional, const py::kwargs& named) {
  static const auto* signature = new Signature(signature_of(
      kPySimplify, "simplify_levels", {"a", "max", "levels", "ratio", "float32", "device"}, 2, 2));
  const Call call;
  const auto start = std::chrono::steady_clock::now();
  const Arguments given(*signature, positional, named);
  LevelsOptions options = levels_options(given);
  const std::shared_ptr<Session> session = session_of(given);
  const MeshPointer a = mesh_of("a", "A", given.at("a"));
  options.simplify = simplify_options(given, *a);
  std::vector<Simplified> found;
  session->use([&](Solver& s, const PreparedMesh*) { found = simplify_levels(s, *a, options); });
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
  if (found.empty() && spent.count() >= options.simplify.time_limit_s) raise_too_late();
  py::list levels;
  for (const Simplified& level : found) levels.append(simplified_of(level));
  return levels;
}

py::object distance(const py::args& positional, const py::kwargs& named) {
  static const auto* signature = new Signature(
      signature_of(kPyDistance, "distance",
                   {"va", "fa", "vb", "fb", "tol", "symmetric", "progress", "on_progress"}, 4, 6));
  const Call call;
  const py::args all = spread(positional, named, {"va", "fa", "vb", "fb"});
  const Arguments arguments(*signature, all, named);
  const PointSides points = point_sides(arguments);
  return answered({kPyDistance, "distance", arguments,
                   mesh_of("A", arguments.at("va"), arguments.at("fa"), points.a),
                   kept(mesh_of("B", arguments.at("vb"), arguments.at("fb"), points.b))},
                  *session_of(arguments));
}

py::object gate(const py::args& positional, const py::kwargs& named) {
  static const auto* signature = new Signature(
      signature_of(kPyGate, "gate", {"a", "b", "max", "progress", "on_progress"}, 3, 3));
  const Call call;
  const Arguments arguments(*signature, positional, named);
  const PointSides points = point_sides(arguments);
  return answered({kPyGate, "gate", arguments,
                   mesh_of("a", "A", arguments.at("a"), ReadLimits{.points = points.a}),
                   kept(mesh_of("b", "B", arguments.at("b"), ReadLimits{.points = points.b}))},
                  *session_of(arguments));
}

py::object metrics(const py::args& positional, const py::kwargs& named) {
  static const auto* signature = new Signature(
      signature_of(kPyMetrics, "metrics",
                   {"a", "b", "spacing", "affine", "empty", "progress", "on_progress"}, 2, 2));
  const Call call;
  const Arguments arguments(*signature, positional, named);
  return answered({kPyMetrics, "metrics", arguments, mesh_of("a", "A", arguments.at("a")),
                   kept(mesh_of("b", "B", arguments.at("b")))},
                  *session_of(arguments));
}

void free_devices() { Session::free_all(); }

namespace {

// Frees what a Python object holds of a session, without the GIL. `drop` is not called at the
// interpreter's end; in a forked process nothing is called.
void let_go(std::shared_ptr<Session> session, const std::function<void(Session&)>& drop) {
  if (session == nullptr || is_forked()) return;
  try {
    const Call call;
    const WithoutGil outside;
    drop(*session);
    session.reset();
  } catch (const Ended&) {
    session.reset();
  }
}

}  // namespace

PythonDevice::PythonDevice(const py::args& positional, const py::kwargs& named)
    : session_([&] {
        static const auto* signature = new Signature{"Device", {"device"}, 0, 1};
        const Call call;
        const Arguments given(*signature, positional, named);
        return std::make_shared<Session>(std::vector{given.device(kSelector)}, "Device");
      }()) {}

void PythonDevice::close() {
  const Call call;
  session_->close();
}

// Solvers may still have it.
PythonDevice::~PythonDevice() {
  let_go(std::move(session_), [](Session&) {});
}

PythonSolver::PythonSolver(const py::args& positional, const py::kwargs& named) {
  static const auto* signature = new Signature{"Solver", {"vb", "fb", "device"}, 2, 3};
  const Call call;
  const py::args all = spread(positional, named, {"vb", "fb"});
  const Arguments given(*signature, all, named);
  std::shared_ptr<Session> session = shared_session(given);
  shares_device_ = session != nullptr;
  std::vector<std::string> devices;
  if (!shares_device_) devices = given.devices(kDevices);
  b_ = kept(mesh_of("B", given.at("vb"), given.at("fb")));
  if (!shares_device_) session = std::make_shared<Session>(std::move(devices), "Solver");
  key_ = session->prepare(b_.mesh);
  session_ = std::move(session);
}

std::shared_ptr<Session> PythonSolver::open_session() const {
  std::shared_ptr<Session> session = session_;  // it may be closed meanwhile
  if (session == nullptr) throw py::value_error("this Solver is closed");
  return session;
}

py::object PythonSolver::distance(const py::args& positional, const py::kwargs& named) {
  static const auto* signature = new Signature(signature_of(
      kPySolver, "Solver.distance", {"va", "fa", "tol", "progress", "on_progress"}, 2, 3));
  const Call call;
  const std::shared_ptr<Session> session = open_session();
  const py::args all = spread(positional, named, {"va", "fa"});
  const Arguments arguments(*signature, all, named);
  const PointSides points = point_sides(arguments);
  if (points.b)
    refuse_value("points", "True for a, 'a' or None: B is the Solver's", arguments.at("points"));
  return answered({kPySolver, "distance", arguments,
                   mesh_of("A", arguments.at("va"), arguments.at("fa"), points.a), b_},
                  *session, key_);
}

py::object PythonSolver::closest(const py::args& positional, const py::kwargs& named) {
  static const auto* signature = new Signature{"Solver.closest", {"points"}, 1, 1};
  const Call call;
  const std::shared_ptr<Session> session = open_session();
  const Arguments given(*signature, positional, named);
  const std::vector<DVec3> points = points_from(given.at("points"));
  ClosestPoints found;
  session->use_all([&](auto solvers,
                       auto prepared) { found = closest_over(solvers, prepared, points, goes_on); },
                   key_);
  return closest_of(found);
}

void PythonSolver::close() {
  const Call call;
  std::shared_ptr<Session> session = std::move(session_);
  if (session == nullptr) return;
  if (!shares_device_) session->close();
  const WithoutGil outside;
  if (shares_device_) session->drop(key_);
  session.reset();  // unless a run in flight has it, too
}

// When this runs, no thread calls it any more, so no run of it is in flight.
PythonSolver::~PythonSolver() {
  let_go(std::move(session_), [this](Session& session) {
    if (shares_device_) session.drop(key_);
  });
}

}  // namespace vkh::python
