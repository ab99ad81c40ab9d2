#include "host/solve/queue.h"

#include <algorithm>

namespace vkh {
namespace {

// A mesh that is missing is the pair's error, once it runs.
uint64_t faces_of(const std::shared_ptr<const Mesh>& mesh) {
  return mesh == nullptr ? 0 : mesh->faces.size();
}
uint64_t faces_of(const StreamPair& pair) { return faces_of(pair.a) + faces_of(pair.b); }

// An estimate: BVH, meshes and workspace as they are recommended.
uint64_t device_bytes(const StreamPair& pair) {
  constexpr uint64_t kMostWorkspace = uint64_t{100} << 20;
  const uint64_t faces = faces_of(pair);
  return 400 * faces + std::min(4096 * faces, kMostWorkspace);
}

// A group lasts as long as its longest pair.
bool is_like(const StreamPair& x, const StreamPair& y) {
  constexpr uint64_t kMostRatio = 4;
  constexpr uint64_t kSmall = 2000;  // faces: waves of such pairs are mostly empty dispatches
  const uint64_t n = std::max(faces_of(x), kSmall), m = std::max(faces_of(y), kSmall);
  return x.symmetric == y.symmetric && n <= kMostRatio * m && m <= kMostRatio * n;
}

}  // namespace

bool PairQueue::put(WaitingPair pair) {
  std::unique_lock lock(mutex_);
  room_.wait(lock, [&] { return is_closed_ || waiting_.size() < most_; });
  if (is_closed_) return false;
  waiting_.push_back(std::move(pair));
  work_.notify_one();
  return true;
}

void PairQueue::put_back(std::vector<WaitingPair> pairs) {
  const std::lock_guard lock(mutex_);
  taken_ -= pairs.size();
  if (!is_closed_) {
    for (WaitingPair& pair : pairs) waiting_.push_front(std::move(pair));
  }
  work_.notify_all();
  done_.notify_all();
}

std::vector<WaitingPair> PairQueue::take(size_t most, uint64_t bytes) {
  std::unique_lock lock(mutex_);
  // Pairs that other threads hold may come back.
  work_.wait(lock, [&] { return !waiting_.empty() || is_closed_ || (is_ended_ && taken_ == 0); });
  std::vector<WaitingPair> group;
  if (waiting_.empty()) return group;
  group.push_back(std::move(waiting_.front()));
  waiting_.pop_front();
  const bool alone = group[0].tries > 0;
  uint64_t taken_bytes = device_bytes(group[0].pair);
  for (auto other = waiting_.begin(); !alone && group.size() < most && other != waiting_.end();) {
    const uint64_t more = device_bytes(other->pair);
    if (other->tries > 0 || taken_bytes + more > bytes || !is_like(group[0].pair, other->pair)) {
      ++other;
      continue;
    }
    taken_bytes += more;
    group.push_back(std::move(*other));
    other = waiting_.erase(other);
  }
  taken_ += group.size();
  room_.notify_all();
  return group;
}

void PairQueue::done(size_t pairs) {
  const std::lock_guard lock(mutex_);
  taken_ -= pairs;
  work_.notify_all();
  done_.notify_all();
}

void PairQueue::wait() {
  std::unique_lock lock(mutex_);
  done_.wait(lock, [&] { return taken_ == 0 && (is_closed_ || waiting_.empty()); });
}

void PairQueue::end() {
  const std::lock_guard lock(mutex_);
  is_ended_ = true;
  work_.notify_all();
}

void PairQueue::close() {
  const std::lock_guard lock(mutex_);
  is_closed_ = true;
  waiting_.clear();
  room_.notify_all();
  work_.notify_all();
  done_.notify_all();
}

bool PairQueue::is_empty() const {
  const std::lock_guard lock(mutex_);
  return waiting_.empty() && taken_ == 0;
}

}  // namespace vkh
