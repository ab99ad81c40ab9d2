#include "host/app/many_pairs.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <set>
#include <tuple>

#include "host/answer/merge.h"
#include "host/answer/merge_parts.h"
#include "host/answer/rank.h"
#include "host/answer/session.h"
#include "host/answer/steps.h"
#include "host/answer/tables.h"
#include "host/app/outputs.h"
#include "host/base/output_file.h"
#include "host/base/system.h"
#include "host/batch/batch.h"
#include "host/batch/github.h"
#include "vkhausdorff/error.h"

namespace vkh {
namespace {

void note(const std::string& text) {
  std::fprintf(stderr, "vkhausdorff: note: %s\n", printable(text).c_str());
}

void warn(const std::string& text) {
  std::fprintf(stderr, "vkhausdorff: warning: %s\n", printable(text).c_str());
}

std::string worst_first(std::vector<std::pair<Rank, std::string>> rows) {
  std::sort(rows.begin(), rows.end(),
            [](const auto& x, const auto& y) { return is_worse(x.first, y.first); });
  std::string text;
  for (const auto& [rank, row] : rows) text += row;
  return text;
}

/// The CSV and JUnit XML of results, checked before the work.
class Tables {
 public:
  Tables(const Outputs& asked, const std::vector<std::string>& inputs) {
    if (asked.csv) csv_.emplace("--csv", *asked.csv, inputs);
    if (asked.junit) junit_.emplace("--junit", *asked.junit, inputs);
  }
  bool is_any() const { return csv_ || junit_; }

  void write(const Results& results, bool with_run) const {
    CsvColumns with{.run = with_run};
    results.for_each([&](const Result& result, const std::string&) {
      const std::optional<Metrics>& metrics = result.answer.metrics;
      with.sides = with.sides || sides_of(result.answer, false) != nullptr;
      with.metrics = with.metrics || metrics.has_value();
      with.normals = with.normals || (metrics && metrics->normals);
      if (metrics) with.distances = std::max(with.distances, metrics->within.size());
    });
    std::vector<std::pair<Rank, std::string>> rows;
    std::vector<JunitCase> cases;
    results.for_each([&](const Result& result, const std::string&) {
      if (csv_) rows.emplace_back(rank_of(result), csv_row(result, with));
      if (junit_) cases.push_back(junit_case(result, with_run));
    });
    if (csv_) csv_->write(csv_heading(with) + worst_first(std::move(rows)));
    if (junit_) junit_->write(to_junit(cases, "", ""));
  }

 private:
  std::optional<OutputFile> csv_, junit_;
};

PairList list_of(const Request& asked) {
  const auto& [files, against] = std::tie(asked.many.files, asked.many.against);
  if (!against.empty()) return list_against(against, files);
  if (files.size() == 1) return read_list(files[0]);
  return list_folders({files[0], asked.question.points_a}, {files[1], asked.question.points_b});
}

/// Refuses a file that is named twice: it would be read while it is written.
void check_outputs(const Outputs& asked) {
  if (asked.out == "-")
    throw UsageError("--out '-': expected the name of a file; one that is called so is ./-");
  std::set<std::filesystem::path> places{place_of(asked.out)};
  for (const auto& other : {asked.csv, asked.junit}) {
    if (other && !places.insert(place_of(*other)).second)
      throw UsageError("two outputs would be written to '" + *other + "'");
  }
}

/// Names the shard's files without a partner. Unless they are allowed, each is a failure.
void add_unpaired(const ManyRequest& asked, PairList& list, BatchJob& batch) {
  for (Entry& entry : list.unpaired) {
    if (!is_in(asked.shard, entry.id)) continue;
    warn(entry.one_file() + ": " + entry.missing);
    if (asked.allows_unpaired) {
      ++batch.unpaired;
    } else {
      batch.entries.push_back(std::move(entry));
    }
  }
}

std::vector<std::string> inputs_of(const ManyRequest& asked, const std::vector<Entry>& entries) {
  std::vector<std::string> inputs;
  const auto add = [&](const std::string& file) {
    if (!file.empty()) inputs.push_back(file);
  };
  add(asked.files.size() == 1 ? asked.files[0] : asked.against);
  for (const Entry& entry : entries) {
    add(entry.file_a);
    add(entry.file_b);
  }
  return inputs;
}

BatchJob batch_of(const Request& request, PairList& list) {
  const ManyRequest& asked = request.many;
  const Question& question = request.question;
  BatchJob batch;
  batch.asked = request;
  batch.asked
      .many = {};  // each pair has a copy of the request, and does not need the other pairs' names
  batch.asked.question.max_distance.reset();  // it only concerns pictures
  batch.shared = shared_files(list.entries);
  for (Entry& entry : list.entries) {
    if (is_in(asked.shard, entry.id)) batch.entries.push_back(std::move(entry));
  }
  add_unpaired(asked, list, batch);
  batch.results = request.outputs.out;
  batch.resumes = asked.resumes;
  batch.fails_fast = asked.fails_fast;
  batch.devices.together = asked.together;
  batch.devices.lanes = asked.lanes;
  batch.devices.devices = selectors_of(question.device);
  batch.devices.threads = question.threads;
  if (question.caches) batch.devices.cache_folder = user_cache_folder();
  batch.devices.first = engine_of(question);
  batch.read_ahead_bytes = asked.read_ahead_bytes;
  return batch;
}

/// Returns null if no folders were asked for.
std::shared_ptr<BatchFolders> folders_of(const Request& asked, const std::vector<Entry>& entries,
                                         std::vector<std::string> taken) {
  const ManyRequest& many = asked.many;
  const Outputs& outputs = asked.outputs;
  if (!many.image_folder && !many.report_folder) return nullptr;
  taken.push_back(outputs.out);
  for (const auto& table : {outputs.csv, outputs.junit}) {
    if (table) taken.push_back(*table);
  }
  return std::make_shared<BatchFolders>(asked, entries, taken);
}

/// Reports the pairs that were not drawn, and writes the indexes.
ExitCode write_indexes(const BatchJob& batch) {
  constexpr size_t kMost = 5;
  const BatchFolders& folders = *batch.folders;
  const std::vector<std::string> failures = folders.failures();
  for (size_t i = 0; i < std::min(failures.size(), kMost); ++i) note(failures[i]);
  if (failures.size() > kMost)
    note("and " + std::to_string(failures.size() - kMost) + " more pairs are not drawn");
  folders.write_indexes(batch.results, batch.entries, batch.asked.question.max.has_value());
  for (const std::string& file : folders.indexes())
    std::cout << "  index      " << printable(file) << '\n';
  if (!failures.empty()) return kExitNotWritten;
  return folders.left() > 0 ? kExitNotClosed : kExitClosed;
}

}  // namespace

namespace {

/// Tells GitHub Actions about the pairs of the batch.
ExitCode report_to_github(const BatchJob& batch) {
  const GithubTexts texts = github_texts(batch);
  std::cout << texts.annotations << std::flush;
  try {
    append_github_summary(texts.summary);
  } catch (const OutputError& error) {
    note(error.what());
    return kExitNotWritten;
  }
  return kExitClosed;
}

ExitCode run_asked_batch(const Request& request) {
  const Outputs& outputs = request.outputs;
  check_outputs(outputs);
  // Lines would be added to the list, and a last one without an end would be cut off.
  const std::string& first = request.many.files.front();
  std::error_code none;
  if (std::filesystem::equivalent(path_of(first), path_of(outputs.out), none))
    throw UsageError("--out '" + outputs.out + "': would overwrite the input '" + first + "'");
  PairList list = list_of(request);
  for (const std::string& text : list.notes) note(text);
  BatchJob batch = batch_of(request, list);
  const std::vector<std::string> inputs = inputs_of(request.many, batch.entries);
  const Tables tables(outputs, inputs);
  batch.folders = folders_of(request, batch.entries, inputs);
  ExitCode code = run_batch(batch, std::cout);
  if (tables.is_any()) {
    Results results;
    results.add(outputs.out);
    tables.write(results, true);
  }
  if (batch.folders) code = worse(code, write_indexes(batch));
  return outputs.github ? worse(code, report_to_github(batch)) : code;
}

}  // namespace

ExitCode run_batch_command(const Request& asked) {
  try {
    return run_asked_batch(asked);
  } catch (...) {
    const Failure failure = failure_of(error_of(std::current_exception()));
    if (asked.outputs.github) std::cout << github_annotation(failure) << std::flush;
    throw;
  }
}

namespace {

/// Merges the parts of one pair, measured apart. The answer is one line, like that of `distance
/// --json`.
ExitCode merge_all_parts(const Request& request, const std::vector<WrittenAnswer>& parts) {
  const ManyRequest& asked = request.many;
  const Outputs& outputs = request.outputs;
  if (!asked.list.empty() || asked.reproducible || outputs.csv || outputs.junit)
    throw UsageError(
        "merge: the parts of one pair make one answer: no --list, --reproducible, "
        "--csv or --junit");
  const OutputFile out("--out", outputs.out, asked.files);
  const Answer whole = merge_parts(parts);
  out.write(to_json(whole) + '\n');
  std::cout << in_words(whole) << "\n  parts      " << parts.size() << ": "
            << stop_reason(whole.a_to_b.status) << '\n';
  return code_of(whole);
}

}  // namespace

ExitCode run_merge_command(const Request& request) {
  const ManyRequest& asked = request.many;
  const Outputs& outputs = request.outputs;
  check_outputs(outputs);
  if (const auto parts = read_parts(asked.files); !parts.empty())
    return merge_all_parts(request, parts);
  std::vector<std::string> inputs = asked.files;
  if (!asked.list.empty()) inputs.push_back(asked.list);
  const OutputFile out("--out", outputs.out, inputs);
  const Tables tables(outputs, inputs);
  Results results;
  for (const std::string& file : asked.files) results.add(file);
  std::string text;
  Totals totals;
  results.for_each([&](const Result& result, const std::string& line) {
    text += (asked.reproducible ? without_run(line) : line) + '\n';
    totals.add(result);
  });
  std::vector<std::string> missing;
  if (!asked.list.empty()) {
    const PairList list = read_list(asked.list);
    for (const std::string& note_text : list.notes) note(note_text);
    for (const Entry& entry : list.entries) {
      if (!results.has(entry.id)) missing.push_back(entry.id);
    }
  }
  out.write(text);
  if (tables.is_any()) tables.write(results, !asked.reproducible);
  for (const std::string& id : missing) note("no result: " + id);
  totals.print_merged(std::cout, missing.size(), outputs.out);
  return missing.empty() ? totals.worst() : worse(totals.worst(), kExitNotClosed);
}

}  // namespace vkh
