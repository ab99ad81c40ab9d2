// Lengths as typed, and their enclosing intervals in the files' unit.
#include "vkhausdorff/length.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "vkhausdorff/error.h"

namespace {

using namespace vkh;
using Of = Length::Of;

Length parsed(const char* text, PlainNumber plain = PlainNumber::kFraction) {
  return parse_length("--tol", text, plain);
}

/// Encloses `exact`, within a few ulps.
void check_near(const Limit& limit, double exact) {
  CHECK(limit.within <= exact);
  CHECK(exact <= limit.beyond);
  CHECK(limit.beyond - limit.within <= 40 * 0x1p-52 * exact);
}

TEST_CASE("each spelling is what it says") {
  CHECK(parsed("1e-6").of == Of::kDiagonal);
  CHECK(parsed("1e-6").number == 1e-6);
  CHECK(parsed("1e-6diag").number == 1e-6);
  CHECK(parsed("5%").number == 0.05);
  CHECK(parsed("5 %").of == Of::kDiagonal);
  CHECK(parsed("0.01abs").of == Of::kFiles);
  CHECK(parsed("0.01abs").number == 0.01);
  for (const char* unit : {"um", "mm", "cm", "m", "in", "ft", "mil", "thou"}) {
    const Length length = parsed((std::string("2.5") + unit).c_str());
    CHECK(length.of == Of::kUnit);
    CHECK(length.unit == unit);
    CHECK(length.number == 2.5);
  }
}

TEST_CASE("what is no length is refused, and a limit is no number alone") {
  for (const char* wrong : {"", "0", "-1mm", "nan", "inf", "1e-400", "1 fortnight", "1e-6 %abs",
                            "0.1MM", "mm", "1,5mm", "0x1p-3", "1e-323%", "1 mm mm"}) {
    CAPTURE(wrong);
    CHECK_THROWS_AS(parsed(wrong), UsageError);
  }
  CHECK_THROWS_AS(parsed("0.1", PlainNumber::kRefused), UsageError);
  CHECK_NOTHROW(parsed("0.1%", PlainNumber::kRefused));
  CHECK(parsed("1e-3", PlainNumber::kSmallFraction).number == 1e-3);
  CHECK(parsed("0.01diag", PlainNumber::kSmallFraction).number == 0.01);
  CHECK(parsed("0.01").number == 0.01);
  const auto refused = [](const char* text) {
    try {
      parsed(text, PlainNumber::kSmallFraction);
    } catch (const UsageError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  CHECK(
      refused("0.01") ==
      "--tol '0.01': write 0.01diag for 0.01 of A's diagonal, or 0.01mm or 0.01abs, in the files' "
      "own unit, for a length");
  CHECK(refused("1").find("write 1diag") != std::string::npos);
  CHECK_THROWS_WITH_AS(check_unit("--unit", "miles"),
                       "--unit 'miles': expected um, mm, cm, m, in or ft", UsageError);
}

/// Returns the text that an error proposes; empty if it proposes nothing.
std::string proposed(const std::string& text, PlainNumber plain = PlainNumber::kRefused) {
  try {
    parse_length("--max", text, plain);
  } catch (const UsageError& error) {
    const std::string line = error.what(), before = "--max '" + text + "': did you mean ";
    if (!line.starts_with(before)) return "";
    return line.substr(before.size(), line.find("? expected") - before.size());
  }
  return "accepted";
}

TEST_CASE("a length that is meant is proposed as it has to be written") {
  CHECK(proposed("0,1mm") == "0.1mm");
  CHECK(proposed("0,100 mm") == "0.100mm");
  CHECK(proposed("1,000mm") == "1.000mm or 1000mm");
  CHECK(proposed("1,000.5mm") == "1000.5mm");
  CHECK(proposed("4mil") == "accepted");
  CHECK(proposed("4 thou") == "accepted");
  CHECK(proposed("4mils") == "4mil");
  CHECK(proposed("2yd") == "6ft");
  CHECK(proposed("1 mile") == "1609.344m");
  CHECK(proposed("0.1inch") == "0.1in");
  CHECK(proposed("0.1 Inches") == "0.1in");
  CHECK(proposed("0.1MM") == "0.1mm");
  CHECK(proposed("+0.1mm") == "0.1mm");
  CHECK(proposed("100\xc2\xb5m") == "100um");
  CHECK(proposed("5 microns") == "5um");
  CHECK(proposed("50nm") == "0.05um");
  CHECK(proposed("1e-2 millimetres") == "1e-2mm");
  CHECK(proposed("0,5%") == "0.5%");
  CHECK(proposed("0.1mm") == "accepted");
  CHECK(proposed("0.1 mm") == "accepted");
  for (const char* unknown :
       {"", "mm", "0.1", "1 fortnight", "1.2.3inch", "-1inch", "0,0mm", "1mm mm", ","}) {
    CAPTURE(unknown);
    CHECK(proposed(unknown) == "");
  }
}

TEST_CASE("a misspelt unit is taken for the one that is nearest, if one is") {
  CHECK(proposed("0.1mn") == "0.1mm");
  CHECK(proposed("0.1mmm") == "0.1mm");
  CHECK(proposed("0.1cms") == "0.1cm");
  CHECK(proposed("0.1milimeter") == "0.1mm");
  CHECK(proposed("0.1 milimetre") == "0.1mm");
  CHECK(proposed("0.1ab") == "0.1abs");
  CHECK(proposed("0.1inche") == "0.1in");
  CHECK(proposed("0.1dig") == "0.1diag");
  for (const char* none : {"0.1x", "0.1zz", "0.1 parsec", "0.1lightyear", "1e-6 %abs", "0.1xm"}) {
    CAPTURE(none);
    CHECK(proposed(none) == "");
  }
}

TEST_CASE("a unit that is meant is proposed by its name") {
  CHECK_THROWS_WITH_AS(check_unit("--unit", "inch"),
                       "--unit 'inch': did you mean in? expected um, mm, cm, m, in or ft",
                       UsageError);
  for (const auto& one : {std::pair{"MM", "mm"},
                          {"Inches", "in"},
                          {"micron", "um"},
                          {"meter", "m"},
                          {"mmm", "mm"},
                          {"feet", "ft"}}) {
    CAPTURE(one.first);
    const std::string hint = std::string("did you mean ") + one.second + "?";
    CHECK_THROWS_WITH_AS(check_unit("--unit", one.first), doctest::Contains(hint.c_str()),
                         UsageError);
  }
  for (const char* none : {"mil", "thou", "%", "abs", "diag", "nm", "parsec", "x"})
    CHECK_THROWS_WITH_AS(check_unit("--unit", none), doctest::Contains("': expected"), UsageError);
}

TEST_CASE("a length is enclosed in the files' unit") {
  const double diagonal = std::sqrt(3.0);
  const auto in = [&](const char* text, const char* unit) {
    return in_files(parsed(text), "--max", unit, Diagonal(diagonal, 0));
  };
  check_near(in("1e-3", ""), 1e-3 * diagonal);
  check_near(in("0.1%", "mm"), 1e-3 * diagonal);
  check_near(in("0.1abs", "in"), 0.1);
  check_near(in("0.1mm", "mm"), 0.1);
  check_near(in("1in", "mm"), 25.4);
  check_near(in("25.4mm", "in"), 1);
  check_near(in("1ft", "in"), 12);
  check_near(in("1um", "m"), 1e-6);
  check_near(in("3cm", "mm"), 30);
  check_near(in("4mil", "mm"), 0.1016);
  check_near(in("5000mil", "mm"), 127);  // a mil is 127/5000 mm
  check_near(in("1000thou", "in"), 1);
  check_near(in("1m", "ft"), 1 / 0.3048);
  // A tenth is no double: neither end is above, nor under, its exact value.
  const Limit tenth = in("0.1mm", "mm");
  CHECK(tenth.within < 0.1);
  CHECK(tenth.beyond > 0.1);
  CHECK_THROWS_AS(in("0.1mm", ""), UsageError);
  CHECK_THROWS_WITH_AS(in("0.1mm", ""), doctest::Contains("as 0.1abs"), UsageError);
  CHECK_THROWS_AS(in("1e308m", "um"), UsageError);
}

// The double of 0.3 is a little less than it, that of 0.1 a little more.
TEST_CASE("a limit is written as it was typed") {
  for (const std::string text : {"0.1", "0.2", "0.3", "0.7", "2.54", "1.1"}) {
    CAPTURE(text);
    for (const char* unit : {"mm", "abs"}) {
      const Length length = parsed((text + unit).c_str());
      CHECK(length_in_words(limit_in_files(length, "--max", "mm", Diagonal(1, 0))) == text);
    }
  }
  const double third = 1.0 / 3;
  CHECK(length_in_words({third, third}) == "about 0.3333");
}

TEST_CASE("a share of a diagonal that no double holds to all its bits decides nothing") {
  const auto limit = [](const char* text, double diagonal) {
    return limit_in_files(parsed(text), "--max", "mm", Diagonal(diagonal, 0));
  };
  for (const double none : {0.0, 5e-324, 1e-310, std::numeric_limits<double>::max()}) {
    CAPTURE(none);
    for (const char* text : {"50%", "0.5diag"}) CHECK_THROWS_AS(limit(text, none), UsageError);
    CHECK(limit("0.5abs", none).within > 0);
    CHECK(limit("0.5mm", none).within > 0);
  }
  check_near(limit("50%", 4 * std::numeric_limits<double>::min()), 0x1p-1021);
  check_near(limit("50%", 1e308), 5e307);
}

}  // namespace
