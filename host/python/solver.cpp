#include "host/python/solver.h"

#include <pybind11/numpy.h>

#include <map>

#include "host/base/error.h"
#include "host/base/float_environment.h"
#include "host/python/interpreter.h"
#include "host/python/mesh.h"
#include "host/python/options.h"
#include "host/python/proof.h"
#include "host/python/survey.h"

namespace vkh::python {
namespace {

namespace py = pybind11;

constexpr const char* kDevice = "'', 'gpu', 'cpu', an index such as '0' or part of a name";

/// The limit of gate(): one for all, or one per face.
struct GateWish {
  Limit limit;
  std::optional<std::vector<Limit>> of_faces;
};

/// Reads it in A's own coordinates: a number as it is, or a string such as '0.1%', or numbers for
/// A's faces.
GateWish read_gate_wish(const Arguments& given, const Mesh& a) {
  constexpr const char* kExpected =
      "a positive number, in the coordinates' unit, a string such as '0.1%' or '0.01abs', or a "
      "number for each face of A";
  const FloatEnvironment ours;
  const py::object& max = given.at("max");
  if (py::isinstance<py::str>(max)) return {limit_for(read_max(given, kExpected), a), std::nullopt};
  const auto array = py::array::ensure(max);
  if (!array || array.ndim() != 1) return {limit_for(read_max(given, kExpected), a), std::nullopt};
  const auto numbers = py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(max);
  if (!numbers) PyErr_Clear();
  if (!numbers) refuse_type("max", kExpected, max);
  std::vector<Limit> of_faces;
  for (py::ssize_t i = 0; i < numbers.shape(0); ++i)
    of_faces.push_back({numbers.at(i), numbers.at(i)});
  return {{}, std::move(of_faces)};
}

/// The options of both functions and of a Solver's run.
SolveOptions heard_options(const Arguments& given) {
  static const py::object* none = new py::none();
  SolveOptions options = options_of(given);
  const py::object* progress = given.find("progress");
  if (progress != nullptr && !progress->is_none() && PyCallable_Check(progress->ptr()) == 0)
    refuse_type("progress", "a function of wave, lower and upper, or None", *progress);
  listen_to(progress != nullptr ? *progress : *none, options);
  return options;
}

// One session a device, kept between calls of distance(): making one takes longer than most runs.
// It is never destroyed, but freed: see interpreter.cpp.
std::map<std::string, std::unique_ptr<Session>>& sessions() {
  static auto* kept = new std::map<std::string, std::unique_ptr<Session>>;
  return *kept;
}

Session& session_for(const std::string& device) {
  const auto known = sessions().find(device);
  if (known != sessions().end()) return *known->second;
  auto made = std::make_unique<Session>(device);  // without the GIL: another may be first
  return *sessions().try_emplace(device, std::move(made)).first->second;
}

// Raises a KeyboardInterrupt that came too late for a run after it.
template <class Found>
Answer answered(const Found& found) {
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  return answer_of(found);
}

/// The arguments of both functions.
struct Given {
  SolveOptions options;
  bool is_symmetric;
  std::string device;
  MeshPointer a, b;
  SurveyAsked survey;
  Certificate certificate;

  Given(const Arguments& given, MeshPointer mesh_a, MeshPointer mesh_b)
      : options(heard_options(given)),
        is_symmetric(given.flag("symmetric")),
        device(given.text("device", kDevice)),
        a(std::move(mesh_a)),
        b(std::move(mesh_b)),
        survey(read_survey(given, *a)),
        certificate(given, options) {
    if (a == b) b = std::make_shared<const Mesh>(*a);  // SurveyRun tells them apart by their place
  }
};

Answer solve(Given& given) {
  SymmetricReport both;  // its forward direction, if that is all that is asked
  Surveys surveys;
  session_for(given.device).use([&](Solver& s) {
    SurveyRun run(given.survey, given.options, *given.a, surveys);
    if (given.is_symmetric) {
      both = s.symmetric(*given.a, *given.b, run.options());
    } else {
      both.a_to_b = s.distance(*given.a, *given.b, run.options());
    }
    run.beside([&](const SolveOptions& options) { s.distance(*given.a, *given.b, options); });
    if (given.is_symmetric)
      run.beside([&](const SolveOptions& options) { s.distance(*given.b, *given.a, options); });
  });
  if (given.survey.is_any) narrow(given.survey, both.a_to_b, surveys.a);
  if (given.survey.is_any && given.is_symmetric) narrow(given.survey, both.b_to_a, surveys.b);
  if (given.certificate.is_asked())
    session_for(given.device).use([&](Solver& s) {
      given.certificate.make(s, {*given.a, *given.b}, both.a_to_b,
                             given.is_symmetric ? &both.b_to_a : nullptr);
    });
  Answer answer = given.is_symmetric ? answered(both) : answered(both.a_to_b);
  add_surveys(given.survey, surveys.a, given.is_symmetric ? &surveys.b : nullptr, answer);
  given.certificate.tell(answer);
  return answer;
}

/// Solves with a limit of its own for each face of A.
Answer solve_by_face(const Given& given, const std::vector<Limit>& limits) {
  if (given.is_symmetric)
    throw UsageError("max: limits of A's faces say nothing of B's; ask for each direction apart");
  if (given.survey.area)
    throw UsageError("area: faces with limits of their own are asked about whole");
  FaceGate found;
  Surveys surveys;
  session_for(given.device).use([&](Solver& s) {
    SurveyRun run(given.survey, given.options, *given.a, surveys, true);
    found = gate_faces(s, *given.a, *given.b, limits, run.options());
    run.beside([&](const SolveOptions& options) { s.distance(*given.a, *given.b, options); });
  });
  if (given.survey.is_any) narrow(given.survey, found.report, surveys.a);
  Answer answer = answered(found);
  add_surveys(given.survey, surveys.a, nullptr, answer);
  return answer;
}

}  // namespace

Answer distance(const py::args& positional, const py::kwargs& named) {
  static const auto* signature = new Signature{
      "distance",
      {"va",    "fa",         "vb",     "fb",      "tol",         "symmetric",  "device",
       "time",  "waves",      "memory", "disable", "progress",    "enable",     "preset",
       "field", "statistics", "bands",  "effort",  "survey_time", "certificate"},
      4,
      6};
  const Call call;
  const py::args all = spread(positional, named, {"va", "fa", "vb", "fb"});
  const Arguments given(*signature, all, named);
  Given asked(given, mesh_of("A", given.at("va"), given.at("fa")),
              mesh_of("B", given.at("vb"), given.at("fb")));
  return solve(asked);
}

Answer gate(const py::args& positional, const py::kwargs& named) {
  static const auto* signature = new Signature{
      "gate",
      {"a",          "b",      "max",     "tol",      "symmetric",   "device",     "time",
       "waves",      "memory", "disable", "progress", "enable",      "preset",     "field",
       "statistics", "bands",  "area",    "effort",   "survey_time", "certificate"},
      3,
      3};
  constexpr double kTolerance = 1e-7;
  const Call call;
  const Arguments arguments(*signature, positional, named);
  Given given(arguments, mesh_of("a", "A", arguments.at("a")),
              mesh_of("b", "B", arguments.at("b")));
  const GateWish asked = read_gate_wish(arguments, *given.a);
  if (arguments.find("tol") == nullptr) given.options.tolerance = kTolerance;
  read_area(arguments, asked.limit, given.survey);
  if (given.certificate.is_asked() && (asked.of_faces || given.survey.area))
    throw UsageError(
        "certificate: is of the interval, not to be had with area or limits of A's faces");
  if (asked.of_faces) return solve_by_face(given, *asked.of_faces);
  // The survey decides questions about its area.
  if (!given.survey.area) given.options.limit = asked.limit;
  return solve(given);
}

void free_devices() { Session::free_all(); }

PythonSolver::PythonSolver(const py::args& positional, const py::kwargs& named) {
  static const auto* signature = new Signature{"Solver", {"vb", "fb", "device"}, 2, 3};
  const Call call;
  const py::args all = spread(positional, named, {"vb", "fb"});
  const Arguments given(*signature, all, named);
  const std::string device = given.text("device", kDevice);
  const MeshPointer b = mesh_of("B", given.at("vb"), given.at("fb"));
  session_ = std::make_shared<Session>(device);
  session_->prepare(*b);
}

Answer PythonSolver::distance(const py::args& positional, const py::kwargs& named) {
  static const auto* signature = new Signature{
      "Solver.distance",
      {"va", "fa", "tol", "time", "waves", "memory", "disable", "progress", "enable", "preset",
       "field", "statistics", "bands", "effort", "survey_time", "certificate"},
      2,
      3};
  const Call call;
  const std::shared_ptr<Session> session = session_;
  if (session == nullptr) throw py::value_error("this Solver is closed");
  const py::args all = spread(positional, named, {"va", "fa"});
  const Arguments given(*signature, all, named);
  const SolveOptions options = heard_options(given);
  const MeshPointer mesh = mesh_of("A", given.at("va"), given.at("fa"));
  const Mesh& a = *mesh;
  const SurveyAsked asked = read_survey(given, a);
  Certificate certificate(given, options);
  Report report;
  Surveys surveys;
  session->distance([&](const Session::ToPrepared& to_b) {  // it may have been closed meanwhile
    const SurveyRun run(asked, options, a, surveys);
    report = to_b(a, run.options());
  });
  if (asked.is_any) narrow(asked, report, surveys.a);
  if (certificate.is_asked())
    session->with_prepared([&](Solver& solver, const Mesh& b) {
      certificate.make(solver, {a, b}, report, nullptr);
    });
  Answer answer = answered(report);
  add_surveys(asked, surveys.a, nullptr, answer);
  certificate.tell(answer);
  return answer;
}

void PythonSolver::close() {
  const Call call;
  std::shared_ptr<Session> session = std::move(session_);
  if (session == nullptr) return;
  session->close();
  const WithoutGil outside;
  session.reset();  // unless a run in flight has it, too
}

// No thread calls it any more: no run is in flight.
PythonSolver::~PythonSolver() {
  if (session_ == nullptr || is_forked()) return;
  try {
    const Call call;
    const WithoutGil outside;
    session_.reset();
  } catch (const Ended&) {
    session_.reset();
  }
}

}  // namespace vkh::python
