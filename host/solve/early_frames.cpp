#include "host/solve/early_frames.h"

#include "host/base/float_environment.h"
#include "host/solve/pair.h"

namespace vkh {
namespace {

// Larger meshes are written by several threads at once, and a copy of them takes memory.
constexpr size_t kMostKept = size_t{1} << 17;

void keep_small(const Mesh& mesh, StoragePlan& stored) {
  if (mesh.vertices.size() <= kMostKept) keep_vertices(mesh, stored);
}

}  // namespace

// Forgets meshes that are gone, since another may lie at their address.
std::shared_ptr<const EarlyFrames::FramedB> EarlyFrames::shared(
    const std::shared_ptr<const Mesh>& b) {
  shared_.forget_where([](const auto& one) { return one == nullptr || one->mesh.expired(); });
  return shared_.get(b.get(), [&]() -> std::shared_ptr<const FramedB> {
    try {
      check_mesh(*b);
      return std::make_shared<FramedB>(FramedB{b, frame_mesh(*b), bounding_box(*b)});
    } catch (...) {  // the worker finds the same error
      return nullptr;
    }
  });
}

std::optional<FramedPair> EarlyFrames::frame(const StreamPair& pair) {
  check_mesh(*pair.a);
  if (!pair.shares_b) {
    check_mesh(*pair.b);
    return frame_pair(*pair.a, *pair.b);
  }
  const std::shared_ptr<const FramedB> b = shared(pair.b);
  const Box box_a = bounding_box(*pair.a);
  if (b == nullptr || !serves(b->framed.frame, b->box, box_a)) return std::nullopt;
  return FramedPair{b->framed.frame, store_in(b->framed.frame, *pair.a), b->framed.stored, box_a,
                    b->box};
}

std::optional<FramedPair> EarlyFrames::of(const StreamPair& pair) {
  if (pair.a == nullptr || pair.b == nullptr || pair.before) return std::nullopt;
  const FloatEnvironment ours;
  try {
    std::optional<FramedPair> framed = frame(pair);
    if (!framed) return framed;
    keep_small(*pair.a, framed->a);
    if (!pair.shares_b) keep_small(*pair.b, framed->b);
    return framed;
  } catch (...) {
    return std::nullopt;
  }
}

}  // namespace vkh
