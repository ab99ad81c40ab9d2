// vkhCmdFindClosest through the C API alone: true in every way to run, the same bits by address, of
// the B that has moved, and NaN where there is no B.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include "host/solve/run.h"
#include "tests/shapes/adversarial.h"
#include "tests/support/api_bench.h"
#include "tests/support/kernel_bench.h"
#include "tests/verification/oracle/exact.h"

namespace {

using namespace vkh;
using namespace vkh::test;

ContextHandle make_closest_context(VkhDeviceKind kind, VkBool32 by_address = VK_FALSE,
                                   VkBool32 checks = VK_FALSE) {
  const uint32_t defaults = kind == VKH_DEVICE_KIND_WIDE ? uint32_t{VKH_SWITCH_DEFAULT_WIDE}
                                                         : uint32_t{VKH_SWITCH_DEFAULT_NARROW};
  const VkhContextCreateInfo info =
      create_info(defaults | VKH_CONTEXT_CLOSEST, kind, by_address, checks);
  VkhContext context = nullptr;
  REQUIRE(vkhCreateContext(&info, &context) == VKH_SUCCESS);
  return {context, vkhDestroyContext};
}

std::vector<Stored> some_points(uint32_t count) {
  Random random(5);
  std::vector<Stored> points;
  for (uint32_t i = 0; i < count; ++i) points.push_back(stored(random.in_cube(1.5)));
  return points;
}

/// Records with `first`, asks for the points' faces in the same commands, and waits.
template <class First>
std::vector<VkhClosestFace> closest_faces(ApiPair& pair, const std::vector<Stored>& points,
                                          const First& first) {
  const auto count = static_cast<uint32_t>(points.size());
  Buffer asked(test_device(), count * sizeof(VkhPoint), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
               Placement::kUpload);
  Buffer found(test_device(), count * sizeof(VkhClosestFace), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
               Placement::kReadback);
  std::memset(found.mapped(), 0, count * sizeof(VkhClosestFace));
  auto* to = reinterpret_cast<VkhPoint*>(asked.mapped());
  for (const Stored& p : points) *to++ = {{p.hi.x, p.hi.y, p.hi.z}, {p.lo.x, p.lo.y, p.lo.z}};
  const VkhClosestQuery query{asked.handle(), 0, count, VK_FALSE, found.handle(), 0};
  pair.run([&](VkCommandBuffer c) {
    first(c);
    vkhCmdFindClosest(pair.context(), c, &pair.problem().b, &query, nullptr);
    record_host_barrier(c);
  });
  std::vector<VkhClosestFace> faces(count);
  std::memcpy(faces.data(), found.mapped(), count * sizeof(VkhClosestFace));
  return faces;
}

size_t count_wrong(const std::vector<VkhClosestFace>& found, const std::vector<Stored>& points,
                   const Mesh& b) {
  size_t wrong = 0;
  for (size_t i = 0; i < points.size(); ++i) {
    const auto& [base, lower, upper, face] = found[i];
    const glm::dvec3 p = points[i].value();
    const Rational d2 = squared_distance_exact(p, b);
    const double from = static_cast<double>(base);
    const bool holds = is_lower_bound(from, static_cast<double>(lower), d2) &&
                       is_upper_bound(from, static_cast<double>(upper), d2);
    wrong += holds && face < b.faces.size() && upper - lower < 1e-10f ? 0 : 1;
  }
  return wrong;
}

bool same(const std::vector<VkhClosestFace>& x, const std::vector<VkhClosestFace>& y) {
  return x.size() == y.size() && std::memcmp(x.data(), y.data(), x.size() * sizeof(x[0])) == 0;
}

bool is_unknown(const VkhClosestFace& found) {
  return std::isnan(found.base) && std::isnan(found.lowerAbove) && std::isnan(found.upperAbove) &&
         found.face == 0xffffffffu;
}

Mesh closest_ball() { return translated(icosphere(1.0, 2), {0.1, 0.2, 0.05}); }

}  // namespace

TEST_CASE("points have their closest faces, on wide and on narrow devices") {
  const std::vector<Stored> points = some_points(257);  // a workgroup has 64
  for (const VkhDeviceKind kind : {VKH_DEVICE_KIND_NARROW, VKH_DEVICE_KIND_WIDE}) {
    const ContextHandle context = make_closest_context(kind);
    ApiMesh b(closest_ball());
    ApiPair pair(b, b, 1e-5f, context.get());
    const auto found = closest_faces(pair, points, [&](VkCommandBuffer c) { pair.build(c); });
    CHECK(count_wrong(found, points, b.mesh()) == 0);
  }
}

TEST_CASE("closest faces by address: every bit is the same") {
  if (!test_device().has_addresses()) {
    MESSAGE("SKIP: the device has no bufferDeviceAddress");
    return;
  }
  std::vector<std::vector<VkhClosestFace>> found;
  for (const VkBool32 by_address : {VK_FALSE, VK_TRUE}) {
    const ContextHandle context = make_closest_context(VKH_DEVICE_KIND_NARROW, by_address);
    ApiMesh b(closest_ball());
    ApiPair pair(b, b, 1e-5f, context.get());
    found.push_back(
        closest_faces(pair, some_points(200), [&](VkCommandBuffer c) { pair.build(c); }));
  }
  CHECK(same(found[0], found[1]));
}

TEST_CASE("after a refit closest faces are of the B that has moved") {
  const ContextHandle context = make_closest_context(VKH_DEVICE_KIND_NARROW);
  ApiMesh b(closest_ball());
  ApiPair pair(b, b, 1e-5f, context.get());
  pair.run([&](VkCommandBuffer c) { pair.build(c); });
  b.move(translated(icosphere(1.2, 2), {0.3, -0.1, 0.2}));
  const std::vector<Stored> points = some_points(100);
  const auto found = closest_faces(pair, points, [&](VkCommandBuffer c) { pair.refit(c); });
  CHECK(count_wrong(found, points, b.mesh()) == 0);
}

TEST_CASE("of a B that is no mesh nothing is known") {
  const ContextHandle context = make_closest_context(VKH_DEVICE_KIND_NARROW, VK_FALSE, VK_TRUE);
  Mesh bad = closest_ball();
  bad.vertices[bad.faces[3].x].x = std::nan("");
  ApiMesh b(bad);
  ApiPair pair(b, b, 1e-5f, context.get());
  const std::vector<Stored> points = some_points(3);
  for (const auto& found : closest_faces(pair, points, [&](VkCommandBuffer c) { pair.build(c); }))
    CHECK(is_unknown(found));
}

// A build that asserts names the rule instead (api_misuse_test).
#ifdef NDEBUG
TEST_CASE("of a B that was not built nothing is known, and other contexts record nothing") {
  const ContextHandle context = make_closest_context(VKH_DEVICE_KIND_NARROW);
  ApiMesh b(closest_ball());
  ApiPair pair(b, b, 1e-5f, context.get()), other(b, b, 1e-5f);
  const std::vector<Stored> points = some_points(3);
  pair.problem().b.faceCount = pair.problem().b.vertexCount = 0;
  for (const auto& found : closest_faces(pair, points, [](VkCommandBuffer) {}))
    CHECK(is_unknown(found));
  for (const auto& found : closest_faces(other, points, [&](VkCommandBuffer c) { other.build(c); }))
    CHECK(found.base == 0);
}
#endif
