// The results of pairs on their way to the caller.
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>

#include "vkhausdorff/stream.h"

namespace vkh {

/// Hands results out one at a time, on a thread of its own: writing sixteen took a worker of an
/// H100 2.3 ms, beside 5.8 for the device's work on them (docs/log/measurements.md, batches).
class Delivery {
 public:
  explicit Delivery(std::function<void(StreamResult&&)> to);
  /// Waits as wait() does.
  ~Delivery();
  Delivery(const Delivery&) = delete;
  Delivery& operator=(const Delivery&) = delete;

  void put(StreamResult&& result);
  /// Waits until every result that was put is handed out.
  void wait();

 private:
  void work();

  const std::function<void(StreamResult&&)> to_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<StreamResult> waiting_;
  bool is_busy_ = false, is_over_ = false;
  std::thread thread_;
};

}  // namespace vkh
