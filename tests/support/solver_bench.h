// The solver on the device that all tests of a program share, and its answers as intervals.
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <string>
#include <utility>

#include "tests/support/kernel_bench.h"
#include "tests/verification/oracle/reference_solver.h"
#include "vkhausdorff/solver.h"
#include "vkhausdorff/survey.h"

namespace vkh::test {

/// On the device; or, where VKH_TEST_NATIVE is set and not empty, on the processor alone.
inline bool is_native() {
  const char* asked = std::getenv("VKH_TEST_NATIVE");
  return asked != nullptr && *asked != 0;
}

inline Solver& solver() {
  static Solver& one = is_native() ? kept<Solver>(NativeProcessor{}) : kept<Solver>(test_device());
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

/// Surveys a after h(a, b) is enclosed, as the program does.
inline SurveyResult surveyed(const Mesh& a, const Mesh& b, SurveyOptions survey) {
  survey.upper = std::min(survey.upper, solver().distance(a, b).upper);
  return survey_mesh(solver(), {.a = a, .b = b}, survey);
}

/// Checks two runs that must be one run: bit by bit their results and their work.
inline void check_same(const Report& r, const Report& other) {
  CHECK(r.status == other.status);
  CHECK(r.lower == other.lower);
  CHECK(r.upper == other.upper);
  CHECK(r.waves == other.waves);
  CHECK(r.candidates == other.candidates);
  CHECK(r.queries == other.queries);
  CHECK(r.witness_a.face == other.witness_a.face);
  CHECK(r.witness_a.point == other.witness_a.point);
  CHECK(r.witness_b.face == other.witness_b.face);
}

inline Interval interval(const Report& r) { return {r.lower, r.upper}; }

}  // namespace vkh::test
