// A variant to time: a preset, switches changed in it, and its memory, under one name.
#pragma once

#include <string>

#include "vkhausdorff/solver.h"

namespace vkh::bench {

struct Variant {
  std::string name;
  SolveOptions options;
};

/// "paper", "paper-sort", "+packet" (of default), "default-thin-u3+u4", "-defer@64MiB". `common` is
/// what all variants have. Throws std::runtime_error.
Variant variant_of(const std::string& name, const SolveOptions& common);

}  // namespace vkh::bench
