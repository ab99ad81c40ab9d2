#include "examples/scene.h"

#include <algorithm>
#include <cstring>
#include <stdexcept>

namespace example {
namespace {
#include "examples/deform_comp.h"

struct DeformPush {
  uint32_t first, cells_u, cells_v;
  float time;
};

}  // namespace

Scene::Scene(Gpu& gpu, uint32_t cells_u, uint32_t cells_v, uint32_t levels) : gpu_(gpu) {
  uint32_t vertices = 0, indices = 0;
  for (uint32_t k = 0; k < levels; ++k) {
    levels_.push_back({vertices, indices, cells_u >> k, cells_v >> k});
    vertices += levels_[k].vertex_count();
    indices += 3 * levels_[k].face_count();
  }
  vertices_ = gpu.buffer(vertices * sizeof(SceneVertex), Memory::kDevice);
  indices_ = gpu.buffer(indices * sizeof(uint32_t), Memory::kDevice);
  const Buffer staging = gpu.buffer(indices_.size, Memory::kHost);
  for (uint32_t k = 0; k < levels; ++k) {
    const std::vector<uint32_t> corners = this->indices(k);
    std::memcpy(staging.mapped + levels_[k].first_index * sizeof(uint32_t), corners.data(),
                corners.size() * sizeof(uint32_t));
  }
  gpu.run([&](VkCommandBuffer commands) {
    const VkBufferCopy all{0, 0, indices_.size};
    vkCmdCopyBuffer(commands, staging.handle, indices_.handle, 1, &all);
  });
  deform_ = gpu.compute_pipeline(k_deform_comp);
}

uint32_t Scene::vertex_count() const {
  return levels_.back().first_vertex + levels_.back().vertex_count();
}

std::vector<uint32_t> Scene::indices(uint32_t level) const {
  const Level& l = levels_[level];
  const auto at = [&](uint32_t u, uint32_t v) { return v % l.cells_v * l.cells_u + u % l.cells_u; };
  std::vector<uint32_t> corners;
  for (uint32_t v = 0; v < l.cells_v; ++v) {
    for (uint32_t u = 0; u < l.cells_u; ++u) {
      corners.insert(corners.end(), {at(u, v), at(u + 1, v), at(u + 1, v + 1)});
      corners.insert(corners.end(), {at(u, v), at(u + 1, v + 1), at(u, v + 1)});
    }
  }
  return corners;
}

void Scene::deform(VkCommandBuffer commands, float time) const {
  vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, deform_);
  for (const Level& l : levels_) {
    const DeformPush push{l.first_vertex, l.cells_u, l.cells_v, time};
    gpu_.bind(commands, VK_PIPELINE_BIND_POINT_COMPUTE, {vertices_.handle}, bytes_of(push));
    vkCmdDispatch(commands, (l.vertex_count() + 63) / 64, 1, 1);
  }
}

VkhMesh Scene::mesh(uint32_t level) const {
  const Level& l = levels_[level];
  VkhMesh mesh{};
  mesh.vertexBuffer = vertices_.handle;
  mesh.vertexOffset = l.first_vertex * sizeof(SceneVertex);
  mesh.vertexStride = sizeof(SceneVertex);
  mesh.vertexCount = l.vertex_count();
  mesh.indexBuffer = indices_.handle;
  mesh.indexOffset = l.first_index * sizeof(uint32_t);
  mesh.indexType = VK_INDEX_TYPE_UINT32;
  mesh.faceCount = l.face_count();
  return mesh;
}

Pair::Pair(Gpu& gpu, const Scene& scene, uint32_t a, uint32_t b)
    : context_(gpu.context()), b_(scene.mesh(b)) {
  problem_.a = scene.mesh(a);
  VkhHierarchyRequirements hierarchy;
  VkhWorkspaceRequirements workspace;
  if (vkhGetHierarchyRequirements(context_, b_.vertexCount, b_.faceCount, &hierarchy) !=
          VKH_SUCCESS ||
      vkhGetWorkspaceRequirements(context_, problem_.a.vertexCount, problem_.a.faceCount,
                                  &workspace) != VKH_SUCCESS ||
      hierarchy.rangeCount > 1)
    throw std::runtime_error("the meshes are too large for this device");
  // The scratch has a place of its own: a warm start needs the last frame's data in the workspace.
  problem_.b.memory = {gpu.buffer(hierarchy.hierarchySize, Memory::kDevice).handle, 0,
                       hierarchy.hierarchySize};
  scratch_ = {gpu.buffer(hierarchy.scratchSize, Memory::kDevice).handle, 0, hierarchy.scratchSize};
  problem_.workspace = {gpu.buffer(workspace.recommended, Memory::kDevice).handle, 0,
                        workspace.recommended};
}

void Pair::certify(VkCommandBuffer commands, Hierarchy hierarchy, bool warm, uint32_t waves,
                   float tolerance) {
  problem_.options.size = sizeof(problem_.options);
  problem_.options.warm = warm ? VK_TRUE : VK_FALSE;
  problem_.options.cullTolerance = tolerance;
  if (hierarchy == Hierarchy::kBuild) {
    vkhCmdBuildHierarchy(context_, commands, &b_, &problem_.b, &scratch_, nullptr);
  } else {
    vkhCmdRefitHierarchy(context_, commands, &b_, &problem_.b, nullptr);
  }
  vkhCmdBegin(context_, commands, &problem_, nullptr);
  vkhCmdAdvance(context_, commands, &problem_, std::max(waves, 1u) - 1, nullptr);
}

void Pair::write_report(VkCommandBuffer commands, const Buffer& report, VkDeviceSize offset) {
  vkhCmdWriteReport(context_, commands, &problem_, report.handle, offset, nullptr);
}

void Pair::write_face_errors(VkCommandBuffer commands, const VkhSurvey& survey, uint32_t waves,
                             const Buffer& errors, VkDeviceSize offset) {
  vkhCmdBeginSurvey(context_, commands, &problem_, &survey, nullptr);
  vkhCmdAdvanceSurvey(context_, commands, &problem_, &survey, waves, nullptr);
  vkhCmdWriteSurveyFaces(context_, commands, &problem_, &survey, errors.handle, offset, nullptr);
}

void Pair::write_survey_report(VkCommandBuffer commands, const VkhSurvey& survey,
                               const Buffer& report) {
  vkhCmdWriteSurvey(context_, commands, &problem_, &survey, report.handle, 0, nullptr);
}

}  // namespace example
