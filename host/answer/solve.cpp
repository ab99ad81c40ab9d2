// The step from meshes to an enclosed distance.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "host/answer/face_limits.h"
#include "host/answer/steps.h"
#include "host/solve/pair.h"
#include "host/solve/part.h"
#include "host/survey/shells.h"
#include "vkhausdorff/error.h"
#include "vkhausdorff/face_gate.h"
#include "vkhausdorff/note.h"
#include "vkhausdorff/together.h"

namespace vkh {
namespace {

constexpr double kLeastTime = 1e-3;  // even a spent budget buys a first, true interval

SolveOptions observed_options(const Question& question, const Observer& observer,
                              const Answer& answer) {
  SolveOptions options = solve_options(question, answer);
  if (observer.left_s) options.time_limit_s = std::max(observer.left_s(), kLeastTime);
  options.progress = observer.search;
  return options;
}

/// A direction whose faces may have limits of their own: in a file, or given.
struct GatedSide {
  const std::string& file;
  const std::optional<std::vector<Limit>>& given;
  const Mesh& from;
  const Mesh& to;
  std::optional<FaceLimits>& limits;
};

Report gate(const GatedSide& side, const SolveOptions& options, Solver& solver,
            const Answer& answer) {
  if (side.file.empty() && !side.given) return solver.distance(side.from, side.to, options);
  std::vector<Limit> limits = side.given.value_or(std::vector<Limit>());
  if (!side.file.empty())
    limits = read_face_limits(side.file, side.from, answer.max->limit, answer.unit,
                              diagonal_of_a(answer));
  FaceGate found = gate_faces(solver, side.from, side.to, limits, options);
  side.limits = FaceLimits{.path = side.file,
                           .within = found.within,
                           .faces = side.from.faces.size(),
                           .runs = found.runs,
                           .limit = found.limit,
                           .verdict = found.verdict};
  return std::move(found.report);
}

/// Solves both directions on their own: limits of faces bound nothing in the reverse direction.
void solve_by_face(const Question& question, const AskedMeshes& meshes, Solver& solver,
                   const Observer& observer, Answer& answer) {
  SolveOptions options = observed_options(question, observer, answer);
  options.tolerance = answer.a_to_b.tolerance;
  options.tolerance_is_absolute = true;
  SolveOptions there = options;
  if (question.symmetric) there.time_limit_s /= 2;
  answer.a_to_b =
      gate({question.face_max_a, question.face_limits_a, meshes.a, meshes.b, answer.max->faces_a},
           there, solver, answer);
  if (!question.symmetric) return;
  options.time_limit_s = std::max(observer.time_left_s(), kLeastTime);
  options.progress = [&observer](Progress progress) {
    progress.back = true;
    return !observer.search || observer.search(progress);
  };
  answer.b_to_a = gate({question.face_max_b, std::nullopt, meshes.b, meshes.a, answer.max->faces_b},
                       options, solver, answer);
}

void note_left_out(std::span<Solver* const> solvers, Answer& answer) {
  for (const LeftOut& one : answer.a_to_b.left_out) {
    answer.notes.push_back(note_of(
        NoteCode::kDevices,
        "the others did the part of " + solvers[one.device]->description().name + ": " + one.why));
  }
}

Report distance_of(std::span<Solver* const> solvers, const AskedMeshes& meshes,
                   const SolveOptions& options) {
  if (solvers.size() != 1) return distance_over(solvers, meshes.a, meshes.b, options);
  const PairView view = meshes.view();
  return std::move(solvers.front()->distances({&view, 1}, options)[0]);
}

SymmetricReport symmetric_of(Solver& solver, const AskedMeshes& meshes,
                             const SolveOptions& options) {
  PairView view = meshes.view();
  view.prepared = nullptr;
  return std::move(solver.symmetrics({&view, 1}, options)[0]);
}

Report distance_of_one_part(std::span<Solver* const> solvers, const AskedMeshes& meshes,
                            const PartOf& part, const SolveOptions& options) {
  const size_t faces = meshes.a.faces.size();
  if (part.count > faces)
    throw UsageError("--part: A has " + std::to_string(faces) + " faces, too few for " +
                     std::to_string(part.count) + " parts");
  const auto distance = [&](const Mesh& a, const Mesh& b, const SolveOptions& of_it) {
    return distance_over(solvers, a, b, of_it);
  };
  return distance_of_part(distance, meshes.a, part_in_order(faces, part.index, part.count),
                          meshes.b, options);
}

constexpr uint32_t kWorstWaves = 60;  // an ordinary pair closes in under 30

/// Adds a search without a limit. The status stays: the limit was decided.
void add_search(Report& report, const Report& worst) {
  narrow(report, worst);
  report.times.wall_ms += worst.times.wall_ms;
}

/// Searches on for the farthest point, to a thousandth of the known distance, which is enough for
/// people.
void find_worst(const Question& question, std::span<Solver* const> solvers,
                const AskedMeshes& meshes, const Observer& observer, Answer& answer) {
  answer.max->worst = true;
  SolveOptions options = observed_options(question, observer, answer);
  options.limit = {};
  options.wave_limit = std::min(options.wave_limit, kWorstWaves);
  options.tolerance = std::max(answer.a_to_b.tolerance, 1e-3 * interval_of(answer).lower);
  options.tolerance_is_absolute = true;
  if (!answer.b_to_a) return add_search(answer.a_to_b, distance_of(solvers, meshes, options));
  const SymmetricReport both = symmetric_of(*solvers.front(), meshes, options);
  add_search(answer.a_to_b, both.a_to_b);
  add_search(*answer.b_to_a, both.b_to_a);
}

bool goes_on_to_worst(const Question& question, const Observer& observer, const Answer& answer) {
  return question.worst && question.max && !question.area && !question.is_by_face() &&
         !question.part && verdict_of(answer) != Verdict::kUndecided && observer.is_to_go_on() &&
         observer.time_left_s() > 0;
}

}  // namespace

void check_sides(const Question& question, const Mesh& a, const Mesh& b) {
  if (!question.asks_for_sides()) return;
  refuse_any_triangulation(a, b, question.option("signed"));
  refuse_conflicts(b);
  if (question.symmetric) refuse_conflicts(a);
}

void solve(const Question& question, std::span<Solver* const> solvers, const AskedMeshes& meshes,
           const Observer& observer, Answer& answer) {
  const auto options = [&] { return observed_options(question, observer, answer); };
  if (question.is_by_face()) {
    solve_by_face(question, meshes, *solvers.front(), observer, answer);
  } else if (question.symmetric) {
    if (solvers.size() > 1)
      throw UsageError(question.option("symmetric") +
                       ": over several devices ask for each direction by itself");
    SymmetricReport both = symmetric_of(*solvers.front(), meshes, options());
    answer.a_to_b = std::move(both.a_to_b);
    answer.b_to_a = std::move(both.b_to_a);
  } else {
    answer.a_to_b = question.part ? distance_of_one_part(solvers, meshes, *question.part, options())
                                  : distance_of(solvers, meshes, options());
    note_left_out(solvers, answer);
  }
  if (observer.found) observer.found(answer);
  if (goes_on_to_worst(question, observer, answer))
    find_worst(question, solvers, meshes, observer, answer);
  add_memory_notes(question.budget.memory_bytes, answer);
  if (observer.found) observer.found(answer);
}

}  // namespace vkh
