// Metrics of two surfaces by the names that papers use (docs/metrics.md), each enclosed, from the
// surveys of both directions.
#pragma once

#include <array>
#include <initializer_list>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "vkhausdorff/field.h"
#include "vkhausdorff/report.h"
#include "vkhausdorff/survey.h"

namespace vkh {

/// A figure, and whether it is as narrow as was asked. Before anything is known it has no bounds
/// and is not narrow.
struct Metric {
  Enclosure value{0, std::numeric_limits<double>::infinity()};
  bool is_met = false;
  /// No effort narrows it, because much area lies at exactly this distance, or nearly none around
  /// it.
  bool jump = false;
};

/// The figures at a distance: shares of area, in [0, 1].
struct MetricsWithin {
  double distance = 0;                ///< in the files' units
  Metric nsd, precision, recall, f1;  ///< of both areas; of A's; of B's; of the last two
  /// The same, of area whose normals agree, too. Known with Metrics::normals alone.
  Metric precision_normals, recall_normals, f1_normals;
};

/// The figures of a pair. Lengths are in the files' units, chamfer_l2 in their square.
struct Metrics {
  double percentile = 95;            ///< of hd_p and hd_p_pooled, in percent
  std::vector<std::string> figures;  ///< MetricsOptions::figures: others have no goal
  std::optional<double> normals;     ///< MetricsOptions::normals
  Metric hausdorff, hd_p, hd_p_pooled, masd, assd, rms, chamfer_l1, chamfer_l2;
  Metric normal_consistency;  ///< in [0, 1]; known with `normals` alone
  std::vector<MetricsWithin> within;

  /// Returns whether a figure of this name is asked for.
  bool asks_for(std::string_view name) const;
  /// Returns whether all requested figures are as narrow as asked.
  bool is_met() const;
};

/// The metrics that are asked for.
struct MetricsOptions {
  double percentile = 95;  ///< in (0, 100]
  /// Names of kNamedMetrics and kNamedShares. Only these have goals. The others get the intervals
  /// that come without further work, and no estimates if only shares are named. Empty: all.
  std::vector<std::string> figures = {};
  /// If set: figures of normals are wanted, too. Normals agree if their angle is at most this, in
  /// degrees from 0 to 90.
  std::optional<double> normals = {};
  /// The width that is enough: of a length, as a fraction of its own lower end, but no less than a
  /// millionth of the larger diagonal or what floats leave; of a share.
  static constexpr double kTolerance = 0.02, kShareTolerance = 0.001;
  static constexpr double kNormalTolerance = 0.01;  ///< of normal_consistency

  /// Returns whether any figure of these names is asked for.
  bool asks_for(std::initializer_list<std::string_view> names) const;
};

/// A figure by its name in JSON.
struct NamedMetric {
  const char* name;
  Metric Metrics::*figure;
  int dimension;            ///< the power of the unit
  bool of_normals = false;  ///< only with Metrics::normals
};
inline constexpr std::array<NamedMetric, 9> kNamedMetrics{
    {{"hausdorff", &Metrics::hausdorff, 1},
     {"hd_p", &Metrics::hd_p, 1},
     {"hd_p_pooled", &Metrics::hd_p_pooled, 1},
     {"masd", &Metrics::masd, 1},
     {"assd", &Metrics::assd, 1},
     {"rms", &Metrics::rms, 1},
     {"chamfer_l1", &Metrics::chamfer_l1, 1},
     {"chamfer_l2", &Metrics::chamfer_l2, 2},
     {"normal_consistency", &Metrics::normal_consistency, 0, true}}};
struct NamedShare {
  const char* name;
  Metric MetricsWithin::*figure;
  bool of_normals = false;
};
inline constexpr std::array<NamedShare, 7> kNamedShares{
    {{"nsd", &MetricsWithin::nsd},
     {"precision", &MetricsWithin::precision},
     {"recall", &MetricsWithin::recall},
     {"f1", &MetricsWithin::f1},
     {"precision_normals", &MetricsWithin::precision_normals, true},
     {"recall_normals", &MetricsWithin::recall_normals, true},
     {"f1_normals", &MetricsWithin::f1_normals, true}}};

/// The names of kNamedMetrics and kNamedShares between commas.
std::string names_of_figures();
/// Checks names of figures, where "hd95" and "hd95_pooled" stand for hd_p and hd_p_pooled if 95 is
/// the percentile, and returns them as they are in the tables above. Throws UsageError, which
/// begins with `option`.
std::vector<std::string> checked_figures(const std::string& option,
                                         const std::vector<std::string>& names, double percentile);

/// The name with the percentile in place of p: "hd95_pooled".
std::string name_of(const NamedMetric& metric, double percentile);

// The formulas, for tests: each encloses its value for all numbers within its arguments.

/// w x + (1 - w) y for w in `weight`, which lies in [0, 1]; x and y are not negative.
Enclosure weighted(const Enclosure& weight, const Enclosure& x, const Enclosure& y);
/// a / (a + b) of positive numbers.
Enclosure weight_of(const Enclosure& a, const Enclosure& b);
/// The harmonic mean of two numbers in [0, 1]; 0 of two zeros.
Enclosure harmonic_mean(const Enclosure& x, const Enclosure& y);
/// sqrt(w x^2 + (1 - w) y^2).
Enclosure weighted_rms(const Enclosure& weight, const Enclosure& x, const Enclosure& y);

}  // namespace vkh
