// Reads a tally of a survey's cells: its integers as enclosures of what is proven of A, in the
// frame.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "host/solve/cells.h"
#include "host/survey/area_figures.h"
#include "host/survey/statistics.h"

namespace vkh {

/// The areas of A's faces as integers, together between 2^59 and 2^62.
struct AreaWeights {
  std::vector<uint64_t> of_face;
  double whole = 0;  ///< all of them, rounded to nearest
  /// The areas of parts of faces, in the integers' unit, differ together from their parts of the
  /// integers by no more than this.
  double error = 0;
};
/// All weights are 0 unless the areas can have shares: Areas::is_positive().
AreaWeights weights_of(const Areas& areas);

/// The plan of a tally at some thresholds: at most gpu::kSurveyEdges. Each end of them ascends by
/// itself, so that a threshold has a place for either.
struct TallyEdges {
  struct Places {
    size_t down, up;
  };
  std::vector<gpu::SurveyEdge> edges;
  std::vector<Places> of;  ///< of each threshold
};
TallyEdges edges_of(std::span<const Threshold> thresholds);
/// A threshold in floats: its ends are no nearer.
gpu::SurveyEdge edge_of(const Threshold& at);

/// The plan of a tally at these edges.
gpu::SurveyPlan plan_of(const TallyEdges& at, const Tally& asked);

/// Adds the tally of other cells.
void add_table(const gpu::SurveyTable& table, gpu::SurveyTable& sum);

/// The unit of a tally: every distance is below 2^(unit - 127), or every cosine.
int tally_unit(float farthest);
inline constexpr int kCosineUnit = 128;

class AreaTable {
 public:
  AreaTable(const gpu::SurveyTable& table, const TallyEdges& at, const AreaWeights& weights,
            int unit);

  /// Adds the table's answers for cells of some classes: appends shares of A's area, and overwrites
  /// everything else.
  void answer(const Tally& asked, Tallied& all) const;

 private:
  double lowest() const;   // no distance is less,
  double highest() const;  // and none is more
  Enclosure share(const TallyEdges::Places& at, bool are_all) const;
  Moments moments(double most) const;
  double mean_down(uint32_t sum, double largest) const;
  double mean_up(uint32_t sum, double largest) const;

  const gpu::SurveyTable& table_;
  const TallyEdges& at_;
  const AreaWeights& weights_;
  const double unit_;
  std::vector<double> surely_, perhaps_;  // areas within each edge
};

}  // namespace vkh
