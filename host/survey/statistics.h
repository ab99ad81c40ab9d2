// Areas of A, and what is told of shares of them.
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

/// A distance in the frame that is not known better than that.
struct Threshold {
  double down, up;
};

/// A distance of the files in the frame, from below and above what it is on the stored meshes.
/// `displacement`: of both, in the frame.
Threshold threshold_at(const Frame& frame, double displacement, double distance);

/// The wish for percentiles: lengths are in the frame.
struct PercentileSearch {
  std::span<const double> shares;
  double resolution;  ///< bounds are to be so close to the best that the cells say
};

struct Moments {
  Enclosure mean, rms;  ///< in the frame
};
}  // namespace vkh
