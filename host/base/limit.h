// A length to stay within.
#pragma once

namespace vkh {

/// A length in the files' units, rounded down and up to doubles: a distance of at most `within` is
/// surely within it, one above `beyond` surely is not. 0: none.
struct Limit {
  double within = 0, beyond = 0;
};

}  // namespace vkh
