// The prepared B meshes of one device, which pairs share.
#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "vkhausdorff/solver.h"

namespace vkh {

class PreparedMeshes {
 public:
  /// `bytes`: about how much of the device's memory BVHs without a user may take.
  explicit PreparedMeshes(uint64_t bytes) : most_bytes_(bytes) {}

  /// Returns B, prepared now unless it was. Threads that ask meanwhile wait. Null: the device has
  /// no room.
  std::shared_ptr<const PreparedMesh> get(Solver& solver, const std::shared_ptr<const Mesh>& b);

 private:
  struct Kept {
    std::shared_ptr<const Mesh> mesh;
    std::shared_ptr<const PreparedMesh> prepared;
  };
  void drop_until(uint64_t bytes);

  uint64_t most_bytes_;
  std::mutex mutex_;
  std::vector<Kept> kept_;  // the last one used is at the end
};

}  // namespace vkh
