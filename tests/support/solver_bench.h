// The solver on the device that all tests of a program share, and its answers as intervals.
#pragma once

#include "host/solver.h"
#include "tests/support/kernel_bench.h"
#include "tests/support/reference_solver.h"

namespace vkh::test {

inline Solver& solver() {
  static Solver one(test_device());
  return one;
}

inline Interval interval(const Report& r) { return {r.lower, r.upper}; }

}  // namespace vkh::test
