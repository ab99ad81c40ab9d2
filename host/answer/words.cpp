// An answer's first line, and what its parts are called.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "engine/vkhausdorff.h"
#include "host/answer/answer.h"
#include "host/base/decimal.h"
#include "host/base/rounding.h"

namespace vkh {
namespace {

std::string with_unit(std::string number, const Answer& answer) {
  if (!answer.unit.empty()) number.append(" ").append(answer.unit);
  return number;
}

std::string point_text(const SurfacePoint& p) {
  char text[160];
  std::snprintf(text, sizeof text, "(%.9g, %.9g, %.9g) on face %llu", p.point.x, p.point.y,
                p.point.z, static_cast<unsigned long long>(p.face));
  return text;
}

// Of upper, in percent.
std::string share_of_diagonal(const Answer& answer, double upper) {
  const double diagonal = answer.a_to_b.diagonal_a;
  if (!(diagonal > 0)) return "";
  const double share = 100 * divide_up(upper, diagonal);
  return " (" + decimal(share, 3, Rounding::kUp) + " % of A's diagonal)";
}

/// The direction whose lower bound is the larger: its witness proves what is beyond.
const Report& farther(const Answer& answer) {
  const Report& r = answer.a_to_b;
  return answer.b_to_a && answer.b_to_a->lower > r.lower ? *answer.b_to_a : r;
}

std::string distance_in_words(const Answer& answer) {
  const CertifiedInterval whole = interval_of(answer);
  const bool both = answer.b_to_a.has_value();
  const std::string all = both ? "every point of A and of B " : "every point of A ";
  const std::string other = both ? "the other" : "B";
  if (whole.upper == 0) return all + "lies on " + other;
  std::string text = std::isfinite(whole.upper)
                         ? all + "is within " +
                               length_up(answer, whole.upper, whole.upper - whole.lower) + " of " +
                               other
                         : "no bound was found yet";
  if (whole.lower > 0) {
    text += ", and one point is at least " +
            length_down(answer, whole.lower, whole.upper - whole.lower) + " away";
  }
  return text + (std::isfinite(whole.upper) ? share_of_diagonal(answer, whole.upper) : "");
}

std::string hint(const Answer& answer, Status status) {
  if (status == Status::kTime) return "; ask for more --time";
  if (status == Status::kWaves) return "; ask for more --waves";
  if (status == Status::kMemory) return "; ask for more --memory";
  if (status == Status::kCancelled) return "; it was interrupted";
  return "; ask for a smaller --tol than " + answer.tolerance.requested;
}

std::string gate_in_words(const Answer& answer) {
  const CertifiedInterval whole = interval_of(answer);
  const double gap = whole.upper - whole.lower;
  const std::string asked = answer.max->length.requested;
  const std::string interval =
      "[" + decimal(whole.lower, digits_that_matter(whole.lower, gap), Rounding::kDown) + ", " +
      with_unit(decimal(whole.upper, digits_that_matter(whole.upper, gap), Rounding::kUp) + "]",
                answer);
  const char* h = answer.b_to_a ? "max(h(A,B), h(B,A))" : "h(A,B)";
  switch (verdict_of(answer)) {
    case Verdict::kWithin:
      return std::string("PASS  ") + h + " <= " + asked + ", proven: it is in " + interval;
    case Verdict::kBeyond: {
      const Report& r = farther(answer);
      const bool is_there = &r == &answer.a_to_b;
      // Never down to the limit itself.
      const double margin = std::min(r.lower - answer.max->limit.beyond, gap);
      const std::string far =
          with_unit(decimal(r.lower, digits_that_matter(r.lower, margin), Rounding::kDown), answer);
      if (!r.has_witness)
        return "FAIL  a point of " + std::string(is_there ? "A" : "B") + " is at least " + far +
               " from " + (is_there ? "B" : "A");
      return "FAIL  " + point_text(r.witness_a) + (is_there ? " of A" : " of B") + " is at least " +
             far + " from " + (is_there ? "B" : "A");
    }
    case Verdict::kUndecided:
      break;
  }
  return "UNDECIDED  " + asked + " lies in " + interval + hint(answer, whole.status);
}

}  // namespace

const char* program_version() { return VKH_VERSION_STRING; }

CertifiedInterval interval_of(const Answer& answer) {
  const Report& r = answer.a_to_b;
  if (!answer.b_to_a) return {r.lower, r.upper, r.gap(), r.status};
  return symmetric_interval(r, *answer.b_to_a);
}

Verdict verdict_of(const Answer& answer) {
  const CertifiedInterval whole = interval_of(answer);
  return verdict_of(whole.lower, whole.upper, answer.max->limit);
}

const char* stop_reason(Status status) {
  switch (status) {
    case Status::kClosed:
      return "the interval meets the tolerance";
    case Status::kPrecision:
      return "what is left cannot be decided in this arithmetic";
    case Status::kTime:
      return "the time budget ended";
    case Status::kWaves:
      return "the wave budget ended";
    case Status::kMemory:
      return "the memory did not hold what had to be refined";
    case Status::kCancelled:
      return "it was interrupted";
    case Status::kPruned:
      return "it exceeds the other direction's lower bound by no more than the tolerance";
    case Status::kLimit:
      return "the limit was decided, which was all that was asked";
  }
  return "unknown";
}

std::string length_down(const Answer& answer, double length, double gap) {
  return with_unit(decimal(length, digits_that_matter(length, gap), Rounding::kDown), answer);
}
std::string length_up(const Answer& answer, double length, double gap) {
  return with_unit(decimal(length, digits_that_matter(length, gap), Rounding::kUp), answer);
}

std::string printable(const std::string& text) {
  std::string out;
  for (size_t i = 0; i < text.size(); ++i) {
    const auto c = static_cast<unsigned char>(text[i]);
    // Of UTF-8, U+0080 to U+009F, which some terminals take for the same.
    const bool is_c1 = c == 0xc2 && i + 1 < text.size() &&
                       static_cast<unsigned char>(text[i + 1]) >= 0x80 &&
                       static_cast<unsigned char>(text[i + 1]) < 0xa0;
    if (c >= 0x20 && c != 0x7f && !is_c1) {
      out += text[i];
      continue;
    }
    char escape[8];
    std::snprintf(escape, sizeof escape, "\\x%02x", c);
    out += escape;
    if (!is_c1) continue;
    std::snprintf(escape, sizeof escape, "\\x%02x", static_cast<unsigned char>(text[++i]));
    out += escape;
  }
  return out;
}

std::string in_words(const Answer& answer) {
  return answer.max ? gate_in_words(answer) : distance_in_words(answer);
}

}  // namespace vkh
