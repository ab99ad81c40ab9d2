// The line of progress: a share of all work that is never rounded up to 100 %, a true interval, the
// time that is left.
#include "host/answer/progress_line.h"

#include <doctest/doctest.h>

namespace {

using namespace vkh;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST_CASE("it has a percentage, the interval and the time") {
  CHECK(progress_text({0.999, 1.0 / 3, 2.0 / 3}, kInfinity) == "99 %  [0.3333333, 0.6666667]");
  CHECK(progress_text({0, 0, kInfinity}, 65.2) == "0 %  [0, inf]  at most 1:05 left");
  CHECK(progress_text({1, 1, 1}, -3) == "100 %  [1, 1]  at most 0:00 left");
  CHECK(clock_text(3600) == "1:00:00");
  CHECK(clock_text(59.6) == "1:00");
}

TEST_CASE("words of the method are apart") {
  CHECK(search_words({.wave = 3, .candidates = 70, .gap = 0.25, .back = true}) ==
        "h(B,A)  wave 3  70 candidates  gap 2.50e-01");
  CHECK(count_words("survey", {.back = false, .count = 12}, "cells bounded") ==
        "survey of A  12 cells bounded");
}

}  // namespace
