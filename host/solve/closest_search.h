// The search for closest points of a mesh that lies on a device.
#pragma once

#include <span>

#include "host/solve/run.h"
#include "vkhausdorff/closest_points.h"
#include "vkhausdorff/frame.h"

namespace vkh {

/// B in its own frame, on the device.
struct FramedB {
  const Mesh& mesh;
  Frame frame;
  double displacement;  ///< by storing it, in the frame, rounded up
  bool has_low;         ///< its vertices have low parts
  const ResidentMesh& resident;
};

struct ClosestQuestion {
  std::span<const DVec3> points;
  ClosestGoesOn goes_on;
};

/// Throws InputError that names the row of a point that is not finite.
void check_points(std::span<const DVec3> points);

/// Throws as Solver::closest does.
ClosestPoints find_closest_points(Runner& runner, const FramedB& b,
                                  const ClosestQuestion& question);

}  // namespace vkh
