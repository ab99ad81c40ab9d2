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
  GithubAnnotation one{.outcome = pair.rank.outcome,
                       .file = file_beside(result, entry),
                       .title = "vkhausdorff batch: " + result.name.id,
                       .words = printable(result.words()),
                       .notes = server_notes(result.answer)};
  pair.row = std::string("| ") + github_mark(one.outcome) + " | " + github_code(result.name.id) +
             " | " + github_code(result.words());
  for (const std::string& note : one.notes) pair.row += "<br>" + github_code(note);
  pair.row += " |\n";
  if (one.outcome <= Outcome::kOpen || !one.notes.empty()) pair.annotation = github_line(one);
  return pair;
}

/// The outcome of a batch: its worst pair's, or open if pairs are left.
Outcome outcome_of(const std::vector<OfPair>& pairs, size_t left) {
  const Outcome worst = pairs.empty() ? Outcome::kWithin : pairs[0].rank.outcome;
  return left > 0 ? std::min(worst, Outcome::kOpen) : worst;
}

std::string summary_of(const std::string& words, const std::vector<OfPair>& pairs,
                       Outcome outcome) {
  std::string text = std::string("### ") + github_mark(outcome) + " vkhausdorff batch\n\n" +
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
          {.outcome = Outcome::kWithin, .file = {}, .title = "vkhausdorff batch", .words = words}),
      .summary = summary_of(words, pairs, outcome_of(pairs, run.left))};
  for (const OfPair& pair : pairs) texts.annotations += pair.annotation;
  return texts;
}

}  // namespace vkh
