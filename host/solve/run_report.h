// Writes what a run did and where it found its witness into a report.
#pragma once

#include "host/solve/run.h"
#include "vkhausdorff/frame.h"
#include "vkhausdorff/report.h"

namespace vkh {

void fill_counts(const RunOutput& r, const Frame& frame, Report& out);
void fill_stages(const RunOutput& run, Report& out);
void fill_witness(const VkhReport& r, const Mesh& a, const Mesh& b, Report& out);

}  // namespace vkh
