#include "host/python/flow.h"

#include <algorithm>
#include <chrono>
#include <set>
#include <system_error>
#include <utility>

#include "host/base/float_environment.h"
#include "host/base/parallel.h"
#include "host/python/session.h"

namespace vkh::python {
namespace {

// This is never destroyed: see interpreter.cpp.
struct Alive {
  std::mutex mutex;
  std::set<Flow*> flows;
};
Alive& alive() {
  static auto* all = new Alive;
  return *all;
}

}  // namespace

// The default for GPUs, which take most: 3 workers of 16 pairs, and as many that wait for them.
size_t Flow::default_ahead(const StreamOptions& devices) {
  const size_t lanes = devices.lanes != 0 ? devices.lanes : 3;
  const size_t together = devices.together != 0 ? devices.together : 16;
  return 2 * lanes * together * devices.devices.size();
}

Flow::Flow(FlowAsked asked) : asked_(std::move(asked)) {
  if (asked_.ahead == 0) asked_.ahead = default_ahead(asked_.devices);
  StreamOptions devices = asked_.devices;
  devices.first = asked_.options;
  devices.waiting = asked_.ahead;  // so that no thread ever waits in push()
  stream_.emplace(devices, [this](StreamResult&& result) { deliver(std::move(result)); });
  const std::lock_guard lock(alive().mutex);
  alive().flows.insert(this);
}

Flow::~Flow() {
  {
    const std::lock_guard lock(alive().mutex);
    alive().flows.erase(this);
  }
  end();
}

bool Flow::has_room() const {
  const std::lock_guard lock(mutex_);
  return bytes_.size() < asked_.ahead && bytes_sum_ <= kMostBytes;
}

void Flow::put(FlowPair pair) {
  const uint64_t bytes = pair.a.bytes() + pair.b.bytes();  // asks the disk
  const std::lock_guard lock(mutex_);
  if (is_ended_) return;
  if (idle_ <= jobs_.size() && threads_.size() < thread_count()) add_thread();
  bytes_.emplace(pair.number, bytes);
  bytes_sum_ += bytes;
  jobs_.push_back(std::move(pair));
  jobs_changed_.notify_one();
}

// Goes on with one thread if no more are available.
void Flow::add_thread() {
  try {
    threads_.emplace_back([this] { work(); });
  } catch (const std::system_error&) {
    if (threads_.empty()) throw;
  }
}

void Flow::work() {
  const FloatEnvironment ours;
  std::unique_lock lock(mutex_);
  for (;;) {
    ++idle_;
    jobs_changed_.wait(lock, [&] { return is_ended_ || !jobs_.empty(); });
    --idle_;
    if (is_ended_) return;
    FlowPair pair = std::move(jobs_.front());
    jobs_.pop_front();
    lock.unlock();
    const size_t number = pair.number;
    try {
      solve(std::move(pair));
    } catch (...) {
      deliver({.number = number,
               .a_to_b = {},
               .b_to_a = std::nullopt,
               .error = std::current_exception()});
    }
    lock.lock();
  }
}

void Flow::solve(FlowPair pair) {
  ReadLimits limits = asked_.limits;
  limits.keep_going = [this] {
    const std::lock_guard lock(mutex_);
    return !is_ended_;
  };
  StreamPair whole{.number = pair.number,
                   .a = made_mesh(std::move(pair.a), limits),
                   .b = asked_.against,
                   .shares_b = asked_.against != nullptr,
                   .symmetric = asked_.symmetric,
                   .options = asked_.options};
  if (!asked_.against) whole.b = made_mesh(std::move(pair.b), limits);
  if (asked_.max) whole.options.limit = limit_for(*asked_.max, *whole.a);
  try {
    stream_->push(std::move(whole));
  } catch (...) {  // no device is left, and the fault is not the pair's: wait() reports it
  }
}

void Flow::deliver(StreamResult&& result) {
  const std::lock_guard lock(mutex_);
  results_.push_back(std::move(result));
  results_changed_.notify_all();
}

// Called with mutex_ locked.
std::optional<StreamResult> Flow::next_result() {
  if (results_.empty() || is_ended_) return std::nullopt;
  StreamResult result = std::move(results_.front());
  results_.pop_front();
  const auto taken = bytes_.find(result.number);
  bytes_sum_ -= taken->second;
  bytes_.erase(taken);
  return result;
}

std::optional<StreamResult> Flow::take() {
  const std::lock_guard lock(mutex_);
  return next_result();
}

std::optional<StreamResult> Flow::wait() {
  constexpr std::chrono::milliseconds kStep(50);
  for (;;) {
    {
      std::unique_lock lock(mutex_);
      results_changed_.wait_for(lock, kStep,
                                [&] { return !results_.empty() || bytes_.empty() || is_ended_; });
      if (!results_.empty() || bytes_.empty() || is_ended_) return next_result();
    }
    stream_->check();
    hear_signals();
  }
}

void Flow::end() {
  const std::lock_guard only_one(ending_);
  {
    const std::lock_guard lock(mutex_);
    is_ended_ = true;
    jobs_.clear();
    jobs_changed_.notify_all();
    results_changed_.notify_all();
  }
  stream_->cancel();
  for (std::thread& thread : threads_) thread.join();
  threads_.clear();
  try {
    stream_->finish();
  } catch (...) {  // no caller asks for it any more
  }
}

void Flow::end_all() {
  const std::lock_guard lock(alive().mutex);
  for (Flow* flow : alive().flows) flow->end();
}

}  // namespace vkh::python
