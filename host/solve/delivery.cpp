#include "host/solve/delivery.h"

#include <utility>

#include "host/base/float_environment.h"

namespace vkh {

Delivery::Delivery(std::function<void(StreamResult&&)> to)
    : to_(std::move(to)), thread_([this] { work(); }) {}

Delivery::~Delivery() {
  {
    const std::lock_guard lock(mutex_);
    is_over_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void Delivery::put(StreamResult&& result) {
  const std::lock_guard lock(mutex_);
  waiting_.push_back(std::move(result));
  changed_.notify_all();
}

void Delivery::wait() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return waiting_.empty() && !is_busy_; });
}

void Delivery::work() {
  const FloatEnvironment ours;
  std::unique_lock lock(mutex_);
  for (;;) {
    changed_.wait(lock, [&] { return !waiting_.empty() || is_over_; });
    if (waiting_.empty()) return;
    StreamResult next = std::move(waiting_.front());
    waiting_.pop_front();
    is_busy_ = true;
    lock.unlock();
    to_(std::move(next));
    lock.lock();
    is_busy_ = false;
    changed_.notify_all();
  }
}

}  // namespace vkh
