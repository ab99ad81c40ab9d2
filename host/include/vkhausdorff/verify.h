// A second opinion on a finished run, by the host alone: brute force over B, in other arithmetic
// and from other formulas than the device's.
#pragma once

#include "vkhausdorff/mesh.h"
#include "vkhausdorff/report.h"

namespace vkh {

/// Encloses d(witness, B) in the files' units, the witness being the exact point that the report
/// names by face and barycentrics, and compares it with report.lower.
///
/// Every face of B counts. A face's distance is bounded from below by a plane that separates it
/// from the witness: min over its corners s of (p - s).r / |r| is true for any r, so that only this
/// quotient needs care; r is the offset from the closest point found.
WitnessCheck verify_witness(const Mesh& a, const Mesh& b, const Report& report);

}  // namespace vkh
