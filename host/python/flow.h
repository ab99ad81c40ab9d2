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
#include "vkhausdorff/answer.h"
#include "vkhausdorff/question.h"
#include "vkhausdorff/stream.h"

namespace vkh::python {

/// The question about every pair, and its devices.
struct FlowQuestion {
  Question question;  ///< its `limits` are for files
  KeptMesh against;   ///< the B of all; null: each has its own
  StreamOptions devices;
  size_t ahead = 0;  ///< most pairs that are put and not taken; 0: twice what devices hold

  /// Replaces an `ahead` of 0.
  FlowQuestion with_ahead() &&;
};

struct FlowPair {
  size_t number = 0;
  MeshGiven a, b;  ///< empty `b` if all have the same
};

/// The answer of a pair, or the exception that it ended with.
struct FlowResult {
  size_t number = 0;
  Answer answer = {};
  MeshPointer a = nullptr, b = nullptr;  ///< as they were measured, where a field is asked for
  std::exception_ptr error = nullptr;
};

class Flow {
 public:
  /// Opens devices in threads.
  explicit Flow(FlowQuestion asked);
  ~Flow();
  Flow(const Flow&) = delete;
  Flow& operator=(const Flow&) = delete;

  /// Returns whether one more may be put: fewer than `ahead` are there, and their meshes are not
  /// above kMostBytes.
  bool has_room() const;
  /// Does not wait: threads of the flow read the pair, clean it and pass it on.
  void put(FlowPair pair);
  /// Takes a result, in the order in which pairs end; `number` is the pair's.
  std::optional<FlowResult> take();
  /// Does the same, but waits for a result; nothing when no pair that was put is left, or end()
  /// came. Called within a WithoutGil. Throws DeviceError if no device is left, and what ask()
  /// throws.
  std::optional<FlowResult> wait();

  /// Drops what waits, cancels what runs, and returns when no thread and no device is left. Never
  /// takes the GIL.
  void end();
  /// Ends every flow at the end of the interpreter.
  static void end_all();

  static constexpr uint64_t kMostBytes = uint64_t{2} << 30;

 private:
  void add_thread();
  void work();
  void solve(FlowPair pair);
  /// A pair on its way through a device.
  struct Running {
    MeshPointer a, b;
    Answer answer = {};
  };
  void take(Running& running) const;
  void fit(Solver& solver, const PreparedMesh* b, Running& running, StreamPair& pair);
  void push(size_t number, const std::shared_ptr<Running>& running);
  void take_result(StreamResult&& result);
  void deliver(FlowResult&& result);
  bool is_over() const;
  std::optional<FlowResult> next_result();

  FlowQuestion asked_;
  mutable std::mutex mutex_;
  std::condition_variable jobs_changed_, results_changed_;
  std::deque<FlowPair> jobs_;
  std::deque<FlowResult> results_;
  std::map<size_t, std::shared_ptr<Running>> running_;
  std::map<size_t, uint64_t> bytes_;  // for pairs that are put and not taken
  uint64_t bytes_sum_ = 0;
  size_t idle_ = 0;
  bool is_ended_ = false;
  std::mutex ending_;
  std::vector<std::thread> threads_;
  std::optional<PairStream> stream_;
};

}  // namespace vkh::python
