// Areas of A, and the types for shares of them.
#pragma once

#include <span>
#include <vector>

#include "host/solve/cells.h"
#include "vkhausdorff/field.h"

namespace vkh {

/// The areas of A's faces, in a unit that A's own size decides, so that none is lost beside a large
/// B. Points have no area: each weighs 1.
struct Areas {
  std::vector<double> of_face;
  double whole = 0;
  double error = 0;  ///< error of `whole`, and of any sum of parts of the faces
  Frame unit;        ///< unit of these areas
  /// Returns whether A has an area that figures can be shares of. Below 2^-700 products of it
  /// underflow.
  bool is_positive() const { return whole > 2 * error && whole >= 0x1p-700; }
};
Areas areas_of(const Mesh& a);

float least_float_above(double x);

/// A distance in the frame, known to lie between two numbers.
struct Threshold {
  double down, up;
};

/// Converts a distance of the files to the frame, with bounds of what it is on the stored meshes.
/// `displacement`: of both, in the frame.
Threshold threshold_at(const Frame& frame, double displacement, double distance);

/// A search for percentiles. Lengths are in the frame.
struct PercentileSearch {
  std::span<const double> shares;
  double resolution;  ///< bounds have to be this close to the best that the cells prove
};

struct Moments {
  Enclosure mean, rms;  ///< in the frame
};
}  // namespace vkh
