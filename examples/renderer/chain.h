// A mesh that does not move, and its levels of detail from `vkhausdorff simplify --levels`: how far
// each is from the mesh was proven once, so that a frame only compares.
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

#include "examples/renderer/renderer.h"

namespace example {

struct ChainLevel {
  std::vector<glm::vec3> points;
  std::vector<uint32_t> corners;  ///< three for each face
  float error = 0;                ///< no point of it or of the mesh is farther from the other
};

/// Reads what `simplify A.obj --levels N --out LOD.obj --json=FILE` wrote, the mesh first. Paths
/// are of the folder of `file`, or absolute. The mesh is moved into a sphere of radius 1 around the
/// origin, levels and errors with it. Throws std::runtime_error.
std::vector<ChainLevel> read_chain(const std::string& file);

/// The coarsest level whose error is under `pixel`; the mesh itself is level 0.
uint32_t coarsest_under(std::span<const ChainLevel> chain, float pixel);

struct ChainFrame {
  const uint8_t* rgba;  ///< until the next frame
  uint32_t drawn, faces;
  float error, pixel;  ///< of the level, and the size of a pixel at the nearest part
};

class ChainRenderer {
 public:
  ChainRenderer(const RendererOptions& options, std::vector<ChainLevel> chain);

  /// `camera` is its distance, more than 1.
  ChainFrame frame(float angle, float camera);
  Gpu& gpu() { return gpu_; }

 private:
  void upload();

  Gpu gpu_;
  Target target_;
  std::vector<ChainLevel> chain_;
  Buffer vertices_, levels_, choice_, indices_;
  VkPipeline mesh_;
};

}  // namespace example
