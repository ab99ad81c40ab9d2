#include "host/solve/prepared.h"

#include <algorithm>

#include "vkhausdorff/error.h"

namespace vkh {
namespace {

// A BVH takes 200 to 258 bytes a face; a small one takes the least bytes of an allocation.
uint64_t device_bytes(const Mesh& b) {
  return std::max<uint64_t>(260 * b.faces.size(), uint64_t{1} << 20);
}

// Each mesh takes one allocation or more, and some drivers allow 4096 in all.
constexpr size_t kMost = 256;

}  // namespace

void PreparedMeshes::drop_until(uint64_t bytes) {
  uint64_t taken = 0;
  for (const Kept& kept : kept_) taken += device_bytes(*kept.mesh);
  while (!kept_.empty() && (taken > bytes || kept_.size() >= kMost)) {
    taken -= device_bytes(*kept_.front().mesh);
    kept_.erase(kept_.begin());
  }
}

std::shared_ptr<const PreparedMesh> PreparedMeshes::get(Solver& solver,
                                                        const std::shared_ptr<const Mesh>& b) {
  const std::lock_guard lock(mutex_);
  const auto found =
      std::find_if(kept_.begin(), kept_.end(), [&](const Kept& kept) { return kept.mesh == b; });
  if (found != kept_.end()) {
    std::rotate(found, found + 1, kept_.end());
    return kept_.back().prepared;
  }
  const uint64_t bytes = device_bytes(*b);
  drop_until(most_bytes_ - std::min(bytes, most_bytes_));
  for (const bool again : {false, true}) {
    try {
      kept_.push_back({b, std::make_shared<const PreparedMesh>(solver.prepare(*b))});
      return kept_.back().prepared;
    } catch (const MemoryError&) {
      if (again || kept_.empty()) break;
      kept_.clear();
    }
  }
  return nullptr;
}

}  // namespace vkh
