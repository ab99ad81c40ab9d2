#include "host/solve/way_back.h"

#include <algorithm>

#include "host/base/rounding.h"
#include "host/solve/switches.h"
#include "vkhausdorff/frame.h"

namespace vkh {

// The reverse direction has the forward direction's tolerance, which is a fraction of A's diagonal,
// and what is left of the time: the forward one had half of it. A run cannot be resumed, so time
// that the reverse direction leaves would not help the forward one, which would need more than its
// half again. Every candidate whose u is within the tolerance of the forward direction's lower
// bound can be closed: max(h(A,B), h(B,A)) is no smaller than that bound.
SolveOptions options_back(const SolveOptions& options, const Report& there, double elapsed_s) {
  constexpr double kLeastTime = 1e-3;  // even a spent budget buys a first, true interval
  SolveOptions back = options;
  back.tolerance = there.tolerance;  // 0 where A is one point
  back.tolerance_is_absolute = true;
  back.engine.fine = there.tolerance < kFineTolerance * there.diagonal_a || options.engine.fine;
  back.time_limit_s = std::max(options.time_limit_s - elapsed_s, kLeastTime);
  back.known_lower = std::max(options.known_lower, there.lower);
  const bool cancelled = there.status == Status::kCancelled;
  back.progress = [&options, cancelled](Progress progress) {
    progress.back = true;
    return !cancelled && (!options.progress || options.progress(progress));
  };
  return back;
}

Report unsearched_back(const Mesh& a, const Mesh& b, const Report& there) {
  Report back;
  back.status = Status::kLimit;
  const Box box_b = bounding_box(b);
  back.upper = farthest_in(join(bounding_box(a), box_b), add_up(a.delta, b.delta));
  back.diagonal_a = diagonal(box_b);
  back.tolerance = there.tolerance;
  back.limit = there.limit;
  back.mesh_a = there.mesh_b;
  back.mesh_b = there.mesh_a;
  back.place_a = there.place_b;
  back.place_b = there.place_a;
  back.device = there.device;
  back.preset = there.preset;
  back.switched_on = there.switched_on;
  back.switched_off = there.switched_off;
  return back;
}

}  // namespace vkh
