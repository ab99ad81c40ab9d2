// The doctor's judge on answers made on the CPU, right ones and each kind of wrong one; and the
// device at hand.
#include "host/check/self_test.h"

#include <doctest/doctest.h>

#include <bit>
#include <cmath>
#include <functional>

#include "tests/model/composed.h"
#include "tests/support/kernel_bench.h"

using namespace vkh;
using namespace vkh::test;
using Cpu = vkh::test::Device;  // in one of the arithmetics

namespace {

struct Answers {
  std::vector<gpu::SelfTestQuestion> questions;
  std::vector<gpu::SelfTestAnswer> answers;
  gpu::SelfTestTotals totals{};
};

constexpr uint32_t kSubgroup = 16;

/// What a device with subgroups of 16 would answer in this arithmetic.
Answers answered(const Cpu& device) {
  Answers out;
  out.questions = self_test_questions(7, 1024);
  out.totals = {.highest = 0, .lowest = UINT32_MAX, .items = 1024, .subgroups = 1024 / kSubgroup};
  for (uint32_t i = 0; i < out.questions.size(); ++i) {
    const gpu::SelfTestQuestion& q = out.questions[i];
    gpu::SelfTestAnswer x{};
    device.run([&] {
      const math::Two sum = math::two_sum(q.a, q.b), product = math::two_product(q.a, q.b);
      x = {.sum = q.a + q.b,
           .difference = q.a - q.b,
           .product = q.a * q.b,
           .quotient = q.a / q.b,
           .root = std::sqrt(std::abs(q.a)),
           .sum_hi = sum.hi,
           .sum_lo = sum.lo,
           .product_hi = product.hi,
           .product_lo = product.lo,
           .bits = q.bits,
           .larger = std::max(q.a, q.b),
           .smaller = std::min(q.a, q.b),
           .subgroup = i / kSubgroup,
           .highest = 0,
           .keepers = 0,
           .rank = 0};
      return 0;
    });
    const uint32_t first = i / kSubgroup * kSubgroup;
    for (uint32_t j = first; j < first + kSubgroup; ++j) {
      const bool keeps = out.questions[j].a > out.questions[j].b;
      x.highest = std::max(x.highest, std::abs(out.questions[j].a));
      x.keepers += keeps ? 1 : 0;
      x.rank += keeps && j < i ? 1 : 0;
    }
    out.answers.push_back(x);
    const auto bits = std::bit_cast<uint32_t>(std::abs(q.a));
    out.totals.highest = std::max(out.totals.highest, bits);
    out.totals.lowest = std::min(out.totals.lowest, bits);
  }
  return out;
}

std::string fault_of(const Answers& a) {
  SelfTestResult result;
  judge_self_test(a.questions, a.answers, a.totals, result);
  return result.fault;
}

void check_fault(const Answers& good, const char* named,
                 const std::function<void(Answers&)>& break_it) {
  Answers bad = good;
  break_it(bad);
  const std::string fault = fault_of(bad);
  CAPTURE(fault);
  CHECK(fault.find(named) != std::string::npos);
}

/// What a device would answer on composed expressions in this arithmetic.
std::string composed_fault(const Cpu& device, uint32_t count) {
  const std::vector<gpu::SelfTestOperands> questions = composed_questions(7, count);
  std::vector<gpu::SelfTestComposed> answers;
  for (const gpu::SelfTestOperands& q : questions)
    answers.push_back(device.run([&] { return answer_composed(q); }));
  SelfTestResult result;
  judge_composed(questions, answers, result);
  return result.fault;
}

float stepped(float x, int ulps) {
  for (; ulps > 0; --ulps) x = std::nextafter(x, INFINITY);
  for (; ulps < 0; ++ulps) x = std::nextafter(x, -INFINITY);
  return x;
}

}  // namespace

TEST_CASE("the judge accepts every arithmetic that Vulkan allows") {
  for (uint64_t i = 0; i < kArithmetics.size(); ++i) {
    const Cpu device(i);
    CAPTURE(device.name());
    CHECK(fault_of(answered(device)) == "");
    CHECK(composed_fault(device, 5000) == "");
  }
}

TEST_CASE("the judge names what a device gets wrong") {
  const Answers good = answered(Cpu(0));
  const auto at = [](Answers& a) -> gpu::SelfTestAnswer& { return a.answers[77]; };
  check_fault(good, "a + b", [&](Answers& a) { at(a).sum = stepped(at(a).sum, 2); });
  check_fault(good, "a - b", [&](Answers& a) { at(a).difference = stepped(at(a).difference, -2); });
  check_fault(good, "a * b", [&](Answers& a) { at(a).product = stepped(at(a).product, 2); });
  check_fault(good, "a / b", [&](Answers& a) { at(a).quotient = stepped(at(a).quotient, 6); });
  check_fault(good, "a / b", [&](Answers& a) { at(a).quotient = NAN; });
  check_fault(good, "sqrt(|a|)", [&](Answers& a) { at(a).root = stepped(at(a).root, 13); });
  // As if (a - (s - (s - a))) had been simplified to 0.
  check_fault(good, "two_sum", [](Answers& a) {
    for (gpu::SelfTestAnswer& x : a.answers) x.sum_lo = 0;
  });
  check_fault(good, "two_product", [](Answers& a) {
    for (gpu::SelfTestAnswer& x : a.answers) x.product_lo = 0;
  });
  check_fault(good, "bits of a float", [&](Answers& a) { at(a).bits ^= 1; });
  check_fault(good, "max(a, b)", [&](Answers& a) { at(a).larger = at(a).smaller; });
  check_fault(good, "min(a, b)", [&](Answers& a) { at(a).smaller = at(a).larger; });
  check_fault(good, "maximum is not", [&](Answers& a) { at(a).highest = 0; });
  check_fault(good, "does not count", [&](Answers& a) { at(a).keepers ^= 1; });
  check_fault(good, "does not number", [](Answers& a) {
    for (gpu::SelfTestAnswer& x : a.answers) x.rank = 0;
  });
  check_fault(good, "larger than its workgroup", [](Answers& a) {
    uint32_t all = 0;
    for (size_t i = 0; i < a.questions.size(); ++i) {
      a.answers[i].rank = all;
      all += a.questions[i].a > a.questions[i].b ? 1 : 0;
    }
    for (gpu::SelfTestAnswer& x : a.answers) {
      x.subgroup = 0;
      x.keepers = all;
      x.highest = std::bit_cast<float>(a.totals.highest);
    }
  });
  check_fault(good, "atomic maximum", [](Answers& a) { a.totals.highest -= 1; });
  check_fault(good, "atomic maximum or minimum", [](Answers& a) { a.totals.lowest += 1; });
  check_fault(good, "atomic sum", [](Answers& a) { a.totals.items -= 1; });
}

TEST_CASE("the device at hand keeps its promises") {
  const SelfTestResult result = run_self_test(test_device());
  CHECK(result.fault == "");
  CHECK(result.items >= 1'000'000);
  CHECK(result.composed >= 50'000);
  CHECK(result.largest_subgroup >= 1);
  CHECK(result.worst_quotient_ulp <= 2.5);
}
