// shaders/lib/lower.h against exact arithmetic: triangle_distance_down never exceeds the distance,
// in any rounding direction, flushed or not, and is rarely far below it.
#include <doctest/doctest.h>

#include <algorithm>
#include <limits>

#include "tests/support/arithmetic.h"
#include "tests/support/exact_lib.h"
#include "tests/support/lib_probe.h"
#include "tests/support/lower_checks.h"
#include "tests/support/tally.h"

using namespace vkh;
using namespace vkh::test;

TEST_CASE("triangle_distance_down is a lower bound, and a tight one") {
  const uint64_t count = case_count();
  Random random(20240611);
  Tally tally("triangle_distance_down");
  for (uint64_t i = 0; i < count && !tally.hopeless(); ++i) {
    const lib::LowerCase c = lib::hard_lower_case(random);
    const Arithmetic& arithmetic = kArithmetics[i % kArithmetics.size()];
    const auto got = under(arithmetic, [&] { return lib::distance_down(c.surface, c.enough); });
    lib::check_lower(c, got, arithmetic.name, tally);
  }
  lib::conclude_lower(tally, count);
}
