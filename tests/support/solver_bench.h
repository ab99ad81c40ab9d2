// The solver on the device that all tests of a program share, and its answers as intervals.
#pragma once

#include <string>
#include <utility>

#include "host/solver.h"
#include "tests/support/kernel_bench.h"
#include "tests/support/reference_solver.h"

namespace vkh::test {

inline Solver& solver() {
  static Solver one(test_device());
  return one;
}

/// Two meshes and the exact distance to 1e-9.
struct ReferencePair {
  std::string name;
  Mesh a, b;
  Interval exact;
};

inline ReferencePair with_reference(std::string name, Mesh a, Mesh b) {
  const Interval exact = reference_hausdorff(a, b, 1e-9);
  return {std::move(name), std::move(a), std::move(b), exact};
}

inline Interval interval(const Report& r) { return {r.lower, r.upper}; }

}  // namespace vkh::test
