// Metrics from both directions of a pair.
#pragma once

#include "host/survey/distribution.h"
#include "vkhausdorff/metrics.h"
#include "vkhausdorff/report.h"

namespace vkh {

/// One direction: its interval, and the survey of the mesh that it begins at, whose only percentile
/// is the requested one.
struct MeasuredDirection {
  const Report& report;
  const Statistics& statistics;
  const Distribution& distribution;
};

/// Computes the figures. Both directions have the same bands.
Metrics metrics_of(const MetricsOptions& options, const MeasuredDirection& a,
                   const MeasuredDirection& b);

}  // namespace vkh
