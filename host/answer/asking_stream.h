// Many pairs on their way from questions to answers: read ahead by all cores, solved side by side
// on every device, handed out as they end.
#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <exception>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "host/answer/asked_pair.h"
#include "host/solve/byte_budget.h"
#include "vkhausdorff/stream.h"

namespace vkh {

/// A pair of a stream. Its functions are called one after the other, on threads of the stream; what
/// they throw is the pair's error, and Interrupted ends the stream.
class StreamedPair {
 public:
  virtual ~StreamedPair() = default;

  /// The first step, which reads no mesh. Returns the bytes of memory that both meshes take, about;
  /// nothing if the pair is not wanted: then no other function of it is called.
  virtual std::optional<uint64_t> look() { return 0; }
  /// Makes `pair`, unless look() did, and gives it its meshes.
  virtual void read() = 0;
  /// Whether other pairs have the same object as B.
  virtual bool shares_b() const = 0;
  /// Whether there is more to do on the device once the pair is solved: finish().
  virtual bool has_more() const = 0;
  /// Finishes a copy of `pair` that has its reports.
  virtual void finish(AskedPair& solved, Solver& solver) = 0;

  std::unique_ptr<AskedPair> pair;  ///< at the end it has its answer, which may be cancelled
  std::exception_ptr error;         ///< set by the stream, where the pair has no answer
};

class AskingStream {
 public:
  using Deadline = std::chrono::steady_clock::time_point;
  using Deliver = std::function<void(std::unique_ptr<StreamedPair>)>;
  static constexpr uint64_t kReadAhead = uint64_t{2} << 30;

  /// Opens devices in threads of its own. `read_ahead`: the most bytes of meshes that are read and
  /// whose pairs have not ended; 0: kReadAhead. `deliver` is called by one thread at a time, and
  /// must not throw; if it is empty, take() returns the results.
  explicit AskingStream(StreamOptions devices, uint64_t read_ahead = 0, Deliver deliver = {});
  /// Cancels what is left, and waits for what runs.
  ~AskingStream();
  AskingStream(const AskingStream&) = delete;
  AskingStream& operator=(const AskingStream&) = delete;

  /// Adds a pair, without waiting: threads of the stream look at pairs and read them in the order
  /// in which they were put.
  void put(std::unique_ptr<StreamedPair> one);
  /// Waits until all pairs have ended. No more may be put. Throws DeviceError if no device is left.
  void finish();
  /// Drops what waits, and ends what runs with true intervals. Does not wait. Any thread may call
  /// it.
  void cancel();
  bool is_cancelled() const;
  /// Throws DeviceError if no device is left. Does not wait.
  void check() const { stream_->check(); }

  /// Returns a pair that has ended, in the order in which pairs end; null if none has.
  std::unique_ptr<StreamedPair> take();
  /// Waits until the deadline for a pair to end. Returns true if one has, or if no more are
  /// expected.
  bool wait(Deadline deadline);

  double read_s() const;  ///< the seconds that its threads spent on looking and reading, in all
  StreamTimes times() const { return stream_->times(); }
  std::vector<DeviceDescription> devices() const { return stream_->devices(); }

 private:
  /// A pair in the devices' stream.
  struct Running {
    std::unique_ptr<StreamedPair> it;
    uint64_t bytes = 0;
  };

  void add_thread();
  void work();
  void timed(const std::function<void()>& step);
  void bring(std::unique_ptr<StreamedPair> one, uint64_t ticket);
  void forget();
  void push(Running running);
  void take_result(StreamResult&& result);
  void hand_out(Running running);

  ByteBudget budget_;
  const Deliver deliver_;
  mutable std::mutex mutex_;
  std::condition_variable jobs_changed_, results_changed_;
  std::deque<std::unique_ptr<StreamedPair>> jobs_, results_;
  std::map<size_t, Running> running_;
  size_t idle_ = 0, open_ = 0, last_number_ = 0;  // open_: put, and not handed out
  bool is_whole_ = false, is_cancelled_ = false;
  double read_s_ = 0;
  std::mutex delivering_;
  std::vector<std::thread> threads_;
  std::unique_ptr<PairStream> stream_;  // destroyed before the members that it delivers to
};

}  // namespace vkh
