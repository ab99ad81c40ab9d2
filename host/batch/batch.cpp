#include "host/batch/batch.h"

#include <atomic>
#include <memory>
#include <optional>
#include <unordered_map>
#include <unordered_set>

#include "host/answer/asking_stream.h"
#include "host/answer/one_of_many.h"
#include "host/answer/progress_line.h"
#include "host/base/begin_now.h"
#include "host/base/output_file.h"
#include "vkhausdorff/error.h"

namespace vkh {
namespace {

/// The error of a pair, with its files as its list names them.
Failure failure_of(const std::exception_ptr& thrown, const Entry& entry) {
  const Error error = error_of(thrown);
  for (const auto& [file, name] : {std::pair{&entry.file_a, &entry.a}, {&entry.file_b, &entry.b}}) {
    if (!file->empty() && error.parts().option.empty() && error.file() == *file)
      return failure_of(error.renamed(*name));
  }
  return failure_of(error);
}

std::vector<std::string> inputs_of(const BatchJob& job) {
  std::vector<std::string> files;
  for (const Entry& entry : job.entries) {
    for (const std::string* file : {&entry.file_a, &entry.file_b}) {
      if (!file->empty()) files.push_back(*file);
    }
  }
  return files;
}

/// The file of results with the lines of earlier runs, and the totals of all lines. Threads may
/// share it.
class ResultLines {
 public:
  /// Throws UsageError for a file that has results but is not to be resumed, or that has other
  /// content.
  explicit ResultLines(const BatchJob& job)
      : job_(job), file_("--out", job.results, inputs_of(job)) {
    if (file_.size() > 0 && !file_.begins_with(kResultStart))
      throw UsageError({.option = "--out",
                        .file = job_.results,
                        .problem = "is a file, and no batch's results"});
    if (file_.size() > 0 && !job_.resumes)
      throw UsageError({.option = "--out",
                        .file = job_.results,
                        .problem = "has results: add --resume to go on, or name another file"});
    read_older();
  }

  /// Whether an earlier run has done all of this pair. If so, its line counts.
  bool keep(const ResultName& name, bool symmetric) {
    const auto older = older_.find(name.id);
    if (older == older_.end() || !older->second.is_final || older->second.key != name.key)
      return false;
    const bool is_drawn =
        !job_.folders || !older->second.counted.has_answer() || job_.folders->has(name, symmetric);
    if (!is_drawn) return false;
    const std::lock_guard lock(mutex_);
    if (!kept_.insert(name.id).second) return true;
    totals_.add_kept(older->second.counted);
    show();
    return true;
  }

  /// Adds a line. Returns whether the batch goes on: false if this pair ends it. Throws
  /// OutputError.
  bool write(const Result& result) {
    const std::string line = to_line(result);
    const std::lock_guard lock(mutex_);
    file_.append(line);
    totals_.add(result);
    show();
    const bool is_bad = result.code == kExitBeyond || !result.has_answer();
    return !job_.fails_fast || !is_bad;
  }

  void sync() { file_.sync(); }

  void print(std::ostream& out, const AskingStream& stream) {
    line_.end();
    const std::lock_guard lock(mutex_);
    totals_.print(out, {.left = job_.entries.size() - totals_.pairs(),
                        .wall_s = seconds_since(start_),
                        .read_s = stream.read_s(),
                        .device = stream.times(),
                        .devices = stream.devices(),
                        .results = job_.results,
                        .has_limit = job_.asked.question.max.has_value(),
                        .unpaired = job_.unpaired});
    out.flush();
  }

  ExitCode code() const {
    const std::lock_guard lock(mutex_);
    const bool is_whole = totals_.pairs() == job_.entries.size();
    return is_whole ? totals_.worst() : worse(totals_.worst(), kExitNotClosed);
  }

 private:
  /// A line of an earlier run.
  struct Older {
    std::string key;
    bool is_final;
    Counted counted;
  };

  void read_older() {
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

  void show() {
    const size_t done = totals_.pairs(), all = job_.entries.size();
    const size_t now = done - kept_.size();  // pairs that this run did
    if (now == 1) first_ = Clock::now();
    const double each = now < 2 ? 0 : seconds_since(first_) / static_cast<double>(now - 1);
    line_.show_batch(done, all, totals_.failed(), each * static_cast<double>(all - done));
  }

  const BatchJob& job_;
  const Clock::time_point start_ = Clock::now();
  Clock::time_point first_ = start_;  // the end of the first pair of this run
  LineFile file_;
  ProgressLine line_;
  std::unordered_map<std::string, Older> older_;
  mutable std::mutex mutex_;
  std::unordered_set<std::string> kept_;
  Totals totals_;
};

/// The state that all pairs of a batch share.
struct Running {
  explicit Running(const BatchJob& asked)
      : job(asked), lines(job), reader(job.asked, job.shared, [this] { return goes_on(); }) {}

  bool goes_on() const { return !is_stopped && !is_interrupted(); }
  const BatchJob job;
  ResultLines lines;
  EntryReader reader;
  std::atomic<bool> is_stopped = false;
  std::exception_ptr error;  // of a line that could not be written
};

/// A pair of the list.
class ListedPair : public StreamedPair {
 public:
  ListedPair(Running& batch, const Entry& entry) : batch_(batch), entry_(entry) {
    named_.name.id = entry.id;
  }

  std::optional<uint64_t> look() override {
    named_ = batch_.reader.name(entry_);
    pair = std::move(named_.pair);
    if (batch_.lines.keep(named_.name, pair->question().symmetric)) return std::nullopt;
    return kBytesOfAByte * named_.file_bytes;
  }
  void read() override { batch_.reader.read(named_.shares_b, *pair); }
  bool shares_b() const override { return named_.shares_b; }
  bool has_more() const override { return batch_.job.folders || is_surveyed(); }
  void finish(AskedPair& solved, Solver& solver) override;

  /// The pair's line; nothing if the pair has to be done again.
  std::optional<Result> result() const;

 private:
  bool is_surveyed() const { return pair->question().asks_for_survey(); }
  void survey(AskedPair& solved, Solver& solver) const;

  Running& batch_;
  const Entry& entry_;
  NamedEntry named_;
};

// Makes one survey for what was asked and for what the pictures show. The time limit of a pair
// includes its survey.
void ListedPair::survey(AskedPair& solved, Solver& solver) const {
  const Clock::time_point start = Clock::now();
  Answer& answer = solved.answer();
  const double limit_s = solved.question().budget.time_limit_s;
  const double spent_s = (answer.waits.total - answer.waits.read) / 1000;
  const Observer observer{.goes_on = [this] { return batch_.goes_on(); },
                          .left_s = [=] { return limit_s - spent_s - seconds_since(start); }};
  Question question = solved.question();
  if (batch_.job.folders) batch_.job.folders->ask(question);
  vkh::finish(question, solver, {*solved.a(), *solved.b()}, observer, answer);
  answer.waits.total += 1000 * seconds_since(start);
}

void ListedPair::finish(AskedPair& solved, Solver& solver) {
  Answer& answer = solved.answer();
  if (is_cancelled(answer)) return;
  if (is_surveyed()) survey(solved, solver);
  if (batch_.job.folders)
    batch_.job.folders->draw({named_.name, solved, solver, [this] { return batch_.goes_on(); }});
  for (std::optional<SurveyResult>* one_way : {&answer.survey_a, &answer.survey_b}) {
    if (!*one_way) continue;
    (*one_way)->map.reset();  // it is large, and a line has none
    (*one_way)->shares.reset();
  }
}

bool is_called_off(const std::exception_ptr& error) {
  try {
    std::rethrow_exception(error);
  } catch (const Interrupted&) {
    return true;
  } catch (...) {
    return false;
  }
}

bool is_survey_cancelled(const std::optional<SurveyResult>& survey) {
  return survey && survey->ended == SurveyEnd::kCancelled;
}

std::optional<Result> ListedPair::result() const {
  if (error) {
    if (is_called_off(error)) return std::nullopt;
    Answer known;
    known.inputs[0].path = entry_.a;
    known.inputs[1].path = entry_.b;
    return result_of(named_.name, failure_of(error, entry_), pair ? pair->answer() : known);
  }
  const Answer& answer = pair->answer();
  const bool is_to_be_done_again = is_cancelled(answer) || is_survey_cancelled(answer.survey_a) ||
                                   is_survey_cancelled(answer.survey_b);
  if (is_to_be_done_again) return std::nullopt;
  return result_of(named_.name, answer);
}

/// Adds the pair's line, unless one could not be written before. One thread at a time.
void take(Running& batch, const StreamedPair& ended) {
  if (batch.error) return;
  try {
    const std::optional<Result> result = dynamic_cast<const ListedPair&>(ended).result();
    if (result && !batch.lines.write(*result)) batch.is_stopped = true;
  } catch (...) {
    batch.error = std::current_exception();
    batch.is_stopped = true;
  }
}

/// Returns nothing if the batch was told to stop but a part of it does not: its threads are then
/// left running.
std::optional<ExitCode> run(Running& batch, AskingStream& stream, std::ostream& out) {
  constexpr double kGrace = 10;  // seconds for a submission on a slow device
  auto working = begin_now([&] {
    for (const Entry& entry : batch.job.entries)
      stream.put(std::make_unique<ListedPair>(batch, entry));
    stream.finish();
  });
  std::optional<Clock::time_point> asked;
  while (working.wait_for(std::chrono::milliseconds(20)) == std::future_status::timeout) {
    if (batch.goes_on()) continue;
    if (!asked) asked = Clock::now();
    stream.cancel();
    if (seconds_since(*asked) < kGrace) continue;
    batch.lines.print(out, stream);
    return std::nullopt;
  }
  std::exception_ptr error;
  try {
    working.get();
  } catch (...) {
    error = std::current_exception();
  }
  if (batch.error) error = batch.error;
  if (!error) batch.lines.sync();
  batch.lines.print(out, stream);
  if (error) std::rethrow_exception(error);
  return batch.lines.code();
}

StreamOptions stream_of(const BatchJob& job) {
  StreamOptions options = job.devices;
  options.surveys = job.folders != nullptr || job.asked.question.asks_for_survey();
  return options;
}

}  // namespace

ExitCode run_batch(const BatchJob& job, std::ostream& out) {
  auto batch = std::make_unique<Running>(job);
  auto stream = std::make_unique<AskingStream>(
      stream_of(job), job.read_ahead_bytes,
      [&all = *batch](std::unique_ptr<StreamedPair> ended) { take(all, *ended); });
  const std::optional<ExitCode> code = run(*batch, *stream, out);
  if (code) return *code;
  (void)stream.release();  // threads still read both
  (void)batch.release();
  return kExitNotClosed;
}

}  // namespace vkh
