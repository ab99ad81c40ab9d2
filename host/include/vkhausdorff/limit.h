// A length to stay within.
#pragma once

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
  const Limit& smaller() const { return over.within <= under.within ? over : under; }
  /// The limit that no point may exceed.
  const Limit& larger() const { return over.within <= under.within ? under : over; }
};

}  // namespace vkh
