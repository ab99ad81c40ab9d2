// A stream of pairs of meshes: pushed one by one, solved several at a time on every device that it
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

#include "vkhausdorff/solver.h"

namespace vkh {

/// The result of a pair.
struct StreamResult {
  size_t number = 0;
  Report a_to_b;
  std::optional<Report> b_to_a;  ///< present for a symmetric pair
  std::exception_ptr error;      ///< the exception that Solver threw, instead
};

/// A pair, and how its distance is to be found.
struct StreamPair {
  size_t number = 0;                 ///< the caller's own
  std::shared_ptr<const Mesh> a, b;  ///< null for either: the pair's error
  /// Other pairs have the same object as `b`: it is prepared once on each device. Answers
  /// are those of Solver::distance(a, prepared b), so set this by the pairs alone, not by their
  /// order.
  bool shares_b = false;
  bool symmetric = false;
  SolveOptions
      options;  ///< `progress` is called on the threads that run; Progress::pair is then `number`
  /// Called before the pair's run, once, with the solver that will run it and the prepared `b`, or
  /// null unless pairs share it: it may change `a`, `options` and `beside`. An exception from it is
  /// the pair's error.
  std::function<void(Solver&, const PreparedMesh*, StreamPair&)> before = {};
  /// Called after the pair's own run, with the solver that ran it, before it is delivered: for
  /// surveys and certificates. An exception from it is the pair's error.
  std::function<void(Solver&, StreamResult&)> beside = {};
};

struct StreamOptions {
  /// The DeviceRequest::selector of each, which names one device; at least one. A device that takes
  /// long to start gets no pairs until it has: see wait_until_open(). kNative: the processor.
  std::vector<std::string> devices = {""};
  size_t threads = 0;                  ///< NativeProcessor::threads
  std::filesystem::path cache_folder;  ///< see Solver
  EngineOptions first;                 ///< its pipelines are made while the first pairs are read
  size_t together = 0;   ///< pairs side by side in one submission; 0: what pays on the device
  size_t lanes = 0;      ///< submissions side by side on a device; 0: what pays on it
  bool surveys = false;  ///< most pairs have a survey in `beside`, which is mostly the host's work
  size_t waiting = 0;    ///< most pairs that wait for a device; 0: twice what devices hold

  /// Returns `waiting`, or its default.
  size_t most_waiting() const;
};

/// The time that devices were busy, in seconds over all of them.
struct StreamTimes {
  double start_s = 0;  ///< until the first device was ready
  double lanes_s = 0;  ///< workers with pairs, each counted by itself
  double gpu_s = 0;    ///< timestamps around what they submitted; 0 where a queue has none
};

class PairStream {
 public:
  /// Opens devices in threads of its own: an error that prevents this is thrown by push() or
  /// finish(). Throws UsageError where `options` name no device. `deliver` is called on one thread,
  /// not the caller's, once for each pair that was pushed, unless cancel() came first; it must not
  /// throw.
  PairStream(StreamOptions options, std::function<void(StreamResult&&)> deliver);
  /// Cancels what is left and waits for what runs.
  ~PairStream();
  PairStream(const PairStream&) = delete;
  PairStream& operator=(const PairStream&) = delete;

  /// Waits while too many pairs wait. Any thread may call it. False: the stream was cancelled, and
  /// the pair is dropped. Throws DeviceError when no device is left: then pairs were dropped, and
  /// finish() throws, too.
  bool push(StreamPair pair);
  /// Waits until every device was opened, or could not be: before that, pairs go to the first ones.
  void wait_until_open();
  /// Waits until all pushed pairs are delivered, and every device was tried. The pairs of a lost
  /// device go to the others, and the device is opened again. Throws DeviceError if no device was
  /// left.
  void finish();
  /// Throws DeviceError when no device is left, as finish() does: pairs that were pushed may have
  /// been dropped. Any thread may call it, without waiting.
  void check() const;
  /// Drops the pairs that wait. Pairs that run end with a true interval, as Status::kCancelled, and
  /// are delivered.
  void cancel();

  std::vector<DeviceDescription> devices() const;  ///< the opened ones
  StreamTimes times() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace vkh
