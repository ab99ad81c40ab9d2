// The triangles of a mesh that are closest to points, in doubles.
#pragma once

#include <memory>

#include "shaders/gpu_types.h"
#include "vkhausdorff/frame.h"
#include "vkhausdorff/mesh.h"

namespace vkh::native {

class FaceTree;

/// A mesh in a frame. Threads may share it.
class PlacedMesh {
 public:
  PlacedMesh(const Mesh& b, const Frame& frame);
  ~PlacedMesh();

  /// How far its farthest vertex may be from its exact place, in the frame.
  double displacement() const { return displacement_; }
  /// The face that is closest to a point of the frame, and a lower bound of its distance, both in
  /// the form of the device's search; `upper_above` is unused.
  gpu::ClosestFace closest(const gpu::Vertex& point) const;

 private:
  double displacement_ = 0;
  std::unique_ptr<const FaceTree> tree_;
};

}  // namespace vkh::native
