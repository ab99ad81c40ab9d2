// A chain of ever coarser meshes, each with its proven distance from A itself.
#pragma once

#include <functional>
#include <vector>

#include "vkhausdorff/simplify.h"

namespace vkh {

struct LevelsOptions {
  SimplifyOptions
      simplify;        ///< its limit ends the chain; its progress callback hears of each level
  size_t levels = 5;   ///< most levels
  double ratio = 0.5;  ///< of faces, from one level to the next; in (0, 1)
};

/// The reason why a chain has no further level.
enum class ChainEnd {
  kAll,        ///< it has as many as were asked for
  kNoFewer,    ///< no mesh of fewer faces was found
  kFarther,    ///< the next one is farther than the limit
  kUndecided,  ///< the next one is not proven to be within the limit
  kEnded,      ///< time or the callback ended it
};

/// Makes each level from A, with ratio^k of its faces, the finest first, and measures it. The chain
/// ends before a level that is not proven to be within the limit, that has not fewer faces than the
/// one before it, or for which there is no time: Simplified::complete of the last one is then
/// false. Writes the reason to `end`, unless it is null. Throws what simplify() throws, and
/// UsageError for a ratio that is not between 0 and 1.
std::vector<Simplified> simplify_levels(Solver& solver, const Mesh& a, const LevelsOptions& options,
                                        ChainEnd* end = nullptr);

}  // namespace vkh
