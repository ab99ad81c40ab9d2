// The engine on a device of your own, in thirty lines and two buffers: one for work, one for the
// result.
#include <algorithm>
#include <cstdio>
#include <cstring>
#include <stdexcept>

#include "examples/gpu.h"

namespace {

// [embed]
VkhReport distance(example::Gpu& gpu, const VkhMesh& a, const VkhMesh& b, float tol) {
  VkhContext vkh = gpu.context();  // vkhCreateContext, once a device
  VkhHierarchyRequirements hierarchy;
  VkhWorkspaceRequirements workspace;
  if (vkhGetHierarchyRequirements(vkh, b.vertexCount, b.faceCount, &hierarchy) != VKH_SUCCESS ||
      vkhGetWorkspaceRequirements(vkh, a.vertexCount, a.faceCount, &workspace) != VKH_SUCCESS ||
      hierarchy.rangeCount > 1)  // of a B of several GB
    throw std::runtime_error("the meshes are too large for this device");
  const VkDeviceSize split = (hierarchy.hierarchySize + 255) / 256 * 256;
  const VkDeviceSize room = std::max(workspace.recommended, hierarchy.scratchSize);
  const example::Buffer memory = gpu.buffer(split + room, example::Memory::kDevice);
  const example::Buffer result = gpu.buffer(sizeof(VkhReport), example::Memory::kHost);
  const VkhMemory scratch{memory.handle, split, room};  // free before the run begins
  VkhProblem problem{};
  problem.a = a;
  problem.b.memory = {memory.handle, 0, split};
  problem.workspace = {memory.handle, split, workspace.recommended};
  problem.options.size = sizeof(problem.options);
  problem.options.cullTolerance = tol;
  gpu.run([&](VkCommandBuffer commands) {
    vkhCmdBuildHierarchy(vkh, commands, &b, &problem.b, &scratch, nullptr);
    vkhCmdBegin(vkh, commands, &problem, nullptr);
    vkhCmdAdvance(vkh, commands, &problem, 16, nullptr);
    vkhCmdWriteReport(vkh, commands, &problem, result.handle, 0, nullptr);
    example::barrier(commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_ACCESS_SHADER_WRITE_BIT,
                     VK_PIPELINE_STAGE_HOST_BIT, VK_ACCESS_HOST_READ_BIT);
  });
  VkhReport report;
  std::memcpy(&report, result.mapped, sizeof(report));
  return report;  // report.lower <= h(A, B) <= report.upper, for any report.status
}
// [embed]

// A square pyramid of height 1 over [-1, 1]^2, and its base: h(pyramid, base) is the height.
constexpr float kVertices[][3] = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {0, 0, 1}};
constexpr uint16_t kFaces[][3] = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}, {0, 1, 2}, {0, 2, 3}};

}  // namespace

int main(int argc, char** argv) try {
  const bool validation = argc > 1 && std::strcmp(argv[1], "--validation") == 0;
  example::Gpu gpu({.validation = validation});
  const example::Buffer meshes =
      gpu.buffer(sizeof(kVertices) + sizeof(kFaces), example::Memory::kHost);
  std::memcpy(meshes.mapped, kVertices, sizeof(kVertices));
  std::memcpy(meshes.mapped + sizeof(kVertices), kFaces, sizeof(kFaces));
  VkhMesh pyramid{};
  pyramid.vertexBuffer = pyramid.indexBuffer = meshes.handle;
  pyramid.vertexStride = sizeof(kVertices[0]);
  pyramid.vertexCount = 5;
  pyramid.indexOffset = sizeof(kVertices);
  pyramid.indexType = VK_INDEX_TYPE_UINT16;
  pyramid.faceCount = 4;
  VkhMesh base = pyramid;
  base.indexOffset += 4 * sizeof(kFaces[0]);
  base.faceCount = 2;
  const VkhReport report = distance(gpu, pyramid, base, 1e-5f);
  std::printf("%.9g <= h(pyramid, base) <= %.9g on %s\n", static_cast<double>(report.lower),
              static_cast<double>(report.upper), gpu.name().c_str());
  return gpu.validation_messages() == 0 ? 0 : 1;
} catch (const std::exception& error) {
  std::fprintf(stderr, "embed: %s\n", error.what());
  return 1;
}
