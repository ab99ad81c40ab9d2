// The order of a batch's results for people: the worst first.
#pragma once

#include <string>

#include "host/answer/result.h"

namespace vkh {

/// Whether there is an answer, with a limit that is above 0.
bool has_limit(const Result& result);

Outcome outcome_of(const Result& result);
/// "FAIL", "NO ANSWER", "UNDECIDED" or "NOT CLOSED", "CLOSED", "PASS".
const char* outcome_word(const Result& result);

/// The lower end as a multiple of the limit, rounded down; 0: no limit, or no answer.
double share_of_limit(const Result& result);
/// share_of_limit() in three digits, rounded down, such as "3.48"; empty: no limit, or no answer.
std::string share_of_limit_text(const Result& result);

/// A place in the order. Within an outcome, pairs without a limit come first, by their lower ends,
/// and then the others by the share of their limits. Upper ends do not count: a run with a limit
/// stops before it finds one.
struct Rank {
  Outcome outcome = Outcome::kWithin;
  bool has_limit = false;
  double size =
      0;  ///< share_of_limit(); without a limit the lower end, in mm where a unit is known
  std::string id;
};
Rank rank_of(const Result& result);
bool is_worse(const Rank& x, const Rank& y);

}  // namespace vkh
