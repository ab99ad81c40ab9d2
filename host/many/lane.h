// One device of a stream, and the lanes on it: each a solver of its own, so that one frames and
// uploads while another's submission runs.
#pragma once

#include <atomic>
#include <functional>

#include "host/many/prepared.h"
#include "host/many/queue.h"

namespace vkh {

/// What the lanes of a stream share.
struct LaneShare {
  const StreamOptions& options;
  PairQueue& queue;
  std::function<void(StreamResult&&)> deliver;
  std::function<void(double busy_s, double gpu_s)> count;
  std::atomic<bool> is_cancelled = false;
};

/// How many pairs a device runs at once.
struct LaneShape {
  size_t lanes = 1, together = 1;
  uint64_t bytes = 0;  ///< of the device's memory, for each lane
};
LaneShape shape_for(const StreamOptions& options, const DeviceDescription& device);

/// A lane's work until nothing waits, or the device is lost: then what it had is back in the queue,
/// and it returns false.
class Lane {
 public:
  Lane(LaneShare& share, const Device& device, Solver& solver, PreparedMeshes& prepared,
       const LaneShape& shape)
      : share_(share), device_(device), solver_(solver), prepared_(prepared), shape_(shape) {}
  bool work();

 private:
  using Group = std::vector<WaitingPair>;
  bool solve(Group group);
  void solve_all(const Group& group);
  bool retry_apart(Group group);
  void give_up(const WaitingPair& one);
  bool is_lost() const;

  LaneShare& share_;
  const Device& device_;
  Solver& solver_;
  PreparedMeshes& prepared_;
  LaneShape shape_;
};

}  // namespace vkh
