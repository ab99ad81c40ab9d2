// Tests whether a device keeps the promises that the certificate rests on (docs/certificate.md).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "shaders/gpu_types.h"
#include "vkhausdorff/device.h"

namespace vkh {

/// Where an invocation views its subgroup: all of it, in the two branches of a condition, in a loop
/// that invocations leave one by one.
enum class Flow { kWhole, kBranch, kLoop };
inline constexpr std::array kFlowNames{"in a whole subgroup", "in a branch", "in a loop"};

/// The subgroup operations that are tried, in the order in which a fault names them.
inline constexpr std::array kGroupOperations{
    "subgroupBallot",       "subgroupBroadcastFirst", "first_lane",
    "subgroupElect",        "subgroupBallotBitCount", "subgroupBallotExclusiveBitCount",
    "subgroupInclusiveAdd", "subgroupShuffle",        "subgroupMin",
    "subgroupMax"};

/// The views of subgroups at one Flow: their number, the number of partial ones, and for each of
/// kGroupOperations the number of views in which it was wrong.
struct GroupTally {
  uint64_t views = 0, partial = 0;
  std::array<uint64_t, kGroupOperations.size()> wrong{};
};

/// The observed behaviour of a device. `fault` is empty if every promise was kept.
struct SelfTestResult {
  std::string fault;  ///< the first broken promise: which operation, operands and error
  uint64_t items = 0;
  uint64_t composed = 0;          ///< composed expressions
  bool rounds_to_nearest = true;  ///< + - * and so exact error-free transformations; not needed
  bool flushes = false;           ///< some result under 2^-126 came out as 0; allowed
  double worst_quotient_ulp = 0, worst_root_ulp = 0;  ///< 2.5 and 6 are allowed
  uint32_t largest_subgroup = 0;
  std::array<GroupTally, kFlowNames.size()> groups;  ///< by Flow

  uint64_t group_views() const;    ///< times that an invocation tried every subgroup operation
  uint64_t partial_views() const;  ///< the ones with only a part of its subgroup
};

/// `count` questions, a multiple of gpu::kGroupSize, on which arithmetic goes wrong: mantissas of
/// all ones or next to a tie, sums that cancel, products near 2^-126.
std::vector<gpu::SelfTestQuestion> self_test_questions(uint64_t seed, uint32_t count);

/// Compares answers with exact results. Adds to `result`; a fault that stands is kept.
void judge_self_test(std::span<const gpu::SelfTestQuestion> questions,
                     std::span<const gpu::SelfTestAnswer> answers,
                     const gpu::SelfTestTotals& totals, SelfTestResult& result);

/// Judges the results in the subgroups of the first items. The device chooses which invocations run
/// together in divergent control flow; each operation must agree with the ballot about it.
void judge_groups(std::span<const gpu::SelfTestQuestion> questions,
                  std::span<const gpu::SelfTestGroups> groups, SelfTestResult& result);

/// The same for composed expressions: sums that a driver must not regroup.
std::vector<gpu::SelfTestOperands> composed_questions(uint64_t seed, uint32_t count);
void judge_composed(std::span<const gpu::SelfTestOperands> operands,
                    std::span<const gpu::SelfTestComposed> results, SelfTestResult& result);

/// A float of that range of binary exponents with a mantissa on which arithmetic goes wrong; draws
/// from `state`.
float hard_float(uint64_t& state, int lo, int hi);
uint64_t draw(uint64_t& state);  ///< splitmix64

/// Asks the device about a million questions. Throws DeviceError if it is lost.
SelfTestResult run_self_test(const Device& device);
/// Creates its pipeline and runs nothing: for tools/kernels/compile_kernels.cpp.
void compile_self_test(const Device& device);

}  // namespace vkh
