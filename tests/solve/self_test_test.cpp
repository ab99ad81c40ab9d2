// The doctor's judge on answers made on the CPU, right ones and each kind of wrong one; and the
// device at hand.
#include "host/app/self_test.h"

#include <doctest/doctest.h>

#include <bit>
#include <cmath>
#include <functional>
#include <set>

#include "kernels/all_kernels.h"
#include "kernels/self_test.h"
#include "tests/support/kernel_bench.h"
#include "tests/verification/model/composed.h"

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

/// The answers of a device with subgroups of 16 in this arithmetic.
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

/// A device's answers on composed expressions in this arithmetic.
std::string composed_fault(const Cpu& device, uint32_t count) {
  const std::vector<gpu::SelfTestOperands> questions = composed_questions(7, count);
  std::vector<gpu::SelfTestComposed> answers;
  for (const gpu::SelfTestOperands& q : questions)
    answers.push_back(device.run([&] { return answer_composed(q); }));
  SelfTestResult result;
  judge_composed(questions, answers, result);
  return result.fault;
}

/// The answers of a device with subgroups of 16; `keep` decides which items share a branch.
gpu::SelfTestGroup looked(const std::vector<gpu::SelfTestQuestion>& questions, uint32_t item,
                          uint32_t turn, bool swaps, const std::function<bool(uint32_t)>& keep) {
  gpu::SelfTestGroup g{};
  const uint32_t start = item / kSubgroup * kSubgroup;
  g.subgroup = item / kSubgroup;
  g.lane = item - start;
  for (uint32_t lane = 0; lane < kSubgroup; ++lane) {
    const uint32_t other = start + lane;
    if (!keep(other)) continue;
    const float a = swaps ? questions[other].b : questions[other].a;
    const float b = swaps ? questions[other].a : questions[other].b;
    if (g.members++ == 0) {
      g.first = g.first_lane = lane;
      g.shuffled = other + turn;
      g.least = g.highest = a;
      g.all_least = g.all_highest = {a, b, -a};
    }
    g.ballot.x |= 1u << lane;
    g.rank += lane < g.lane ? 1 : 0;
    g.sum += lane <= g.lane ? other + turn + 1 : 0;
    g.least = std::min(g.least, a);
    g.highest = std::max(g.highest, a);
    g.all_least = {g.least, std::min(g.all_least.y, b), std::min(g.all_least.z, -a)};
    g.all_highest = {g.highest, std::max(g.all_highest.y, b), std::max(g.all_highest.z, -a)};
  }
  g.elected = g.lane == g.first ? 1 : 0;
  return g;
}

std::vector<gpu::SelfTestGroups> looked_around(
    const std::vector<gpu::SelfTestQuestion>& questions) {
  std::vector<gpu::SelfTestGroups> all;
  for (uint32_t i = 0; i < questions.size(); ++i) {
    const uint32_t turn = questions[i].bits & 3u;
    const bool larger = questions[i].a > questions[i].b;
    const auto same_branch = [&](uint32_t j) {
      return (questions[j].a > questions[j].b) == larger;
    };
    const auto still_there = [&](uint32_t j) { return (questions[j].bits & 3u) >= turn; };
    all.push_back({looked(questions, i, 0, false, [](uint32_t) { return true; }),
                   looked(questions, i, 0, !larger, same_branch),
                   looked(questions, i, turn, false, still_there)});
  }
  return all;
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
  // The result if (a - (s - (s - a))) had been simplified to 0.
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

TEST_CASE("the judge names the subgroup operation that is wrong, and where") {
  const std::vector<gpu::SelfTestQuestion> questions = self_test_questions(3, 256);
  const auto fault_with = [&](const std::function<void(gpu::SelfTestGroups&)>& break_it) {
    std::vector<gpu::SelfTestGroups> groups = looked_around(questions);
    break_it(groups[77]);
    SelfTestResult result;
    judge_groups(questions, groups, result);
    return result.fault;
  };
  CHECK(fault_with([](gpu::SelfTestGroups&) {}) == "");
  std::vector<gpu::SelfTestGroups> wrong_twice = looked_around(questions);
  for (const size_t i : {5u, 77u}) wrong_twice[i].loop.sum ^= 1;
  SelfTestResult counted;
  judge_groups(questions, wrong_twice, counted);
  CHECK(counted.groups[2].wrong == decltype(GroupTally::wrong){0, 0, 0, 0, 0, 0, 2, 0, 0, 0});
  CHECK(counted.groups[0].wrong == decltype(GroupTally::wrong){});
  CHECK(counted.group_views() == 3 * questions.size());
  CHECK(counted.groups[0].partial == 0);
  CHECK(counted.partial_views() == counted.groups[1].partial + counted.groups[2].partial);
  using Field = uint32_t gpu::SelfTestGroup::*;
  const std::pair<Field, const char*> fields[] = {
      {&gpu::SelfTestGroup::first, "subgroupBroadcastFirst"},
      {&gpu::SelfTestGroup::first_lane, "first_lane"},
      {&gpu::SelfTestGroup::elected, "subgroupElect"},
      {&gpu::SelfTestGroup::members, "subgroupBallotBitCount"},
      {&gpu::SelfTestGroup::rank, "subgroupBallotExclusiveBitCount"},
      {&gpu::SelfTestGroup::sum, "subgroupInclusiveAdd"},
      {&gpu::SelfTestGroup::shuffled, "subgroupShuffle"}};
  for (const auto& pair : fields) {
    const Field field = pair.first;
    const char* name = pair.second;
    CAPTURE(name);
    const auto named = [&](const std::string& fault, const char* where) {
      CHECK(fault.find(name + std::string(" is wrong ") + where) == 0);
    };
    named(fault_with([&](auto& g) { g.whole.*field ^= 1; }), "in a whole subgroup");
    named(fault_with([&](auto& g) { g.branch.*field ^= 1; }), "in a branch");
    named(fault_with([&](auto& g) { g.loop.*field ^= 1; }), "in a loop");
  }
  const auto starts = [](const std::string& text, const char* with) {
    return text.find(with) == 0;
  };
  CHECK(starts(fault_with([](auto& g) { g.branch.least -= 1; }), "subgroupMin"));
  CHECK(starts(fault_with([](auto& g) { g.loop.all_least.z -= 1; }), "subgroupMin"));
  CHECK(starts(fault_with([](auto& g) { g.branch.highest += 1; }), "subgroupMax"));
  CHECK(starts(fault_with([](auto& g) { g.whole.all_highest.y += 1; }), "subgroupMax"));
  CHECK(starts(fault_with([](auto& g) { g.branch.ballot = g.whole.ballot; }), "subgroupBallot"));
  CHECK(
      starts(fault_with([](auto& g) { g.whole.ballot.x &= g.whole.ballot.x - 1; }), "subgroupBa"));
}

namespace {

// Subgroup operations of a kernel: the opcode, and the kind if it has kinds. 333 to 366 are
// OpGroupNonUniform* of the SPIR-V specification; those of arithmetic and bit counts have the kind
// behind the scope.
std::set<std::pair<uint32_t, uint32_t>> subgroup_operations(std::span<const uint32_t> words) {
  std::set<std::pair<uint32_t, uint32_t>> found;
  for (size_t at = 5; at < words.size(); at += words[at] >> 16) {
    const uint32_t op = words[at] & 0xffffu;
    if (op < 333 || op > 366) continue;
    const bool has_kind = op == 342 || (op >= 349 && op <= 364);
    found.insert({op, has_kind ? words[at + 4] : 0});
  }
  return found;
}

}  // namespace

TEST_CASE("the self-test tries every subgroup operation of every kernel") {
  const auto tried = subgroup_operations(k::SelfTest::words());
  constexpr uint32_t kFindLsb = 343, kFindMsb = 344;  // RADV fails on the former
  size_t used = 0;
  const auto see = [&](const char* kernel, std::span<const uint32_t> words) {
    for (const auto& operation : subgroup_operations(words)) {
      CAPTURE(kernel);
      CAPTURE(operation.first);
      CHECK(tried.contains(operation));
      CHECK(operation.first != kFindLsb);
      CHECK(operation.first != kFindMsb);
      ++used;
    }
  };
#define VKH_SEE(K) see(#K, k::K::words());
  VKH_KERNELS(VKH_SEE)
#undef VKH_SEE
  CHECK(used > 10);
}

TEST_CASE("the device at hand keeps its promises") {
  const SelfTestResult result = run_self_test(test_device());
  CHECK(result.fault == "");
  CHECK(result.items >= 1'000'000);
  CHECK(result.composed >= 50'000);
  CHECK(result.largest_subgroup >= 1);
  CHECK(result.group_views() >= 100'000);
  CHECK((result.largest_subgroup == 1 || result.partial_views() >= 10'000));
  CHECK(result.worst_quotient_ulp <= 2.5);
}
