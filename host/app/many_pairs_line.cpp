#include "host/app/many_pairs_line.h"

#include <CLI/CLI.hpp>
#include <limits>
#include <utility>

#include "host/answer/options.h"
#include "vkhausdorff/error.h"

namespace vkh {
namespace {

// A few pairs that need more would take most of the list's time (docs/log/measurements.md).
constexpr uint64_t kEffortOfMetrics = 1'000'000;

void add_tables(CLI::App& command, TypedMany& typed) {
  command
      .add_option("--out", typed.results,
                  "The results: one JSON object a line, a line a pair (JSONL)")
      ->type_name("FILE")
      ->required();
  command.add_option("--csv", typed.csv, "Write them as CSV, too")->type_name("FILE");
  command
      .add_option("--junit", typed.of_pairs.junit,
                  "Write a test suite, a test case a pair: JUnit's XML")
      ->type_name("FILE");
}

TablesAsked tables_of(const TypedMany& typed) {
  TablesAsked tables;
  if (!typed.csv.empty()) tables.csv = typed.csv;
  if (!typed.of_pairs.junit.empty()) tables.junit = typed.of_pairs.junit;
  return tables;
}

void add_limits(CLI::App& command, Typed& typed) {
  command
      .add_option("--max", typed.max,
                  std::string("Ask whether each is within a limit: ") + kLengths +
                      "; or one over B, in front of its faces, and one under it: +0.25mm,-0.4mm")
      ->type_name("LENGTH");
  command
      .add_option(
          "--tol", typed.tolerance,
          std::string("Width of the intervals: ") + kLengths +
              ", or a number alone up to 1e-3, a fraction of the diagonal [1e-6; with --max "
              "1e-7]")
      ->type_name("LENGTH");
  add_symmetric(command, typed);
  add_unit_and_input(command, typed);
  command.add_option("--time", typed.time,
                     "End a pair's run after so long: 250ms, 10s, 2min [no limit]");
}

/// Tells a list, two folders, and meshes against one apart.
void put_source(const TypedMany& typed, BatchAsked& batch) {
  const bool is_of_folders = typed.against.empty() && typed.files.size() == 2;
  if (typed.against.empty() && typed.files.size() > 2)
    throw UsageError("batch: expected one LIST, two folders, or --against B with meshes");
  if (typed.allows_unpaired && !is_of_folders)
    throw UsageError("--allow-unpaired: is of two folders: batch FOLDER_A FOLDER_B");
  batch.against = typed.against;
  batch.allows_unpaired = typed.allows_unpaired;
  if (!typed.against.empty()) {
    batch.parts = typed.files;
  } else if (is_of_folders) {
    batch.folder_a = typed.files[0];
    batch.folder_b = typed.files[1];
  } else {
    batch.list = typed.files[0];
  }
}

}  // namespace

void add_batch(CLI::App& command, TypedMany& typed) {
  command.footer("LIST has " + list_columns() +
                 ": JSONL, or CSV with a heading. Its files' names are of its own folder.");
  command
      .add_option("LIST", typed.files,
                  "A list of pairs; or two folders, A's and B's, whose meshes are paired by their "
                  "names; with --against, meshes to start from, each a pair")
      ->required();
  command.add_option("--against", typed.against, "One mesh to go to for all that are named")
      ->type_name("B");
  command.add_flag("--allow-unpaired", typed.allows_unpaired,
                   "Name and count the meshes of two folders that have no partner, and let them "
                   "cost no exit code [each is a pair without an answer, code 4]");
  add_tables(command, typed);
  command.add_flag(
      "--github", typed.of_pairs.github,
      "Print workflow annotations for GitHub Actions, of all pairs and of each that is "
      "no PASS, and add to the summary of the run ($GITHUB_STEP_SUMMARY)");
  command.add_flag("--resume", typed.resumes,
                   "Keep the results that there are, and do what they have not, or not of these "
                   "inputs and options");
  command
      .add_option(
          "--shard", typed.shard,
          "Do one of n parts of the list, i from 0; which pairs it has is a matter of their "
          "ids alone")
      ->type_name("i/n");
  command.add_flag("--fail-fast", typed.fails_fast,
                   "End with the first pair that is beyond its limit or has no answer");
  add_limits(command, typed.of_pairs);
  add_signed_option(command, typed.of_pairs, "with the signed mean and percentiles");
  command.add_flag("--metrics", typed.of_pairs.metrics,
                   "Both directions' figures by the names that papers use, as of 'metrics'");
  add_metrics_options(command, typed.of_pairs);
  add_folder_options(command, typed.of_pairs.pictures);
  add_effort_option(command, typed.of_pairs,
                    "; with --metrics " + std::to_string(kEffortOfMetrics));
  add_max_distance_option(command, typed.of_pairs, "pictures and pages");
  command.add_option("--device", typed.of_pairs.device,
                     "Devices, between commas, as 'doctor' names them; all: every GPU [the best]");
  command.add_option("--together", typed.together,
                     "Pairs side by side on a device [16 on a GPU, 1 on a CPU]");
  command.add_option("--lanes", typed.lanes,
                     "Groups of them at a time on a device [3 on a GPU, 1 on a CPU]");
  command.add_option("--read-ahead", typed.read_ahead,
                     "Memory for meshes that are read and not solved yet [2GiB]");
  add_engine_options(command, typed.of_pairs);
}

void add_merge(CLI::App& command, TypedMany& typed) {
  command
      .add_option("RESULTS", typed.files,
                  "Results of batches; or the answers of all parts of one pair")
      ->required();
  add_tables(command, typed);
  command
      .add_option("--list", typed.list,
                  "Name the pairs of this list that have no result; exit code 3 if there are any")
      ->type_name("LIST");
  command.add_flag("--reproducible", typed.reproducible,
                   "Leave out times, hosts and devices, so that two runs can be compared byte for "
                   "byte");
}

namespace {

void check_metrics(const Typed& typed) {
  if (typed.metrics && !typed.max.empty())
    throw UsageError("--metrics: figures are no verdict: leave out --max, or ask for it by itself");
  const bool has_more = !typed.bands.empty() || !typed.percentile.empty() ||
                        !typed.figures.empty() || !typed.normals.empty();
  if (!typed.metrics && has_more)
    throw UsageError("--bands, --percentile, --figures, --normals: are of --metrics");
}

}  // namespace

CommandLine batch_line(const TypedMany& typed, const Words& words) {
  Typed of_pairs = typed.of_pairs;
  const bool has_limit = !of_pairs.max.empty();
  if (of_pairs.tolerance.empty()) of_pairs.tolerance = has_limit ? "1e-7" : "1e-6";
  CommandLine line;
  line.command = Command::kBatch;
  check_metrics(of_pairs);
  line.question = question_of(of_pairs, words, "batch");
  line.question.tolerance_is_typed = !typed.of_pairs.tolerance.empty();
  line.question.statistics = line.question.is_signed;  // a line of results has figures
  if (line.question.metrics && !line.question.effort) line.question.effort = kEffortOfMetrics;
  BatchAsked& batch = line.batch;
  put_source(typed, batch);
  batch.results = typed.results;
  if (!typed.shard.empty()) batch.shard = parse_shard(typed.shard);
  batch.resumes = typed.resumes;
  batch.fails_fast = typed.fails_fast;
  batch.github = typed.of_pairs.github;
  batch.device = of_pairs.device;
  batch.devices.together = typed.together;
  batch.devices.lanes = typed.lanes;
  if (typed.read_ahead) batch.read_ahead_bytes = parse_size("--read-ahead", *typed.read_ahead);
  batch.time_limit_s =
      of_pairs.time ? parse_time(*of_pairs.time) : std::numeric_limits<double>::infinity();
  batch.tables = tables_of(typed);
  batch.folders = folders_of(of_pairs.pictures);
  const bool may_survey =  // pairs of a list may ask for it
      !batch.list.empty() || batch.folders.any() || line.question.asks_for_survey();
  if (line.question.effort && !may_survey)
    throw UsageError(
        "--effort: is of figures and of what is drawn: ask for --signed, --metrics, "
        "--image-dir or --report-dir");
  batch.folders.effort = line.question.effort;
  batch.folders.max_distance = std::exchange(line.question.max_distance, std::nullopt);
  return line;
}

CommandLine merge_line(const TypedMany& typed) {
  CommandLine line;
  line.command = Command::kMerge;
  line.merge = {.files = typed.files,
                .results = typed.results,
                .list = typed.list,
                .reproducible = typed.reproducible,
                .tables = tables_of(typed)};
  return line;
}

}  // namespace vkh
