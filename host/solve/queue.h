// The pairs of a stream that wait for a device.
#pragma once

#include <condition_variable>
#include <deque>
#include <mutex>
#include <vector>

#include "vkhausdorff/stream.h"

namespace vkh {

/// A pair, and how many devices were lost while they ran it.
struct WaitingPair {
  StreamPair pair;
  unsigned tries = 0;
};

class PairQueue {
 public:
  explicit PairQueue(size_t most) : most_(most) {}

  /// Waits while `most` pairs wait. Returns false if the queue is closed to all.
  bool put(WaitingPair pair);
  /// Puts back, without waiting, the pairs that a lost device had.
  void put_back(std::vector<WaitingPair> pairs);

  /// Takes the oldest pair, and with it others of like size: at most `most`, which take at most
  /// `bytes` of a device. Waits for a pair; returns none if there will be none any more. A caller
  /// that took pairs calls done().
  std::vector<WaitingPair> take(size_t most, uint64_t bytes);
  void done(size_t pairs);

  /// Waits until all that was put is done, or, once the queue is closed, all that was taken.
  void wait();

  void end();             ///< no more will be put
  void close();           ///< drops what waits; nothing is taken any more
  bool is_empty() const;  ///< whether all that was put is done

 private:
  mutable std::mutex mutex_;
  std::condition_variable room_, work_, done_;
  std::deque<WaitingPair> waiting_;
  size_t most_, taken_ = 0;
  bool is_ended_ = false, is_closed_ = false;
};

}  // namespace vkh
