// The options of `simplify`.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "host/app/typed.h"

namespace vkh {

struct TypedSimplify {
  Typed of_mesh;  ///< the options that it shares with commands about pairs
  std::string out, certificate;
  std::optional<uint32_t> levels;
  std::optional<double> ratio;
  bool one_way = false, lock_borders = false;
};

void add_simplify(CLI::App& command, TypedSimplify& typed);
/// Throws UsageError.
CommandLine simplify_line(const TypedSimplify& typed, const Words& words);

}  // namespace vkh
