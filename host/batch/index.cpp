#include "host/batch/index.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "host/answer/rank.h"
#include "host/base/decimal.h"
#include "host/batch/totals.h"
#include "host/show/escape.h"
#include "host/show/page_markup.h"

namespace vkh {
namespace {

constexpr uint32_t kThumbnail = 200;  // pixels of CSS

// Colours and sizes are the report's (tools/page/src/style.css). Nothing may be fetched or run.
constexpr const char* kHead = R"(<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; img-src 'self' file:; style-src 'unsafe-inline'">
<meta name="viewport" content="width=device-width, initial-scale=1">
<style>
:root { --ink: #1b2330; --soft: #566174; --line: #d9dee6; --panel: #f5f7fa; --pass: #146c37; --fail: #b3161f; --amber: #8a5300; --plain: #2b4a76;
  font: 15px/1.45 system-ui, -apple-system, "Segoe UI", Roboto, "Helvetica Neue", "DejaVu Sans", Arial, sans-serif;
  color: var(--ink); background: #fff; font-variant-numeric: tabular-nums; }
body { margin: 0 auto; max-width: 1200px; padding: 20px 28px; }
.kind, .notes, small { color: var(--soft); font-size: 13px; }
h1 { display: flex; align-items: stretch; margin: 8px 0 14px; border: 1px solid var(--line); border-radius: 8px; overflow: hidden; font-size: 17px; font-weight: 400; }
h1 b { padding: 12px 20px; font-size: 22px; color: #fff; }
h1 span { padding: 12px 18px; align-self: center; }
p { margin: 4px 0; }
table { border-collapse: collapse; width: 100%; margin-top: 18px; }
thead th { font-size: 13px; color: var(--soft); font-weight: 600; border-bottom: 2px solid var(--line); }
th, td { text-align: left; vertical-align: top; padding: 8px 18px 8px 0; }
tbody tr { border-bottom: 1px solid var(--line); break-inside: avoid; }
tbody th { font-weight: 600; overflow-wrap: anywhere; min-width: 15em; }
tbody th small { display: block; font-weight: 400; }
.number { white-space: nowrap; }
.mark { display: inline-block; padding: 1px 9px; border-radius: 5px; font-size: 13px; font-weight: 650; color: #fff; white-space: nowrap; }
.pass { background: var(--pass); } .fail { background: var(--fail); } .open { background: var(--amber); } .plain { background: var(--plain); }
img { margin: 0 0 4px; height: auto; border: 1px solid var(--line); border-radius: 5px; background: var(--panel); }
td:last-child, thead th:last-child { padding-right: 0; }
a { color: #1f56b5; }
@media print {
  @page { margin: 12mm; }
  :root { font-size: 11px; }
  body { padding: 0; }
  h1 b { font-size: 16px; } h1 { font-size: 13px; }
  .kind, .notes, small, .mark, thead th { font-size: 10px; }
  th, td { padding: 6px 10px 6px 0; }
  tbody th { min-width: 12em; }
  .number { white-space: normal; }
  img { width: 32mm; }
  .mark, h1 b { print-color-adjust: exact; -webkit-print-color-adjust: exact; }
}
</style>
)";

struct Mark {
  const char* style;
  std::string word;
};

Mark mark_of(const Record& record) {
  const char* const styles[] = {"fail", "fail", "open", "plain", "pass"};
  return {styles[static_cast<size_t>(outcome_of(record))], outcome_word(record)};
}

/// The ratio to A's diagonal: a lower bound if a pair is beyond its limit, since its run ends
/// there; else an upper bound.
std::string ratio_in_words(const Record& record) {
  const bool is_beyond = outcome_of(record) == Outcome::kBeyond;
  const double bound = is_beyond ? record.lower : record.upper;
  if (!std::isfinite(bound) || !(record.diagonal > 0)) return "";
  const double ratio = bound / record.diagonal;
  if (is_beyond) return "at least " + decimal(100 * ratio, 3, Rounding::kDown) + " %";
  return "at most " + percent_up(ratio);
}

std::string limit_in_words(const Record& record) {
  const std::string share = share_of_limit_text(record);
  return share.empty() ? "" : "at least " + share + " times";
}

/// The interval, or the lower end alone if a run ended beyond its limit: its upper end means
/// nothing.
std::string distance_in_words(const Record& record) {
  Answer units;
  units.unit = record.unit;
  const bool is_beyond = outcome_of(record) == Outcome::kBeyond;
  return range_text(
      units, {record.lower, is_beyond ? std::numeric_limits<double>::infinity() : record.upper});
}

void sort_worst_first(std::vector<IndexRow>& rows) {
  std::sort(rows.begin(), rows.end(), [](const IndexRow& x, const IndexRow& y) {
    return is_worse(rank_of(x.record), rank_of(y.record));
  });
}

bool has_any_limit(const IndexContents& contents) {
  return std::any_of(contents.rows.begin(), contents.rows.end(),
                     [](const IndexRow& row) { return row.record.limit.beyond > 0; });
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

/// The heading in the style of the report's badge.
std::string heading_of(const std::string& words) {
  const auto [verdict, rest] = said_in(words);
  const char* style = verdict.empty()     ? "plain"
                      : verdict == "PASS" ? "pass"
                      : verdict == "FAIL" ? "fail"
                                          : "open";
  return std::string("<h1><b class=\"") + style + "\">" + (verdict.empty() ? "DISTANCE" : verdict) +
         "</b><span>" + html_text(rest) + "</span></h1>\n";
}

/// The words that its row's other cells do not have.
std::string more_words(const Record& record) {
  const bool says_more = record.code != kExitClosed || !record.verdict.empty();
  return says_more ? "<small>" + html_text(said_in(record.words).rest) + "</small>" : "";
}

std::string paragraph(const std::string& text) {
  return "<p class=\"notes\">" + html_text(text) + "</p>\n";
}

std::string colours_in_words(const IndexContents& contents) {
  const auto has_verdict = [](const IndexRow& row) { return !row.record.verdict.empty(); };
  const auto& rows = contents.rows;
  std::string text;
  if (std::any_of(rows.begin(), rows.end(), has_verdict))
    text +=
        "Where a limit was asked about, faces are proven within it, proven beyond it, or undecided "
        "and hatched. ";
  if (std::all_of(rows.begin(), rows.end(), has_verdict)) return text;
  if (!contents.look.range)
    return text +
           "Each picture has its own range of colours, so that colours of two say nothing of each "
           "other. --range gives them one.";
  const auto& [from, to] = *contents.look.range;
  return text + "Colours of lengths have the same range in every picture: " + from.requested +
         " to " + to.requested + ".";
}

std::string head_of(const IndexContents& contents) {
  Totals totals;
  for (const IndexRow& row : contents.rows) totals.add(row.record);
  Totals::Run run;
  run.left = contents.left;
  run.has_limit = contents.has_limit;
  const std::string words = totals.in_words(run), percentiles = totals.percentiles();
  std::string text = kHead;
  text += "<title>" + html_text(words) + "</title>\n</head>\n<body>\n";
  text += "<p class=\"kind\">VkHausdorff " + std::string(program_version()) +
          ": certified distances of many pairs, the worst first</p>\n";
  text += heading_of(words);
  if (!percentiles.empty())
    text += paragraph("Upper bounds without a limit, of diag(A): " + percentiles + ".");
  text += paragraph(colours_in_words(contents));
  return text + paragraph("Results: " + contents.results);
}

std::string pictures_of(const IndexRow& row, const PictureOptions& options) {
  const std::string size = " width=\"" + std::to_string(kThumbnail) + "\" height=\"" +
                           std::to_string(kThumbnail * options.height / options.width) + "\"";
  std::string text;
  for (const std::string& file : row.pictures) {
    const char* mesh = file == row.pictures[0] ? "A" : "B";
    text.append("<a href=\"").append(file).append("\"><img src=\"").append(file);
    text.append("\" alt=\"").append(mesh).append(" of ").append(html_text(row.record.name.id));
    text.append("\" loading=\"lazy\"").append(size).append("></a>");
  }
  return text;
}

std::string row_of(const IndexRow& row, const IndexContents& contents, bool has_limits) {
  const Record& record = row.record;
  const bool has_answer = !record.status.empty();
  const std::string none = has_answer ? "<small>none</small>" : "";
  const auto cell = [](const char* style, const std::string& html) {
    return std::string("<td class=\"") + style + "\">" + html + "</td>";
  };
  const Mark mark = mark_of(record);
  std::string text =
      "<tr><th scope=\"row\">" + html_text(record.name.id) + more_words(record) + "</th>";
  text += "<td><span class=\"mark " + std::string(mark.style) + "\">" + mark.word + "</span></td>";
  text += cell("number", has_answer ? html_text(distance_in_words(record)) : "");
  if (has_limits) text += cell("number", limit_in_words(record));
  text += cell("number", has_answer ? ratio_in_words(record) : "");
  if (contents.has_reports)
    text += cell("", row.report.empty() ? none : "<a href=\"" + row.report + "\">report</a>");
  if (contents.has_pictures)
    text += cell("", row.pictures.empty() ? none : pictures_of(row, contents.look.options));
  return text + "</tr>\n";
}

}  // namespace

std::string to_index(IndexContents contents) {
  sort_worst_first(contents.rows);
  const bool has_limits = has_any_limit(contents);
  std::string text = head_of(contents);
  text +=
      "<table>\n<thead><tr><th scope=\"col\">Pair</th><th scope=\"col\">Verdict</th>"
      "<th scope=\"col\">Distance</th>";
  if (has_limits) text += "<th scope=\"col\">Of its limit</th>";
  text += "<th scope=\"col\">Of diag(A)</th>";
  if (contents.has_reports) text += "<th scope=\"col\">Report</th>";
  if (contents.has_pictures) text += "<th scope=\"col\">Picture</th>";
  text += "</tr></thead>\n<tbody>\n";
  for (const IndexRow& row : contents.rows) text += row_of(row, contents, has_limits);
  return text + "</tbody>\n</table>\n</body>\n</html>\n";
}

}  // namespace vkh
