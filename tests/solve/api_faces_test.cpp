// Surveys that the device plans, through the C API alone: errors of faces are true, get narrower
// and end at the width that was asked for, in as much room as there is.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "engine/vkhausdorff_experimental.h"
#include "host/solve/run.h"
#include "tests/shapes/shapes.h"
#include "tests/support/api_bench.h"
#include "tests/support/kernel_bench.h"

namespace {

using namespace vkh;
using namespace vkh::test;

constexpr VkBufferUsageFlags kOfCells = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT |
                                        VK_BUFFER_USAGE_TRANSFER_SRC_BIT |
                                        VK_BUFFER_USAGE_TRANSFER_DST_BIT;

ContextHandle make_context(VkhDeviceKind kind, VkhContextFlags flags = 0) {
  const uint32_t defaults = kind == VKH_DEVICE_KIND_WIDE ? uint32_t{VKH_SWITCH_DEFAULT_WIDE}
                                                         : uint32_t{VKH_SWITCH_DEFAULT_NARROW};
  const VkhContextCreateInfo info =
      create_info(defaults | VKH_CONTEXT_CELLS | flags, kind, VK_FALSE);
  VkhContext context = nullptr;
  REQUIRE(vkhCreateContext(&info, &context) == VKH_SUCCESS);
  return {context, vkhDestroyContext};
}

struct Told {
  VkhSurveyReport report;
  std::vector<float> errors;  // of faces: reached, then highest
};

/// A pair with a survey of its A: begun, advanced and read as the caller likes.
class FaceBench {
 public:
  FaceBench(VkhContext context, ApiMesh& a, ApiMesh& b, uint32_t room, float width, float limit = 0)
      : context_(context),
        faces_(a.view().faceCount),
        pair_(a, b, 1e-5f, context),
        memory_(test_device(), vkhGetSurveySize(context, faces_, room * faces_), kOfCells,
                Placement::kDevice),
        told_(test_device(), sizeof(VkhSurveyReport) + 2 * faces_ * sizeof(float),
              VK_BUFFER_USAGE_TRANSFER_DST_BIT, Placement::kReadback),
        survey_{
            sizeof(VkhSurvey), {memory_.handle(), 0, memory_.size()}, room * faces_, width, limit} {
  }

  void record_begin(VkCommandBuffer c) {
    pair_.build(c);
    pair_.begin(c);
    vkhCmdBeginSurvey(context_, c, &pair_.problem(), &survey_, nullptr);
  }
  void record_waves(VkCommandBuffer c, uint32_t waves) {
    vkhCmdAdvanceSurvey(context_, c, &pair_.problem(), &survey_, waves, nullptr);
  }
  void record_end(VkCommandBuffer c) {
    const VkBuffer to = told_.handle();
    vkhCmdWriteSurveyFaces(context_, c, &pair_.problem(), &survey_, to, sizeof(VkhSurveyReport),
                           nullptr);
    vkhCmdWriteSurvey(context_, c, &pair_.problem(), &survey_, to, 0, nullptr);
    record_host_barrier(c);
  }
  Told begin() {
    return run([&](VkCommandBuffer c) { record_begin(c); });
  }
  Told advance(uint32_t waves) {
    return run([&](VkCommandBuffer c) { record_waves(c, waves); });
  }
  Told run(const std::function<void(VkCommandBuffer)>& record) {
    pair_.run([&](VkCommandBuffer c) {
      record(c);
      record_end(c);
    });
    Told told{{}, std::vector<float>(2 * size_t{faces_})};
    std::memcpy(&told.report, told_.mapped(), sizeof(told.report));
    std::memcpy(told.errors.data(), told_.mapped() + sizeof(told.report),
                told.errors.size() * sizeof(float));
    return told;
  }
  uint32_t faces() const { return faces_; }
  ApiPair& pair() { return pair_; }

 private:
  VkhContext context_;
  uint32_t faces_;
  ApiPair pair_;
  Buffer memory_, told_;
  VkhSurvey survey_;
};

Interval exact_error(const ApiMesh& a, uint32_t face, const ApiMesh& b) {
  Mesh alone;
  alone.faces = {{0, 1, 2}};
  for (int k = 0; k < 3; ++k) alone.vertices.push_back(a.mesh().vertices[a.mesh().faces[face][k]]);
  return reference_hausdorff(alone, b.mesh(), 1e-6);
}

void check_true(const Told& told, const ApiMesh& a, const ApiMesh& b) {
  const auto faces = static_cast<uint32_t>(told.errors.size() / 2);
  for (uint32_t i = 0; i < faces; ++i) {
    const Interval exact = exact_error(a, i, b);
    CHECK(static_cast<double>(told.errors[i]) <= exact.upper);
    CHECK(static_cast<double>(told.errors[faces + i]) >= exact.lower);
  }
}

void check_narrower(const Told& before, const Told& after) {
  const size_t faces = before.errors.size() / 2;
  for (size_t i = 0; i < faces; ++i) {
    CHECK(after.errors[i] >= before.errors[i]);
    CHECK(after.errors[faces + i] <= before.errors[faces + i]);
  }
}

float widest(const Told& told) {
  const size_t faces = told.errors.size() / 2;
  float most = 0;
  for (size_t i = 0; i < faces; ++i) most = std::max(most, told.errors[faces + i] - told.errors[i]);
  return most;
}

bool is_same(const Told& x, const Told& y) {
  return std::memcmp(&x.report, &y.report, sizeof(x.report)) == 0 && x.errors == y.errors;
}

struct Meshes {
  ApiMesh a{icosphere(1.0, 2)}, b{translated(icosphere(1.1, 3), {0.1, 0.2, 0.05})};
};

TEST_CASE("waves narrow the errors of faces to the width that is asked for") {
  for (const VkhDeviceKind kind : {VKH_DEVICE_KIND_NARROW, VKH_DEVICE_KIND_WIDE}) {
    const ContextHandle context = make_context(kind);
    Meshes of;
    constexpr float kWidth = 2e-3f;
    FaceBench bench(context.get(), of.a, of.b, 64, kWidth);
    Told told = bench.begin();
    CHECK(told.report.status == VKH_STATUS_RUNNING);
    CHECK(told.report.waves == 0);
    CHECK(told.report.cells == bench.faces());
    CHECK(told.report.open > 0);
    check_true(told, of.a, of.b);
    while (told.report.status == VKH_STATUS_RUNNING) {
      const Told next = bench.advance(1);
      check_narrower(told, next);
      REQUIRE(next.report.waves == told.report.waves + 1);
      CHECK(next.report.cells > told.report.cells);
      told = next;
    }
    CHECK(told.report.status == VKH_STATUS_DECIDED);
    CHECK(told.report.open == 0);
    CHECK(widest(told) <= kWidth);
    check_true(told, of.a, of.b);
    CHECK(is_same(bench.advance(3), told));  // waves after the end are empty
  }
}

TEST_CASE("one command buffer does what several do, and the run may advance in between") {
  const ContextHandle context = make_context(VKH_DEVICE_KIND_NARROW);
  Meshes of;
  FaceBench first(context.get(), of.a, of.b, 16, 1e-3f),
      second(context.get(), of.a, of.b, 16, 1e-3f);
  first.begin();
  first.advance(1);
  const Told apart = first.advance(2);
  const Told together = second.run([&](VkCommandBuffer c) {
    second.record_begin(c);
    second.pair().advance(c, 2);
    second.record_waves(c, 3);
  });
  CHECK(is_same(apart, together));
}

TEST_CASE("a survey splits as much as it has room for, the widest first") {
  const ContextHandle context = make_context(VKH_DEVICE_KIND_NARROW);
  Meshes of;
  FaceBench none(context.get(), of.a, of.b, 1, 0), few(context.get(), of.a, of.b, 2, 0),
      many(context.get(), of.a, of.b, 12, 0);
  none.begin();
  few.begin();
  many.begin();
  const Told without = none.advance(2), little = few.advance(8), more = many.advance(8);
  CHECK(without.report.status == VKH_STATUS_MEMORY);
  CHECK(without.report.cells == none.faces());
  CHECK(without.report.waves == 0);
  CHECK(little.report.status == VKH_STATUS_MEMORY);
  CHECK(little.report.cells <= 2 * few.faces());
  CHECK(little.report.cells + 3 > 2 * few.faces());
  CHECK(more.report.cells <= 12 * many.faces());
  CHECK(widest(little) < widest(without));
  CHECK(widest(more) < widest(little));
  check_narrower(without, little);
  for (const Told& told : {without, little, more}) check_true(told, of.a, of.b);
}

TEST_CASE("with a limit, a face is done once it is within it or beyond it") {
  const ContextHandle context = make_context(VKH_DEVICE_KIND_NARROW);
  Meshes of;
  constexpr float kLimit = 0.15f;
  FaceBench with(context.get(), of.a, of.b, 64, 1e-4f, kLimit),
      without(context.get(), of.a, of.b, 64, 1e-4f);
  with.begin();
  without.begin();
  const Told decided = with.advance(12), all = without.advance(12);
  CHECK(decided.report.status == VKH_STATUS_DECIDED);
  CHECK(2 * decided.report.cells < all.report.cells);
  uint32_t within = 0, beyond = 0;
  for (uint32_t i = 0; i < with.faces(); ++i) {
    within += decided.errors[with.faces() + i] <= kLimit ? 1 : 0;
    beyond += decided.errors[i] > kLimit ? 1 : 0;
  }
  CHECK(within > 0);
  CHECK(beyond > 0);
  CHECK(within + beyond == with.faces());
  check_true(decided, of.a, of.b);
}

TEST_CASE("where floats tell no more, a survey ends by precision") {
  const ContextHandle context = make_context(VKH_DEVICE_KIND_NARROW);
  ApiMesh a(icosphere(1.0, 1)), b(translated(icosphere(1.0, 1), {1e-6, 0, 0}));
  FaceBench bench(context.get(), a, b, 16, 0);
  bench.begin();
  const Told told = bench.advance(2);
  CHECK(told.report.status == VKH_STATUS_PRECISION);
  CHECK(widest(told) > 0);
  CHECK(widest(told) < 1e-5f);
  check_true(told, a, b);
}

TEST_CASE("of an input that is no mesh nothing is known") {
  const auto is_unknown = [](const Told& told) {
    return told.report.status == VKH_STATUS_INPUT &&
           std::all_of(told.errors.begin(), told.errors.end(),
                       [](float x) { return std::isnan(x); });
  };
  Meshes of;
  SUBCASE("as the device finds it") {
    const ContextHandle context = make_context(VKH_DEVICE_KIND_NARROW, VKH_CONTEXT_CHECK_INPUT);
    Mesh broken = of.a.mesh();
    broken.vertices[3].x = std::nan("");
    ApiMesh a(broken);
    FaceBench bench(context.get(), a, of.b, 8, 1e-3f);
    CHECK(is_unknown(bench.begin()));
    CHECK(is_unknown(bench.advance(2)));
  }
#ifdef NDEBUG  // a build that checks calls ends there
  SUBCASE("as its description tells") {
    const ContextHandle context = make_context(VKH_DEVICE_KIND_NARROW);
    FaceBench bench(context.get(), of.a, of.b, 8, 1e-3f);
    bench.pair().problem().b.faceCount = 0;
    const Told told = bench.run([&](VkCommandBuffer c) {
      vkhCmdBegin(context.get(), c, &bench.pair().problem(), nullptr);
      bench.record_waves(c, 1);
    });
    CHECK(is_unknown(told));
  }
#endif
}

}  // namespace
