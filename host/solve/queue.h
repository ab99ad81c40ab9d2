// The pairs of a stream that wait for a device.
#pragma once

#include <condition_variable>
#include <deque>
#include <mutex>
#include <vector>

#include "host/solve/stream.h"

namespace vkh {

/// How often a pair was on a device that was lost meanwhile, besides.
struct WaitingPair {
  StreamPair pair;
  unsigned tries = 0;
};

class PairQueue {
 public:
  explicit PairQueue(size_t most) : most_(most) {}

  /// Waits while `most` pairs wait. False: it is closed to all.
  bool put(StreamPair pair);
  /// Without waiting: what a lost device had.
  void put_back(std::vector<WaitingPair> pairs);

  /// The oldest, and with it others of like size: at most `most`, which take at most `bytes` of a
  /// device. Waits for one; empty: there are none, nor will there be. Who takes some says done().
  std::vector<WaitingPair> take(size_t most, uint64_t bytes);
  void done(size_t pairs);

  /// Waits until all that was put is done, or, once it is closed, what was taken.
  void wait();

  void end();             ///< no more will be put
  void close();           ///< what waits is dropped; nothing is taken any more
  bool is_empty() const;  ///< all that was put is done

 private:
  mutable std::mutex mutex_;
  std::condition_variable room_, work_, done_;
  std::deque<WaitingPair> waiting_;
  size_t most_, taken_ = 0;
  bool is_ended_ = false, is_closed_ = false;
};

}  // namespace vkh
