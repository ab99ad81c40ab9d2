// Printed numbers: what has no "at least" or "at most" lies in its interval, and an estimate lies
// between the ends that are printed beside it. Random enclosures, every printer of host/answer.
#include <doctest/doctest.h>
#include <gmpxx.h>

#include <cmath>
#include <limits>
#include <random>
#include <regex>
#include <sstream>
#include <vector>

#include "host/answer/steps.h"
#include "host/answer/tables.h"
#include "host/base/decimal.h"
#include "tests/support/decimal_value.h"
#include "vkhausdorff/answer.h"

namespace {

using namespace vkh;
using namespace vkh::test;
using Q = mpq_class;

class Random {
 public:
  explicit Random(uint64_t seed) : engine_(seed) {}
  uint64_t below(uint64_t count) { return engine_() % count; }
  double unit() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
  double log_uniform(double low, double high) {
    return std::pow(10, std::log10(low) + unit() * (std::log10(high) - std::log10(low)));
  }

 private:
  std::mt19937_64 engine_;
};

/// From one double to as wide as it is large, about sizes that decimals like: 0.3 and 50.8, too.
Enclosure random_enclosure(Random& random) {
  const double round[] = {0.3, 50.8, 1, 0.1, 1e-5, 123456};
  const double size = random.below(3) == 0 ? round[random.below(6)] : random.log_uniform(1e-9, 1e9);
  const uint64_t ulps = random.below(4);
  Enclosure e{size, size};
  if (random.below(3) == 0) {  // neighbouring doubles
    for (uint64_t i = 0; i < ulps; ++i)
      e.upper = std::nextafter(e.upper, std::numeric_limits<double>::infinity());
  } else {
    const double width = size * random.log_uniform(1e-16, 1);
    e = {size - width * random.unit(), size + width * random.unit()};
  }
  const uint64_t where = random.below(4);  // an estimate may be an end
  e.estimate = where == 0 ? e.lower
               : where == 1
                   ? e.upper
                   : std::clamp(e.lower + random.unit() * (e.upper - e.lower), e.lower, e.upper);
  return e;
}

Enclosure random_share(Random& random) {
  const Enclosure e = random_enclosure(random);
  const double scale = std::max(1.0, e.upper);
  Enclosure share{std::min(e.lower / scale, 1.0), std::min(e.upper / scale, 1.0)};
  share.estimate = std::clamp(*e.estimate / scale, share.lower, share.upper);
  return share;
}

Enclosure negative(const Enclosure& e) {
  Enclosure out{-e.upper, -e.lower};
  out.estimate = -*e.estimate;
  return out;
}

/// Whether the text is in the interval. A double of many digits may be given by enough digits to
/// name it.
bool is_inside(const std::string& text, const Enclosure& e) {
  const Q value = decimal_value(text);
  if (value >= Q(e.lower) && value <= Q(e.upper)) return true;
  return e.lower == e.upper && std::stod(text) == e.lower;
}

bool is_between(const std::string& text, const std::string& low, const std::string& high) {
  const Q value = decimal_value(text);
  return value >= decimal_value(low) && value <= decimal_value(high);
}

Question gate_question() {
  Question question;
  question.command = "gate";
  question.max = parse_length("--max", "0.1abs", PlainNumber::kRefused);
  return question;
}

/// An answer whose limit is off the interval by about its width, or by what it is.
Answer answer_of(Random& random, const Enclosure& e) {
  Answer answer = unread_answer(gate_question());
  for (Input& input : answer.inputs) input.is_read = true;
  answer.a_to_b.diagonal_a = 1;
  answer.a_to_b.lower = e.lower;
  answer.a_to_b.upper = e.upper;
  answer.a_to_b.status = Status::kLimit;
  const double off = random.below(2) == 0 ? 0.3 * e.lower : 1e-14 * e.lower;
  const double limit = random.below(2) == 0 ? e.lower - off : e.upper + off;
  answer.max->limit = {limit, limit};
  return answer;
}

/// The number behind `before`, if the text has it; empty: it says "at least", "at most" or a range.
std::string number_behind(const std::string& text, const std::string& before) {
  const size_t at = text.find(before);
  if (at == std::string::npos) return "";
  const size_t begin = at + before.size();
  return text.substr(begin, text.find_first_not_of("0123456789.e+-", begin) - begin);
}

Metric metric_of(const Enclosure& e) { return {.value = e, .is_met = true}; }

Metrics random_metrics(Random& random) {
  Metrics metrics;
  metrics.percentile = 95;
  for (const NamedMetric& named : kNamedMetrics)
    metrics.*named.figure = metric_of(random_enclosure(random));
  metrics.normals = 30;
  metrics.normal_consistency = metric_of(random_share(random));
  MetricsWithin& at = metrics.within.emplace_back();
  at.distance = 0.1;
  for (const NamedShare& named : kNamedShares) at.*named.figure = metric_of(random_share(random));
  return metrics;
}

Statistics random_statistics(Random& random) {
  Statistics s;
  s.mean = random_enclosure(random);
  s.rms = random_enclosure(random);
  s.bands = {{.distance = 0.1, .share = random_share(random)}};
  s.percentiles = {{0.5, random_enclosure(random)}, {0.95, random_enclosure(random)}};
  return s;
}

SignedFigures random_sides(Random& random) {
  SignedFigures sides;
  sides.over = random_enclosure(random);
  sides.under = random_enclosure(random);
  sides.mean = random.below(2) == 0 ? random_enclosure(random) : negative(random_enclosure(random));
  sides.percentiles = {{0.05, negative(random_enclosure(random))},
                       {0.95, random_enclosure(random)}};
  return sides;
}

/// Checks "ESTIMATE, in [LOWER, UPPER]" wherever the text has it, and returns how often.
int check_figures(const std::string& text) {
  static const std::regex figure(R"((-?[0-9][0-9.e+-]*)(?: %)?, in \[(-?[0-9][^,]*), ([^\]]*)\])");
  int found = 0;
  for (std::sregex_iterator it(text.begin(), text.end(), figure), end; it != end; ++it) {
    CAPTURE(it->str());
    CHECK(is_between((*it)[1], (*it)[2], (*it)[3]));
    ++found;
  }
  return found;
}

/// Checks every object of JSON's text that has both ends and an estimate.
int check_json(const std::string& text) {
  static const std::regex ends(R"re("lower":([^,]*),"lower_hex":"[^"]*","upper":([^,]*),)re"
                               R"re("upper_hex":"[^"]*","estimate":([^,}]*))re");
  int found = 0;
  for (std::sregex_iterator it(text.begin(), text.end(), ends), end; it != end; ++it) {
    CAPTURE(it->str());
    CHECK(is_between((*it)[3], (*it)[1], (*it)[2]));
    ++found;
  }
  return found;
}

constexpr int kCases = 3000;

}  // namespace

TEST_CASE("a number in an enclosure is inside, with as few digits as it takes") {
  Random random(1);
  for (int i = 0; i < 20000; ++i) {
    const Enclosure plain = random_enclosure(random);
    const Enclosure e = random.below(4) == 0 ? negative(plain) : plain;
    CAPTURE(e.lower);
    CAPTURE(e.upper);
    CAPTURE(*e.estimate);
    const std::string inside = decimal_inside(*e.estimate, e.lower, e.upper, 4);
    CAPTURE(inside);
    CHECK(is_inside(inside, e));
    const std::string between = decimal_between(*e.estimate, e.lower, e.upper);
    CAPTURE(between);
    CHECK(is_between(between, decimal(e.lower, kJsonDigits, Rounding::kDown),
                     decimal(e.upper, kJsonDigits, Rounding::kUp)));
    CHECK(std::stod(between) == *e.estimate);
  }
  CHECK(decimal_inside(0.29999999999, 0.29999999999, 0.30000000191, 4) == "0.3");
  CHECK(decimal_inside(50.8000015, 50.799999, 50.800003, 4) == "50.8");
  CHECK(decimal_inside(0.34567, 0.345669, 0.345671, 4) == "0.34567");
  CHECK(decimal_inside(0.34567, 0.3, 0.4, 4) == "0.3457");
  CHECK(decimal_inside(0.1, 0.1, 0.1, 4) == "0.1");
  CHECK(decimal_inside(0, -1, 1, 4) == "0");
  CHECK(decimal_inside(9.9999, 9.99985, 10, 2) == "10");
  CHECK(decimal_between(0.1, 0.1, 0.1) == "0.100000000000000005");
  CHECK(decimal_between(0.1, 0, 1) == "0.1");
  CHECK(decimal_between(-0.25, -0.25, 1) == "-0.25");
}

TEST_CASE("a verdict's distance is inside its interval") {
  Random random(2);
  int failed = 0, passed = 0;
  for (int i = 0; i < kCases; ++i) {
    const Enclosure e = random_enclosure(random);
    const Answer answer = answer_of(random, e);
    const std::string words = in_words(answer);
    CAPTURE(words);
    CAPTURE(e.lower);
    CAPTURE(e.upper);
    const std::string distance = number_behind(words, "FAIL  ");
    const std::string largest = number_behind(words, "largest deviation ");
    failed += distance.empty() ? 0 : 1;
    passed += largest.empty() ? 0 : 1;
    if (!distance.empty()) CHECK(is_inside(distance, e));
    if (!distance.empty()) CHECK(decimal_value(distance) > Q(answer.max->limit.beyond));
    if (!largest.empty()) CHECK(is_inside(largest, e));
    if (!largest.empty()) CHECK(decimal_value(largest) <= Q(answer.max->limit.within));
  }
  CHECK(failed > kCases / 8);
  CHECK(passed > kCases / 8);
}

TEST_CASE("a side's distance is inside its interval") {
  Random random(3);
  int failed = 0;
  for (int i = 0; i < kCases; ++i) {
    const Enclosure e = random_enclosure(random);
    Answer answer = answer_of(random, e);
    const double limit = 0.5 * e.lower;
    answer.a_to_b.lower = 0;
    answer.max->sides = AskedSides{
        *gate_question().max, *gate_question().max, {{limit, limit}, {2 * e.upper, 2 * e.upper}}};
    answer.survey_a.emplace().sides.emplace().over = {e.lower, e.upper};
    const std::string words = in_words(answer);
    CAPTURE(words);
    const std::string distance = number_behind(words, "FAIL  ");
    failed += distance.empty() ? 0 : 1;
    if (!distance.empty()) CHECK(is_inside(distance, e));
  }
  CHECK(failed > kCases / 3);
}

TEST_CASE("figures in the table and in JSON are between their ends") {
  Random random(4);
  int in_table = 0, in_json = 0;
  for (int i = 0; i < kCases / 10; ++i) {
    Answer answer = answer_of(random, random_enclosure(random));
    answer.survey_a.emplace().statistics = random_statistics(random);
    answer.survey_a->sides = random_sides(random);
    answer.survey_a->ended = SurveyEnd::kMet;
    std::ostringstream table;
    print_table(table, answer, false);
    in_table += check_figures(table.str());
    in_json += check_json(to_json(answer));
  }
  CHECK(in_table > kCases / 4);
  CHECK(in_json > kCases / 4);
}

TEST_CASE("metrics are inside their intervals, in words, rows and JSON") {
  Random random(5);
  int in_rows = 0, in_json = 0;
  for (int i = 0; i < kCases / 10; ++i) {
    Answer answer = answer_of(random, random_enclosure(random));
    answer.max.reset();
    answer.b_to_a = answer.a_to_b;
    answer.metrics = random_metrics(random);
    const Metrics& m = *answer.metrics;
    const std::string words = in_words(answer);
    CAPTURE(words);
    CHECK(is_inside(number_behind(words, "hausdorff "), m.hausdorff.value));
    CHECK(is_inside(number_behind(words, "hd95 "), m.hd_p.value));
    CHECK(is_inside(number_behind(words, "assd "), m.assd.value));
    const std::string f1 = number_behind(words, "f1 ");
    const Enclosure& share = m.within[0].f1.value;
    if (share.lower < share.upper) {  // a product by 100 is rounded, and a step outward
      CHECK(decimal_value(f1) >= 100 * Q(share.lower) * Q(1 - 0x1p-51));
      CHECK(decimal_value(f1) <= 100 * Q(share.upper) * Q(1 + 0x1p-51));
    }
    for (const TableRow& row : metrics_rows(answer)) in_rows += check_figures(row.text);
    in_json += check_json(to_json(answer));
  }
  CHECK(in_rows > kCases / 4);
  CHECK(in_json > kCases / 4);
}

TEST_CASE("a CSV's figures are between their ends") {
  Random random(6);
  const CsvColumns with{.metrics = true, .normals = true, .distances = 1};
  for (int i = 0; i < kCases / 10; ++i) {
    Result result;
    result.answer.metrics = random_metrics(random);
    std::vector<std::string> cells;
    const std::string text = csv_row(result, with);
    std::istringstream row(text.substr(0, text.size() - 1));
    for (std::string cell; std::getline(row, cell, ',');) cells.push_back(cell);
    // Behind the percentile and the distance, each figure has three columns.
    const size_t first = cells.size() - (1 + 3 * kNamedShares.size()) - 3 * kNamedMetrics.size();
    for (size_t k = 0; k < kNamedMetrics.size() + kNamedShares.size(); ++k) {
      const size_t at = first + 3 * k + (k < kNamedMetrics.size() ? 0 : 1);
      CAPTURE(cells[at]);
      CAPTURE(cells[at + 1]);
      CAPTURE(cells[at + 2]);
      CHECK(is_between(cells[at], cells[at + 1], cells[at + 2]));
    }
  }
}
