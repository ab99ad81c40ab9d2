// The host's side of the self-test's subgroup operations: each invocation's results against the
// operands of the invocations in its ballot.
#include <algorithm>
#include <array>
#include <bit>
#include <map>
#include <utility>

#include "host/app/self_test.h"

namespace vkh {
namespace {

using Trial = gpu::SelfTestQuestion;
using Group = gpu::SelfTestGroup;
using Groups = gpu::SelfTestGroups;

constexpr uint32_t kLanes = 128;  // the widest subgroup that Vulkan has

bool holds(const gpu::uvec4& ballot, uint32_t lane) {
  const std::array words{ballot.x, ballot.y, ballot.z, ballot.w};
  return lane < kLanes && (words[lane / 32] >> (lane % 32) & 1u) != 0;
}

uint32_t last_turn(const Trial& q) { return q.bits & 3u; }

/// Holds an invocation's operands, which its subgroup combines.
struct Given {
  uint32_t item;
  float a, b;
};

/// Holds the results that one invocation should have for each operation.
struct Expected {
  uint32_t members = 0, first = 0, first_item = 0, rank = 0, sum = 0;
  gpu::vec3 least{}, highest{};
};

bool same(const gpu::vec3& p, const gpu::vec3& q) { return p.x == q.x && p.y == q.y && p.z == q.z; }

class Judge {
 public:
  Judge(std::span<const Trial> questions, std::span<const Groups> groups) : asked_(questions) {
    for (uint32_t i = 0; i < groups.size(); ++i) {
      const Group& g = groups[i].whole;
      items_[{g.subgroup, g.lane}] = i;
      ++sizes_[g.subgroup];
    }
  }

  /// Returns the operations that are wrong, a bit for each of kGroupOperations. If the ballot is
  /// wrong, the others cannot be judged.
  uint32_t faults(uint32_t item, const Group& seen, Flow flow) const {
    constexpr uint32_t kBallot = 1;
    Expected e;
    if (!holds(seen.ballot, seen.lane)) return kBallot;
    for (uint32_t lane = 0; lane < kLanes; ++lane) {
      if (!holds(seen.ballot, lane)) continue;
      const auto other = items_.find({seen.subgroup, lane});
      if (other == items_.end() || !may_be_beside(item, other->second, flow)) return kBallot;
      add(given(other->second, flow, last_turn(asked_[item])), lane, seen.lane, e);
    }
    const bool is_whole = flow == Flow::kWhole;
    if (is_whole && e.members != sizes_.at(seen.subgroup)) return kBallot;
    return compare(seen, e);
  }

 private:
  /// Whether both items can be at the place in the code of `item`'s last view.
  bool may_be_beside(uint32_t item, uint32_t other, Flow flow) const {
    const Trial &q = asked_[item], &o = asked_[other];
    if (flow == Flow::kBranch) return (q.a > q.b) == (o.a > o.b);
    return flow == Flow::kWhole || last_turn(o) >= last_turn(q);
  }

  Given given(uint32_t item, Flow flow, uint32_t turn) const {
    const Trial& q = asked_[item];
    if (flow == Flow::kBranch && !(q.a > q.b)) return {item, q.b, q.a};
    return {flow == Flow::kLoop ? item + turn : item, q.a, q.b};
  }

  static void add(const Given& g, uint32_t lane, uint32_t own_lane, Expected& e) {
    const gpu::vec3 all{g.a, g.b, -g.a};
    if (e.members++ == 0) {
      e.first = lane;
      e.first_item = g.item;
      e.least = e.highest = all;
    }
    e.least = {std::min(e.least.x, all.x), std::min(e.least.y, all.y), std::min(e.least.z, all.z)};
    e.highest = {std::max(e.highest.x, all.x), std::max(e.highest.y, all.y),
                 std::max(e.highest.z, all.z)};
    e.rank += lane < own_lane ? 1 : 0;
    e.sum += lane <= own_lane ? g.item + 1 : 0;
  }

  // In the order of kGroupOperations, behind the ballot.
  static uint32_t compare(const Group& seen, const Expected& e) {
    const std::array wrong{seen.first != e.first,
                           seen.first_lane != e.first,
                           seen.elected != (seen.lane == e.first ? 1u : 0u),
                           seen.members != e.members,
                           seen.rank != e.rank,
                           seen.sum != e.sum,
                           seen.shuffled != e.first_item,
                           seen.least != e.least.x || !same(seen.all_least, e.least),
                           seen.highest != e.highest.x || !same(seen.all_highest, e.highest)};
    static_assert(wrong.size() + 1 == kGroupOperations.size());
    uint32_t bits = 0;
    for (size_t i = 0; i < wrong.size(); ++i) bits |= wrong[i] ? 2u << i : 0u;
    return bits;
  }

  std::span<const Trial> asked_;
  std::map<std::pair<uint32_t, uint32_t>, uint32_t> items_;  // by subgroup and lane
  std::map<uint32_t, uint32_t> sizes_;                       // sizes of subgroups
};

}  // namespace

void judge_groups(std::span<const Trial> questions, std::span<const Groups> groups,
                  SelfTestResult& result) {
  const Judge judge(questions, groups);
  for (uint32_t i = 0; i < groups.size(); ++i) {
    const std::array seen{&groups[i].whole, &groups[i].branch, &groups[i].loop};
    for (size_t flow = 0; flow < seen.size(); ++flow) {
      const uint32_t faults = judge.faults(i, *seen[flow], static_cast<Flow>(flow));
      GroupTally& tally = result.groups[flow];
      for (size_t k = 0; k < kGroupOperations.size(); ++k) tally.wrong[k] += faults >> k & 1u;
      if (faults != 0 && result.fault.empty())
        result.fault =
            std::string(kGroupOperations[static_cast<size_t>(std::countr_zero(faults))]) +
            " is wrong " + kFlowNames[flow] + ", of item " + std::to_string(i);
      ++tally.views;
      tally.partial += seen[flow]->members < groups[i].whole.members ? 1 : 0;
    }
  }
}

uint64_t SelfTestResult::group_views() const {
  return groups[0].views + groups[1].views + groups[2].views;
}

uint64_t SelfTestResult::partial_views() const {
  return groups[0].partial + groups[1].partial + groups[2].partial;
}

}  // namespace vkh
