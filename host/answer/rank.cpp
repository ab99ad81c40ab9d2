#include "host/answer/rank.h"

#include <cmath>

#include "host/base/decimal.h"
#include "vkhausdorff/length.h"

namespace vkh {

bool has_limit(const Result& result) {
  return result.has_answer() && result.answer.max && result.answer.max->limit.beyond > 0;
}

namespace {

Outcome outcome_by(ExitCode code, const Answer& answer) {
  if (code == kExitBeyond) return Outcome::kBeyond;
  if (code == kExitNotClosed) return Outcome::kOpen;
  return answer.max ? Outcome::kWithin : Outcome::kClosed;
}

}  // namespace

Outcome outcome_of(const Answer& answer) { return outcome_by(code_of(answer), answer); }

Outcome outcome_of(const Result& result) {
  return result.has_answer() ? outcome_by(result.code, result.answer) : Outcome::kNoAnswer;
}

const char* outcome_word(const Result& result) {
  switch (outcome_of(result)) {
    case Outcome::kBeyond:
      return "FAIL";
    case Outcome::kNoAnswer:
      return "NO ANSWER";
    case Outcome::kOpen:
      if (result.answer.metrics) return "WIDER THAN ASKED";
      return !result.answer.max ? "NOT CLOSED" : "UNDECIDED";
    case Outcome::kClosed:
      return "CLOSED";
    case Outcome::kWithin:
      break;
  }
  return "PASS";
}

// The quotient is off by half an ulp at most, unless it is subnormal: then by half of the least
// double. The double below it is under the exact one in either case.
double share_of_limit(const Result& result) {
  const double lower = interval_of(result.answer).lower;
  if (!has_limit(result) || !(lower > 0)) return 0;
  return std::nextafter(lower / result.answer.max->limit.beyond, 0.0);
}

std::string share_of_limit_text(const Result& result) {
  if (!has_limit(result)) return "";
  return decimal(share_of_limit(result), 3, Rounding::kDown);
}

Rank rank_of(const Result& result) {
  Rank rank{.outcome = outcome_of(result),
            .has_limit = has_limit(result),
            .size = share_of_limit(result),
            .id = result.name.id};
  if (!rank.has_limit)
    rank.size = in_millimetres(interval_of(result.answer).lower, result.answer.unit);
  return rank;
}

bool is_worse(const Rank& x, const Rank& y) {
  if (x.outcome != y.outcome) return x.outcome < y.outcome;
  if (x.has_limit != y.has_limit) return y.has_limit;
  return x.size != y.size ? x.size > y.size : x.id < y.id;
}

}  // namespace vkh
