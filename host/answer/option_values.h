// Converts a text to the value of an option, and the value to a line of a pair's key, by the kind
// of the option. Options that fill in more than one member have functions of their own.
#pragma once

#include <string>

#include "host/answer/options_table.h"

namespace vkh {

/// The most cells to bound for a pair of a batch with --metrics: a few pairs that need more would
/// take most of the list's time (docs/log/measurements.md).
constexpr uint64_t kEffortOfMetrics = 1'000'000;

/// "a, b or c", with `last` between the last two.
std::string joined(const std::vector<std::string>& names, const char* last);
/// The values that a count may have, for messages: "a whole number of cells from 0 to 100".
std::string whole_number(const Option& option);

/// Reads a length, or a tolerance, as `given` has it. Throws UsageError.
///
///                  | a number alone: of a length       | of a tolerance
///   kTyped         | refused                           | a fraction of A's diagonal up to 1e-3
///   kPythonText    | refused, as is a unit of its own  | a fraction of A's diagonal
///   kPythonNumber  | in the files' unit                | a fraction of A's diagonal
Length length_of(Kind kind, const Given& given, const std::string& text);

/// Throws InputError for a text that is neither true nor false.
void check_truth(const std::string& said, const std::string& text);

// The options with a rule of their own. Each throws UsageError.

void put_max(const Given& given, Request& asked);  ///< one limit, or one for each side
void put_area(const Given& given, Request& asked);
void put_polygons(const Given& given, Request& asked);
void put_bodies(const Given& given, Request& asked);
void put_points(const Given& given, Request& asked);
void put_transform(const Given& given, Request& asked);
void put_json(const Given& given, Request& asked);  ///< no text: on standard output
void put_range(const Given& given, Request& asked);
void put_no_cache(const Given& given, Request& asked);

std::string typed_max(const Request& asked);
std::string area_text(const Request& asked);
std::string polygons_text(const Request& asked);
std::string bodies_text(const Request& asked);
std::string points_text(const Request& asked);
/// The matrix, once it was read: files of other names may have the same one.
std::string transform_text(const Request& asked);

}  // namespace vkh
