// The way back, h(B, A), of a run of both directions.
#pragma once

#include "host/mesh/mesh.h"
#include "host/solve/report.h"

namespace vkh {

/// What is asked of the way back, `elapsed_s` after the way there began. Refers to `options`.
SolveOptions options_back(const SolveOptions& options, const Report& there, double elapsed_s);

/// The way back where the way there has decided the limit: true, and nothing was sought.
Report unsought_back(const Mesh& a, const Mesh& b, const Report& there);

}  // namespace vkh
