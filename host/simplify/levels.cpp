#include "vkhausdorff/levels.h"

#include "host/base/float_environment.h"
#include "host/simplify/collapse.h"
#include "host/simplify/judge.h"
#include "vkhausdorff/error.h"

namespace vkh {
namespace {

void check_ratio(double ratio) {
  if (!(ratio > 0 && ratio < 1))
    throw UsageError("simplify: the ratio of a level's faces must be between 0 and 1");
}

/// Calls the progress callback for a level; returns whether to make it.
bool announce(const SimplifyOptions& options, const SimplifyProgress& progress, Judge& judge) {
  if (options.progress && !options.progress(progress)) judge.call_off();
  return judge.goes_on();
}

}  // namespace

std::vector<Simplified> simplify_levels(Solver& solver, const Mesh& a, const LevelsOptions& options,
                                        ChainEnd* end) {
  const FloatEnvironment ours;
  check_mesh(a);
  check_ratio(options.ratio);
  const Deadline deadline(options.simplify.time_limit_s);
  Judge judge(solver, a, options.simplify, deadline);
  const Collapser collapser(a, options.simplify.lock_borders, options.simplify.rounds_to_float);
  std::vector<Simplified> levels;
  size_t fewest = collapser.faces().size();
  auto target = static_cast<double>(fewest);
  bool complete = true;
  ChainEnd why = ChainEnd::kAll;
  while (levels.size() < options.levels) {
    target *= options.ratio;
    Faces faces = collapser.collapse(collapser.faces(), {.faces = static_cast<size_t>(target)});
    why = ChainEnd::kNoFewer;
    if (faces.empty() || faces.size() >= fewest) break;
    complete = announce(options.simplify, {levels.size(), fewest, faces.size()}, judge);
    why = ChainEnd::kEnded;
    if (!complete) break;
    Simplified level;
    level.mesh = collapser.mesh_of(faces);
    level.found = level.complete = true;
    level.tried = 1;
    const Deviation decided = judge.decide(level.mesh);
    complete = judge.goes_on();
    why = !complete                             ? ChainEnd::kEnded
          : decided.verdict == Verdict::kBeyond ? ChainEnd::kFarther
                                                : ChainEnd::kUndecided;
    if (decided.verdict != Verdict::kWithin) break;
    level.deviation = judge.measure(level.mesh, decided);
    fewest = faces.size();
    levels.push_back(std::move(level));
    why = ChainEnd::kAll;
  }
  if (end != nullptr) *end = why;
  if (!levels.empty()) levels.back().complete = complete;
  return levels;
}

}  // namespace vkh
