#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <exception>
#include <future>
#include <mutex>
#include <optional>
#include <vector>

#include "host/base/parallel.h"
#include "host/solve/closest_search.h"
#include "vkhausdorff/error.h"
#include "vkhausdorff/together.h"

namespace vkh {
namespace {

// About how many shares of the points each device gets, so that no device waits long for the last
// one. A share is at least the search's first batch, and at most its largest.
constexpr size_t kSharesOfDevice = 8;
constexpr size_t kSmallestShare = size_t{1} << 12;
constexpr size_t kLargestShare = size_t{1} << 20;

struct PointShare {
  size_t begin, count;
};

/// A device: B on it, and how far it is with its share.
struct ClosestDevice {
  Solver* solver;
  const PreparedMesh* b;  ///< null until it is prepared here
  std::optional<PreparedMesh> own = {};
  size_t done = 0;  ///< points of the share
  bool is_lost = false;
};

class ClosestTogether {
 public:
  ClosestTogether(std::vector<ClosestDevice> devices, const Mesh& b, std::span<const DVec3> points)
      : devices_(std::move(devices)), b_(b), points_(points) {
    const size_t count = points.size();
    const size_t size =
        std::clamp(count / (kSharesOfDevice * devices_.size()), kSmallestShare, kLargestShare);
    for (size_t begin = 0; begin < count; begin += size)
      waiting_.push_back({begin, std::min(size, count - begin)});
    found_ = {std::vector<double>(count), std::vector<double>(count), std::vector<DVec3>(count),
              std::vector<uint32_t>(count)};
  }

  /// Searches on other threads, since the caller's has to hear `goes_on`: a signal's handler may
  /// run on no other. Where there is no thread, the search runs here, and hears nothing.
  ClosestPoints run(const ClosestGoesOn& goes_on) {
    auto searching =
        std::async(std::launch::async | std::launch::deferred, [this] { search_and_report(); });
    const bool is_here =
        searching.wait_for(std::chrono::seconds(0)) == std::future_status::deferred;
    try {
      if (goes_on && !is_here) listen(goes_on);
    } catch (...) {
      call_off();
      searching.wait();
      throw;
    }
    searching.get();
    if (is_called_off_) throw Interrupted("the search for closest points was called off");
    return std::move(found_);
  }

 private:
  /// Asks the caller whenever points are done, until the search is over.
  void listen(const ClosestGoesOn& goes_on) {
    std::unique_lock lock(mutex_);
    size_t heard = 0;
    while (true) {
      changed_.wait(lock, [&] { return is_over_ || done() != heard; });
      if (is_over_) return;
      heard = done();
      lock.unlock();
      if (!goes_on(heard)) call_off();
      lock.lock();
    }
  }

  void call_off() {
    const std::lock_guard lock(mutex_);
    is_called_off_ = true;
  }

  void search_and_report() {
    const auto report = [this] {
      const std::lock_guard lock(mutex_);
      is_over_ = true;
      changed_.notify_all();
    };
    try {
      search();
    } catch (...) {
      report();
      throw;
    }
    report();
  }

  /// Runs all devices; once more where one that was lost has left points when others had ended.
  void search() {
    while (has_more()) {
      for_each_index(
          devices_.size(), [this](size_t i) { work(devices_[i]); }, devices_.size());
    }
  }

  /// Throws where points wait and no device is left.
  bool has_more() const {
    const std::lock_guard lock(mutex_);
    if (waiting_.empty() || is_called_off_) return false;
    if (std::all_of(devices_.begin(), devices_.end(), [](auto& one) { return one.is_lost; }))
      std::rethrow_exception(loss_);
    return true;
  }

  /// Runs one device: share after share.
  void work(ClosestDevice& device) {
    while (const std::optional<PointShare> share = next(device)) {
      try {
        find(device, *share);
      } catch (const DeviceError&) {
        give_back(device, *share);
      } catch (const Interrupted&) {
        return;  // run() throws it
      } catch (...) {
        call_off();
        throw;
      }
    }
  }

  std::optional<PointShare> next(const ClosestDevice& device) {
    const std::lock_guard lock(mutex_);
    if (device.is_lost || is_called_off_ || waiting_.empty()) return std::nullopt;
    const PointShare share = waiting_.front();
    waiting_.pop_front();
    return share;
  }

  void find(ClosestDevice& device, const PointShare& share) {
    if (device.b == nullptr) device.b = &device.own.emplace(device.solver->prepare(b_));
    const ClosestPoints some =
        device.solver->closest(*device.b, points_.subspan(share.begin, share.count),
                               [&](size_t count) { return advance(device, count); });
    const auto put = [&](const auto& from, auto& to) {
      std::copy(from.begin(), from.end(), to.begin() + static_cast<ptrdiff_t>(share.begin));
    };
    put(some.lower, found_.lower);
    put(some.upper, found_.upper);
    put(some.points, found_.points);
    put(some.faces, found_.faces);
    const std::lock_guard lock(mutex_);
    finished_ += share.count;
    device.done = 0;
    changed_.notify_all();
  }

  bool advance(ClosestDevice& device, size_t count) {
    const std::lock_guard lock(mutex_);
    device.done = count;
    changed_.notify_all();
    return !is_called_off_;
  }

  void give_back(ClosestDevice& device, const PointShare& share) {
    const std::lock_guard lock(mutex_);
    device.is_lost = true;
    device.done = 0;
    loss_ = std::current_exception();
    waiting_.push_front(share);
  }

  size_t done() const {
    size_t count = finished_;
    for (const ClosestDevice& device : devices_) count += device.done;
    return count;
  }

  std::vector<ClosestDevice> devices_;
  const Mesh& b_;
  std::span<const DVec3> points_;
  ClosestPoints found_;  // rows of a share belong to its device's thread

  mutable std::mutex mutex_;  // guards what follows, and the devices' counts
  std::condition_variable changed_;
  std::deque<PointShare> waiting_;
  size_t finished_ = 0;
  std::exception_ptr loss_;
  bool is_called_off_ = false, is_over_ = false;
};

}  // namespace

ClosestPoints closest_over(std::span<Solver* const> solvers, const Mesh& b,
                           std::span<const DVec3> points, const ClosestGoesOn& goes_on) {
  if (solvers.empty()) throw UsageError("no device was given");
  if (solvers.size() == 1) return solvers[0]->closest(b, points, goes_on);
  check_mesh(b);
  check_points(points);
  std::vector<ClosestDevice> devices;
  for (Solver* solver : solvers) devices.push_back({.solver = solver, .b = nullptr});
  return ClosestTogether(std::move(devices), b, points).run(goes_on);
}

ClosestPoints closest_over(std::span<Solver* const> solvers,
                           std::span<const PreparedMesh* const> prepared,
                           std::span<const DVec3> points, const ClosestGoesOn& goes_on) {
  if (solvers.empty() || prepared.size() != solvers.size())
    throw UsageError("expected one prepared mesh for each device");
  if (solvers.size() == 1) return solvers[0]->closest(*prepared[0], points, goes_on);
  check_points(points);
  std::vector<ClosestDevice> devices;
  for (size_t i = 0; i < solvers.size(); ++i)
    devices.push_back({.solver = solvers[i], .b = prepared[i]});
  return ClosestTogether(std::move(devices), prepared[0]->mesh(), points).run(goes_on);
}

}  // namespace vkh
