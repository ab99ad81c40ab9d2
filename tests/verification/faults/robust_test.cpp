// Indices out of range in a caller's buffers: no check finds them on the GPU, and nothing outside
// of the buffers is read or written. The device has robustBufferAccess, as the host enables it.
#include <doctest/doctest.h>

#include <cmath>

#include "host/gpu/vulkan_api.h"
#include "tests/shapes/shapes.h"
#include "tests/support/api_bench.h"
#include "tests/support/kernel_bench.h"
#include "tests/verification/faults/trial.h"

namespace {

using namespace vkh;
using namespace vkh::test;

bool has_robust_access() {
  VkPhysicalDeviceFeatures2 features{};
  features.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2;
  const Device& device = test_device();
  device.vk().GetPhysicalDeviceFeatures2(device.physical(), &features);
  return features.features.robustBufferAccess == VK_TRUE;
}

/// A mesh that every reader would refuse: every third face has one corner at `index`, every fifth
/// vertex one coordinate `x`. It lies in buffers of its own, with no byte more than the contract
/// requires.
class BadMesh {
 public:
  BadMesh(const Mesh& mesh, VkIndexType type, uint32_t index, float x) {
    std::vector<float> positions;
    for (const glm::dvec3& v : mesh.vertices) {
      const bool is_bad = positions.size() % 15 == 0 && x != 0;
      positions.insert(positions.end(), {is_bad ? x : static_cast<float>(v.x),
                                         static_cast<float>(v.y), static_cast<float>(v.z)});
    }
    std::vector<uint32_t> words;
    for (const glm::uvec3& f : mesh.faces) words.insert(words.end(), {f.x, f.y, f.z});
    for (size_t i = 0; i < words.size() && index != 0; i += 9) words[i + i % 2] = index;
    const bool is_16bit = type == VK_INDEX_TYPE_UINT16;
    const std::vector<uint16_t> halves(words.begin(), words.end());
    keep(vertices_, positions.data(), positions.size() * sizeof(float));
    keep(indices_, is_16bit ? static_cast<const void*>(halves.data()) : words.data(),
         (words.size() * (is_16bit ? 2 : 4) + 3) / 4 * 4);
    view_ = {.vertexBuffer = vertices_.handle(),
             .vertexOffset = 0,
             .vertexStride = 12,
             .vertexCount = static_cast<uint32_t>(mesh.vertices.size()),
             .indexBuffer = indices_.handle(),
             .indexOffset = 0,
             .indexType = type,
             .faceCount = static_cast<uint32_t>(mesh.faces.size()),
             .vertexLowBuffer = VK_NULL_HANDLE,
             .vertexLowOffset = 0};
  }
  const VkhMesh& view() const { return view_; }

 private:
  static void keep(Buffer& buffer, const void* content, size_t bytes) {
    buffer = Buffer(test_device(), bytes, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, Placement::kReadback);
    std::memcpy(buffer.mapped(), content, bytes);
  }
  Buffer vertices_, indices_;
  VkhMesh view_{};
};

/// Build or refit, begin, waves, report; each mesh is the pair's own if none is given. The report
/// may be anything, but must come soon.
void run_to_an_end(ApiPair& pair, const BadMesh* a, const BadMesh* b) {
  const Watchdog watchdog;
  const VkhMesh good = pair.problem().a;
  if (a != nullptr) pair.problem().a = a->view();
  VkhTask task = pair.task(3);
  if (b != nullptr) task.mesh = &b->view();
  for (const VkhMemory* scratch : {task.scratch, static_cast<const VkhMemory*>(nullptr)}) {
    task.scratch = scratch;
    const VkhReport r = pair.run([&](VkCommandBuffer commands) {
      vkhCmdRunTasks(pair.context(), commands, 1, &task, nullptr);
      record_host_barrier(commands);
    });
    CHECK(r.waves <= 4);
    CHECK(r.status <= VKH_STATUS_MEMORY);
  }
  pair.problem().a = good;
}

VkhReport answer_of(ApiPair& pair) {
  return pair.run([&](VkCommandBuffer commands) {
    pair.build(commands);
    pair.begin(commands);
    pair.advance(commands, 8);
    pair.report(commands);
  });
}

TEST_CASE("the host enables robustBufferAccess where it is there, and only there") {
  const uint64_t wanted = has_robust_access() ? 1 : 0;
  layer();  // before the instance
  {
    const Device device({.selector = "", .validation = false});
    CHECK(layer().count("robust_devices") == wanted);
  }
  layer().arm("");
  {
    const Device device({.selector = "", .validation = false, .robust = false});
    CHECK(layer().count("robust_devices") == 0);
  }
  CHECK(layer().violations() == 0);
}

TEST_CASE("indices out of range and strange vertices touch nothing outside, and end") {
  if (!has_robust_access()) {
    MESSAGE("SKIP: the device has no robustBufferAccess");
    return;
  }
  const Mesh a = noisy(icosphere(1, 1), 0.05, 1), b = icosphere(1, 1);
  ApiMesh good_a(a), good_b(b);
  ApiPair pair(good_a, good_b, 1e-3f);
  const VkhReport before = answer_of(pair);
  const auto count = static_cast<uint32_t>(b.vertices.size());
  const auto try_both = [&](VkIndexType type, uint32_t index, float x) {
    CAPTURE(index);
    CAPTURE(x);
    const BadMesh bad_a(a, type, index, x), bad_b(b, type, index, x);
    run_to_an_end(pair, &bad_a, nullptr);
    run_to_an_end(pair, nullptr, &bad_b);
    run_to_an_end(pair, &bad_a, &bad_b);
  };
  // The next one; 12 MiB on; 3 GiB on; all bits.
  for (const uint32_t index : {count, 1u << 20, 1u << 28, UINT32_MAX})
    try_both(VK_INDEX_TYPE_UINT32, index, 0);
  try_both(VK_INDEX_TYPE_UINT16, 0xffff, 0);
  for (const float x : {std::nanf(""), 3e38f}) try_both(VK_INDEX_TYPE_UINT32, 0, x);
  const VkhReport after = answer_of(pair);
  CHECK(after.base == before.base);
  CHECK(after.lowerAbove == before.lowerAbove);
  CHECK(after.upperAbove == before.upperAbove);
  check_true(after, good_a, good_b);
}

}  // namespace
