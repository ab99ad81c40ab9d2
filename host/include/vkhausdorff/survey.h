// A survey of A: cells are bounded, and the ones that matter most are split, until the goals are
// met or the effort is used. Its results are true whenever it ends, and the same to the last bit on
// the same device, unless time or the caller ended it.
#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "vkhausdorff/cell_map.h"
#include "vkhausdorff/field.h"
#include "vkhausdorff/solve_options.h"

namespace vkh {

class Solver;
struct PairView;

/// The reason why a survey ended; of several, the last one here.
enum class SurveyEnd {
  kMet,     ///< all goals are met
  kBits,    ///< no split brings a goal nearer: 20 bits are used up, points are measured, or A has
            ///< no area
  kEffort,  ///< SurveyOptions::effort is used
  kTime,    ///< the time limit was over: another run may get further
  kCancelled,  ///< `goes_on` said so, or the run that it follows was cancelled
  kMemory,     ///< there was no memory for it
};
/// The word for it in JSON and in Python: "met", "bits", "effort", "time", "cancelled", "memory".
const char* survey_end_name(SurveyEnd end);

/// The effort of a survey that names none. On a CPU device that is about ten seconds on two cores,
/// on a GPU what the goals of all but a few of the public pairs need (docs/log/measurements.md).
size_t default_effort(bool on_cpu);

struct SurveyOptions {
  bool faces = false;  ///< each face's bounds have to be narrow; otherwise it is bounded once
  /// The width to reach, in the files' units; 0: `face_tolerance` of what the largest distance is
  /// at least.
  double field_tolerance = 0;
  double face_tolerance = 0.01;
  /// If set, faces are only to be proven within it or beyond.
  Limit limit = {};
  bool statistics = false;
  /// The width to reach of the mean, the root mean square and percentiles, each: a fraction of its
  /// own lower end, but no less than 1e-6 of A's diagonal, or than what floats leave.
  double mean_tolerance = 0.02;
  /// The share of A's area that may be undecided in each of `bands`.
  double area_tolerance = 0.001;
  std::vector<double> bands;  ///< distances, in the files' units
  /// If set: the other surface's shares within `bands`. A share is then met when the harmonic mean
  /// of both is known to area_tolerance, too.
  std::vector<Enclosure> other_shares = {};
  /// If set: figures and the map are of the part of A within it alone: Statistics::kept, and
  /// CellMap::max_distance. The field, and the distance itself, are of all of A.
  std::optional<Limit> max_distance = {};
  /// If set, a share: a band is met as soon as it is known whether this share of A's area is within
  /// it.
  std::optional<double> enough = {};
  std::vector<double> percentiles = {0.5, 0.9, 0.95, 0.99};  ///< shares of A's area, 0 to 1
  /// false: the mean, the root mean square or the percentiles are enclosed, and have no goal. Where
  /// none of them has one, only the shares within `bands` have estimates, and there is no curve.
  bool narrows_mean = true, narrows_rms = true, narrows_percentiles = true;
  /// With statistics of a surface: also the agreement of normals, of an angle from 0 to 90 degrees.
  /// Normals are of the corners as the meshes hold them; Mesh::delta is no part of them.
  std::optional<double> normals_within = {};
  /// The widths to reach of the mean cosine, and of agreeing shares.
  double cosine_tolerance = 0.01, agreeing_tolerance = 0.001;
  std::optional<MapOptions> map = {};  ///< result.map is wanted
  /// The sides of A are wanted, of 95 % of its area that is farther from B than a hundredth of the
  /// largest distance: result.sides.
  bool is_signed = false;
  /// With sides and statistics: the width to reach of the signed mean and percentiles, as a share
  /// of the figure itself, or of the mean distance where that is larger; and, as a share of A's
  /// diagonal, the width that is always enough.
  double signed_tolerance = 0.02, signed_floor = 1e-6;
  /// If set: A is only to be proven within the limits of its sides, or beyond. Sides are wanted.
  std::optional<SidedLimits> sided = {};
  /// An upper bound of all distances, in the files' units.
  double upper = std::numeric_limits<double>::infinity();
  /// The number of cells that the device may bound besides each face once. Unset:
  /// default_effort(). The device needs some 115 bytes for each of them. A point of A is not split
  /// but measured once, on the host. That counts as two cells, like a split.
  std::optional<size_t> effort = {};
  /// The limit for the survey alone. A survey that it ends differs from run to run. Where sides are
  /// wanted, cells are split in the first 70 % of it, so that there is time to find them.
  double time_limit_s = std::numeric_limits<double>::infinity();
  /// The time that a submission of cells should take: `goes_on` is called between submissions. No
  /// result depends on it.
  double submission_ms = 50;
  /// Called between submissions, and between pieces of the work on sides, with the number of cells
  /// bounded so far; false ends the survey.
  std::function<bool(size_t)> goes_on;
};

struct SurveyResult {
  Field field;
  bool faces = false;  ///< SurveyOptions::faces
  /// The summary of a field that is not held, since the answer was read from JSON.
  std::optional<FieldSummary> summary = {};
  std::optional<Statistics> statistics;
  std::optional<SignedFigures> sides = {};
  std::shared_ptr<const CellMap> map = {};  ///< null where A has no area; copies share it
  std::optional<MapShares> shares = {};     ///< the shares that pictures of the map name
  SurveyEnd ended = SurveyEnd::kCancelled;
  bool is_met() const { return ended == SurveyEnd::kMet; }
  size_t effort = 0;  ///< SurveyOptions::effort, or the default
  size_t cells = 0;
  size_t bounded = 0;  ///< cells that were bounded, including the ones that were split later
  double ms = 0;
  double device_ms = 0;  ///< part of `ms`: submissions, from the first byte sent to the last one
                         ///< read
};

/// The field of a run that ended before its survey began: all that is known is that no distance is
/// above `upper`.
Field field_within(size_t face_count, double upper);

/// Surveys the pair's A in a run of its own, which takes `engine`, memory and progress from `run`.
/// Throws what Solver throws; UsageError for a percentile outside [0, 1] and for statistics or
/// sides of meshes of any triangulation; and InputError for sides of a B with two faces that use an
/// edge in one direction.
SurveyResult survey_mesh(Solver& solver, const PairView& pair, const SurveyOptions& options,
                         const SolveOptions& run = {});

}  // namespace vkh
