// The host's side of the self-test's subgroup operations: each invocation's results against the
// operands of the invocations in its ballot.
#include <algorithm>
#include <array>
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

enum class Flow { kWhole, kBranch, kLoop };
constexpr std::array kFlowNames{"in a whole subgroup", "in a branch", "in a loop"};

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

  /// Returns the operation that is wrong, or an empty text.
  std::string fault(uint32_t item, const Group& seen, Flow flow) const {
    Expected e;
    if (!holds(seen.ballot, seen.lane)) return "subgroupBallot";
    for (uint32_t lane = 0; lane < kLanes; ++lane) {
      if (!holds(seen.ballot, lane)) continue;
      const auto other = items_.find({seen.subgroup, lane});
      if (other == items_.end() || !may_be_beside(item, other->second, flow))
        return "subgroupBallot";
      add(given(other->second, flow, last_turn(asked_[item])), lane, seen.lane, e);
    }
    const bool is_whole = flow == Flow::kWhole;
    if (is_whole && e.members != sizes_.at(seen.subgroup)) return "subgroupBallot";
    return compare(seen, e);
  }

 private:
  /// Whether both can be at the place in the code where `item` took its last view.
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

  static std::string compare(const Group& seen, const Expected& e) {
    if (seen.first != e.first) return "subgroupBroadcastFirst";
    if (seen.first_lane != e.first) return "first_lane";
    if (seen.elected != (seen.lane == e.first ? 1u : 0u)) return "subgroupElect";
    if (seen.members != e.members) return "subgroupBallotBitCount";
    if (seen.rank != e.rank) return "subgroupBallotExclusiveBitCount";
    if (seen.sum != e.sum) return "subgroupInclusiveAdd";
    if (seen.shuffled != e.first_item) return "subgroupShuffle";
    if (seen.least != e.least.x || !same(seen.all_least, e.least)) return "subgroupMin";
    if (seen.highest != e.highest.x || !same(seen.all_highest, e.highest)) return "subgroupMax";
    return {};
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
      const std::string fault = judge.fault(i, *seen[flow], static_cast<Flow>(flow));
      if (!fault.empty() && result.fault.empty())
        result.fault = fault + " is wrong " + kFlowNames[flow] + ", of item " + std::to_string(i);
      ++result.group_views;
      result.partial_views += seen[flow]->members < groups[i].whole.members ? 1 : 0;
    }
  }
}

}  // namespace vkh
