// Pairs on their way from Python through devices, and back: all that runs on threads of ours.
// Nothing here touches Python, but for wait(), which asks it about signals.
#pragma once

#include <condition_variable>
#include <deque>
#include <map>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "host/python/mesh.h"
#include "host/python/options.h"
#include "host/solve/stream.h"

namespace vkh::python {

/// What is asked of every pair, and where.
struct FlowAsked {
  SolveOptions options;
  std::optional<MaxAsked> max;
  bool symmetric = false;
  ReadLimits limits;    ///< of files
  MeshPointer against;  ///< the B of all; null: each has its own
  StreamOptions devices;
  size_t ahead = 0;  ///< pairs that are put and not taken, at most; 0: twice what devices hold
};

struct FlowPair {
  size_t number = 0;
  MeshGiven a, b;  ///< no `b` where all have the same
};

class Flow {
 public:
  /// Devices are opened by threads.
  explicit Flow(FlowAsked asked);
  ~Flow();
  Flow(const Flow&) = delete;
  Flow& operator=(const Flow&) = delete;

  /// Whether one more may be put: fewer than `ahead` are there, and their meshes are not above
  /// kMostBytes.
  bool has_room() const;
  /// Waits for nobody: threads of the flow read it, clean it and pass it on.
  void put(FlowPair pair);
  /// What ended, in the order in which pairs end; `number` is the pair's.
  std::optional<StreamResult> take();
  /// Likewise, and waits for one; nothing when nothing is left of what was put, or end() came.
  /// Within a WithoutGil. Throws DeviceError where no device is left, and what ask() throws.
  std::optional<StreamResult> wait();

  /// Drops what waits, cancels what runs, and returns when no thread and no device is left. Never
  /// takes the GIL.
  void end();
  /// For the end of the interpreter: end() of every flow.
  static void end_all();

  static constexpr uint64_t kMostBytes = uint64_t{2} << 30;

 private:
  static size_t default_ahead(const StreamOptions& devices);
  void add_thread();
  void work();
  void solve(FlowPair pair);
  void deliver(StreamResult&& result);
  std::optional<StreamResult> next_result();

  FlowAsked asked_;
  mutable std::mutex mutex_;
  std::condition_variable jobs_changed_, results_changed_;
  std::deque<FlowPair> jobs_;
  std::deque<StreamResult> results_;
  std::map<size_t, uint64_t> bytes_;  // of pairs that are put and not taken
  uint64_t bytes_sum_ = 0;
  size_t idle_ = 0;
  bool is_ended_ = false;
  std::mutex ending_;
  std::vector<std::thread> threads_;
  std::optional<PairStream> stream_;
};

}  // namespace vkh::python
