// One device of a stream, and the workers on it: each has a solver of its own, so that one frames
// and uploads while another's submission runs.
#pragma once

#include <atomic>
#include <functional>

#include "host/solve/prepared.h"
#include "host/solve/queue.h"

namespace vkh {

/// The state that the workers of a stream share.
struct WorkerShare {
  const StreamOptions& options;
  PairQueue& queue;
  std::function<void(StreamResult&&)> deliver;
  std::function<void(double busy_s, double gpu_s)> count;
  std::atomic<bool> is_cancelled = false;
};

/// The number of pairs that a device runs at once.
struct LaneShape {
  size_t lanes = 1, together = 1;
  uint64_t bytes = 0;  ///< bytes of the device's memory, for each worker
};
LaneShape shape_for(const StreamOptions& options, const DeviceDescription& device);

/// The state that the workers of one device share. A lost device is opened again when all of them
/// have ended.
struct WorkerDevice {
  const Device* device;  ///< null: the processor alone
  PreparedMeshes prepared;
  LaneShape shape;
  std::atomic<bool> is_lost = false;
};

/// Works until nothing waits, or until the device is lost: then its pairs go back to the queue.
class Worker {
 public:
  Worker(WorkerShare& share, WorkerDevice& device, Solver& solver)
      : share_(share), device_(device), solver_(solver) {}
  void work();

 private:
  using Group = std::vector<WaitingPair>;
  bool solve(Group group);
  void solve_all(Group& group);
  bool retry_apart(Group group);
  void give_up(const WaitingPair& one);
  bool find_lost();

  WorkerShare& share_;
  WorkerDevice& device_;
  Solver& solver_;
};

}  // namespace vkh
