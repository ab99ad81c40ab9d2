// The known bounds of d(x, B) over all of A: by faces, and in figures of the whole surface.
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "vkhausdorff/report.h"
#include "vkhausdorff/side.h"

namespace vkh {

/// A true statement: the quantity that it encloses lies in [lower, upper]. `upper` may be infinite.
struct Enclosure {
  double lower = 0, upper = 0;
  /// A value between the two that is likely, and proves nothing. None where none was found.
  std::optional<double> estimate = {};
};

/// The bounds of each face of A, by its number in the mesh: the largest d(x, B) over the face lies
/// in [lower, upper], in the files' units, rounded outward.
struct Field {
  std::vector<double> lower, upper;

  size_t face_count() const { return lower.size(); }
  Enclosure of(size_t face) const { return {lower[face], upper[face]}; }
};

/// The verdict of one face: within the limit if upper is, beyond it if lower is; each is proven.
inline Verdict verdict_of(const Field& field, size_t face, const Limit& limit) {
  return verdict_of(field.lower[face], field.upper[face], limit);
}

/// The summary of all faces: the widest bounds, and how many have each verdict.
struct FieldSummary {
  size_t faces = 0;
  double width = 0;
  size_t within = 0, beyond = 0, undecided = 0;
};
FieldSummary summary_of(const Field& field, const Limit& limit);

/// The share of A's area, in [0, 1], that is within `distance` of B.
struct AreaWithin {
  double distance = 0;  ///< in the files' units
  Enclosure share;
  /// More effort does not narrow the share, because too much area lies within rounding of this
  /// distance.
  bool jump = false;
  /// With SurveyOptions::normals_within: the share whose normals agree, too.
  std::optional<Enclosure> agreeing = {};
};

/// The least distance that `share` of A's area is within.
struct Percentile {
  double share = 0;  ///< in [0, 1]: 0.5 is the median
  Enclosure distance;
  /// Proven: nearly no area lies at distances within `distance`, so that no effort narrows it.
  bool jump = false;
};

/// Figures that are weighted by area, and certified. Lengths are in the files' units.
struct Statistics {
  double area = 0;      ///< A's area, rounded to nearest; 0 for points
  uint64_t points = 0;  ///< if A is points, how many: all figures weigh them alike, not an area
  /// The share of A, or of its points, that is within SurveyOptions::max_distance: all figures are
  /// of this part. Unset: they are of all of A.
  std::optional<Enclosure> kept = {};
  double max_distance = 0;  ///< what `kept` is within
  /// Moments of d(x, B) over A. Of one that was not computed nothing is known.
  Enclosure mean = {0, std::numeric_limits<double>::infinity()};
  Enclosure rms = mean;
  std::vector<AreaWithin> bands;
  std::vector<Percentile> percentiles;
  /// With SurveyOptions::normals_within: the mean of the cosines of angles between A's normals and
  /// those of B's closest faces, without their signs; in [0, 1].
  std::optional<Enclosure> normal_cosine = {};
  /// The whole distribution, for charts: distances that ascend from 0 to the largest upper.
  /// Empty where only the shares within `bands` have goals.
  std::vector<AreaWithin> curve;
};

/// The shares at which the distribution of signed distances is reported: both of its ends matter.
inline constexpr std::array kSignedShares = {0.01, 0.05, 0.5, 0.95, 0.99};

/// A point of A with a proven side.
struct SidedPoint {
  SurfacePoint at;
  double lower = 0;  ///< it is at least so far from B
};

/// The sides of A: over B, in front of its faces as they are oriented, or under it. A cell has a
/// side where that is proven; the rest is counted as unsigned. The signed distance is negative
/// under B; where there is no side, it may be either.
struct SignedFigures {
  /// The largest distance of a point over B, and of one under it: `upper` covers what has no side,
  /// `lower` does not. [0, 0]: there is none.
  Enclosure over, under;
  /// Far points of both sides: `over.lower` is at least over_witness->lower. None: no cell has that
  /// side.
  std::optional<SidedPoint> over_witness, under_witness;
  Inside inside = Inside::kUndecided;       ///< whether B has an inside, so that cells share sides
  InsideOut inside_out = InsideOut::kNone;  ///< whether B's faces look inward
  EdgeCounts edges;                         ///< of B
  struct Areas {
    Enclosure over, under;                  ///< shares of A's area
    std::array<Enclosure, kDoubts> doubts;  ///< those without a side, by Doubt
  };
  std::optional<Areas> areas;           ///< none if A has no area
  std::optional<Enclosure> mean;        ///< of the signed distance; with statistics
  std::vector<Percentile> percentiles;  ///< of the signed distance; with statistics
  /// The same as `over` and `under` for each face, with SurveyOptions::faces.
  Field over_of_faces, under_of_faces;
  double ms = 0;  ///< the time that sides took
};

/// The verdict on a surface with limits that differ by side: within if each side is within its
/// own, what has no side within both; beyond if some point with a side is beyond that.
Verdict verdict_of(const Enclosure& over, const Enclosure& under, const SidedLimits& limits);
/// The summary of all faces by such limits.
FieldSummary summary_of(const Field& field, const SignedFigures& sides, const SidedLimits& limits);

}  // namespace vkh
