// The search for closest points of a mesh, on a device or on the processor alone.
#pragma once

#include <functional>
#include <span>

#include "host/solve/run.h"
#include "vkhausdorff/closest_points.h"
#include "vkhausdorff/frame.h"

namespace vkh {

/// Finds the faces of B that are closest to points of a frame; blocks until it is done.
using FindClosest = std::function<void(const PointBatch&)>;

/// B in a frame.
struct LaidB {
  const Mesh& mesh;
  Frame frame;
  double displacement;  ///< by storing it, in the frame, rounded up
  FindClosest find;
};
/// Stores B in another frame than its own, for points far from it.
using LayB = std::function<LaidB(const Frame&)>;

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

/// Throws as Solver::closest does. `b`: in its own frame.
ClosestPoints find_closest_points(const LaidB& b, const LayB& lay, const ClosestQuestion& question);
/// The same on a device.
ClosestPoints find_closest_points(Runner& runner, const FramedB& b,
                                  const ClosestQuestion& question);

}  // namespace vkh
