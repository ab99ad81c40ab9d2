// The reverse direction, h(B, A), of a run of both directions.
#pragma once

#include "vkhausdorff/mesh.h"
#include "vkhausdorff/report.h"

namespace vkh {

/// The options of the reverse direction, `elapsed_s` after the forward direction began. Refers to
/// `options`.
SolveOptions options_back(const SolveOptions& options, const Report& there, double elapsed_s);

/// The reverse report if the forward direction has decided the limit: a true interval, without a
/// search.
Report unsearched_back(const Mesh& a, const Mesh& b, const Report& there);

}  // namespace vkh
