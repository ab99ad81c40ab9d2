// Lengths as typed, and what encloses them in the files' unit.
#include "host/answer/length.h"

#include <doctest/doctest.h>

#include <cmath>

#include "host/base/error.h"

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
  for (const char* unit : {"um", "mm", "cm", "m", "in", "ft"}) {
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
  CHECK_THROWS_WITH_AS(check_unit("--unit", "miles"),
                       "--unit 'miles': expected um, mm, cm, m, in or ft", UsageError);
}

TEST_CASE("a length is enclosed in the files' unit") {
  const double diagonal = std::sqrt(3.0);
  const auto in = [&](const char* text, const char* unit) {
    return in_files(parsed(text), "--max", unit, diagonal);
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
  check_near(in("1m", "ft"), 1 / 0.3048);
  // A tenth is no double: neither end is above, nor under, what it stands for.
  const Limit tenth = in("0.1mm", "mm");
  CHECK(tenth.within < 0.1);
  CHECK(tenth.beyond > 0.1);
  CHECK_THROWS_AS(in("0.1mm", ""), UsageError);
  CHECK_THROWS_WITH_AS(in("0.1mm", ""), doctest::Contains("as 0.1abs"), UsageError);
  CHECK_THROWS_AS(in("1e308m", "um"), UsageError);
}

}  // namespace
