// VKH_CONTEXT_BY_ADDRESS and BVHs of several ranges: every bit of a report is that
// of a run that binds everything.
#include <doctest/doctest.h>

#include <vector>

#include "host/solve/run.h"
#include "tests/shapes/shapes.h"
#include "tests/support/api_bench.h"
#include "tests/support/kernel_bench.h"

namespace {

using namespace vkh;
using namespace vkh::test;

constexpr VkDeviceSize kAllocation = 64 << 10;  // several for the BVH of 5,120 faces

struct Ways {
  uint32_t switches;
  VkhDeviceKind kind;
};
constexpr Ways kWays[] = {
    {0, VKH_DEVICE_KIND_WIDE},
    {0, VKH_DEVICE_KIND_NARROW},
    {VKH_SWITCH_CENTROID | VKH_SWITCH_SORT | VKH_SWITCH_PACKET | VKH_SWITCH_DEFER |
         VKH_SWITCH_PAIRS | VKH_SWITCH_LARGEST_FIRST | VKH_SWITCH_U3_PAPER | VKH_SWITCH_U4,
     VKH_DEVICE_KIND_WIDE}};

ContextHandle make_context(const Ways& ways, VkBool32 by_address) {
  const VkhContextCreateInfo info = create_info(ways.switches, ways.kind, by_address);
  VkhContext context = nullptr;
  REQUIRE(vkhCreateContext(&info, &context) == VKH_SUCCESS);
  return {context, vkhDestroyContext};
}

bool device_has_addresses() {
  if (test_device().has_addresses()) return true;
  MESSAGE("SKIP: the device has no bufferDeviceAddress");
  return false;
}

/// The reports of one pair: built and begun, advanced, moved and refitted, begun warm.
std::vector<VkhReport> reports_of(VkhContext context) {
  ApiMesh a(icosphere(1.0, 3)), b(translated(icosphere(1.1, 4), {0.1, 0.2, 0.05}));
  ApiPair pair(a, b, 1e-5f, context);
  std::vector<VkhReport> reports;
  reports.push_back(pair.run([&](VkCommandBuffer c) {
    pair.build(c);
    pair.begin(c);
    pair.report(c);
  }));
  const auto advance = [&](VkCommandBuffer c) {
    pair.advance(c, 40);
    pair.report(c);
  };
  reports.push_back(pair.run(advance));
  b.move(translated(icosphere(1.15, 4), {0.1, 0.15, 0.05}));
  reports.push_back(pair.run([&](VkCommandBuffer c) {
    pair.refit(c);
    pair.begin(c, true);
    pair.report(c);
  }));
  reports.push_back(pair.run(advance));
  check_true(reports.back(), a, b);
  return reports;
}

void check_same(const std::vector<VkhReport>& x, const std::vector<VkhReport>& y) {
  REQUIRE(x.size() == y.size());
  for (size_t i = 0; i < x.size(); ++i) CHECK(is_same(x[i], y[i]));
}

}  // namespace

TEST_CASE("what is given by address is found there: the same reports, bit by bit") {
  if (!device_has_addresses()) return;
  for (const Ways& ways : kWays) {
    const ContextHandle bound = make_context(ways, VK_FALSE),
                        addressed = make_context(ways, VK_TRUE);
    const std::vector<VkhReport> expected = reports_of(bound.get());
    CHECK(expected[1].status == VKH_STATUS_DECIDED);
    check_same(reports_of(addressed.get()), expected);
    addressed->limits.allocation = kAllocation;
    check_same(reports_of(addressed.get()), expected);
  }
}

TEST_CASE("a hierarchy in several ranges is the hierarchy in one") {
  const ContextHandle context = make_context(kWays[0], VK_FALSE);
  const std::vector<VkhReport> expected = reports_of(context.get());
  context->limits.allocation = kAllocation;
  VkhHierarchyRequirements needed{};
  REQUIRE(vkhGetHierarchyRequirements(context.get(), 2562, 5120, &needed) == VKH_SUCCESS);
  CHECK(needed.rangeCount == VKH_MAX_RANGES);
  VkDeviceSize sum = 0;
  for (const VkDeviceSize bytes : needed.ranges) sum += bytes;
  CHECK(sum == needed.hierarchySize);
  check_same(reports_of(context.get()), expected);
}

TEST_CASE("by address meshes may be larger: up to four bytes a face of what is bound") {
  if (!device_has_addresses()) return;
  const ContextHandle bound = make_context(kWays[0], VK_FALSE),
                      addressed = make_context(kWays[0], VK_TRUE);
  constexpr VkDeviceSize kRange = 1 << 20;
  bound->limits.storage_range = addressed->limits.storage_range = kRange;
  constexpr uint32_t kMost = kRange / 4;
  VkhHierarchyRequirements b{};
  VkhWorkspaceRequirements a{};
  CHECK(vkhGetHierarchyRequirements(addressed.get(), kMost / 2, kMost, &b) == VKH_SUCCESS);
  CHECK(vkhGetWorkspaceRequirements(addressed.get(), kMost / 2, kMost, &a) == VKH_SUCCESS);
  for (const auto& [context, faces] :
       {std::pair{addressed.get(), kMost + 1}, {bound.get(), kMost / 8}}) {
    CHECK(vkhGetHierarchyRequirements(context, faces / 2, faces, &b) == VKH_ERROR_TOO_LARGE);
    CHECK(vkhGetWorkspaceRequirements(context, faces / 2, faces, &a) ==
          (context == bound.get() ? VKH_SUCCESS : VKH_ERROR_TOO_LARGE));
  }
}
