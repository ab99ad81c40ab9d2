// The host's side of the self-test: exact results, in double where 53 bits hold them and in two
// doubles where they do not.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <map>

#include "host/app/self_test.h"

namespace vkh {
namespace {

constexpr double kHalfUlp2 = 0x1p-45;  // the operands' share that two_sum and two_product may lose
constexpr double kLeastNormal = 0x1p-126;
constexpr double kQuotientUlps = 2.5;
constexpr double kRootUlps = 6;

double as_double(float x) { return static_cast<double>(x); }

/// value + rest without rounding, rest under half an ulp of value.
struct Exact {
  double value, rest;
};

Exact exact_sum(double a, double b) {
  const double s = a + b;
  const double from_b = s - a;
  return {s, (a - (s - from_b)) + (b - from_b)};
}

/// |got - exact| in double: got is near, so the first difference is exact or the result is
/// hopeless.
double distance(double got, const Exact& exact) {
  return std::abs((got - exact.value) - exact.rest);
}

std::string number(double x) {
  char text[48];
  std::snprintf(text, sizeof text, "%a", x);
  return text;
}

class OperationJudge {
 public:
  OperationJudge(const gpu::SelfTestQuestion& question, const gpu::SelfTestAnswer& answer,
                 SelfTestResult& result)
      : a_(as_double(question.a)),
        b_(as_double(question.b)),
        q_(question),
        answer_(answer),
        result_(result) {}

  void all() {
    rounded("a + b", as_double(answer_.sum), exact_sum(a_, b_));
    rounded("a - b", as_double(answer_.difference), exact_sum(a_, -b_));
    rounded("a * b", as_double(answer_.product), {a_ * b_, 0});
    const double quotient = a_ / b_, root = std::sqrt(std::abs(a_));
    within("a / b", as_double(answer_.quotient), quotient, kQuotientUlps,
           result_.worst_quotient_ulp);
    within("sqrt(|a|)", as_double(answer_.root), root, kRootUlps, result_.worst_root_ulp);
    pairs();
    promise(answer_.bits == q_.bits, "the bits of a float", static_cast<double>(answer_.bits));
    promise(answer_.larger == std::max(q_.a, q_.b), "max(a, b)", as_double(answer_.larger));
    promise(answer_.smaller == std::min(q_.a, q_.b), "min(a, b)", as_double(answer_.smaller));
  }

 private:
  void promise(bool kept, const char* what, double got) {
    if (kept || !result_.fault.empty()) return;
    result_.fault = std::string(what) + " is " + number(got) + " for a = " + number(a_) +
                    ", b = " + number(b_) + ", bits " + std::to_string(q_.bits) +
                    ", outside of what Vulkan allows";
  }

  /// Requires one of the two floats around the exact result, or 0 where flushing is allowed.
  void rounded(const char* what, double got, const Exact& exact) {
    const double size = std::abs(exact.value);
    const double off = distance(got, exact);
    if (size < kLeastNormal) {
      result_.flushes = result_.flushes || (got == 0 && size > 0);
      promise(got == 0 || off <= 0x1p-149, what, got);
      return;
    }
    const double ulp = std::ldexp(1.0, std::ilogb(size) - 23);
    result_.rounds_to_nearest = result_.rounds_to_nearest && off <= 0.5 * ulp;
    promise(off < ulp && std::isfinite(got), what, got);
  }

  void within(const char* what, double got, double exact, double ulps, double& worst) {
    const double size = std::abs(exact);
    if (size < kLeastNormal) {
      promise(std::abs(got) <= 2 * kLeastNormal, what, got);
      return;
    }
    const double off = std::abs(got - exact) / std::ldexp(1.0, std::ilogb(size) - 23);
    worst = std::max(worst, off);
    promise(off <= ulps * (1 + 0x1p-20), what, got);  // NaN fails
  }

  /// Checks the error-free transformations: reassociation or a product's contraction would break
  /// them.
  void pairs() {
    const Exact sum = exact_sum(a_, b_);
    const double left =
        std::abs(((sum.value - as_double(answer_.sum_hi)) + sum.rest) - as_double(answer_.sum_lo));
    promise(left <= kHalfUlp2 * (std::abs(a_) + std::abs(b_)) + 0x1p-125, "two_sum(a, b)",
            as_double(answer_.sum_lo));
    const double product = a_ * b_;
    const double rest =
        std::abs((product - as_double(answer_.product_hi)) - as_double(answer_.product_lo));
    promise(rest <= kHalfUlp2 * std::abs(product) + 0x1p-120, "two_product(a, b)",
            as_double(answer_.product_lo));
  }

  double a_, b_;
  const gpu::SelfTestQuestion& q_;
  const gpu::SelfTestAnswer& answer_;
  SelfTestResult& result_;
};

struct Subgroup {
  float highest = 0;
  uint32_t keepers = 0, members = 0;
  std::vector<uint32_t> ranks;
};

/// Whether each of the keepers has a rank of its own, 0, 1, 2, ...
bool are_ranks(std::vector<uint32_t> ranks) {
  std::sort(ranks.begin(), ranks.end());
  for (uint32_t i = 0; i < ranks.size(); ++i) {
    if (ranks[i] != i) return false;
  }
  return true;
}

std::string subgroup_fault(std::span<const gpu::SelfTestQuestion> questions,
                           std::span<const gpu::SelfTestAnswer> answers, uint32_t& largest) {
  std::map<uint32_t, Subgroup> all;
  for (size_t i = 0; i < answers.size(); ++i) {
    Subgroup& s = all[answers[i].subgroup];
    const bool keeps = questions[i].a > questions[i].b;
    s.highest = std::max(s.highest, std::abs(questions[i].a));
    s.keepers += keeps ? 1 : 0;
    if (keeps) s.ranks.push_back(answers[i].rank);
    largest = std::max(largest, ++s.members);
  }
  for (size_t i = 0; i < answers.size(); ++i) {
    const Subgroup& s = all[answers[i].subgroup];
    if (answers[i].highest != s.highest)
      return "a subgroup's maximum is not the largest of its values";
    if (answers[i].keepers != s.keepers)
      return "a subgroup's ballot does not count its invocations";
  }
  for (const auto& [name, s] : all) {
    if (!are_ranks(s.ranks)) return "a subgroup's ballot does not number its invocations";
    if (s.members > gpu::kGroupSize) return "a subgroup is larger than its workgroup";
  }
  return {};
}

std::string totals_fault(std::span<const gpu::SelfTestQuestion> questions,
                         const gpu::SelfTestTotals& totals) {
  uint32_t highest = 0, lowest = UINT32_MAX;
  for (const gpu::SelfTestQuestion& q : questions) {
    const auto bits = std::bit_cast<uint32_t>(std::abs(q.a));
    highest = std::max(highest, bits);
    lowest = std::min(lowest, bits);
  }
  if (totals.highest != highest || totals.lowest != lowest)
    return "an atomic maximum or minimum lost a value";
  if (totals.items != questions.size()) return "an atomic sum lost a count";
  return {};
}

}  // namespace

uint64_t draw(uint64_t& state) {
  uint64_t z = (state += 0x9e3779b97f4a7c15u);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

float hard_float(uint64_t& state, int lo, int hi) {
  const uint64_t bits = draw(state);
  uint32_t mantissa = static_cast<uint32_t>(bits) & 0x7fffffu;
  switch (bits >> 32 & 7u) {
    case 0:
      mantissa = 0;
      break;
    case 1:
      mantissa = 0x7fffff;
      break;
    case 2:
      mantissa = (mantissa & ~0xfffu) | 0x800u;
      break;
    case 3:
      mantissa &= 7u;
      break;
    default:
      break;
  }
  const int exponent =
      lo + static_cast<int>((bits >> 36 & 0xffffu) % static_cast<uint32_t>(hi - lo + 1));
  const auto biased = static_cast<uint32_t>(127 + exponent);
  return std::bit_cast<float>(static_cast<uint32_t>(bits >> 63) << 31 | biased << 23 | mantissa);
}

std::vector<gpu::SelfTestQuestion> self_test_questions(uint64_t seed, uint32_t count) {
  std::vector<gpu::SelfTestQuestion> questions(count);
  uint64_t state = seed;
  for (gpu::SelfTestQuestion& q : questions) {
    const uint64_t way = draw(state) & 7u;
    // These exponents keep exact sums in two doubles and exact products in one.
    q.a = hard_float(state, -20, 20);
    q.b = hard_float(state, -20, 20);
    if (way == 0)
      q.b = -std::bit_cast<float>(std::bit_cast<uint32_t>(q.a) ^
                                  (static_cast<uint32_t>(draw(state)) & 0xffu));
    if (way == 1) {
      q.a = hard_float(state, -70, -40);
      q.b = hard_float(state, -80, -50);  // products from 2^-150 on
    }
    if (way == 2) q.b = std::bit_cast<float>(std::bit_cast<uint32_t>(q.b) & 0xfffff000u);
    q.bits = std::bit_cast<uint32_t>(hard_float(state, -126, 127));
  }
  return questions;
}

void judge_self_test(std::span<const gpu::SelfTestQuestion> questions,
                     std::span<const gpu::SelfTestAnswer> answers,
                     const gpu::SelfTestTotals& totals, SelfTestResult& result) {
  for (size_t i = 0; i < questions.size(); ++i)
    OperationJudge(questions[i], answers[i], result).all();
  result.items += questions.size();
  const std::string together = subgroup_fault(questions, answers, result.largest_subgroup);
  if (result.fault.empty()) result.fault = together;
  if (result.fault.empty()) result.fault = totals_fault(questions, totals);
}

}  // namespace vkh
