#include "host/simplify/judge.h"

#include <algorithm>
#include <cmath>

#include "host/solve/switches.h"
#include "vkhausdorff/error.h"
#include "vkhausdorff/frame.h"

namespace vkh {
namespace {

/// The margin that lets `gate`, whose tolerance is 1e-7 of a diagonal, decide in any later run: the
/// distance is farther than that from the limit. For a limit under 8e-7 of the diagonal the margin
/// is half of it, and a gate may need a finer tolerance there.
double without_margin(double within, double diagonal) {
  constexpr double kOfDiagonal = 4e-7, kOfLimit = 0.5;
  return within - std::min(kOfDiagonal * diagonal, kOfLimit * within);
}

// Shares of the limit: the width of an interval that decides, and of one that is reported.
constexpr double kDeciding = 1e-4, kTold = 1e-3;

/// Makes the pipelines of runs first, which BVHs are built with, too.
PreparedMesh prepared(Solver& solver, const Mesh& a, const SimplifyOptions& options) {
  const double diagonal_a = diagonal(bounding_box(a));
  const double share = diagonal_a > 0 ? options.max.within / diagonal_a : 1;
  solver.make_ready(simplify_engine(options.solve.engine, share));
  return solver.prepare(a);
}

void check_limit(const Limit& max) {
  if (!(max.within > 0 && max.within <= max.beyond && std::isfinite(max.beyond)))
    throw UsageError("simplify: the limit must be a positive, finite length");
}

}  // namespace

Judge::Judge(Solver& solver, const Mesh& a, const SimplifyOptions& options,
             const Deadline& deadline)
    : solver_(solver),
      options_((check_limit(options.max), options)),
      deadline_(deadline),
      prepared_(prepared(solver, a, options)),
      within_(without_margin(options.max.within, diagonal(bounding_box(a)))) {}

SolveOptions Judge::run_options() const {
  constexpr double kLeastTime = 1e-3;  // a run needs some time
  SolveOptions run = options_.solve;
  run.tolerance_is_absolute = true;
  run.engine.stage_times = false;
  run.time_limit_s = std::max(deadline_.left_s(), kLeastTime);
  run.progress = [this](const Progress&) { return goes_on(); };
  return run;
}

void Judge::conclude(Deviation& d) const {
  d.interval = d.b_to_a ? symmetric_interval(d.a_to_b, *d.b_to_a)
                        : CertifiedInterval{.lower = d.a_to_b.lower,
                                            .upper = d.a_to_b.upper,
                                            .gap = d.a_to_b.gap(),
                                            .status = d.a_to_b.status};
  d.verdict = verdict_of(d.interval.lower, d.interval.upper, options_.max);
}

Deviation Judge::decide(const Mesh& b) {
  SolveOptions run = run_options();
  run.limit = {within_, within_};
  run.tolerance = kDeciding * within_;
  Deviation d;
  d.a_to_b.upper = std::numeric_limits<double>::infinity();
  // The candidate has few faces, and A's BVH is there: the cheaper direction comes first.
  if (!options_.one_way) d.b_to_a = solver_.distance(b, prepared_, run);
  if (!d.b_to_a || d.b_to_a->upper <= within_) {
    run.time_limit_s = run_options().time_limit_s;
    d.a_to_b = solver_.distance(prepared_.mesh(), b, run);
  }
  conclude(d);
  if (d.verdict == Verdict::kWithin && !(d.interval.upper <= within_))
    d.verdict = Verdict::kUndecided;
  return d;
}

Deviation Judge::measure(const Mesh& b, const Deviation& decided) {
  SolveOptions run = run_options();
  run.tolerance = kTold * options_.max.within;
  Deviation d;
  d.a_to_b = solver_.distance(prepared_.mesh(), b, run);
  if (!options_.one_way) {
    run.time_limit_s = run_options().time_limit_s;
    run.known_lower = d.a_to_b.lower;
    d.b_to_a = solver_.distance(b, prepared_, run);
    d.b_to_a->upper = std::min(d.b_to_a->upper, decided.b_to_a->upper);
  }
  d.a_to_b.upper = std::min(d.a_to_b.upper, decided.a_to_b.upper);
  conclude(d);
  return d;
}

std::vector<DVec3> Judge::beyond(const PreparedMesh& to, std::span<const DVec3> points,
                                 double share) {
  std::vector<DVec3> found;
  const ClosestPoints closest = solver_.closest(to, points, [this](size_t) { return goes_on(); });
  for (size_t i = 0; i < points.size(); ++i)
    if (closest.upper[i] > share * within_) found.push_back(points[i]);
  return found;
}

EngineOptions simplify_engine(const EngineOptions& engine, double share) {
  EngineOptions first = engine;
  first.closest = true;
  first.fine = engine.fine || kDeciding * without_margin(share, 1) < kFineTolerance;
  return first;
}

}  // namespace vkh
