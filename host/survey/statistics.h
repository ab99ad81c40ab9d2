// Areas of A, and what is told of shares of them.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "host/survey/cell_store.h"
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

/// The share of a triangle's area on which the affine function with these values at its corners is
/// at most `t`.
double share_within(float a, float b, float c, double t);

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

/// The mean over A's area of a quantity in [0, 1] that `of_cell` encloses on each cell.
Enclosure mean_over(const CellStore& cells, const Areas& areas,
                    const std::function<Enclosure(size_t)>& of_cell);

/// The share of cell i that is surely, and perhaps, within a distance.
Enclosure share_within(const CellStore& cells, size_t i, const Threshold& at);

/// The mean of d(x, B) over the cell, from below.
double mean_lower(const gpu::CellBounds& bounds);

struct Moments {
  Enclosure mean, rms;  ///< in the frame
};
}  // namespace vkh
