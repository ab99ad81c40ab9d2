// Pairs of meshes as a stream: pushed one by one, solved several at a time on every device that it
// is given, delivered as they end.
#pragma once

#include <cstdint>
#include <exception>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "host/solve/solver.h"

namespace vkh {

/// What came of a pair.
struct StreamResult {
  size_t number = 0;
  Report a_to_b;
  std::optional<Report> b_to_a;  ///< there for a symmetric pair
  std::exception_ptr error;      ///< instead: what Solver threw
};

/// A pair, and what is asked about it.
struct StreamPair {
  size_t number = 0;  ///< the caller's own
  std::shared_ptr<const Mesh> a, b;
  /// Other pairs have the same `b`, the very object: it is prepared once on each device. Answers
  /// are those of Solver::distance(a, prepared b), so let the pairs alone decide, not their order.
  bool shares_b = false;
  bool symmetric = false;
  SolveOptions options;  ///< `progress` is asked on the threads that run
  /// Called after the pair's own run, with the solver that ran it, before it is delivered: for
  /// surveys and certificates. What it throws is the pair's error.
  std::function<void(Solver&, StreamResult&)> beside = {};
};

struct StreamOptions {
  /// DeviceRequest::selector of each; see host/answer/session.h.
  std::vector<std::string> devices = {""};
  std::filesystem::path cache_folder;  ///< see Solver
  SolveOptions first;                  ///< whose pipelines are made while the first pairs are read
  size_t together = 0;  ///< pairs side by side in one submission; 0: what pays on the device
  size_t lanes = 0;     ///< submissions side by side on a device; 0: likewise
  size_t waiting = 0;   ///< pairs that wait for a device at most; 0: twice what devices hold
};

/// What devices were busy with, in seconds of all of them.
struct StreamTimes {
  double start_s = 0;  ///< until the first device was ready
  double lanes_s = 0;  ///< lanes with pairs, each for itself
  double gpu_s = 0;    ///< timestamps around what they submitted; 0 where a queue has none
};

class PairStream {
 public:
  /// Devices are opened by threads of its own: what keeps one from it is thrown by push() or
  /// finish(). `deliver` is called on one thread, not the caller's, once for each pair that was
  /// pushed, unless cancel() came first; it must not throw.
  PairStream(StreamOptions options, std::function<void(StreamResult&&)> deliver);
  /// Cancels what is left and waits for what runs.
  ~PairStream();
  PairStream(const PairStream&) = delete;
  PairStream& operator=(const PairStream&) = delete;

  /// Waits while too many pairs wait. Any thread. False: the stream was cancelled, and the pair is
  /// dropped. Throws DeviceError when no device is left: then pairs were dropped, and finish() says
  /// so, too.
  bool push(StreamPair pair);
  /// Waits until all that was pushed is delivered. A device that is lost gives its pairs to the
  /// others, and is opened anew. Throws DeviceError when none was left.
  void finish();
  /// Throws DeviceError when no device is left, as finish() does: pairs that were pushed may have
  /// been dropped. Any thread, without waiting.
  void check() const;
  /// Pairs that wait are dropped; those that run end with a true interval, as Status::kCancelled,
  /// and are delivered.
  void cancel();

  std::vector<DeviceDescription> devices() const;  ///< that were opened
  StreamTimes times() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace vkh
