#include "host/batch/github.h"

#include <algorithm>
#include <unordered_map>
#include <utility>

#include "host/answer/merge.h"
#include "host/answer/rank.h"
#include "host/base/system.h"
#include "host/batch/totals.h"

namespace vkh {
namespace {

constexpr size_t kMostRows = 100;  // GitHub takes 1 MiB of a step's summary

/// The texts of one pair.
struct OfPair {
  Rank rank;
  std::string annotation, row;
};

const char* level_of(Outcome outcome) {
  const bool is_error = outcome == Outcome::kBeyond || outcome == Outcome::kNoAnswer;
  return is_error ? "error" : outcome == Outcome::kOpen ? "warning" : "notice";
}

const char* mark_for(const std::string& level) {
  return level == "error" ? ":x:" : level == "warning" ? ":grey_question:" : ":white_check_mark:";
}

/// The path from here of the file that the annotation stands beside: A's, unless the error is of B.
/// GitHub looks for it as it is written, without resolving "..".
std::string file_beside(const Result& result, const Entry& entry) {
  const bool is_of_b =
      result.failure && result.failure->file == entry.b && result.failure->file != entry.a;
  const std::string& file = entry.file_a.empty() || is_of_b ? entry.file_b : entry.file_a;
  const std::u8string name = path_of(file).lexically_normal().generic_u8string();
  return {name.begin(), name.end()};
}

OfPair texts_of(const Result& result, const Entry& entry) {
  OfPair pair{.rank = rank_of(result), .annotation = {}, .row = {}};
  GithubAnnotation one{.level = level_of(pair.rank.outcome),
                       .file = file_beside(result, entry),
                       .title = "vkhausdorff batch: " + result.name.id,
                       .words = printable(result.words()),
                       .notes = server_notes(result.answer)};
  pair.row = std::string("| ") + mark_for(one.level) + " | " + github_code(result.name.id) + " | " +
             github_code(result.words());
  for (const std::string& note : one.notes) pair.row += "<br>" + github_code(note);
  pair.row += " |\n";
  if (one.level != "notice" || !one.notes.empty()) pair.annotation = github_line(one);
  return pair;
}

/// The level of a batch whose worst pair, if there is one, is this.
std::string level_of(const std::vector<OfPair>& pairs, size_t left) {
  const std::string level = pairs.empty() ? "notice" : level_of(pairs[0].rank.outcome);
  return level == "notice" && left > 0 ? "warning" : level;
}

std::string summary_of(const std::string& words, const std::vector<OfPair>& pairs,
                       const std::string& level) {
  std::string text = std::string("### ") + mark_for(level) + " vkhausdorff batch\n\n" +
                     github_code(words) + "\n\n| | pair | |\n|---|---|---|\n";
  for (size_t i = 0; i < std::min(pairs.size(), kMostRows); ++i) text += pairs[i].row;
  if (pairs.size() > kMostRows)
    text += "\nand " + std::to_string(pairs.size() - kMostRows) + " pairs more\n";
  return text + "\n";
}

}  // namespace

GithubTexts github_texts(const BatchJob& batch) {
  std::unordered_map<std::string, const Entry*> entries;
  for (const Entry& entry : batch.entries) entries.emplace(entry.id, &entry);
  Results results;
  results.add(batch.results);
  Totals totals;
  std::vector<OfPair> pairs;
  results.for_each([&](const Result& result, const std::string&) {
    const auto entry = entries.find(result.name.id);
    if (entry == entries.end()) return;
    totals.add(result);
    pairs.push_back(texts_of(result, *entry->second));
  });
  std::sort(pairs.begin(), pairs.end(),
            [](const OfPair& x, const OfPair& y) { return is_worse(x.rank, y.rank); });
  Totals::Run run;
  run.left = entries.size() - totals.pairs();
  run.has_limit = batch.asked.question.max.has_value();
  run.unpaired = batch.unpaired;
  const std::string words = totals.in_words(run);
  GithubTexts texts{
      .annotations = github_line(
          {.level = "notice", .file = {}, .title = "vkhausdorff batch", .words = words}),
      .summary = summary_of(words, pairs, level_of(pairs, run.left))};
  for (const OfPair& pair : pairs) texts.annotations += pair.annotation;
  return texts;
}

}  // namespace vkh
