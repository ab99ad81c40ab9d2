#include "host/batch/batch.h"

#include <atomic>
#include <map>
#include <optional>
#include <thread>
#include <unordered_map>

#include "host/answer/progress_line.h"
#include "host/base/begin_now.h"
#include "host/base/float_environment.h"
#include "host/base/output_file.h"
#include "host/base/parallel.h"
#include "host/solve/byte_budget.h"
#include "vkhausdorff/error.h"

namespace vkh {
namespace {

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

constexpr uint64_t kReadAhead = uint64_t{2} << 30;

/// The error of a pair, with its files as its list names them.
Failure failure_of(const std::exception_ptr& thrown, const Entry& entry) {
  const Error error = error_of(thrown);
  for (const auto& [file, name] : {std::pair{&entry.file_a, &entry.a}, {&entry.file_b, &entry.b}}) {
    if (!file->empty() && error.parts().option.empty() && error.file() == *file)
      return failure_of(error.renamed(*name));
  }
  return failure_of(error);
}

StreamOptions stream_of(const BatchJob& job) {
  StreamOptions options = job.devices;
  options.surveys = job.folders != nullptr || job.asked.question.asks_for_survey();
  return options;
}

class Batch {
 public:
  explicit Batch(const BatchJob& job)
      : job_(job),
        file_("--out", job.results, inputs_of(job)),
        budget_(job.read_ahead_bytes != 0 ? job.read_ahead_bytes : kReadAhead),
        reader_(job.asked, job.shared, [this] { return goes_on(); }) {
    keep_older_lines();
    stream_ = std::make_unique<PairStream>(
        stream_of(job_), [this](StreamResult&& result) { take(std::move(result)); });
  }

  /// Returns nothing if it was to stop but a part of it does not: its threads are left behind.
  std::optional<ExitCode> run(std::ostream& out) {
    constexpr double kGrace = 10;  // seconds for a submission on a slow device
    PairStream& stream = *stream_;
    auto working = begin_now([this, &stream] {
      for_each_index(thread_count(), [&](size_t) { read_some(stream); });
      stream.finish();
    });
    std::optional<Clock::time_point> asked;
    while (working.wait_for(std::chrono::milliseconds(20)) == std::future_status::timeout) {
      if (goes_on()) continue;
      if (!asked) asked = Clock::now();
      budget_.close();
      stream.cancel();
      if (seconds_since(*asked) < kGrace) continue;
      print(out);
      return std::nullopt;
    }
    std::exception_ptr error;
    try {
      working.get();
    } catch (...) {
      error = std::current_exception();
    }
    if (error_) error = error_;
    if (!error) file_.sync();
    print(out);
    if (error) std::rethrow_exception(error);
    const bool is_whole = totals_.pairs() == job_.entries.size();
    return is_whole ? totals_.worst() : worse(totals_.worst(), kExitNotClosed);
  }

 private:
  struct Running {
    NamedEntry entry;
    EntryMeshes meshes;
    uint64_t bytes = 0;
    std::optional<Answer> surveyed = {};  ///< the answer with its survey, where one was asked for
  };
  /// A line of an earlier run.
  struct Older {
    std::string key;
    bool is_final;
    Counted counted;
  };

  static std::vector<std::string> inputs_of(const BatchJob& job) {
    std::vector<std::string> files;
    for (const Entry& entry : job.entries) {
      for (const std::string* file : {&entry.file_a, &entry.file_b}) {
        if (!file->empty()) files.push_back(*file);
      }
    }
    return files;
  }

  void keep_older_lines() {
    if (file_.size() > 0 && !file_.begins_with(kResultStart))
      throw UsageError({.option = "--out",
                        .file = job_.results,
                        .problem = "is a file, and no batch's results"});
    if (file_.size() > 0 && !job_.resumes)
      throw UsageError({.option = "--out",
                        .file = job_.results,
                        .problem = "has results: add --resume to go on, or name another file"});
    uint64_t number = 0;
    file_.read([&](std::string_view line) {
      ++number;
      try {
        const Result result = read_result(line);
        older_.insert_or_assign(result.name.id,
                                Older{result.name.key, result.is_final(), counted(result)});
      } catch (const InputError& error) {
        throw InputError({.file = job_.results,
                          .place = "line " + std::to_string(number),
                          .problem = error.what()});
      }
    });
  }

  void print(std::ostream& out) {
    line_.end();
    const std::lock_guard lock(mutex_);
    totals_.print(out, {.left = job_.entries.size() - totals_.pairs(),
                        .wall_s = seconds_since(start_),
                        .read_s = read_s_,
                        .device = stream_->times(),
                        .devices = stream_->devices(),
                        .results = job_.results,
                        .has_limit = job_.asked.question.max.has_value(),
                        .unpaired = job_.unpaired});
    out.flush();
  }

  bool goes_on() const { return !stopped_ && !is_interrupted(); }

  void stop(const std::exception_ptr& error) {
    const std::lock_guard lock(mutex_);
    if (error && !error_) error_ = error;
    stopped_ = true;
  }

  // Reads entries in the list's order, on each of the reading threads.
  void read_some(PairStream& stream) {
    for (;;) {
      size_t number = 0;
      uint64_t ticket = 0;
      {
        const std::lock_guard lock(mutex_);
        if (next_ == job_.entries.size()) return;
        number = next_++;
        ticket = budget_.ticket();
      }
      if (!goes_on()) return budget_.close();
      try {
        if (!read_one(number, ticket, stream)) return;
      } catch (...) {
        stop(nullptr);
        throw;
      }
    }
  }

  void count_reading(Clock::time_point start) {
    const double seconds = seconds_since(start);
    const std::lock_guard lock(mutex_);
    read_s_ += seconds;
  }

  bool read_one(size_t number, uint64_t ticket, PairStream& stream) {
    Running running;
    const Entry& entry = job_.entries[number];
    bool has_room = false;
    try {
      running.entry.entry = &entry;
      running.entry.known.inputs[0].path = entry.a;
      running.entry.known.inputs[1].path = entry.b;
      running.entry.name.id = entry.id;
      auto start = Clock::now();
      running.entry = reader_.name(entry);
      count_reading(start);
      const bool is_kept = is_done(running.entry);
      running.bytes = is_kept ? 0 : kBytesOfAByte * running.entry.file_bytes;
      if (!budget_.take(ticket, running.bytes)) return false;
      has_room = true;
      if (is_kept) return true;
      start = Clock::now();
      running.meshes = reader_.read(running.entry);
      count_reading(start);
    } catch (const Interrupted&) {
      return false;
    } catch (...) {
      if (!has_room && !budget_.take(ticket, 0)) return false;
      write_failure(running.entry, std::current_exception());
      budget_.give(running.bytes);
      return true;
    }
    return push(number, std::move(running), stream);
  }

  bool is_done(const NamedEntry& entry) {
    const auto older = older_.find(entry.name.id);
    if (older == older_.end() || !older->second.is_final || older->second.key != entry.name.key)
      return false;
    const bool is_drawn = !job_.folders || !older->second.counted.has_answer() ||
                          job_.folders->has(entry.name, entry.question.symmetric);
    if (!is_drawn) return false;
    const std::lock_guard lock(mutex_);
    if (kept_.insert(entry.name.id).second) {
      totals_.add_kept(older->second.counted);
      show();
    }
    return true;
  }

  bool push(size_t number, Running running, PairStream& stream) {
    StreamPair pair{.number = number,
                    .a = running.meshes.a,
                    .b = running.meshes.b,
                    .shares_b = running.meshes.shares_b,
                    .symmetric = running.entry.question.symmetric,
                    .options = {}};
    if (running.entry.question.align) {
      pair.before = [this](Solver& solver, const PreparedMesh* b, StreamPair& one) {
        fit(solver, b, one);
      };
    } else {
      pair.options = options_of(running);
    }
    if (job_.folders || running.entry.question.asks_for_survey())
      pair.beside = [this](Solver& solver, StreamResult& result) { go_on(solver, result); };
    {
      const std::lock_guard lock(mutex_);
      running_.emplace(number, std::move(running));
    }
    return stream.push(std::move(pair));
  }

  SolveOptions options_of(const Running& one) {
    SolveOptions options = solve_options(one.entry.question, one.entry.known);
    options.progress = [this](const Progress&) { return goes_on(); };
    return options;
  }

  // Runs on a worker's thread, before the pair's run. The time of a pair is for its run.
  void fit(Solver& solver, const PreparedMesh* b, StreamPair& pair) {
    Running& one = running(pair.number);
    const Observer observer{.goes_on = [this] { return goes_on(); }};
    EntryReader::fit(solver, observer, b, one.meshes, one.entry);
    pair.a = one.meshes.a;
    pair.options = options_of(one);
  }

  Running& running(size_t number) {
    const std::lock_guard lock(mutex_);
    return running_.at(number);
  }

  // Surveys what was asked, and what its pictures show, at once. The time of a pair is for its
  // survey, too.
  void survey(Solver& solver, const Running& one, Answer& answer) {
    const Clock::time_point start = Clock::now();
    const double limit_s = one.entry.question.budget.time_limit_s;
    const double spent_s = (answer.waits.total - answer.waits.read) / 1000;
    const Observer observer{.goes_on = [this] { return goes_on(); },
                            .left_s = [=] { return limit_s - spent_s - seconds_since(start); }};
    Question question = one.entry.question;
    if (job_.folders) job_.folders->ask(question);
    finish(question, solver, {*one.meshes.a, *one.meshes.b}, observer, answer);
    answer.waits.total += 1000 * seconds_since(start);
  }

  // Runs on a worker's thread, before the result is delivered.
  void go_on(Solver& solver, const StreamResult& result) {
    Running& one = running(result.number);
    Answer answer = answer_of(one.entry, result);
    if (is_cancelled(answer)) return;
    const bool is_surveyed = one.entry.question.asks_for_survey();
    if (is_surveyed) survey(solver, one, answer);
    if (job_.folders)
      job_.folders->draw({one.entry, one.meshes, solver, [this] { return goes_on(); }}, answer);
    if (!is_surveyed) return;
    for (std::optional<SurveyResult>* one_way : {&answer.survey_a, &answer.survey_b}) {
      if (!*one_way) continue;
      (*one_way)->map.reset();  // it is large, and a line has none
      (*one_way)->shares.reset();
    }
    one.surveyed = std::move(answer);
  }

  Running taken(size_t number) {
    const std::lock_guard lock(mutex_);
    auto node = running_.extract(number);
    return std::move(node.mapped());
  }

  // Runs on the stream's delivering thread.
  void take(StreamResult&& result) {
    const Running running = taken(result.number);
    try {
      write_result(running, std::move(result));
    } catch (...) {
      stop(std::current_exception());
    }
    budget_.give(running.bytes);
  }

  static Answer answer_of(const NamedEntry& entry, StreamResult result) {
    Answer answer = entry.known;
    take_reports(entry.question, std::move(result), answer);
    return answer;
  }

  static bool is_called_off(const std::exception_ptr& error) {
    try {
      std::rethrow_exception(error);
    } catch (const Interrupted&) {
      return true;
    } catch (...) {
      return false;
    }
  }

  static bool is_survey_cancelled(const std::optional<SurveyResult>& survey) {
    return survey && survey->ended == SurveyEnd::kCancelled;
  }

  void write_result(const Running& one, StreamResult&& result) {
    const NamedEntry& entry = one.entry;
    if (result.error && is_called_off(result.error)) return;
    if (result.error) return write_failure(entry, result.error);
    const Answer answer = one.surveyed ? *one.surveyed : answer_of(entry, std::move(result));
    const bool is_to_be_done_again = is_cancelled(answer) || is_survey_cancelled(answer.survey_a) ||
                                     is_survey_cancelled(answer.survey_b);
    if (is_to_be_done_again) return;
    write(result_of(entry.name, answer));
  }

  void write_failure(const NamedEntry& entry, const std::exception_ptr& error) {
    const Failure failure = failure_of(error, *entry.entry);
    write(result_of(entry.name, failure, entry.known));
  }

  void write(const Result& result) {
    const std::string line = to_line(result);
    const std::lock_guard lock(mutex_);
    if (error_) return;
    try {
      file_.append(line);
    } catch (const OutputError&) {
      error_ = std::current_exception();
      stopped_ = true;
      return;
    }
    totals_.add(result);
    show();
    const bool is_bad = result.code == kExitBeyond || !result.has_answer();
    if (job_.fails_fast && is_bad) stopped_ = true;
  }

  void show() {
    const size_t done = totals_.pairs(), all = job_.entries.size();
    const size_t now = done - kept_.size();  // pairs that this run did
    if (now == 1) first_ = Clock::now();
    const double each = now < 2 ? 0 : seconds_since(first_) / static_cast<double>(now - 1);
    line_.show_batch(done, all, totals_.failed(), each * static_cast<double>(all - done));
  }

  const BatchJob job_;
  const Clock::time_point start_ = Clock::now();
  Clock::time_point first_ = start_;  // the end of the first pair of this run
  LineFile file_;
  ByteBudget budget_;
  EntryReader reader_;
  ProgressLine line_;
  std::unordered_map<std::string, Older> older_;
  std::mutex mutex_;
  std::atomic<bool> stopped_ = false;
  std::exception_ptr error_;
  size_t next_ = 0;
  double read_s_ = 0;
  std::map<size_t, Running> running_;
  std::set<std::string> kept_;
  Totals totals_;
  std::unique_ptr<PairStream> stream_;  // destroyed before the members that it delivers to
};

}  // namespace

ExitCode run_batch(const BatchJob& job, std::ostream& out) {
  auto batch = std::make_unique<Batch>(job);
  const std::optional<ExitCode> code = batch->run(out);
  if (code) return *code;
  (void)batch.release();  // threads still read it
  return kExitNotClosed;
}

}  // namespace vkh
