#include "vkhausdorff/stream.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <set>
#include <thread>

#include "host/base/float_environment.h"
#include "host/solve/delivery.h"
#include "host/solve/worker.h"
#include "vkhausdorff/error.h"

namespace vkh {
namespace {

using Clock = std::chrono::steady_clock;
double seconds_from(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// Devices are opened and destroyed one at a time, since drivers have state that devices share. None
// is destroyed while a thread ends that has used a driver: NVIDIA's (580.159.04) may then deadlock
// with the destruction of the thread's data.
std::mutex& opening() {
  static auto* mutex = new std::mutex;
  return *mutex;
}

/// Holds a device. Devices are opened and destroyed one after the other. Holds none for kNative.
class OpenDevice {
 public:
  explicit OpenDevice(const std::string& selector) {
    if (selector == kNative) return;
    const std::lock_guard lock(opening());
    device_ = std::make_unique<Device>(DeviceRequest{.selector = selector});
  }
  ~OpenDevice() {
    const std::lock_guard lock(opening());
    device_.reset();
  }
  OpenDevice(const OpenDevice&) = delete;
  OpenDevice& operator=(const OpenDevice&) = delete;
  const Device* get() const { return device_.get(); }
  std::unique_ptr<Solver> solver(const StreamOptions& options) const {
    if (device_ == nullptr) return std::make_unique<Solver>(NativeProcessor{options.threads});
    return std::make_unique<Solver>(*device_, options.cache_folder);
  }

 private:
  std::unique_ptr<Device> device_;
};

// A device that is lost this many times without an answer in between is not opened again.
constexpr int kMostReopened = 3;

}  // namespace

// Assumes GPUs, which run the most pairs: 3 workers with 16 each.
size_t StreamOptions::most_waiting() const {
  if (waiting != 0) return waiting;
  const size_t workers = lanes != 0 ? lanes : 3;
  const size_t pairs = together != 0 ? together : 16;
  return 2 * workers * pairs * devices.size();
}

struct PairStream::Impl {
  Impl(StreamOptions given, std::function<void(StreamResult&&)> to)
      : options(std::move(given)),
        delivery(std::move(to)),
        queue(options.most_waiting()),
        share{.options = options,
              .queue = queue,
              .deliver = [this](StreamResult&& result) { hand_out(std::move(result)); },
              .count = [this](double busy, double gpu) { count(busy, gpu); }} {
    if (options.devices.empty())
      throw UsageError("a stream needs a device: \"\" names the best one");
    left = unopened = options.devices.size();
    for (const std::string& selector : options.devices)
      threads.emplace_back([this, selector] { serve(selector); });
  }
  ~Impl() {
    cancel();
    join();
  }

  void hand_out(StreamResult&& result) {
    ++delivered;
    delivery.put(std::move(result));
  }
  void count(double busy, double gpu) {
    const std::lock_guard lock(mutex);
    times.lanes_s += busy;
    times.gpu_s += gpu;
  }
  void note_open(const DeviceDescription& device, bool is_first) {
    const std::lock_guard lock(mutex);
    if (is_first) --unopened;
    all_tried.notify_all();
    if (opened.empty()) times.start_s = seconds_from(start);
    const bool is_taken = std::any_of(opened.begin(), opened.end(), [&](const auto& other) {
      return other.index == device.index && other.name == device.name;
    });
    if (!is_taken) opened.push_back(device);
  }
  void claim(const DeviceDescription& device) {
    const std::lock_guard lock(mutex);
    if (!claimed.insert(device.index).second)
      throw UsageError("device " + std::to_string(device.index) + ", " + device.name +
                       ", is named more than once");
  }

  // Runs a device until nothing waits, which returns true, or until it is lost.
  bool live(const std::string& selector, bool& was_open) {
    auto open = std::make_unique<OpenDevice>(selector);
    if (!work_on(*open, was_open)) return false;
    const std::lock_guard lock(mutex);
    idle.push_back(std::move(open));
    return true;
  }

  bool work_on(const OpenDevice& open, bool& was_open) {
    std::vector<std::unique_ptr<Solver>> solvers;
    solvers.push_back(open.solver(options));
    const DeviceDescription& device = solvers[0]->description();
    if (!was_open) claim(device);
    WorkerDevice lanes{.device = open.get(),
                       .prepared = PreparedMeshes(device.memory_bytes / 8),
                       .shape = shape_for(options, device)};
    solvers[0]->make_ready(options.first);
    note_open(device, !was_open);
    was_open = true;
    const auto run = [&](Solver& solver) {
      const FloatEnvironment ours;
      Worker(share, lanes, solver).work();
    };
    std::vector<std::thread> others;
    try {
      for (size_t i = 1; i < lanes.shape.lanes; ++i) {
        solvers.push_back(std::make_unique<Solver>(Solver::SharesPipelines{}, *solvers[0]));
        others.emplace_back([&, solver = solvers.back().get()] { run(*solver); });
      }
    } catch (...) {  // goes on with fewer workers
    }
    run(*solvers[0]);
    for (std::thread& thread : others) thread.join();
    return !lanes.is_lost;
  }

  // A device that was asked for and is not available ends the stream; one that is lost later leaves
  // the rest to the others.
  void serve(const std::string& selector) {
    const FloatEnvironment ours;
    size_t before = 0;
    int lives = 0;
    bool was_open = false;
    try {
      while (!live(selector, was_open)) {
        lives = delivered > before ? 1 : lives + 1;
        before = delivered;
        if (lives > kMostReopened) throw DeviceError("the device was lost again and again");
      }
      leave(nullptr, false);
    } catch (...) {
      leave(std::current_exception(), !was_open);
    }
  }
  void leave(const std::exception_ptr& why, bool ends_all) {
    const std::lock_guard lock(mutex);
    if (why && !error) error = why;
    if (ends_all) --unopened;
    all_tried.notify_all();
    if (--left > 0 && !ends_all) return;
    if (!ends_all && queue.is_empty() && why == nullptr) return;
    is_dead = true;
    share.is_cancelled = true;
    queue.close();
  }

  void cancel() {
    share.is_cancelled = true;
    queue.close();
  }
  void join() {
    for (std::thread& thread : threads) {
      if (thread.joinable()) thread.join();
    }
    idle.clear();
  }
  void wait_for_devices() {
    std::unique_lock lock(mutex);
    all_tried.wait(lock, [&] { return unopened == 0; });
  }
  void check_alive() {
    const std::lock_guard lock(mutex);
    if (is_dead && error) std::rethrow_exception(error);
    if (is_dead) throw DeviceError("no device is left");
  }

  const Clock::time_point start = Clock::now();
  const StreamOptions options;
  Delivery delivery;
  PairQueue queue;
  WorkerShare share;
  std::atomic<size_t> delivered = 0;
  mutable std::mutex mutex;
  std::exception_ptr error;
  bool is_dead = false;
  size_t left = 0, unopened = 0;
  std::condition_variable all_tried;
  std::set<uint32_t> claimed;
  std::vector<DeviceDescription> opened;
  StreamTimes times;
  std::vector<std::unique_ptr<OpenDevice>> idle;  // devices that have nothing left to do
  std::vector<std::thread> threads;
};

PairStream::PairStream(StreamOptions options, std::function<void(StreamResult&&)> deliver)
    : impl_(std::make_unique<Impl>(std::move(options), std::move(deliver))) {}
PairStream::~PairStream() = default;

bool PairStream::push(StreamPair pair) {
  if (impl_->queue.put({.pair = std::move(pair)})) return true;
  impl_->check_alive();
  return false;
}

void PairStream::wait_until_open() { impl_->wait_for_devices(); }

// Devices are destroyed later: delivered results need not wait for that.
void PairStream::finish() {
  impl_->queue.end();
  impl_->queue.wait();
  impl_->delivery.wait();
  impl_->wait_for_devices();
  impl_->check_alive();
}

void PairStream::check() const { impl_->check_alive(); }

void PairStream::cancel() { impl_->cancel(); }

std::vector<DeviceDescription> PairStream::devices() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->opened;
}

StreamTimes PairStream::times() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->times;
}

}  // namespace vkh
