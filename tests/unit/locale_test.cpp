// A program that embeds us may have a locale whose decimal point is a comma: numbers are read and
// printed as ever.
#include <doctest/doctest.h>

#include <cfloat>
#include <clocale>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string>

#include "host/base/decimal.h"
#include "host/read/readers.h"
#include "host/write/rounded.h"
#include "tests/support/files.h"
#include "vkhausdorff/length.h"

namespace {

using namespace vkh;

// Sets a German locale, compiled by glibc's localedef if it is not installed. Returns false if
// there is none.
bool set_german() {
  for (const char* name : {"de_DE.UTF-8", "de_DE.utf8"}) {
    if (std::setlocale(LC_ALL, name) != nullptr) return true;
  }
  const std::string made = vkh::test::folder() / "de_DE.UTF-8";
  const std::string command = "localedef -i de_DE -f UTF-8 '" + made + "' >/dev/null 2>&1";
  if (std::system(command.c_str()) != 0) return false;
  setenv("LOCPATH", made.substr(0, made.rfind('/')).c_str(), 1);
  return std::setlocale(LC_ALL, "de_DE.UTF-8") != nullptr;
}

struct German {
  German() : is_set(set_german()) {}
  ~German() { std::setlocale(LC_ALL, "C"); }
  German(const German&) = delete;
  German& operator=(const German&) = delete;
  bool is_set;
};

}  // namespace

TEST_CASE("a decimal comma of the program's changes no number") {
  const German german;
  if (!german.is_set) {
    MESSAGE("skipped: neither de_DE nor localedef is here");
    return;
  }
  char text[16];
  std::snprintf(text, sizeof(text), "%.1f", 0.5);
  REQUIRE(std::string(text) == "0,5");
  CHECK(shortest_decimal(1.25) == "1.25");
  CHECK(shortest_decimal(0.1 + 0.2) == "0.30000000000000004");
  CHECK(decimal(0.1, 3, Rounding::kUp) == "0.101");
  CHECK(number_text(1234.5, std::chars_format::fixed, 3) == "1234.500");
  CHECK(number_text(0.00012345, std::chars_format::scientific, 2) == "1.23e-04");
  CHECK(number_text(0.00012345, std::chars_format::general, 3) == "0.000123");
  CHECK(parse_length("--max", "0.5mm", PlainNumber::kRefused).number == 0.5);
  const std::string obj = "v 0.5 0 0\nv 1.25 0 0\nv 0 1e-3 0\nf 1 2 3\n";
  const Mesh mesh = parse_mesh({.name = "a.obj", .bytes = obj});
  CHECK(mesh.vertices[1].x == 1.25);
  CHECK(mesh.vertices[2].y == 1e-3);
}

TEST_CASE("floats of field files are rounded outward") {
  const double largest = static_cast<double>(FLT_MAX);
  const double inf = std::numeric_limits<double>::infinity();
  for (const double x :
       {0.0, 1e-300, 1e-46, 2e-45, 0.1, 1.0, 1 + 0x1p-40, 1e10, largest, 2 * largest, 1e300, inf}) {
    CAPTURE(x);
    CHECK(static_cast<double>(float_down(x)) <= x);
    CHECK(static_cast<double>(float_up(x)) >= x);
    CHECK(float_down(x) >= 0.0f);
    const double nearest = static_cast<double>(static_cast<float>(x));
    if (nearest == x) CHECK(float_down(x) == float_up(x));
  }
}
