// The words of answers that are made here: what a first line says of a limit, and what it advises.
#include <doctest/doctest.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <sstream>
#include <string>

#include "host/answer/csv.h"
#include "host/answer/json_object.h"
#include "host/answer/result.h"
#include "host/answer/steps.h"
#include "host/answer/tables.h"
#include "vkhausdorff/note.h"

namespace {

using namespace vkh;

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

Question gate_question() {
  Question question;
  question.command = "gate";
  question.file_a = "a.stl";
  question.file_b = "b.stl";
  question.max = parse_length("--max", "0.1mm", PlainNumber::kRefused);
  return question;
}

/// An answer about 0.1 mm: its largest distance is in [lower, upper].
Answer gate(double lower, double upper) {
  Answer answer = unread_answer(gate_question());
  for (Input& input : answer.inputs) input.is_read = true;
  answer.unit = "mm";
  answer.max->limit = {0.1, 0.1};
  answer.a_to_b.diagonal_a = 10;
  answer.a_to_b.lower = lower;
  answer.a_to_b.upper = upper;
  answer.a_to_b.status = Status::kLimit;
  return answer;
}

SurveyResult survey(const Enclosure& share, SurveyEnd ended = SurveyEnd::kMet) {
  SurveyResult result;
  result.statistics.emplace();
  result.statistics->bands = {{.distance = 0.1, .share = share}};
  result.ended = ended;
  return result;
}

SignedFigures sides(const Enclosure& over, const Enclosure& under) {
  SignedFigures figures;
  figures.over = over;
  figures.under = under;
  return figures;
}

/// Whether so much of A's area, and of B's where it is given, is within the limit: 99 % are asked.
Answer by_area(const Enclosure& of_a, std::optional<Enclosure> of_b = {},
               SurveyEnd ended = SurveyEnd::kMet) {
  Answer answer = gate(0.2, 0.3);
  answer.max->area = 0.99;
  answer.max->area_requested = "99%";
  answer.survey_a = survey(of_a, ended);
  if (!of_b) return answer;
  answer.b_to_a = answer.a_to_b;
  answer.survey_b = survey(*of_b, ended);
  return answer;
}

std::string table_of(const Answer& answer) {
  std::ostringstream out;
  print_table(out, answer, false);
  return out.str();
}

TEST_CASE("a share of both areas names both, and first the one that decides") {
  CHECK(in_words(by_area({1, 1}, Enclosure{0.995, 0.996})) ==
        "PASS  at least 100 % of A's area is within 0.1 mm of B, and at least 99.499 % of B's area "
        "is within 0.1 mm of A, proven (99% asked)");
  CHECK(in_words(by_area({0.995, 1}, Enclosure{0.9, 0.95})) ==
        "FAIL  at most 95.01 % of B's area is within 0.1 mm of A, and at least 99.499 % of A's "
        "area is "
        "within 0.1 mm of B, proven (99% asked)");
  // B has the greater share of what is proven, and fails.
  CHECK(in_words(by_area({0, 1}, Enclosure{0.9, 0.95}))
            .starts_with("FAIL  at most 95.01 % of B's area is within 0.1 mm of A, and from 0 % to "
                         "100 % of A's area is within 0.1 mm of B"));
  const std::string one = in_words(by_area({0.995, 1}));
  CHECK(one.starts_with("PASS  at least 99.499 % of A's area is within 0.1 mm of B, proven (99%"));
  CHECK_FALSE(has(one, "B's area"));
}

TEST_CASE("what is undecided asks for more of what ended it") {
  const auto check = [](SurveyEnd ended, const std::string& advice) {
    const Answer area = by_area({0.98, 0.995}, {}, ended);
    CHECK(in_words(area) ==
          "UNDECIDED  from 97.99 % to 99.501 % of A's area is within 0.1 mm of B (99% "
          "asked); " +
              advice);
    Answer sided = gate(0.05, 0.3);
    sided.max->sides = AskedSides{parse_length("--max", "0.2mm", PlainNumber::kRefused),
                                  parse_length("--max", "0.1mm", PlainNumber::kRefused),
                                  {{0.2, 0.2}, {0.1, 0.1}}};
    sided.survey_a = survey({0, 1}, ended);
    CHECK(
        in_words(sided).ends_with("sides are not known: the limits are 0.2 mm over B and 0.1 mm "
                                  "under it; " +
                                  advice));
    sided.survey_a->sides = sides({0.05, 0.3}, {0.01, 0.3});
    CHECK(in_words(sided).ends_with("points without a side count as either; " + advice));
  };
  check(SurveyEnd::kEffort, "ask for more --effort");
  check(SurveyEnd::kTime, "ask for more --time");
  check(SurveyEnd::kCancelled, "it was interrupted");
  check(SurveyEnd::kMemory, "there was no memory for more");
  check(SurveyEnd::kBits, "no more --effort decides it");
}

TEST_CASE("lengths in a unit wait for the meshes") {
  Question question = gate_question();
  question.max_sides = SidedMax{*question.max, *question.max};
  const Answer unread = unread_answer(question);
  const Json json = Json::parse(to_json(unread));
  for (const char* at : {"/max/within", "/max/beyond", "/max/sides/over/within",
                         "/max/sides/under/beyond", "/tolerance/absolute", "/tolerance/diagonal"})
    CHECK(json.at(Json::json_pointer(at)).is_null());
  CHECK(to_json(answer_from_json(to_json(unread))) == to_json(unread));
  const std::string table = table_of(unread);
  CHECK(has(table, "  max        0.1mm\n"));
  CHECK(has(table, "  tolerance  1e-6 of diag(A)\n"));
  CHECK(Json::parse(to_json(gate(0.2, 0.3)))["max"]["within"] == 0.1);
}

TEST_CASE("a search that went on to the farthest point says so") {
  Answer answer = gate(0.2, 0.2001);
  CHECK(has(table_of(answer), "decided: the search stopped once the verdict was certain\n"));
  answer.max->worst = true;
  const std::string reason =
      "the verdict was certain, and the search went on to the farthest point";
  CHECK(has(table_of(answer), "decided: " + reason + "\n"));
  const Json json = Json::parse(to_json(answer));
  CHECK(json["stop_reason"] == reason);
  CHECK(json["directions"][0]["stop_reason"] == reason);
  CHECK(to_json(answer_from_json(to_json(answer))) == to_json(answer));
  answer = gate(0.01, 0.09);
  CHECK(has(in_words(answer), "; --worst narrows it"));
  answer.max->worst = true;
  CHECK_FALSE(has(in_words(answer), "--worst"));
}

// The cells of one row, by the heading's names.
std::string cell_of(const Answer& answer, const std::string& name) {
  std::istringstream text(csv_heading({}) + csv_row(result_of({"x", "key"}, answer), {}));
  CsvReader reader(text);
  const std::vector<std::string> names = *reader.next(), cells = *reader.next();
  return cells[static_cast<size_t>(std::find(names.begin(), names.end(), name) - names.begin())];
}

/// The result line, written and read.
Result reread(const Answer& answer) {
  return read_result(to_line(result_of({"x", "key"}, answer)));
}

TEST_CASE("an upper end that was not sought is no figure of a table") {
  const Answer failed = gate(0.25, 117);
  CHECK(cell_of(failed, "lower") == "0.25");
  CHECK(cell_of(failed, "upper").empty());
  CHECK(cell_of(failed, "gap").empty());
  CHECK(has(github_summary(failed), "| distance | `at least 0.25 mm` |"));
  CHECK(interval_of(reread(failed).answer).upper == 117);
  CHECK_FALSE(reread(failed).is_upper_sought());
  for (const Answer& sought : {gate(0.05, 0.3), gate(0.2, 0.2001), by_area({0.1, 0.2})}) {
    CHECK_FALSE(cell_of(sought, "upper").empty());
    CHECK_FALSE(cell_of(sought, "gap").empty());
    CHECK(has(github_summary(sought), "| interval | `["));
    CHECK(reread(sought).is_upper_sought());
  }
}

TEST_CASE("a share's remark follows its distance") {
  Answer answer = gate(0.2, 0.3);
  answer.max.reset();
  answer.metrics.emplace();
  MetricsWithin at;
  at.distance = 0.05;
  at.nsd.value = {0.697284, 0.925233, 0.916};
  answer.metrics->within = {at};
  answer.metrics->figures = {"nsd"};
  const std::vector<TableRow> rows = metrics_rows(answer);
  REQUIRE(rows.size() == 1);
  CHECK(rows[0].label == "nsd");
  CHECK(rows[0].text ==
        "91.6 %, in [69.7283, 92.5234] % within 0.05 mm; wider than asked: more "
        "--effort narrows it");
}

TEST_CASE("a figure that is not known reads as no value") {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Answer answer = gate(0.2, 0.3);
  answer.max.reset();
  answer.b_to_a = answer.a_to_b;
  Metrics& m = answer.metrics.emplace();
  m.hausdorff.value = {0.25, 0.25};
  m.hd_p.value = m.assd.value = m.chamfer_l1.value = {0, kInfinity};
  MetricsWithin& at = m.within.emplace_back();
  at.distance = 0.05;
  at.f1.value = {0, 1};
  CHECK(in_words(answer) ==
        "hausdorff 0.25 mm, hd95 not known, assd not known, chamfer_l1 not known, f1 not known "
        "within 0.05 mm; not all are as narrow as asked");
  m.figures = {"f1"};
  CHECK(metrics_rows(answer)[0].text == "not known within 0.05 mm");
}

TEST_CASE("limits of sides are conditional on a B that is not inside out") {
  Answer answer = gate(0.05, 0.15);
  answer.max->sides = AskedSides{parse_length("--max", "0.2mm", PlainNumber::kRefused),
                                 parse_length("--max", "0.1mm", PlainNumber::kRefused),
                                 {{0.2, 0.2}, {0.1, 0.1}}};
  answer.survey_a = survey({0, 1});
  answer.survey_a->sides = sides({0.05, 0.15}, {0.01, 0.02});
  CHECK(in_words(answer).starts_with("PASS  every point"));
  answer.notes = {
      note_of(NoteCode::kInsideOut, "B is inside out, so that over means inside it: x")};
  CHECK(in_words(answer).starts_with(
      "PASS  if the inputs are right (B is inside out, so that over means inside it): every"));
  answer.a_to_b.upper = 0.4;
  answer.survey_a->sides->over = {0.3, 0.35};
  CHECK(has(in_words(answer), ". Check the inputs: B is inside out"));
  answer.max->sides.reset();  // one limit for both sides
  CHECK_FALSE(has(in_words(answer), "inside out"));
}

TEST_CASE("what was not read of a file is said in the first line") {
  for (const auto& [code, text] : {std::pair{NoteCode::kSurfaces, "1 free-form surface not read"},
                                   {NoteCode::kCalls, "2 calls of other files not followed"},
                                   {NoteCode::kElements, "3 lines with points ignored"}}) {
    Answer answer = gate(0.05, 0.15);
    answer.max->length = parse_length("--max", "0.2mm", PlainNumber::kRefused);
    answer.max->limit = {0.2, 0.2};
    answer.inputs[1].notes = {note_of(code, text + std::string(": only the faces are measured"))};
    CHECK(in_words(answer).starts_with("PASS  if the inputs are right (B: " + std::string(text) +
                                       "): every point"));
    CHECK(has(to_junit(answer), text));
    CHECK(has(github_annotation(answer), "if the inputs are right (B: " + std::string(text)));
    answer.a_to_b.lower = answer.a_to_b.upper = 0.4;
    CHECK(has(in_words(answer), ". Check the inputs: B: " + std::string(text)));
  }
}

}  // namespace
