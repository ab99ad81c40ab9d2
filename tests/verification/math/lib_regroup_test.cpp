// Shows why every operation is decorated: the bounds again, on a device that rearranges undecorated
// ones (Vulkan specification, "Evaluation of Expressions"). With the build's decorations no bound
// gives; with those of `precise` alone, as the kernels once had them, many do.
#define VKH_TEST_VULKAN_MODEL
#define VKH_MODEL_REGROUPS

#include <doctest/doctest.h>

#include <cstdio>
#include <map>
#include <string>

#include "host/app/self_test.h"
#include "tests/verification/model/climb.h"
#include "tests/verification/model/composed.h"

using namespace vkh;
using namespace vkh::test;

namespace {

constexpr int kClimbs = 20;

/// The climbs of each target that got beyond its bound.
std::map<std::string, int> beaten(model::Decorations decorations) {
  const uint64_t steps = std::max<uint64_t>(case_count() / 200, 100);
  model::decorations = decorations;
  std::map<std::string, int> out;
  for (const Target& target : kTargets) {
    Random random(20261122);
    for (int i = 0; i < kClimbs; ++i) out[target.name] += climb(target, random, steps) > 0 ? 1 : 0;
  }
  model::decorations = model::Decorations::kAll;
  return out;
}

/// The doctor's verdict on a device that rounds by `seed` and honours these decorations.
std::string diagnosis(model::Decorations decorations, uint64_t seed) {
  const std::vector<gpu::SelfTestOperands> questions = composed_questions(seed, 4096);
  std::vector<gpu::SelfTestComposed> answers;
  model::decorations = decorations;
  const test::Device device(seed);
  for (const gpu::SelfTestOperands& q : questions)
    answers.push_back(device.run([&] { return answer_composed(q); }));
  model::decorations = model::Decorations::kAll;
  SelfTestResult result;
  judge_composed(questions, answers, result);
  return result.fault;
}

}  // namespace

TEST_CASE("the doctor refuses a driver that rearranges, by the name of what it breaks") {
  for (uint64_t seed = 0; seed < 10; ++seed) {
    CAPTURE(test::Device(seed).name());
    CHECK(diagnosis(model::Decorations::kAll, seed) == "");
    const std::string fault = diagnosis(model::Decorations::kPrecise, seed);
    CAPTURE(fault);
    if (seed < 5) continue;  // always the same order: which may be the right one
    CHECK(fault.find("regroups sums") != std::string::npos);
  }
}

TEST_CASE("decorated operations leave nothing to rearrange") {
  for (const auto& target : beaten(model::Decorations::kAll))
    CHECK_MESSAGE(target.second == 0, target.first << ": " << target.second << " of " << kClimbs);
}

TEST_CASE("the model rearranges what is not decorated, and bounds that rest on order give") {
  std::map<std::string, int> count = beaten(model::Decorations::kPrecise);
  int all = 0;
  for (const auto& [name, climbs] : count) {
    if (climbs > 0)
      std::printf("  %-22s beaten in %d of %d climbs\n", name.c_str(), climbs, kClimbs);
    all += climbs;
  }
  std::printf("  beaten in %d climbs\n", all);
  for (const char* name : {"sharp_norm_above_up", "quotient_above_down"})
    CHECK_MESSAGE(count[name] > 0, name);
  // Expressions that are `precise`, and a product alone, hold all the same.
  for (const char* name : {"two_sum", "two_product"}) CHECK_MESSAGE(count[name] == 0, name);
}
