// The C API in frames: a few waves each, reports in between, command buffers submitted again.
#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <memory>
#include <string>
#include <thread>

#include "tests/shapes/shapes.h"
#include "tests/support/api_bench.h"
#include "tests/support/kernel_bench.h"

namespace {

using namespace vkh;
using namespace vkh::test;

/// Pairs that need several waves at this tolerance.
constexpr float kTolerance = 1e-6f;
std::vector<NamedPair> pairs() {
  return {{"spheres", icosphere(1.0, 2), translated(icosphere(1.1, 3), {0.1, 0.2, 0.05})},
          {"twin", height_field(24, 1), height_field(24, 3)},
          {"soups", scaled(soup(1, 60), -1), scaled(soup(2, 80), -1)}};
}

void check_nested(const VkhReport& now, const VkhReport& before) {
  CHECK(now.lower >= before.lower * (1 - 1e-6f));
  CHECK(now.upper <= before.upper * (1 + 1e-6f));
  CHECK(now.waves >= before.waves);
}

}  // namespace

TEST_CASE("two waves a frame: every report is true, they nest, and the run ends") {
  for (const NamedPair& pair : pairs()) {
    CAPTURE(pair.name);
    ApiMesh a(pair.a), b(pair.b);
    const Interval exact = reference_hausdorff(a.mesh(), b.mesh(), 1e-9);
    ApiPair on(a, b, kTolerance);
    VkhReport last = on.run([&](VkCommandBuffer c) {
      on.build(c);
      on.begin(c);
      on.report(c);
    });
    check_true(last, exact);
    CHECK(last.waves == 1);
    int frames = 0;
    for (; last.status == VKH_STATUS_RUNNING && frames < 30; ++frames) {
      const VkhReport now = on.run([&](VkCommandBuffer c) {
        on.advance(c, 2);
        on.report(c);
      });
      check_true(now, exact);
      check_nested(now, last);
      last = now;
    }
    CHECK(frames > 1);
    CHECK(last.status == VKH_STATUS_DECIDED);
    CHECK(last.upper - last.lower <= kTolerance + 1e-6f * last.upper);
  }
}

TEST_CASE("reports between waves of one submission") {
  for (const NamedPair& pair : pairs()) {
    CAPTURE(pair.name);
    ApiMesh a(pair.a), b(pair.b);
    ApiPair on(a, b, kTolerance);
    on.run([&](VkCommandBuffer c) {
      on.build(c);
      on.begin(c);
      for (uint32_t slot = 0; slot < 4; ++slot) {
        on.advance(c, 1);
        on.report(c, slot);
      }
    });
    for (uint32_t slot = 0; slot < 4; ++slot) {
      check_true(on.read(slot), a, b);
      CHECK(on.read(slot).waves == slot + 2);
      if (slot > 0) check_nested(on.read(slot), on.read(slot - 1));
    }
  }
}

TEST_CASE("a recorded run gives the same report each time it is submitted") {
  for (const NamedPair& pair : pairs()) {
    CAPTURE(pair.name);
    ApiMesh a(pair.a), b(pair.b);
    ApiPair on(a, b, kTolerance);
    const VkCommandBuffer recorded = on.commands().record([&](VkCommandBuffer c) {
      on.build(c);
      on.begin(c);
      on.advance(c, 2);  // ends on an odd parity of the frontier
      on.report(c);
    });
    on.commands().submit_and_wait(recorded);
    const VkhReport first = on.read();
    CHECK(first.waves == 3);
    for (int again = 0; again < 2; ++again) {
      on.commands().submit_and_wait(recorded);
      const VkhReport next = on.read();
      CHECK(std::memcmp(&next, &first, sizeof(next)) == 0);
    }
  }
}

TEST_CASE("waves recorded alone and submitted again go on where the run stands") {
  ApiMesh a(height_field(24, 1)), b(height_field(24, 3));
  ApiPair on(a, b, kTolerance);
  const VkhReport whole = on.run([&](VkCommandBuffer c) {
    on.build(c);
    on.begin(c);
    on.advance(c, 30);
    on.report(c);
  });
  CHECK(whole.status == VKH_STATUS_DECIDED);
  const uint32_t candidates = on.statistics().candidateTotal;
  on.run([&](VkCommandBuffer c) { on.begin(c); });
  const VkCommandBuffer step = on.commands().record([&](VkCommandBuffer c) {
    on.advance(c, 1);
    on.report(c);
  });
  int submissions = 0;
  do {
    on.commands().submit_and_wait(step);
    check_true(on.read(), a, b);
  } while (on.read().status == VKH_STATUS_RUNNING && ++submissions < 30);
  CHECK(on.read().lower == whole.lower);
  CHECK(on.read().upper == whole.upper);
  CHECK(on.statistics().candidateTotal == candidates);
}

TEST_CASE("the engine itself reads a report as its next compute shader, without the host") {
  // The witness of h(a, b) becomes the one vertex of a mesh: h(witness, b) is h(a, b) again.
  ApiMesh a(height_field(24, 1)), b(height_field(24, 3));
  ApiPair on(a, b, kTolerance);
  const VkhReport first = on.run([&](VkCommandBuffer c) {
    on.build(c);
    on.begin(c);
    on.advance(c, 30);
    on.report(c);
  });
  Mesh point = single_triangle({0, 0, 0}, {0, 0, 0}, {0, 0, 0});
  point.vertices.resize(1);
  point.faces = {{0, 0, 0}};
  ApiMesh witness(point);
  ApiPair second(witness, b, kTolerance);
  const VkhReport again = second.run([&](VkCommandBuffer c) {
    on.begin(c);
    on.advance(c, 30);
    on.report(c, 1);
    second.build(c);
    second.begin_at(c, on.report_buffer(),
                    on.report_offset(1) + offsetof(VkhReport, witnessPosition));
    second.advance(c, 4);
    second.report(c);
  });
  CHECK(again.upper == doctest::Approx(first.upper).epsilon(1e-5));
  CHECK(again.lower == doctest::Approx(first.lower).epsilon(1e-5));
  CHECK(again.lower > 0);
}

TEST_CASE("layouts: any stride and offset, 16- and 32-bit indices, give the same report") {
  const Mesh mesh_a = height_field(16, 1), mesh_b = height_field(16, 2);
  const auto report_of = [&](MeshLayout layout_a, MeshLayout layout_b) {
    ApiMesh a(mesh_a, layout_a), b(mesh_b, layout_b);
    ApiPair on(a, b, 1e-4f);
    return on.run([&](VkCommandBuffer c) {
      on.build(c);
      on.begin(c);
      on.advance(c, 6);
      on.report(c);
    });
  };
  const VkhReport plain = report_of({}, {});
  CHECK(plain.status == VKH_STATUS_DECIDED);
  const MeshLayout layouts[] = {
      {.stride = 32, .vertex_offset = 4, .index_offset = 8},
      {.stride = 12, .vertex_offset = 260, .index_offset = 2, .is_16bit = true},
      {.stride = 16, .vertex_offset = 1020, .index_offset = 258, .is_16bit = true},
      {.stride = 44, .vertex_offset = 0, .index_offset = 1024, .is_16bit = true},
  };
  for (const MeshLayout& layout : layouts) {
    CAPTURE(layout.stride);
    for (const VkhReport& other : {report_of(layout, {}), report_of({}, layout)})
      CHECK(std::memcmp(&other, &plain, sizeof(plain)) == 0);
  }
}

TEST_CASE("one context records on several threads at once") {
  ApiMesh a(height_field(12, 1)), b(height_field(12, 3));
  constexpr int kThreads = 4;
  std::vector<std::unique_ptr<ApiPair>> pairs;
  for (int i = 0; i < kThreads; ++i) pairs.push_back(std::make_unique<ApiPair>(a, b, kTolerance));
  std::vector<VkCommandBuffer> recorded(kThreads);
  std::vector<std::thread> threads;
  for (size_t i = 0; i < kThreads; ++i) {
    threads.emplace_back([&, i] {
      recorded[i] = pairs[i]->commands().record([&](VkCommandBuffer c) {
        pairs[i]->build(c);
        pairs[i]->begin(c);
        pairs[i]->advance(c, 20);
        pairs[i]->report(c);
      });
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (size_t i = 0; i < kThreads; ++i) {
    pairs[i]->commands().submit_and_wait(recorded[i]);
    const VkhReport report = pairs[i]->read(), first = pairs[0]->read();
    CHECK(report.status == VKH_STATUS_DECIDED);
    CHECK(std::memcmp(&report, &first, sizeof(report)) == 0);
  }
}

TEST_CASE("statistics say whether all of a run was certified") {
  KernelBench plain(VKH_SWITCH_DEFAULT_WIDE | VKH_SWITCH_UNCERTIFIED);
  ApiMesh a(icosphere(1.0, 2)), b(translated(icosphere(1.1, 3), {0.1, 0.2, 0.05}));
  ApiPair on(a, b, kTolerance);
  for (const bool plain_begin : {false, true}) {
    for (const bool plain_wave : {false, true}) {
      CAPTURE(plain_begin);
      CAPTURE(plain_wave);
      // Both contexts lay a workspace out in the same way.
      on.run([&](VkCommandBuffer commands) {
        on.build(commands);
        vkhCmdBegin(plain_begin ? plain.context() : on.context(), commands, &on.problem(), nullptr);
        vkhCmdAdvance(plain_wave ? plain.context() : on.context(), commands, &on.problem(), 4,
                      nullptr);
        on.report(commands);
      });
      CHECK(on.read().waves > 1);
      CHECK(on.statistics().certified == (plain_begin || plain_wave ? 0 : 1));
    }
  }
}
