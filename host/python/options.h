// Keywords that all functions share: what a run may cost, how narrow it has to be, its limit.
#pragma once

#include <optional>
#include <variant>

#include "host/base/length.h"
#include "host/mesh/mesh.h"
#include "host/python/arguments.h"
#include "host/solve/solve_options.h"

namespace vkh::python {

/// Reads tol, time, waves, memory, preset, enable and disable. The run has no callback.
SolveOptions options_of(const Arguments& given);

/// Reads a number of bytes, or a string such as '2GiB'.
std::optional<uint64_t> size_of(const Arguments& given, const char* name);

/// A limit of the whole mesh, as a number in the coordinates' unit or a share of A's diagonal.
using MaxAsked = std::variant<Limit, Length>;
/// Reads `max`, which is there: a number, or a string such as '0.1%'.
MaxAsked read_max(const Arguments& given, const char* expected);
/// Returns the limit in A's own coordinates. Touches nothing of Python.
Limit limit_for(const MaxAsked& max, const Mesh& a);

}  // namespace vkh::python
