#include "host/answer/rank.h"

#include <cmath>

#include "host/base/decimal.h"
#include "vkhausdorff/length.h"

namespace vkh {

Outcome outcome_of(const Record& record) {
  if (record.status.empty()) return Outcome::kNoAnswer;
  if (record.code == kExitBeyond) return Outcome::kBeyond;
  if (record.code == kExitNotClosed) return Outcome::kOpen;
  return record.verdict.empty() ? Outcome::kClosed : Outcome::kWithin;
}

const char* outcome_word(const Record& record) {
  switch (outcome_of(record)) {
    case Outcome::kBeyond:
      return "FAIL";
    case Outcome::kNoAnswer:
      return "NO ANSWER";
    case Outcome::kOpen:
      if (record.metrics) return "WIDER THAN ASKED";
      return record.verdict.empty() ? "NOT CLOSED" : "UNDECIDED";
    case Outcome::kClosed:
      return "CLOSED";
    case Outcome::kWithin:
      break;
  }
  return "PASS";
}

// The quotient is off by half an ulp at most, unless it is subnormal: then by half of the least
// double. The double below it is under the exact one in either case.
double share_of_limit(const Record& record) {
  if (record.status.empty() || !(record.limit.beyond > 0) || !(record.lower > 0)) return 0;
  return std::nextafter(record.lower / record.limit.beyond, 0.0);
}

std::string share_of_limit_text(const Record& record) {
  if (record.status.empty() || !(record.limit.beyond > 0)) return "";
  return decimal(share_of_limit(record), 3, Rounding::kDown);
}

Rank rank_of(const Record& record) {
  Rank rank{.outcome = outcome_of(record),
            .has_limit = record.limit.beyond > 0,
            .size = share_of_limit(record),
            .id = record.name.id};
  if (!rank.has_limit) rank.size = in_millimetres(record.lower, record.unit);
  return rank;
}

bool is_worse(const Rank& x, const Rank& y) {
  if (x.outcome != y.outcome) return x.outcome < y.outcome;
  if (x.has_limit != y.has_limit) return y.has_limit;
  return x.size != y.size ? x.size > y.size : x.id < y.id;
}

}  // namespace vkh
