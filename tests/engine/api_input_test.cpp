// VKH_STATUS_INPUT: what is no mesh is reported as that. In any build what the host sees; with
// VkhContextCreateInfo::checkInput what the buffers hold.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>
#include <functional>
#include <limits>
#include <memory>

#include "tests/shapes/shapes.h"
#include "tests/support/api_bench.h"
#include "tests/support/kernel_bench.h"

using namespace vkh;
using namespace vkh::test;

namespace {

constexpr uint32_t kNothing = 0xffffffffu, kDescription = 0xfffffffeu;
using Context = std::unique_ptr<VkhContext_T, decltype(&vkhDestroyContext)>;

Context checking(VkhDeviceKind kind, VkBool32 checks = VK_TRUE) {
  VkhContextCreateInfo info{};
  info.device = test_device().engine_info();
  info.deviceKind = kind;
  info.checkInput = checks;
  VkhContext context = nullptr;
  REQUIRE(vkhCreateContext(&info, &context) == VKH_SUCCESS);
  return {context, vkhDestroyContext};
}

VkhReport whole_run(ApiPair& pair) {
  return pair.run([&](VkCommandBuffer commands) {
    pair.build(commands);
    pair.begin(commands);
    pair.advance(commands, 8);
    pair.report(commands);
  });
}

void check_refused(const VkhReport& r, uint32_t face_a, uint32_t face_b) {
  CHECK(r.status == VKH_STATUS_INPUT);
  CHECK(r.certified == 0);
  CHECK(r.lower == 0);
  CHECK(r.lowerAbove == 0);
  CHECK(r.base == 0);
  CHECK(std::isinf(r.upper));
  CHECK(std::isinf(r.upperAbove));
  CHECK(r.witnessFaceA == face_a);
  CHECK(r.witnessFaceB == face_b);
}

struct Spoilt {
  const char* name;
  std::function<void(Mesh&)> spoil;
  bool is_mesh = false;
};

// Face 6 is the first that is at fault.
uint32_t corner(const Mesh& m) { return m.faces[6].y; }
void keep_to_six(Mesh& m, double x) {
  const uint32_t old = corner(m);
  m.vertices.push_back(m.vertices[old]);
  m.faces[6].y = static_cast<uint32_t>(m.vertices.size() - 1);
  m.vertices.back().z = x;
}

const std::vector<Spoilt>& spoilt() {
  static const double inf = std::numeric_limits<double>::infinity();
  static const std::vector<Spoilt> all{
      {"nan", [](Mesh& m) { keep_to_six(m, std::nan("")); }},
      {"infinity", [](Mesh& m) { keep_to_six(m, -inf); }},
      {"beyond 2^15", [](Mesh& m) { keep_to_six(m, 32768.01); }},
      {"index", [](Mesh& m) { m.faces[6].z = static_cast<uint32_t>(m.vertices.size()); }},
      {"largest index", [](Mesh& m) { m.faces[6].x = m.faces[9].x = 0xffffffffu; }},
      {"2^15", [](Mesh& m) { keep_to_six(m, -32768); }, true},
      {"a subnormal", [](Mesh& m) { keep_to_six(m, 1e-42); }, true},
      {"a vertex that no face uses",
       [](Mesh& m) {
         m.vertices.push_back({std::nan(""), 0, 0});
       },
       true}};
  return all;
}

}  // namespace

TEST_CASE("a mesh that is none is found on the device, of A and of B") {
  for (const VkhDeviceKind kind : {VKH_DEVICE_KIND_WIDE, VKH_DEVICE_KIND_NARROW}) {
    const Context context = checking(kind);
    for (const Spoilt& s : spoilt()) {
      CAPTURE(s.name);
      Mesh bad = icosphere(1, 1);
      s.spoil(bad);
      ApiMesh good(icosphere(1.1, 1)), spoilt_mesh(bad);
      ApiPair of_a(spoilt_mesh, good, 1e-3f, context.get());
      ApiPair of_b(good, spoilt_mesh, 1e-3f, context.get());
      const VkhReport a = whole_run(of_a), b = whole_run(of_b);
      if (s.is_mesh) {
        CHECK(a.status != VKH_STATUS_INPUT);
        CHECK(a.certified == 1);
        CHECK(b.status != VKH_STATUS_INPUT);
      } else {
        check_refused(a, 6, kNothing);
        check_refused(b, kNothing, 6);
      }
    }
  }
}

TEST_CASE("a refit is checked, and one to a mesh is right again") {
  const Context context = checking(VKH_DEVICE_KIND_NARROW);
  const Mesh ball = icosphere(1.1, 1);
  ApiMesh a(icosphere(1, 1)), b(ball);
  ApiPair pair(a, b, 1e-3f, context.get());
  CHECK(whole_run(pair).certified == 1);
  const auto refitted = [&](const Mesh& moved) {
    b.move(moved);
    return pair.run([&](VkCommandBuffer commands) {
      pair.refit(commands);
      pair.begin(commands);
      pair.advance(commands, 8);
      pair.report(commands);
    });
  };
  Mesh bad = ball;
  bad.vertices[bad.faces[0].x].x = std::nan("");
  check_refused(refitted(bad), kNothing, 0);
  const VkhReport right = refitted(ball);
  CHECK(right.certified == 1);
  check_true(right, a, b);
}

TEST_CASE("the check changes no bit of a report on meshes") {
  ApiMesh a(icosphere(1, 2)), b(icosphere(1.1, 2), {.stride = 20, .is_16bit = true});
  const Context with = checking(VKH_DEVICE_KIND_WIDE);
  const Context without = checking(VKH_DEVICE_KIND_WIDE, VK_FALSE);
  ApiPair one(a, b, 1e-4f, with.get()), other(a, b, 1e-4f, without.get());
  CHECK(is_same(whole_run(one), whole_run(other)));
}

// A build that asserts names the rule instead (api_misuse_test).
#ifdef NDEBUG
TEST_CASE("a description that is none ends as a status in any build") {
  const std::pair<const char*, std::function<void(VkhMesh&)>> descriptions[] = {
      {"stride 0", [](VkhMesh& m) { m.vertexStride = 0; }},
      {"stride 4", [](VkhMesh& m) { m.vertexStride = 4; }},
      {"stride 8", [](VkhMesh& m) { m.vertexStride = 8; }},
      {"stride 13", [](VkhMesh& m) { m.vertexStride = 13; }},
      {"offset 2", [](VkhMesh& m) { m.vertexOffset -= 14; }},
      {"index type", [](VkhMesh& m) { m.indexType = static_cast<VkIndexType>(77); }}};
  for (const VkBool32 checks : {VK_FALSE, VK_TRUE}) {
    const Context context = checking(VKH_DEVICE_KIND_NARROW, checks);
    for (const auto& description : descriptions) {
      CAPTURE(description.first);
      const auto& spoil = description.second;
      // Rows of 16 bytes from byte 16, so that its buffer also holds rows of 13 or from byte 2.
      ApiMesh a(icosphere(1, 1), {.stride = 16, .vertex_offset = 16}),
          b(icosphere(1.1, 1), {.stride = 16});
      ApiPair pair(a, b, 1e-3f, context.get());
      spoil(pair.problem().a);
      check_refused(whole_run(pair), kDescription, kNothing);
    }
  }
}

TEST_CASE("a hierarchy that was copied before its build is reported") {
  const Context context = checking(VKH_DEVICE_KIND_WIDE, VK_FALSE);
  ApiMesh a(icosphere(1, 1)), b(icosphere(1.1, 1));
  ApiPair pair(a, b, 1e-3f, context.get());
  const VkhHierarchy early = pair.problem().b;
  const VkhReport r = pair.run([&](VkCommandBuffer commands) {
    pair.build(commands);
    pair.problem().b = early;
    pair.begin(commands);
    pair.advance(commands, 8);
    pair.report(commands);
  });
  check_refused(r, kNothing, kDescription);
  CHECK(r.waves == 0);
}
#endif
