// A length to stay within.
#pragma once

#include <algorithm>

#include "vkhausdorff/needs_cpp20.h"

namespace vkh {

/// A length in the files' units, rounded down and up to doubles: a distance of at most `within` is
/// surely within it, one above `beyond` surely is not. 0: none.
struct Limit {
  double within = 0, beyond = 0;
};

/// Limits of points over B and of points under it.
struct SidedLimits {
  Limit over, under;
  /// The limit of points whose side is not known.
  Limit smaller() const {
    return {std::min(over.within, under.within), std::min(over.beyond, under.beyond)};
  }
  /// The limit that no point may exceed.
  Limit larger() const {
    return {std::max(over.within, under.within), std::max(over.beyond, under.beyond)};
  }
};

}  // namespace vkh
