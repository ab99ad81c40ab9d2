#include "host/answer/ask_files.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <limits>
#include <new>

#include "host/answer/asked_pair.h"
#include "host/answer/input_hashes.h"
#include "host/answer/known_answer.h"
#include "host/answer/progress_line.h"
#include "host/base/begin_now.h"
#include "host/base/float_environment.h"
#include "host/base/system.h"
#include "host/mesh/default_pair.h"
#include "vkhausdorff/error.h"
#include "vkhausdorff/mesh_io.h"
#include "vkhausdorff/sha256.h"

namespace vkh {
namespace {

double ms_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

/// The state that the threads of a question share.
struct SharedState {
  SharedState(const Question& asked, const Stop& until)
      : question(asked), stop(until), known(asked) {}

  const Question question;
  const Stop stop;
  ProgressLine line;
  KnownAnswer known;

  /// Shows how far all work is. `words`: of the method, for --verbose.
  template <class Words>
  void show(const Words& words) {
    line.show([&] {
      const std::string text = progress_text(known.done(), stop.left_s());
      return question.verbose ? text + "  " + words() : text;
    });
  }
};

Observer observer_of(SharedState& at) {
  return {.goes_on = [&at] { return !at.stop.is_asked(); },
          .left_s = [&at] { return at.stop.left_s(); },
          .search =
              [&at](const Progress& progress) {
                at.known.hear(progress);
                at.show([&] { return search_words(progress); });
                return !is_interrupted();
              },
          .cells =
              [&at](const SideCount& side) {
                at.known.hear_cells(side);
                at.show([&] { return count_words("survey", side, "cells bounded"); });
              },
          .leaves =
              [&at](const SideCount& side) {
                at.known.hear_leaves(side);
                at.show([&] { return count_words("certificate", side, "leaves"); });
              },
          .found = [&at](const Answer& answer) { at.known.keep(answer); }};
}

void take_built_in(AskedPair& asked) {
  MeshPair pair = default_pair();
  asked.take(std::make_shared<ReadMesh>(std::move(pair.a)),
             shaped(std::make_shared<const ReadMesh>(std::move(pair.b))));
}

/// Reads both files at the same time. Throws what read_mesh throws, A's error before B's. Shows the
/// progress, and ends with Interrupted when it is to stop. After a bad A the call does not wait for
/// B, whose threads go on and keep `at`.
void take_files(const std::shared_ptr<SharedState>& at, AskedPair& asked) {
  constexpr uint64_t kWorthwhile = 100'000'000;  // about a second on one core
  uint64_t bytes = 0;
  const std::string &file_a = at->question.file_a, &file_b = at->question.file_b;
  for (const std::string& file : {file_a, file_b}) {
    std::error_code none;
    const uintmax_t size = std::filesystem::file_size(path_of(file), none);
    if (!none) bytes += size;
  }
  const auto bytes_read = std::make_shared<std::atomic<uint64_t>>(0);
  const auto limits_of = [&](bool is_b) {
    ReadLimits limits = at->question.limits_of(is_b);
    limits.bytes_read = bytes_read.get();
    limits.keep_going = [bytes_read, bytes, at] {
      if (bytes >= kWorthwhile) at->line.show_reading(*bytes_read, bytes);
      return !at->stop.is_asked();
    };
    return limits;
  };
  auto b = begin_now([file_b, limits = limits_of(true)] {
    return std::make_shared<const ReadMesh>(read_mesh(path_of(file_b), limits));
  });
  auto a = std::make_shared<ReadMesh>(read_mesh(path_of(file_a), limits_of(false)));
  asked.take(std::move(a), shaped(b.get()));
}

/// Hashes all files that are read, beside the other work; a caller waits only for the result.
class Hashes {
 public:
  explicit Hashes(const std::shared_ptr<SharedState>& at)
      : at_(at), is_wanted_(at->question.hashes && !at->question.file_a.empty()) {
    if (!is_wanted_) return;
    for (const std::string& file : {at->question.file_a, at->question.file_b})
      digests_.push_back(begin_hash(file));
    for (const std::string& file : {at->question.face_max_a, at->question.face_max_b})
      limits_.push_back(begin_hash(file));
    matrix_ = begin_hash(at->question.transform_file);
  }

  /// Begins with the files beneath both. Call it once both are read: parsing a file for their names
  /// earlier would hold it in memory a second time.
  void begin_beneath() {
    if (!is_wanted_) return;
    for (const std::string& file : {at_->question.file_a, at_->question.file_b}) {
      beneath_.push_back(begin_now([at = at_, file]() -> Beneath {
        ReadLimits limits = at->question.limits;
        limits.keep_going = [at] { return !at->stop.is_asked(); };
        try {
          return hashes_beneath(file, limits);
        } catch (const Interrupted&) {
          return std::nullopt;
        } catch (const std::bad_alloc&) {  // it must not cost the answer
          return std::nullopt;
        }
      }));
    }
  }

  /// Writes the hashes of an input only if those of all its files are known.
  void fill(Answer& answer) {
    for (size_t i = 0; i < beneath_.size(); ++i) {
      Beneath beneath = beneath_[i].get();
      if (!beneath) continue;
      answer.inputs[i].sha256 = digests_[i].get();
      answer.inputs[i].files = std::move(*beneath);
    }
    if (is_wanted_ && answer.placed) answer.placed->sha256 = matrix_.get();
    if (!is_wanted_ || !answer.max) return;
    for (size_t i = 0; i < limits_.size(); ++i) {
      auto& faces = i == 0 ? answer.max->faces_a : answer.max->faces_b;
      if (faces) faces->sha256 = limits_[i].get();
    }
  }

 private:
  using Beneath = std::optional<std::vector<FileHash>>;

  std::future<std::string> begin_hash(const std::string& file) {
    return begin_now([at = at_, file] {
      if (file.empty()) return std::string();
      return sha256_of(path_of(file), [at] { return !at->stop.is_asked(); });
    });
  }

  std::shared_ptr<SharedState> at_;
  bool is_wanted_;
  std::vector<std::future<std::string>> digests_, limits_;
  std::future<std::string> matrix_;
  std::vector<std::future<Beneath>> beneath_;
};

std::vector<Solver*> solvers_of(const Session& session) {
  std::vector<Solver*> solvers{session.solver.get()};
  for (const Opened& one : session.more) solvers.push_back(one.solver.get());
  return solvers;
}

std::future<Session> begin_opening(const Question& question) {
  return begin_now([selector = question.device, several = question.several_devices,
                    engine = engine_of(question),
                    cache = question.caches ? user_cache_folder() : std::filesystem::path()] {
    return open_session(selector, several, engine, cache);
  });
}

Answered work(const std::shared_ptr<SharedState>& at) {
  const Question& question = at->question;
  Hashes hashes(at);
  auto opening = begin_opening(question);
  const auto start = Clock::now();
  AskedPair pair(question);
  question.file_a.empty() ? take_built_in(pair) : take_files(at, pair);
  pair.answer().waits.read = ms_since(start);
  if (!question.align) at->known.begin(pair.answer());
  hashes.begin_beneath();
  Session session = opening.get();
  Solver& first = *session.solver;
  const Observer observer = observer_of(*at);
  pair.fit(first, observer);
  pair.answer().waits.start = session.setup_ms;
  at->known.begin(pair.answer());
  at->known.open(session.device->description());
  pair.solve(solvers_of(session), observer);
  pair.finish(first, observer);
  hashes.fill(pair.answer());
  return {std::move(pair.answer()), pair.a(), pair.b(), std::move(session)};
}

/// Returns the answer known so far, for a caller that no longer waits for the run. Unless that
/// answer is final, its status says why the run was stopped.
Answered unfinished(SharedState& at) {
  at.line.end();
  Answered done;
  done.answer = at.known.answer();
  if (at.known.is_final()) return done;
  done.answer.a_to_b.status = at.stop.why();
  if (done.answer.b_to_a) done.answer.b_to_a->status = at.stop.why();
  return done;
}

/// Returns true once `result` is ready; false when the caller is to wait no longer.
bool wait_for(const std::future<Answered>& result, const SharedState& at) {
  constexpr std::chrono::milliseconds kLook(20);
  constexpr double kGraceful = 0.06;  // a run on a GPU ends by itself in it, with more to report
  constexpr double kToAddUp = 3;      // a survey has files to write that the user asked for
  const Stop& stop = at.stop;
  // A certificate proves the final result of the search, so that is waited for too.
  const auto patience = [&] {
    return at.known.is_final() || at.question.certificate ? kToAddUp : kGraceful;
  };
  double asked_at = std::numeric_limits<double>::infinity();
  while (result.wait_for(kLook) == std::future_status::timeout) {
    if (!stop.is_asked()) continue;
    asked_at = std::min(asked_at, stop.elapsed_s());
    if (stop.elapsed_s() - asked_at > patience()) return false;
  }
  return true;
}

}  // namespace

Answered ask(const Question& question, const Stop& stop) {
  // The state is shared: threads that are left behind still read it.
  const auto at = std::make_shared<SharedState>(question, stop);
  auto result = begin_now([at] {
    const FloatEnvironment ours;
    return work(at);
  });
  Answered done;
  try {
    done = wait_for(result, *at) ? result.get() : unfinished(*at);
  } catch (const Interrupted&) {
    done = unfinished(*at);
  }
  at->line.end();
  done.answer.waits.total = stop.elapsed_s() * 1000;
  return done;
}

}  // namespace vkh
