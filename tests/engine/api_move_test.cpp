// vkhCmdMoveRun and VkhRunOptions::pauseWhenFull: a run that pauses until it has room is the run
// that had it from the start, bit by bit.
#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <memory>
#include <vector>

#include "engine/context.h"
#include "engine/workspace.h"
#include "tests/shapes/shapes.h"
#include "tests/support/api_bench.h"
#include "tests/support/kernel_bench.h"

namespace {

using namespace vkh;
using namespace vkh::test;

constexpr float kTolerance = 1e-6f;
constexpr VkBufferUsageFlags kWorking =
    VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT |
    VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;

/// Pairs whose frontiers outgrow the smallest workspace.
struct Pairs : ApiPairs {
  Pairs() {
    add(icosphere(1.0, 2), translated(icosphere(1.1, 3), {0.1, 0.2, 0.05}), kTolerance);
    add(height_field(24, 1), height_field(24, 3), kTolerance);
    add(icosphere(1.0, 1), icosphere(1.05, 2), kTolerance);
  }
};

/// A pair's problem, in workspaces of the test's own; filled with garbage, so that a move that
/// leaves out something that the run needs is noticed.
class Mover {
 public:
  Mover(ApiPair& pair, VkDeviceSize bytes) : pair_(pair), given_(pair.problem().workspace) {
    problem().workspace = memory(bytes);
  }
  ~Mover() {
    problem().workspace = given_;
    problem().options.pauseWhenFull = VK_FALSE;
  }
  Mover(const Mover&) = delete;
  Mover& operator=(const Mover&) = delete;

  VkhProblem& problem() { return pair_.problem(); }
  VkhMemory memory(VkDeviceSize bytes) {
    constexpr VkDeviceSize kOffset = 512;
    buffers_.emplace_back(test_device(), bytes + kOffset, kWorking, Placement::kReadback);
    std::memset(buffers_.back().mapped(), 0x5a, bytes + kOffset);
    return {buffers_.back().handle(), kOffset, bytes};
  }
  VkDeviceSize bytes_for(uint32_t candidates) {
    return vkhGetWorkspaceSize(pair_.context(), problem().a.vertexCount, problem().a.faceCount,
                               candidates);
  }
  VkhReport start() {
    return pair_.run([&](VkCommandBuffer c) {
      pair_.build(c);
      pair_.begin(c);
      pair_.report(c);
    });
  }
  VkhReport advance(uint32_t waves) {
    return pair_.run([&](VkCommandBuffer c) {
      pair_.advance(c, waves);
      pair_.report(c);
    });
  }
  /// Also records a wave in the same command buffer: the engine's own barriers stand between them.
  VkhReport move(const VkhMemory& to) {
    return pair_.run([&](VkCommandBuffer c) {
      vkhCmdMoveRun(pair_.context(), c, &problem(), &to, nullptr);
      pair_.advance(c, 1);
      pair_.report(c);
    });
  }

 private:
  ApiPair& pair_;
  VkhMemory given_;
  std::vector<Buffer> buffers_;
};

VkDeviceSize least_bytes(ApiPair& pair) {
  VkhWorkspaceRequirements needed{};
  REQUIRE(vkhGetWorkspaceRequirements(pair.context(), pair.problem().a.vertexCount,
                                      pair.problem().a.faceCount, &needed) == VKH_SUCCESS);
  return needed.minimum;
}

VkhReport to_the_end(Mover& mover, VkhReport report) {
  for (int i = 0; i < 1000 && report.status == VKH_STATUS_RUNNING; ++i) report = mover.advance(2);
  return report;
}

}  // namespace

TEST_CASE("a run that pauses for room is the run that had it, bit by bit") {
  Pairs all;
  uint32_t moves = 0;
  for (const auto& pair : all.pairs) {
    VkhReport roomy;
    {
      Mover mover(*pair, least_bytes(*pair));
      mover.problem().workspace = mover.memory(mover.bytes_for(1u << 17));
      roomy = to_the_end(mover, mover.start());
      CHECK(roomy.status == VKH_STATUS_DECIDED);
    }
    Mover mover(*pair, least_bytes(*pair));
    mover.problem().options.pauseWhenFull = VK_TRUE;
    VkhReport report = mover.start();
    const uint32_t before = moves;
    while (report.status == VKH_STATUS_RUNNING) {
      if (report.wanted > 0) {
        ++moves;
        CHECK(is_same(mover.advance(3), report));  // it changes nothing by itself
        report = mover.move(mover.memory(mover.bytes_for(report.wanted)));
        CHECK(report.wanted == 0);
      } else {
        report = mover.advance(1);
      }
    }
    CHECK(moves > before);
    CHECK(is_same(report, roomy));
  }
  CHECK(moves >= all.pairs.size() + 2);  // and some more than once
}

TEST_CASE("a run that pauses and is told to go on is the run that never paused") {
  Pairs all;
  for (const auto& pair : all.pairs) {
    VkhReport cramped;
    {
      Mover mover(*pair, least_bytes(*pair));
      cramped = to_the_end(mover, mover.start());
    }
    Mover mover(*pair, least_bytes(*pair));
    mover.problem().options.pauseWhenFull = VK_TRUE;
    VkhReport report = mover.start();
    while (report.status == VKH_STATUS_RUNNING && report.wanted == 0) report = mover.advance(1);
    REQUIRE(report.wanted > 0);
    mover.problem().options.pauseWhenFull = VK_FALSE;
    const VkhMemory own = mover.problem().workspace;
    CHECK(is_same(to_the_end(mover, mover.move(own)), cramped));
  }
}

TEST_CASE("a run can be moved between any two waves") {
  Pairs all;
  for (size_t i = 0; i < all.pairs.size(); ++i) {
    ApiPair& pair = *all.pairs[i];
    const Interval exact =
        reference_hausdorff(all.meshes[2 * i]->mesh(), all.meshes[2 * i + 1]->mesh(), 1e-7);
    Mover mover(pair, least_bytes(pair));
    VkhReport report = mover.start();
    for (uint32_t wave = 0; wave < 40 && report.status == VKH_STATUS_RUNNING; ++wave) {
      check_true(report, exact);
      report = mover.move(mover.memory(mover.bytes_for(300 + 200 * wave)));
    }
    check_true(to_the_end(mover, report), exact);
  }
}

TEST_CASE("a run in the largest workspace waits for no larger one") {
  Pairs all;
  for (const auto& pair : all.pairs) {
    const uint64_t range = pair->context()->limits.storage_range;
    pair->context()->limits.storage_range =
        uint64_t{2} * sizeof(gpu::Candidate) * kSmallestCapacity;
    VkhReport cramped;
    {
      Mover mover(*pair, least_bytes(*pair));
      cramped = to_the_end(mover, mover.start());
    }
    Mover mover(*pair, least_bytes(*pair));
    CHECK(mover.bytes_for(UINT32_MAX) == least_bytes(*pair));
    mover.problem().options.pauseWhenFull = VK_TRUE;
    const VkhReport report = to_the_end(mover, mover.start());
    CHECK(report.wanted == 0);
    CHECK(is_same(report, cramped));
    pair->context()->limits.storage_range = range;
  }
}

TEST_CASE("sizes of workspaces grow with the candidates that they have room for") {
  Pairs all;
  ApiPair& pair = *all.pairs[0];
  Mover mover(pair, least_bytes(pair));
  CHECK(mover.bytes_for(1) == least_bytes(pair));
  CHECK(mover.bytes_for(1u << 16) < mover.bytes_for(1u << 17));
  CHECK(mover.bytes_for(UINT32_MAX) >= mover.bytes_for(1u << 20));
}

TEST_CASE("a moved run keeps its subroots") {
  const Mesh face = single_triangle({0, 0, 0}, {1, 0, 0}, {0.25, 0.75, 0});
  Mesh points = face;
  points.faces = {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}};
  ApiMesh a(face), b(points);
  for (const auto kind : {VKH_DEVICE_KIND_NARROW, VKH_DEVICE_KIND_WIDE}) {
    const bool wide = kind == VKH_DEVICE_KIND_WIDE;
    // The choice of candidates that are split twice depends on the room.
    const uint32_t switches =
        wide ? VKH_SWITCH_DEFAULT_WIDE & ~VKH_SWITCH_SPLIT_TWICE : VKH_SWITCH_DEFAULT_NARROW;
    const VkhContextCreateInfo info = create_info(switches | VKH_CONTEXT_FINE, kind);
    VkhContext context = nullptr;
    REQUIRE(vkhCreateContext(&info, &context) == VKH_SUCCESS);
    {
      ApiPair pair(a, b, 1e-9f, context);
      pair.problem().options.twoFloat = VK_TRUE;
      VkhReport moved, stayed;
      {
        Mover mover(pair, least_bytes(pair));
        stayed = to_the_end(mover, mover.start());
      }
      Mover mover(pair, least_bytes(pair));
      moved = mover.start();
      for (uint32_t wave = 0; wave < 100 && moved.status == VKH_STATUS_RUNNING; ++wave)
        moved = mover.move(mover.memory(mover.bytes_for(300 + 20 * wave)));
      CHECK(moved.status == VKH_STATUS_DECIDED);
      CHECK(is_same(moved, stayed));
      CHECK(moved.witnessBarycentricLow[0] + moved.witnessBarycentricLow[1] > 0);
      const double base = static_cast<double>(moved.base), exact = std::sqrt(5.0) / 4;
      CHECK(base + static_cast<double>(moved.lowerAbove) <= exact + 1e-15);
      CHECK(base + static_cast<double>(moved.upperAbove) >= exact - 1e-15);
      CHECK(moved.upperAbove - moved.lowerAbove < 1.5e-9f);
    }
    vkhDestroyContext(context);
  }
}

TEST_CASE("a move to where the run is tells it what has become known") {
  Pairs all;
  for (const auto& pair : all.pairs) {
    Mover mover(*pair, least_bytes(*pair));
    const VkhReport start = mover.start();
    REQUIRE(start.status == VKH_STATUS_RUNNING);
    const VkhMemory own = mover.problem().workspace;
    const VkhReport same = to_the_end(mover, mover.move(own));
    mover.start();
    CHECK(is_same(to_the_end(mover, mover.advance(1)), same));  // nothing new changes no bit
    mover.start();
    mover.problem().options.knownLower = 10;  // farther than anything is
    const VkhReport pruned = to_the_end(mover, mover.move(own));
    CHECK(pruned.status == VKH_STATUS_DECIDED);
    CHECK(pruned.waves < same.waves);
    CHECK(interval(pruned).meets(interval(same)));
    mover.problem().options.knownLower = 0;
  }
}
