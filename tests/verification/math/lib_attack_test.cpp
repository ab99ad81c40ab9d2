// Hill climbing against the certified headers on the model of Vulkan's arithmetic. Random cases
// come to half of an error term; this comes to nearly all of most.
#define VKH_TEST_VULKAN_MODEL

#include <doctest/doctest.h>

#include <cstdio>

#include "tests/verification/model/climb.h"

using namespace vkh::test;

TEST_CASE("no climb against a bound gets beyond it") {
  // 40 climbs a target.
  const uint64_t steps = std::max<uint64_t>(case_count() / 40, 200);
  for (const Target& target : kTargets) {
    Random random(20240701);
    Wide best = -1e30L;
    for (int i = 0; i < 40; ++i) best = std::max(best, climb(target, random, steps));
    std::printf("  %-22s best %.4Lf of its error term beyond it\n", target.name, best);
    CHECK_MESSAGE(best <= 0, target.name);
  }
}
