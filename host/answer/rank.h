// The order of a batch's results for people: the worst first.
#pragma once

#include <string>

#include "host/answer/record.h"

namespace vkh {

/// The outcomes of a pair, the worst first.
enum class Outcome {
  kBeyond,    ///< beyond its limit
  kNoAnswer,  ///< a failure
  kOpen,      ///< undecided, or not closed
  kClosed,    ///< an interval, since there was no limit
  kWithin,    ///< within its limit
};
Outcome outcome_of(const Record& record);
/// "FAIL", "NO ANSWER", "UNDECIDED" or "NOT CLOSED", "CLOSED", "PASS".
const char* outcome_word(const Record& record);

/// The lower end as a multiple of the limit, rounded down; 0: no limit, or no answer.
double share_of_limit(const Record& record);
/// "3.48": that in three digits, rounded down; empty: no limit, or no answer.
std::string share_of_limit_text(const Record& record);

/// A place in the order. Of one outcome, pairs without a limit come first, by their lower ends;
/// then the others by the share of their limits. No upper end counts: a run with a limit stops
/// before it is found.
struct Rank {
  Outcome outcome = Outcome::kWithin;
  bool has_limit = false;
  double size =
      0;  ///< share_of_limit(); without a limit the lower end, in mm where a unit is known
  std::string id;
};
Rank rank_of(const Record& record);
bool is_worse(const Rank& x, const Rank& y);

}  // namespace vkh
