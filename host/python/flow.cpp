#include "host/python/flow.h"

#include <algorithm>
#include <chrono>
#include <set>
#include <system_error>
#include <utility>

#include "host/answer/steps.h"
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
FlowQuestion FlowQuestion::with_ahead() && {
  const size_t lanes = devices.lanes != 0 ? devices.lanes : 3;
  const size_t together = devices.together != 0 ? devices.together : 16;
  if (ahead == 0) ahead = 2 * lanes * together * devices.devices.size();
  return std::move(*this);
}

Flow::Flow(FlowQuestion asked) : asked_(std::move(asked).with_ahead()) {
  StreamOptions devices = asked_.devices;
  devices.first = engine_of(asked_.question);
  devices.waiting = asked_.ahead;  // so that no thread ever waits in push()
  stream_.emplace(devices, [this](StreamResult&& result) { take_result(std::move(result)); });
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
      deliver({.number = number, .error = std::current_exception()});
    }
    lock.lock();
  }
}

bool Flow::is_over() const {
  const std::lock_guard lock(mutex_);
  return is_ended_;
}

void Flow::solve(FlowPair pair) {
  const Question& question = asked_.question;
  const auto limits_of = [&](bool is_b) {
    ReadLimits limits = question.limits_of(is_b);
    limits.keep_going = [this] { return !is_over(); };
    return limits;
  };
  const auto running = std::make_shared<Running>();
  running->a = made_mesh(std::move(pair.a), limits_of(false));
  const MeshPointer& against = asked_.against.mesh;
  running->b = against ? against : made_mesh(std::move(pair.b), limits_of(true));
  running->a = placed(question, running->a, *running->b);
  running->answer = unread_answer(question);
  if (!question.align) take(*running);
  check_sides(question, *running->a, *running->b);
  push(pair.number, running);
}

void Flow::take(Running& running) const {
  const KeptMesh& against = asked_.against;
  const MeshShape shape_b = against.mesh ? against.shape : shape_of(*running.b);
  take_meshes(asked_.question, {*running.a, shape_of(*running.a)}, {*running.b, shape_b},
              running.answer);
}

// Runs on a worker's thread, before the pair's run.
void Flow::fit(Solver& solver, const PreparedMesh* b, Running& running, StreamPair& pair) {
  auto moved = std::make_shared<ReadMesh>(*running.a);
  fit_a(asked_.question, solver, {.goes_on = [this] { return !is_over(); }},
        {*moved, *running.b, b});
  running.a = std::move(moved);
  take(running);
  pair.a = running.a;
  pair.options = solve_options(asked_.question, running.answer);
}

void Flow::push(size_t number, const std::shared_ptr<Running>& running) {
  const Question& question = asked_.question;
  StreamPair whole{.number = number,
                   .a = running->a,
                   .b = running->b,
                   .shares_b = asked_.against.mesh != nullptr,
                   .symmetric = question.symmetric,
                   .options = {}};
  if (question.align) {
    whole.before = [this, running](Solver& solver, const PreparedMesh* b, StreamPair& pair) {
      fit(solver, b, *running, pair);
    };
  } else {
    whole.options = solve_options(question, running->answer);
  }
  if (question.asks_for_cells()) {
    whole.beside = [this, running](Solver& solver, StreamResult& result) {
      take_reports(asked_.question, std::move(result), running->answer);
      finish(asked_.question, solver, {*running->a, *running->b},
             {.goes_on = [this] { return !is_over(); }}, running->answer);
    };
  }
  {
    const std::lock_guard lock(mutex_);
    running_.emplace(number, running);
  }
  try {
    stream_->push(std::move(whole));
  } catch (...) {  // no device is left, and the fault is not the pair's: wait() reports it
  }
}

// Runs on the stream's delivering thread.
void Flow::take_result(StreamResult&& result) {
  std::shared_ptr<Running> running;
  {
    const std::lock_guard lock(mutex_);
    running = running_.extract(result.number).mapped();
  }
  if (result.error) return deliver({.number = result.number, .error = result.error});
  const size_t number = result.number;
  if (!asked_.question.asks_for_cells())
    take_reports(asked_.question, std::move(result), running->answer);
  FlowResult whole{.number = number, .answer = std::move(running->answer)};
  if (asked_.question.faces) {
    whole.a = running->a;
    whole.b = running->b;
  }
  deliver(std::move(whole));
}

void Flow::deliver(FlowResult&& result) {
  const std::lock_guard lock(mutex_);
  results_.push_back(std::move(result));
  results_changed_.notify_all();
}

// Called with mutex_ locked.
std::optional<FlowResult> Flow::next_result() {
  if (results_.empty() || is_ended_) return std::nullopt;
  FlowResult result = std::move(results_.front());
  results_.pop_front();
  const auto taken = bytes_.find(result.number);
  bytes_sum_ -= taken->second;
  bytes_.erase(taken);
  return result;
}

std::optional<FlowResult> Flow::take() {
  const std::lock_guard lock(mutex_);
  return next_result();
}

std::optional<FlowResult> Flow::wait() {
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
