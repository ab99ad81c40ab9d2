#include "host/batch/index.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "host/answer/rank.h"
#include "host/base/decimal.h"
#include "host/base/rounding.h"
#include "host/batch/totals.h"
#include "host/show/page_assets.h"
#include "host/show/page_words.h"
#include "host/show/template.h"
#include "vkhausdorff/length.h"

namespace vkh {
namespace {

using Json = nlohmann::ordered_json;

constexpr uint32_t kThumbnail = 200;  // pixels of CSS

struct Mark {
  const char* style;
  std::string word;
};

Mark mark_of(const Result& result) {
  const char* const styles[] = {"fail", "fail", "open", "plain", "pass"};
  return {styles[static_cast<size_t>(outcome_of(result))], outcome_word(result)};
}

/// The ratio to A's diagonal: a lower bound if a pair is beyond its limit, since its run ends
/// there; else an upper bound.
std::string ratio_in_words(const Result& result) {
  const bool is_beyond = outcome_of(result) == Outcome::kBeyond;
  const CertifiedInterval whole = interval_of(result.answer);
  const double bound = is_beyond ? whole.lower : whole.upper;
  const double diagonal = result.answer.a_to_b.diagonal_a;
  if (!std::isfinite(bound) || !(diagonal > 0)) return "";
  if (!is_beyond) return "at most " + percent_up(divide_up(bound, diagonal));
  const double ratio = divide_down(bound, diagonal);
  return "at least " + decimal(multiply_down(100, ratio), 3, Rounding::kDown) + " %";
}

Limit limit_of(const Result& result) {
  return has_limit(result) ? result.answer.max->limit : Limit{};
}

std::string limit_in_words(const Result& result) {
  const std::string share = share_of_limit_text(result);
  return share.empty() ? "" : "at least " + share + " times";
}

/// The interval, or only the lower end if a run ended beyond its limit, since its upper end then
/// means nothing.
std::string deviation_in_words(const Result& result) {
  const CertifiedInterval whole = interval_of(result.answer);
  const Enclosure deviation{whole.lower, result.is_upper_sought()
                                             ? whole.upper
                                             : std::numeric_limits<double>::infinity()};
  const std::string text = figure_text(deviation, limit_of(result));
  return text == "not known" ? text : with_unit(text, result.answer.unit);
}

void sort_worst_first(std::vector<IndexRow>& rows) {
  std::sort(rows.begin(), rows.end(), [](const IndexRow& x, const IndexRow& y) {
    return is_worse(rank_of(x.result), rank_of(y.result));
  });
}

bool has_any_limit(const IndexContents& contents) {
  return std::any_of(contents.rows.begin(), contents.rows.end(),
                     [](const IndexRow& row) { return has_limit(row.result); });
}

/// The two parts of words that begin with a verdict and two spaces.
struct Said {
  std::string verdict, rest;
};
Said said_in(const std::string& words) {
  for (const char* verdict : {"PASS", "FAIL", "UNDECIDED"}) {
    const std::string start = std::string(verdict) + "  ";
    if (words.starts_with(start)) return {verdict, words.substr(start.size())};
  }
  return {"", words};
}

Json heading_of(const std::string& words) {
  const auto [verdict, rest] = said_in(words);
  const char* style = verdict.empty()     ? "plain"
                      : verdict == "PASS" ? "pass"
                      : verdict == "FAIL" ? "fail"
                                          : "open";
  return {{"words", words},
          {"style", style},
          {"verdict", verdict.empty() ? "DISTANCE" : verdict},
          {"rest", rest}};
}

/// The words of a result without the advice for another run.
std::string without_advice(const std::string& words) {
  const size_t end = std::min(
      {words.find("; ask for "), words.find(". A to B only"), words.find("; --"), words.size()});
  return words.substr(0, end);
}

/// The words that its row's other cells do not have: a PASS has its limit, and a warning where its
/// words begin with one.
std::string more_words(const Result& result) {
  const std::string rest = said_in(result.words()).rest;
  if (outcome_of(result) == Outcome::kClosed) return "";
  if (outcome_of(result) != Outcome::kWithin) return without_advice(rest);
  const size_t warning = rest.starts_with("if the inputs are right") ? rest.find("): ") : 0;
  if (warning != 0 && warning != std::string::npos) return rest.substr(0, warning + 1);
  if (!has_limit(result)) return "";
  return "limit " + with_unit(length_in_words(limit_of(result)), result.answer.unit);
}

std::string colours_in_words(const IndexContents& contents) {
  const auto has_verdict = [](const IndexRow& row) { return row.result.answer.max.has_value(); };
  const auto& rows = contents.rows;
  std::string text;
  if (std::any_of(rows.begin(), rows.end(), has_verdict))
    text += "Where there is a limit, faces are within it, beyond it, or not known and hatched. ";
  if (std::all_of(rows.begin(), rows.end(), has_verdict)) return text;
  if (!contents.look.range)
    return text +
           "Each picture has its own range of colours, so that colours of two cannot be "
           "compared.";
  const auto& [from, to] = *contents.look.range;
  return text + "Colours of lengths have the same range in every picture: " + from.requested +
         " to " + to.requested + ".";
}

Json head_of(const IndexContents& contents) {
  Totals totals;
  for (const IndexRow& row : contents.rows) totals.add(row.result);
  Totals::Run run;
  run.left = contents.left;
  run.has_limit = contents.has_limit;
  Json view = heading_of(totals.in_words(run));
  const std::string percentiles = totals.percentiles();
  view["paragraphs"] = Json::array();
  if (!percentiles.empty())
    view["paragraphs"].push_back(
        "Largest deviations without a limit, at most, of A's diagonal: " + percentiles + ".");
  if (contents.has_pictures) view["paragraphs"].push_back(colours_in_words(contents));
  view["paragraphs"].push_back("Results: " + contents.results);
  return view;
}

Json pictures_of(const IndexRow& row, const PictureOptions& options) {
  Json pictures = Json::array();
  for (const std::string& file : row.pictures)
    pictures.push_back({{"file", file},
                        {"mesh", file == row.pictures[0] ? "A" : "B"},
                        {"width", kThumbnail},
                        {"height", kThumbnail * options.height / options.width}});
  return pictures;
}

Json row_of(const IndexRow& row, const IndexContents& contents) {
  const Result& result = row.result;
  const bool has_answer = result.has_answer();
  const Mark mark = mark_of(result);
  return {{"name", result.name.id},
          {"more", more_words(result)},
          {"style", mark.style},
          {"word", mark.word},
          {"deviation", has_answer ? deviation_in_words(result) : ""},
          {"of_limit", limit_in_words(result)},
          {"of_diagonal", has_answer ? ratio_in_words(result) : ""},
          {"none", has_answer ? "none" : ""},
          {"report", row.report},
          {"pictures", pictures_of(row, contents.look.options)}};
}

}  // namespace

std::string to_index(IndexContents contents) {
  sort_worst_first(contents.rows);
  Json view = head_of(contents);
  view["count"] = contents.rows.size();
  view["program"] = std::string("VkHausdorff ") + program_version();
  view["has_limits"] = has_any_limit(contents);
  view["has_reports"] = contents.has_reports;
  view["has_pictures"] = contents.has_pictures;
  view["style_sheet"] = std::string(kIndexStyle);
  view["style_hash"] = std::string(kIndexStyleHash);
  view["rows"] = Json::array();
  for (const IndexRow& row : contents.rows) view["rows"].push_back(row_of(row, contents));
  return rendered(kIndexTemplate, view);
}

}  // namespace vkh
