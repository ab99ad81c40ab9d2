#include "vkhausdorff/simplify.h"

#include "host/base/float_environment.h"
#include "host/simplify/search.h"
#include "vkhausdorff/error.h"

namespace vkh {
namespace {

/// Returns whether the search came to its own end.
bool search_all(Search& search) {
  try {
    search.scan_errors();
    if (!search.has_best()) search.try_whole();
    search.repair();
  } catch (const Interrupted&) {  // the best candidate so far stays
    return false;
  }
  return search.goes_on();
}

}  // namespace

Simplified simplify(Solver& solver, const Mesh& a, const SimplifyOptions& options) {
  const FloatEnvironment ours;
  check_mesh(a);
  const Deadline deadline(options.time_limit_s);
  Judge judge(solver, a, options, deadline);
  const Collapser collapser(a, options.lock_borders, options.rounds_to_float);
  Search search(judge, collapser, options);
  Simplified result;
  result.complete = search_all(search);
  result.tried = search.tried();
  result.found = search.has_best();
  if (!result.found) return result;
  result.mesh = collapser.mesh_of(search.best());
  result.deviation = measure_deviation(solver, a, result.mesh, options);
  return result;
}

Deviation measure_deviation(Solver& solver, const Mesh& a, const Mesh& b,
                            const SimplifyOptions& options) {
  const FloatEnvironment ours;
  const Deadline unlimited(std::numeric_limits<double>::infinity());
  Judge judge(solver, a, options, unlimited);
  Deviation decided = judge.decide(b);
  if (decided.verdict != Verdict::kWithin) return decided;
  return judge.measure(b, decided);
}

}  // namespace vkh
