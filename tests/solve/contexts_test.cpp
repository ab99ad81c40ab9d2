// Which context serves whom, so that no set of pipelines is made that is not needed.
#include "host/solve/contexts.h"

#include <doctest/doctest.h>

#include <thread>
#include <vector>

#include "engine/vkhausdorff_experimental.h"
#include "tests/support/kernel_bench.h"

namespace {

using namespace vkh;
using namespace vkh::test;

constexpr uint32_t kCells = VKH_CONTEXT_CELLS, kClosest = VKH_CONTEXT_CLOSEST;

bool runs(uint32_t made, uint32_t asked) { return serves(made, asked, ContextUse::kRun); }
bool builds(uint32_t made, uint32_t asked) { return serves(made, asked, ContextUse::kHierarchy); }

}  // namespace

TEST_CASE("a run is served by a context that has more kernels, and no other code") {
  const uint32_t plain = VKH_SWITCH_DEFAULT_NARROW;
  CHECK(runs(plain, plain));
  CHECK(runs(plain | kCells | kClosest, plain));
  CHECK(runs(plain | kCells | kClosest, plain | kCells));
  CHECK_FALSE(runs(plain, plain | kCells));
  CHECK_FALSE(runs(plain | kCells, plain | kClosest));
  for (const uint32_t other : {uint32_t{VKH_CONTEXT_FINE}, uint32_t{VKH_CONTEXT_COVERAGE},
                               kSwitchByAddress, kSwitchWide, uint32_t{VKH_SWITCH_SORT}}) {
    CAPTURE(other);
    CHECK_FALSE(runs(plain | other, plain));
    CHECK_FALSE(runs(plain, plain | other));
  }
}

TEST_CASE("a BVH is built by the context of any run on the same profile") {
  const uint32_t plain = VKH_SWITCH_DEFAULT_NARROW;
  for (const uint32_t other : {uint32_t{VKH_CONTEXT_FINE}, uint32_t{VKH_CONTEXT_COVERAGE}, kCells,
                               uint32_t{VKH_SWITCH_SORT}})
    CHECK(builds(plain | other, plain));
  CHECK(builds(VKH_CONTEXT_FINE | kClosest, plain | kClosest));
  CHECK_FALSE(builds(plain | kCells, plain | kClosest));
  CHECK_FALSE(builds(plain | kSwitchByAddress, plain));
  CHECK_FALSE(builds(plain | kSwitchWide, plain));
}

TEST_CASE("contexts are made once, whoever asks first") {
  Contexts contexts(test_device(), {});
  const uint32_t plain = default_switches(test_device());
  const VkhContext first = contexts.get(plain, ContextUse::kHierarchy);
  CHECK(contexts.get(plain | kClosest, ContextUse::kHierarchy) == first);
  CHECK(contexts.get(plain) == first);
  CHECK(contexts.count() == 1);
  std::vector<VkhContext> found(4);
  std::vector<std::thread> threads;
  for (VkhContext& one : found)
    threads.emplace_back([&] { one = contexts.get(plain | VKH_CONTEXT_FINE); });
  for (std::thread& thread : threads) thread.join();
  for (const VkhContext one : found) CHECK(one == found[0]);
  CHECK(found[0] != first);
  CHECK(contexts.count() == 2);
}
