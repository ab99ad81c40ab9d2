#include "host/answer/asking_stream.h"

#include <system_error>
#include <utility>

#include "host/answer/stop.h"
#include "host/base/float_environment.h"
#include "host/base/parallel.h"
#include "vkhausdorff/error.h"

namespace vkh {

AskingStream::AskingStream(StreamOptions devices, uint64_t read_ahead, Deliver deliver)
    : budget_(read_ahead != 0 ? read_ahead : kReadAhead),
      deliver_(std::move(deliver)),
      stream_(std::make_unique<PairStream>(
          std::move(devices), [this](StreamResult&& result) { take_result(std::move(result)); })) {}

AskingStream::~AskingStream() {
  cancel();
  for (std::thread& thread : threads_) thread.join();
}

void AskingStream::put(std::unique_ptr<StreamedPair> one) {
  const std::lock_guard lock(mutex_);
  if (is_cancelled_) return;
  if (idle_ <= jobs_.size() && threads_.size() < thread_count()) add_thread();
  jobs_.push_back(std::move(one));
  ++open_;
  jobs_changed_.notify_one();
}

// Goes on with one thread if no more are available.
void AskingStream::add_thread() {
  try {
    threads_.emplace_back([this] { work(); });
  } catch (const std::system_error&) {
    if (threads_.empty()) throw;
  }
}

void AskingStream::work() {
  const FloatEnvironment ours;
  for (;;) {
    std::unique_ptr<StreamedPair> one;
    uint64_t ticket = 0;
    {
      std::unique_lock lock(mutex_);
      ++idle_;
      jobs_changed_.wait(lock, [&] { return is_cancelled_ || is_whole_ || !jobs_.empty(); });
      --idle_;
      if (is_cancelled_ || jobs_.empty()) return;
      one = std::move(jobs_.front());
      jobs_.pop_front();
      ticket = budget_.ticket();
    }
    bring(std::move(one), ticket);
  }
}

void AskingStream::timed(const std::function<void()>& step) {
  const auto start = Clock::now();
  step();
  const std::lock_guard lock(mutex_);
  read_s_ += seconds_since(start);
}

void AskingStream::bring(std::unique_ptr<StreamedPair> one, uint64_t ticket) {
  std::optional<uint64_t> bytes;
  bool has_room = false;
  try {
    timed([&] { bytes = one->look(); });
    if (!budget_.take(ticket, bytes.value_or(0))) return;
    has_room = true;
    if (!bytes) return forget();
    timed([&] { one->read(); });
  } catch (const Interrupted&) {
    return cancel();
  } catch (...) {
    one->error = std::current_exception();
  }
  if (!has_room && !budget_.take(ticket, 0)) return;
  Running running{std::move(one), bytes.value_or(0)};
  if (running.it->error) return hand_out(std::move(running));
  push(std::move(running));
}

void AskingStream::forget() {
  const std::lock_guard lock(mutex_);
  --open_;
  results_changed_.notify_all();
}

// A pair may be tried again, alone or after its device was lost: an attempt that ends changes it.
void AskingStream::push(Running running) {
  StreamedPair& it = *running.it;
  AskedPair& pair = *it.pair;
  StreamPair one{.number = 0,
                 .a = pair.a(),
                 .b = pair.b(),
                 .shares_b = it.shares_b(),
                 .symmetric = pair.question().symmetric,
                 .options = {}};
  if (pair.question().align) {
    one.before = [this, &pair](Solver& solver, const PreparedMesh* b, StreamPair& to_run) {
      const auto start = Clock::now();
      pair.fit(solver, {.goes_on = [this] { return !is_cancelled(); }}, b);
      pair.answer().waits.read += 1000 * seconds_since(start);
      to_run.a = pair.a();
      to_run.options = solve_options(pair.question(), pair.answer());
    };
  } else {
    one.options = solve_options(pair.question(), pair.answer());
  }
  if (it.has_more()) {
    one.beside = [&it](Solver& solver, StreamResult& result) {
      AskedPair solved = *it.pair;
      solved.take(std::move(result));
      it.finish(solved, solver);
      *it.pair = std::move(solved);
    };
  }
  {
    const std::lock_guard lock(mutex_);
    one.number = ++last_number_;
    running_.emplace(one.number, std::move(running));
  }
  try {
    stream_->push(std::move(one));
  } catch (...) {  // no device is left: finish() and check() say why
    cancel();
  }
}

// Runs on the delivering thread of the devices' stream.
void AskingStream::take_result(StreamResult&& result) {
  Running running;
  {
    const std::lock_guard lock(mutex_);
    running = std::move(running_.extract(result.number).mapped());
  }
  StreamedPair& it = *running.it;
  it.error = result.error;
  if (!it.error && !it.has_more()) it.pair->take(std::move(result));
  hand_out(std::move(running));
}

void AskingStream::hand_out(Running running) {
  if (deliver_) {
    const std::lock_guard one_at_a_time(delivering_);
    deliver_(std::move(running.it));
  }
  budget_.give(running.bytes);
  const std::lock_guard lock(mutex_);
  if (!deliver_) results_.push_back(std::move(running.it));
  --open_;
  results_changed_.notify_all();
}

std::unique_ptr<StreamedPair> AskingStream::take() {
  const std::lock_guard lock(mutex_);
  if (results_.empty() || is_cancelled_) return nullptr;
  std::unique_ptr<StreamedPair> one = std::move(results_.front());
  results_.pop_front();
  return one;
}

bool AskingStream::wait(Deadline deadline) {
  std::unique_lock lock(mutex_);
  return results_changed_.wait_until(
      lock, deadline, [&] { return !results_.empty() || open_ == 0 || is_cancelled_; });
}

void AskingStream::finish() {
  {
    const std::lock_guard lock(mutex_);
    is_whole_ = true;
    jobs_changed_.notify_all();
  }
  for (std::thread& thread : threads_) thread.join();
  threads_.clear();
  stream_->finish();
}

void AskingStream::cancel() {
  {
    const std::lock_guard lock(mutex_);
    is_cancelled_ = true;
    jobs_.clear();
    jobs_changed_.notify_all();
    results_changed_.notify_all();
  }
  budget_.close();
  stream_->cancel();
}

bool AskingStream::is_cancelled() const {
  const std::lock_guard lock(mutex_);
  return is_cancelled_;
}

double AskingStream::read_s() const {
  const std::lock_guard lock(mutex_);
  return read_s_;
}

}  // namespace vkh
