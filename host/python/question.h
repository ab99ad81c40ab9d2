// Reads the keywords of a call from Python as a Question.
#pragma once

#include <optional>

#include "host/python/arguments.h"
#include "vkhausdorff/question.h"

namespace vkh::python {

/// Reads tol, max, symmetric, time, waves, memory, preset, enable, disable, field, statistics,
/// bands, area, effort, survey_time, unit_a, unit_b, transform, scale and align, as far as they
/// were given. Numbers are those of the arrays: a tolerance is a fraction of A's diagonal, and
/// other lengths are in the coordinates' unit. Strings are as on the command line, without units,
/// which arrays do not have. `command`: the name of the function.
Question question_of(const char* command, const Arguments& given);

/// Reads a number of bytes, or a string such as '2GiB'.
std::optional<uint64_t> size_of(const Arguments& given, const char* name);

}  // namespace vkh::python
