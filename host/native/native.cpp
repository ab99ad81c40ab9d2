#include "host/native/native.h"

#include <algorithm>

#include "host/base/float_environment.h"
#include "host/base/rounding.h"
#include "host/native/levels.h"
#include "host/native/witness.h"
#include "vkhausdorff/frame.h"
#include "vkhausdorff/length.h"

namespace vkh::native {
namespace {

// Rounding leaves less between the two ends than this, in a frame of order 1: some 30 kUlp of
// surfaces' slack, whose radius is under 4, on either side. Less would refine noise.
constexpr double kToleranceFloor = 0x1p-44;

double tolerance_in_files(const Problem& problem, const NativeOptions& options) {
  if (options.tolerance_is_absolute) return options.tolerance;
  return multiply_down(options.tolerance,
                       Diagonal(diagonal(problem.box_a), problem.a.delta).least());
}

double tolerance_in_frame(const Problem& problem, double in_files) {
  const double given = problem.frame.to_frame(in_files) - 2 * problem.displacement;
  return std::max(given - kToleranceFloor, kToleranceFloor);
}

NativeWitness witness_of(const Problem& problem, const Sample& s) {
  const double v = s.at.x * kUnit, w = s.at.y * kUnit;
  return {.face_a = s.face, .face_b = problem.tree.face(s.place), .barycentric = {1 - v - w, v, w}};
}

NativeStatus status_of(const NativeReport& r, bool is_over) {
  if (is_within(r.lower, r.upper, r.tolerance)) return NativeStatus::kClosed;
  return is_over ? NativeStatus::kPrecision : NativeStatus::kLevels;
}

}  // namespace

NativeReport run_pair(const Mesh& a, const Mesh& b, const NativeOptions& options) {
  const FloatEnvironment ours;
  check_mesh(a);
  check_mesh(b);
  const Problem problem(a, b);
  NativeReport r;
  r.tolerance = tolerance_in_files(problem, options);
  Levels levels(problem, tolerance_in_frame(problem, r.tolerance), options);
  levels.start();
  while (!levels.is_over() && levels.count() < options.level_limit) levels.advance();
  const Gain& total = levels.total();
  const double lower = witness_distance_down(problem, total.best, options.threads);
  const double upper = std::max({lower, total.largest_closed, levels.largest_open()});
  const FileInterval ends = problem.frame.to_files(
      lower, upper, problem.displacement, farthest_in(problem.joint, add_up(a.delta, b.delta)));
  r.lower = ends.lower;
  r.upper = ends.upper;
  r.status = status_of(r, levels.is_over());
  r.witness = witness_of(problem, total.best);
  r.levels = levels.count();
  r.candidates = total.candidates;
  r.queries = total.queries;
  r.peak_candidates = levels.peak();
  r.closed = total.closed;
  return r;
}

}  // namespace vkh::native
