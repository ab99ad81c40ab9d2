// A mesh that a compute shader deforms, at several levels of detail: each has half of the cells of
// the one before in both directions. All levels share two buffers.
#pragma once

#include <vector>

#include "engine/vkhausdorff.h"
#include "examples/gpu.h"

namespace example {

/// The same values as in examples/shaders/frame.glsl.
struct Level {
  uint32_t first_vertex, first_index, cells_u, cells_v;
  uint32_t vertex_count() const { return cells_u * cells_v; }
  uint32_t face_count() const { return 2 * cells_u * cells_v; }
};

struct SceneVertex {
  float position[3];
  float normal[3];
  float spare[2];
};

class Scene {
 public:
  /// cells_u and cells_v are multiples of 2^(levels - 1).
  Scene(Gpu& gpu, uint32_t cells_u, uint32_t cells_v, uint32_t levels);

  /// Moves every vertex; written in COMPUTE_SHADER, as the engine's own barrier expects.
  void deform(VkCommandBuffer commands, float time) const;
  VkhMesh mesh(uint32_t level) const;
  const std::vector<Level>& levels() const { return levels_; }
  uint32_t vertex_count() const;
  /// The corners of a level's faces, counted from its first vertex.
  std::vector<uint32_t> indices(uint32_t level) const;
  const Buffer& vertices() const { return vertices_; }
  const Buffer& index_buffer() const { return indices_; }

 private:
  Gpu& gpu_;
  std::vector<Level> levels_;
  Buffer vertices_, indices_;
  VkPipeline deform_ = VK_NULL_HANDLE;
};

/// h(a, b) of two levels: the data that the engine keeps for it between frames.
class Pair {
 public:
  Pair(Gpu& gpu, const Scene& scene, uint32_t a, uint32_t b);

  enum class Hierarchy { kBuild, kRefit };
  /// A whole frame: BVH, run, report at `offset` of `report`.
  void certify(VkCommandBuffer commands, Hierarchy hierarchy, bool warm, uint32_t waves,
               float tolerance);
  void write_report(VkCommandBuffer commands, const Buffer& report, VkDeviceSize offset);
  /// After certify: writes for each face of a that some point of it is at least so far from b, and
  /// then for each what none exceeds, floats; in TRANSFER. Needs a gpu of VKH_CONTEXT_CELLS.
  void write_face_errors(VkCommandBuffer commands, const VkhSurvey& survey, uint32_t waves,
                         const Buffer& errors, VkDeviceSize offset);
  void write_survey_report(VkCommandBuffer commands, const VkhSurvey& survey, const Buffer& report);

 private:
  VkhContext context_;
  VkhMesh b_;
  VkhMemory scratch_{};
  VkhProblem problem_{};
};

}  // namespace example
