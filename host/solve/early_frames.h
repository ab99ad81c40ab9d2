// Checks and frames the meshes of a stream's pairs on the threads that push them, so that workers
// have their time for their device.
#pragma once

#include <memory>
#include <optional>

#include "host/base/made_once.h"
#include "vkhausdorff/frame.h"
#include "vkhausdorff/stream.h"

namespace vkh {

/// Threads may share it.
class EarlyFrames {
 public:
  /// Returns frame_pair() of the meshes, or A in the frame of a B that pairs share, as a prepared B
  /// has it; with the floats that the device will read, unless a mesh is large. Returns nothing if
  /// the worker has to do it: B's frame does not serve A, or a mesh has an error, which the worker
  /// then finds.
  std::optional<FramedPair> of(const StreamPair& pair);

 private:
  /// A mesh that pairs share, in the frame that its preparation finds.
  struct FramedB {
    std::weak_ptr<const Mesh> mesh;
    FramedMesh framed;
    Box box;
  };
  std::shared_ptr<const FramedB> shared(const std::shared_ptr<const Mesh>& b);
  std::optional<FramedPair> frame(const StreamPair& pair);

  MadeOnce<const Mesh*, std::shared_ptr<const FramedB>> shared_;
};

}  // namespace vkh
