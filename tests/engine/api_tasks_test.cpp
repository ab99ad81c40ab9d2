// vkhCmdRunTasks: pairs side by side, each as if it were alone.
#include <doctest/doctest.h>

#include <array>
#include <cstring>
#include <memory>
#include <vector>

#include "host/gpu/vulkan_api.h"
#include "tests/shapes/shapes.h"
#include "tests/support/api_bench.h"
#include "tests/support/kernel_bench.h"

namespace {

using namespace vkh;
using namespace vkh::test;

constexpr float kTolerance = 1e-6f;
constexpr uint32_t kWaves = 20;

/// Pairs of unlike sizes, so that their sorts, pyramids and waves differ in number.
struct Pairs : ApiPairs {
  Pairs() {
    add(icosphere(1.0, 2), translated(icosphere(1.1, 3), {0.1, 0.2, 0.05}), kTolerance);
    add(height_field(24, 1), height_field(24, 3), kTolerance);
    add(single_triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), scaled(soup(2, 80), -1), kTolerance);
    add(scaled(soup(1, 60), -1), scaled(soup(2, 3), -1), kTolerance);
  }
};

/// Garbage, so that only data that the tasks have written is right.
void spoil(ApiPair& pair, bool with_hierarchy) {
  pair.spoil_report();
  if (with_hierarchy) pair.spoil_hierarchy();
}

void run_tasks(ApiPair& any, const std::vector<VkhTask>& tasks, VkhProfile* profile = nullptr) {
  any.commands().submit_and_wait(any.commands().record([&](VkCommandBuffer c) {
    if (profile != nullptr)
      test_device().vk().CmdResetQueryPool(c, profile->pool, 0, profile->capacity);
    vkhCmdRunTasks(any.context(), c, static_cast<uint32_t>(tasks.size()), tasks.data(), profile);
    record_host_barrier(c);
  }));
}

VkhReport run_alone(ApiPair& pair) {
  return pair.run([&](VkCommandBuffer c) {
    pair.build(c);
    pair.begin(c);
    pair.advance(c, kWaves);
    pair.report(c);
  });
}

struct QueryPool {
  static constexpr uint32_t kCapacity = 256;
  VkQueryPool pool = VK_NULL_HANDLE;
  std::array<const char*, kCapacity> names{};

  QueryPool() {
    VkQueryPoolCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO;
    info.queryType = VK_QUERY_TYPE_TIMESTAMP;
    info.queryCount = kCapacity;
    const Device& device = test_device();
    check(device.vk().CreateQueryPool(device.handle(), &info, nullptr, &pool), "a query pool");
  }
  ~QueryPool() { test_device().vk().DestroyQueryPool(test_device().handle(), pool, nullptr); }
  VkhProfile profile() { return {pool, kCapacity, 0, names.data()}; }
};

}  // namespace

TEST_CASE("tasks side by side give the reports that the pairs have alone, bit for bit") {
  Pairs pairs;
  std::vector<VkhReport> alone;
  std::vector<VkhTask> tasks;
  for (size_t i = 0; i < pairs.size(); ++i) {
    alone.push_back(run_alone(pairs[i]));
    CHECK(alone.back().status == VKH_STATUS_DECIDED);
    tasks.push_back(pairs[i].task(kWaves));
  }
  for (int again = 0; again < 3; ++again) {
    for (size_t i = 0; i < pairs.size(); ++i) spoil(pairs[i], true);
    run_tasks(pairs[0], tasks);
    for (size_t i = 0; i < pairs.size(); ++i) {
      CAPTURE(i);
      CHECK(is_same(pairs[i].read(), alone[i]));
      CHECK(pairs[i].problem().b.faceCount == tasks[i].mesh->faceCount);
      CHECK(pairs[i].problem().b.vertexCount == tasks[i].mesh->vertexCount);
    }
  }
}

TEST_CASE("tasks have the parts that they are given: no build, no begin, no report") {
  Pairs pairs;
  std::vector<VkhReport> alone;
  for (size_t i = 0; i < pairs.size(); ++i) alone.push_back(run_alone(pairs[i]));
  std::vector<VkhTask> start, go_on;
  for (size_t i = 0; i < pairs.size(); ++i) {
    start.push_back(pairs[i].task(0));
    start.back().reportBuffer = VK_NULL_HANDLE;
    go_on.push_back(pairs[i].task(i % 2 == 0 ? 1 : 3));
    go_on.back().mesh = nullptr;
    go_on.back().begin = VK_FALSE;
  }
  for (size_t i = 0; i < pairs.size(); ++i) spoil(pairs[i], true);
  run_tasks(pairs[0], start);
  for (uint32_t round = 0; round < kWaves; ++round) {
    for (size_t i = 0; i < pairs.size(); ++i) spoil(pairs[i], false);
    run_tasks(pairs[0], go_on);
    for (size_t i = 0; i < pairs.size(); ++i) {
      const uint32_t waves = 1 + (round + 1) * go_on[i].waves;
      CHECK(pairs[i].read().waves == std::min(waves, alone[i].waves));
    }
  }
  for (size_t i = 0; i < pairs.size(); ++i) CHECK(is_same(pairs[i].read(), alone[i]));
}

TEST_CASE("tasks that share a hierarchy, and tasks that refit theirs") {
  ApiMesh b(height_field(24, 3)), a(height_field(24, 1)), other(height_field(12, 2));
  ApiPair first(a, b, kTolerance), second(other, b, kTolerance);
  const VkhReport of_first = run_alone(first), of_second = run_alone(second);
  VkhTask tasks[] = {first.task(kWaves), second.task(kWaves)};
  for (VkhTask& task : tasks) task.mesh = nullptr;
  second.problem().b = first.problem().b;
  spoil(first, false);
  spoil(second, false);
  run_tasks(first, {tasks[0], tasks[1]});
  CHECK(is_same(first.read(), of_first));
  CHECK(is_same(second.read(), of_second));

  const Mesh small = height_field(24, 3);
  const auto build = [&](VkCommandBuffer c) { first.build(c); };
  const auto refit_and_run = [&](VkCommandBuffer c) {
    first.refit(c);
    first.begin(c);
    first.advance(c, kWaves);
    first.report(c);
  };
  b.move(scaled(small, 1));  // twice as large
  const VkhReport refitted = first.run(refit_and_run);
  CHECK(!is_same(refitted, of_first));
  b.move(small);
  first.run(build);
  b.move(scaled(small, 1));
  VkhTask refit = first.task(kWaves);
  refit.scratch = nullptr;
  ApiPair third(other, a, kTolerance);
  spoil(first, false);
  run_tasks(first, {refit, third.task(kWaves)});
  CHECK(is_same(first.read(), refitted));
  check_true(third.read(), other, a);
}

TEST_CASE("one task is what the functions record, several are one stage, none is none") {
  Pairs pairs;
  const VkhReport alone = run_alone(pairs[1]);
  QueryPool pool;
  VkhProfile of_one = pool.profile();
  spoil(pairs[1], true);
  run_tasks(pairs[0], {pairs[1].task(kWaves)}, &of_one);
  CHECK(is_same(pairs[1].read(), alone));
  CHECK(of_one.count > kWaves);
  CHECK(pool.names[0] == nullptr);
  CHECK(std::string(pool.names[of_one.count - 1]) == "report");

  VkhProfile of_two = pool.profile();
  run_tasks(pairs[0], {pairs[0].task(kWaves), pairs[1].task(kWaves)}, &of_two);
  CHECK(of_two.count == 2);
  CHECK(std::string(pool.names[1]) == "tasks");

  run_tasks(pairs[0], {});
}
