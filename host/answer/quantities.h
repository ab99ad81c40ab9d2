// Sizes of memory, times and counts as people type them; lengths are in length.h. All throw
// UsageError that names the option, the text and the expected form.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "vkhausdorff/answer.h"

namespace vkh {

/// "2GiB", "512M", "1.5GB", or a plain number of bytes; at least one byte. K, M, G and T are powers
/// of 1024. The error names `option`.
uint64_t parse_size(const char* option, const std::string& text);

/// Seconds: "10s", "250ms", "2min", "1h", or a plain number of seconds; more than zero.
double parse_time(const char* option, const std::string& text);

/// "+0.25mm,-0.4mm": the limits over B and under it, in either order. Nothing for a text that has
/// no sign before a number.
std::optional<SidedMax> parse_sided(const char* option, const std::string& text);
/// Writes both limits in this form, the one over B first, as they were typed.
std::string sided_text(const Length& over, const Length& under);

/// "99.5%", or a number from 0 to 1. Throws UsageError.
double parse_share(const char* option, const std::string& text);

/// "95", or "95%": above 0 and at most 100; a number below 1 needs its percent sign. Throws
/// UsageError.
double parse_percentile(const char* option, const std::string& text);
/// Throws UsageError for a number below 1 without a percent sign, which may be a share, as JSON has
/// it, or a percentage.
void check_percentile(const char* option, double percentile);
/// An angle above 0 and at most 90 degrees.
double parse_angle(const char* option, const std::string& text);

/// The tolerance if none is asked for: a gate's is finer.
Length default_tolerance(bool has_limit);

/// "3/8": part 3, from 0, of 8. Throws UsageError.
PartOf parse_part(const char* option, const std::string& text);

}  // namespace vkh
