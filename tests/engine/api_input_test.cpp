// VKH_STATUS_INPUT: an input that is no mesh is reported. Any build reports the faults that the
// host sees; with VKH_CONTEXT_CHECK_INPUT those in the buffers, too.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "tests/shapes/shapes.h"
#include "tests/support/api_bench.h"
#include "tests/support/kernel_bench.h"

using namespace vkh;
using namespace vkh::test;

namespace {

constexpr uint32_t kNothing = 0xffffffffu, kDescription = 0xfffffffeu;
using Context = std::unique_ptr<VkhContext_T, decltype(&vkhDestroyContext)>;

Context checking(VkhDeviceKind kind, VkBool32 checks = VK_TRUE, VkBool32 by_address = VK_FALSE,
                 uint32_t switches = 0) {
  const VkhContextCreateInfo info = create_info(switches, kind, by_address, checks);
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
  CHECK(r.lower == 0);
  CHECK(r.lowerAbove == 0);
  CHECK(r.base == 0);
  CHECK(std::isinf(r.upper));
  CHECK(std::isinf(r.upperAbove));
  CHECK(r.witnessFaceA == face_a);
  CHECK(r.witnessFaceB == face_b);
}

// A build that checks calls ends there, before a task is recorded.
[[maybe_unused]] VkhReport run_task(ApiPair& pair, const VkhTask& task) {
  pair.spoil_report();
  return pair.run([&](VkCommandBuffer commands) {
    vkhCmdRunTasks(pair.context(), commands, 1, &task, nullptr);
    record_host_barrier(commands);
  });
}

// Bounds A's first `count` faces, one cell per face.
std::vector<VkhCellBounds> cells_of(ApiPair& pair, uint32_t count, bool builds = true) {
  const size_t bytes = std::max(count, 1u) * sizeof(VkhCellBounds);
  Buffer buffer(test_device(), bytes, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, Placement::kReadback);
  std::memset(buffer.mapped(), 0, bytes);
  const VkhCells cells{VK_NULL_HANDLE, 0, 0, count, buffer.handle(), 0};
  pair.run([&](VkCommandBuffer commands) {
    if (builds) pair.build(commands);
    pair.begin(commands);
    vkhCmdBoundCells(pair.context(), commands, &pair.problem(), &cells, nullptr);
    record_host_barrier(commands);
  });
  std::vector<VkhCellBounds> bounds(count);
  std::memcpy(static_cast<void*>(bounds.data()), buffer.mapped(), count * sizeof(VkhCellBounds));
  return bounds;
}

void check_unknown(const VkhCellBounds& bounds) {
  for (int corner = 0; corner < 3; ++corner) {
    CHECK(std::isnan(bounds.lower[corner]));
    CHECK(std::isnan(bounds.upper[corner]));
    CHECK(bounds.cornerFaces[corner] == kNothing);
  }
  CHECK(std::isnan(bounds.highest));
  CHECK(std::isnan(bounds.reached));
  CHECK(std::isnan(bounds.meanUpper));
  CHECK(std::isnan(bounds.squareUpper));
  CHECK(bounds.faceB == kNothing);
}

struct Description {
  const char* name;
  std::function<void(VkhMesh&)> spoil;
};

#ifdef NDEBUG
const std::vector<Description>& descriptions() {
  static const std::vector<Description> all{
      {"stride 0", [](VkhMesh& m) { m.vertexStride = 0; }},
      {"stride 4", [](VkhMesh& m) { m.vertexStride = 4; }},
      {"stride 8", [](VkhMesh& m) { m.vertexStride = 8; }},
      {"stride 13", [](VkhMesh& m) { m.vertexStride = 13; }},
      {"largest stride", [](VkhMesh& m) { m.vertexStride = 0xfffffffc; }},
      {"offset 2", [](VkhMesh& m) { m.vertexOffset -= 14; }},
      {"index offset 2", [](VkhMesh& m) { m.indexOffset = 2; }},
      {"index type", [](VkhMesh& m) { m.indexType = static_cast<VkIndexType>(77); }},
      {"indices of 8 bits", [](VkhMesh& m) { m.indexType = VK_INDEX_TYPE_UINT8_EXT; }},
      {"no indices", [](VkhMesh& m) { m.indexType = VK_INDEX_TYPE_NONE_KHR; }},
      {"no vertices", [](VkhMesh& m) { m.vertexCount = 0; }},
      {"no faces", [](VkhMesh& m) { m.faceCount = 0; }},
      {"nothing", [](VkhMesh& m) { m.faceCount = m.vertexCount = 0; }},
      {"too many vertices", [](VkhMesh& m) { m.vertexCount = (1u << 28) + 1; }},
      {"too many faces", [](VkhMesh& m) { m.faceCount = 0xffffffff; }},
      {"no vertex buffer", [](VkhMesh& m) { m.vertexBuffer = VK_NULL_HANDLE; }},
      {"no index buffer", [](VkhMesh& m) { m.indexBuffer = VK_NULL_HANDLE; }}};
  return all;
}
#endif

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
  for (const auto& [kind, by_address] :
       {std::pair(VKH_DEVICE_KIND_WIDE, VK_FALSE), std::pair(VKH_DEVICE_KIND_NARROW, VK_FALSE),
        std::pair(VKH_DEVICE_KIND_WIDE, VK_TRUE)}) {
    if (by_address == VK_TRUE && !test_device().has_addresses()) continue;
    const Context context = checking(kind, VK_TRUE, by_address);
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
        CHECK(b.status != VKH_STATUS_INPUT);
      } else {
        check_refused(a, 6, kNothing);
        check_refused(b, kNothing, 6);
      }
    }
  }
}

TEST_CASE("low parts are checked where they are used") {
  const Context context = checking(VKH_DEVICE_KIND_NARROW);
  ApiMesh a(icosphere(1, 1)), b(icosphere(1.1, 1));
  const VkDeviceSize bytes = VkDeviceSize{12} * a.view().vertexCount;
  Buffer low(test_device(), bytes, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, Placement::kUpload);
  const auto run = [&](float value, VkBool32 two_float) {
    std::memset(low.mapped(), 0, bytes);
    const size_t vertex = a.mesh().faces[0].x;
    const auto& at = a.mesh().vertices[vertex];
    const size_t axis = std::abs(at.x) > 0.5 ? 0 : std::abs(at.y) > 0.5 ? 1 : 2;  // no 0
    std::memcpy(low.mapped() + 12 * vertex + 4 * axis, &value, sizeof(value));
    ApiPair pair(a, b, 1e-3f, context.get());
    pair.problem().a.vertexLowBuffer = low.handle();
    pair.problem().options.twoFloat = two_float;
    return whole_run(pair);
  };
  CHECK(run(1e-9f, VK_TRUE).status != VKH_STATUS_INPUT);
  check_refused(run(0.5f, VK_TRUE), 0, kNothing);
  check_refused(run(std::nanf(""), VK_TRUE), 0, kNothing);
  CHECK(run(0.5f, VK_FALSE).status != VKH_STATUS_INPUT);  // A is then its float32 positions
}

TEST_CASE("a refit is checked, and one to a mesh is right again") {
  const Context context = checking(VKH_DEVICE_KIND_NARROW);
  const Mesh ball = icosphere(1.1, 1);
  ApiMesh a(icosphere(1, 1)), b(ball);
  ApiPair pair(a, b, 1e-3f, context.get());
  CHECK(whole_run(pair).status != VKH_STATUS_INPUT);
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
  CHECK(right.status != VKH_STATUS_INPUT);
  check_true(right, a, b);
}

TEST_CASE("the check changes no bit of a report on meshes") {
  ApiMesh a(icosphere(1, 2)), b(icosphere(1.1, 2), {.stride = 20, .is_16bit = true});
  const Context with = checking(VKH_DEVICE_KIND_WIDE);
  const Context without = checking(VKH_DEVICE_KIND_WIDE, VK_FALSE);
  ApiPair one(a, b, 1e-4f, with.get()), other(a, b, 1e-4f, without.get());
  CHECK(is_same(whole_run(one), whole_run(other)));
}

TEST_CASE("cells of what is no mesh have no bounds") {
  const Context context = checking(VKH_DEVICE_KIND_NARROW, VK_TRUE, VK_FALSE,
                                   uint32_t{VKH_SWITCH_DEFAULT_NARROW} | VKH_CONTEXT_CELLS);
  Mesh bad = icosphere(1, 1);
  keep_to_six(bad, std::nan(""));
  ApiMesh good(icosphere(1.1, 1)), spoilt_mesh(bad);
  ApiPair none(spoilt_mesh, good, 1e-3f, context.get()), some(good, good, 1e-3f, context.get());
  for (const VkhCellBounds& bounds : cells_of(none, 8)) check_unknown(bounds);
  for (const VkhCellBounds& bounds : cells_of(some, 8)) CHECK(bounds.highest >= bounds.reached);
}

// A build that asserts names the rule instead (api_misuse_test).
#ifdef NDEBUG
TEST_CASE("a description that is none ends as a status in any build") {
  for (const VkBool32 by_address : {VK_FALSE, VK_TRUE}) {
    if (by_address == VK_TRUE && !test_device().has_addresses()) continue;
    for (const VkBool32 checks : {VK_FALSE, VK_TRUE}) {
      const Context context = checking(VKH_DEVICE_KIND_NARROW, checks, by_address);
      for (const Description& description : descriptions()) {
        CAPTURE(description.name);
        // Rows of 16 bytes from byte 16, so that its buffer also holds rows of 13 or from byte 2.
        ApiMesh a(icosphere(1, 1), {.stride = 16, .vertex_offset = 16}),
            b(icosphere(1.1, 1), {.stride = 16, .vertex_offset = 16});
        ApiPair of_a(a, b, 1e-3f, context.get()), of_b(a, b, 1e-3f, context.get());
        description.spoil(of_a.problem().a);
        check_refused(whole_run(of_a), kDescription, kNothing);
        VkhTask task = of_b.task(8);
        VkhMesh bad = *task.mesh;
        description.spoil(bad);
        task.mesh = &bad;
        check_refused(run_task(of_b, task), kNothing, kDescription);
      }
    }
  }
}

TEST_CASE("both meshes are named that have no faces") {
  const Context context = checking(VKH_DEVICE_KIND_WIDE, VK_FALSE);
  ApiMesh a(icosphere(1, 1)), b(icosphere(1.1, 1));
  ApiPair pair(a, b, 1e-3f, context.get());
  VkhTask task = pair.task(8);
  VkhMesh none = *task.mesh;
  none.faceCount = 0;
  task.mesh = &none;
  pair.problem().a.vertexCount = 0;
  check_refused(run_task(pair, task), kDescription, kDescription);
}

TEST_CASE("a refit is of what was built") {
  const Context context = checking(VKH_DEVICE_KIND_WIDE, VK_FALSE);
  ApiMesh a(icosphere(1, 1)), b(icosphere(1.1, 1)), other(icosphere(1.1, 2));
  ApiPair pair(a, b, 1e-3f, context.get());
  VkhTask task = pair.task(8);
  task.scratch = nullptr;
  check_refused(run_task(pair, task), kNothing, kDescription);  // nothing was
  const VkhReport right = whole_run(pair);
  CHECK(right.status != VKH_STATUS_INPUT);
  for (const Description& description : descriptions()) {
    CAPTURE(description.name);
    VkhMesh bad = b.view();
    description.spoil(bad);
    task.mesh = &bad;
    check_refused(run_task(pair, task), kNothing, kDescription);
  }
  task.mesh = &other.view();
  check_refused(run_task(pair, task), kNothing, kDescription);
  task.mesh = &b.view();
  const VkhReport again = run_task(pair, task);
  CHECK(again.status != VKH_STATUS_INPUT);
  check_true(again, a, b);
}

TEST_CASE("a run stays where it is if the workspace cannot take it") {
  const Context context = checking(VKH_DEVICE_KIND_NARROW, VK_FALSE);
  ApiMesh a(icosphere(1, 2)), b(icosphere(1.1, 2));
  ApiPair plain(a, b, 1e-4f, context.get()), moved(a, b, 1e-4f, context.get());
  const VkhMemory own = moved.problem().workspace;
  const VkhMemory wrong[] = {{own.buffer, own.offset, own.size - 256},
                             {own.buffer, own.offset + 256, own.size},
                             {plain.problem().workspace.buffer, 0, own.size - 256}};
  const VkhReport r = moved.run([&](VkCommandBuffer commands) {
    moved.build(commands);
    moved.begin(commands);
    for (const VkhMemory& to : wrong) {
      vkhCmdMoveRun(moved.context(), commands, &moved.problem(), &to, nullptr);
      CHECK(moved.problem().workspace.offset == own.offset);
      CHECK(moved.problem().workspace.size == own.size);
    }
    moved.advance(commands, 8);
    moved.report(commands);
  });
  CHECK(is_same(r, whole_run(plain)));
}

TEST_CASE("a run of what is no mesh stays one where it is moved") {
  const Context context = checking(VKH_DEVICE_KIND_NARROW, VK_FALSE);
  for (const Description& description : descriptions()) {
    CAPTURE(description.name);
    ApiMesh a(icosphere(1, 1), {.stride = 16, .vertex_offset = 16}), b(icosphere(1.1, 1));
    ApiPair pair(a, b, 1e-3f, context.get()), room(a, b, 1e-3f, context.get());
    description.spoil(pair.problem().a);
    const VkhReport r = pair.run([&](VkCommandBuffer commands) {
      pair.build(commands);
      pair.begin(commands);
      vkhCmdMoveRun(pair.context(), commands, &pair.problem(), &room.problem().workspace, nullptr);
      pair.advance(commands, 8);
      pair.report(commands);
    });
    check_refused(r, kDescription, kNothing);
  }
}

#ifdef NDEBUG
TEST_CASE(
    "options of a size that no version has are refused, and a task of such a size is left out") {
  const Context context = checking(VKH_DEVICE_KIND_NARROW, VK_FALSE);
  ApiMesh a(icosphere(1, 1)), b(icosphere(1.1, 1));
  ApiPair pair(a, b, 1e-3f, context.get());
  pair.problem().options.size -= 1;
  check_refused(whole_run(pair), kDescription, kNothing);
  pair.problem().options.size += 1;
  const VkhReport right = whole_run(pair);
  CHECK(right.status == VKH_STATUS_DECIDED);
  VkhTask task = pair.task(8);
  task.size += 1;
  pair.run([&](VkCommandBuffer commands) {
    vkhCmdRunTasks(pair.context(), commands, 1, &task, nullptr);
    record_host_barrier(commands);
  });
  CHECK(is_same(pair.read(), right));
}
#endif

TEST_CASE("numbers that are none change no truth") {
  const Context context = checking(VKH_DEVICE_KIND_NARROW, VK_FALSE);
  ApiMesh a(icosphere(1, 1)), b(icosphere(1.1, 1));
  for (float VkhRunOptions::*member : {&VkhRunOptions::cullTolerance, &VkhRunOptions::knownLower,
                                       &VkhRunOptions::limit, &VkhRunOptions::limitUp}) {
    for (const float value : {std::nanf(""), -1.0f, -std::numeric_limits<float>::infinity()}) {
      CAPTURE(value);
      ApiPair pair(a, b, 1e-3f, context.get());
      pair.problem().options.*member = value;
      const VkhReport r = whole_run(pair);
      CHECK(r.status != VKH_STATUS_INPUT);
      CHECK(r.status != VKH_STATUS_WITHIN);
      CHECK(r.status != VKH_STATUS_BEYOND);
      check_true(r, a, b);
    }
  }
}

TEST_CASE("cells without a run have no bounds, and without the switch are not recorded") {
  const Context with = checking(VKH_DEVICE_KIND_NARROW, VK_FALSE, VK_FALSE,
                                uint32_t{VKH_SWITCH_DEFAULT_NARROW} | VKH_CONTEXT_CELLS);
  const Context without = checking(VKH_DEVICE_KIND_NARROW, VK_FALSE);
  for (const Description& description : descriptions()) {
    CAPTURE(description.name);
    ApiMesh a(icosphere(1, 1), {.stride = 16, .vertex_offset = 16}), b(icosphere(1.1, 1));
    ApiPair pair(a, b, 1e-3f, with.get());
    description.spoil(pair.problem().a);
    for (const VkhCellBounds& bounds : cells_of(pair, 4)) check_unknown(bounds);
  }
  ApiMesh a(icosphere(1, 1)), b(icosphere(1.1, 1));
  ApiPair pair(a, b, 1e-3f, with.get()), plain(a, b, 1e-3f, without.get());
  const VkhHierarchy early = pair.problem().b;
  for (const VkhCellBounds& bounds : cells_of(pair, 4)) CHECK(bounds.highest > 0);
  pair.problem().b = early;
  for (const VkhCellBounds& bounds : cells_of(pair, 4, false)) check_unknown(bounds);
  CHECK(cells_of(pair, 0, false).empty());
  cells_of(plain, 4);
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
