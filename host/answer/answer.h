// A report for people (a short table) and for programs (one versioned JSON object).
#pragma once

#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "host/answer/options.h"
#include "host/solve/report.h"

namespace vkh {

const char* program_version();

/// What was asked about a pair of meshes and what came out of it.
struct Answer {
  std::string file_a, file_b;
  Tolerance tolerance;             ///< a fraction is of A's diagonal in both directions
  std::vector<std::string> notes;  ///< what people should know about the input
  Report a_to_b;
  std::optional<Report> b_to_a;  ///< there for a symmetric run
};

/// The whole answer's interval.
CertifiedInterval interval_of(const Answer& answer);

/// One sentence for each status.
const char* stop_reason(Status status);

/// One line of JSON, without a newline at its end: schema "vkhausdorff.distance/1", or
/// "vkhausdorff.symmetric/1" with the two directed objects in "directed".
std::string to_json(const Answer& answer);

/// Ten to fifteen lines; `verbose` adds the stages, the waves and the cull histogram.
void print_table(std::ostream& out, const Answer& answer, bool verbose);

}  // namespace vkh
