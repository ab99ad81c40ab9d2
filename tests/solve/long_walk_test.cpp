// Traversals that visit most of B: from its middle all of its surface is about as near. lavapipe
// ends the loops of an invocation that has turned 65,535 times, in whichever it is
// (docs/certificate.md, "Loops that a driver ends"): bounds stay true there, if wider.
#include <doctest/doctest.h>

#include "host/solve/held_pairs.h"
#include "tests/shapes/shapes.h"
#include "tests/support/cell_check.h"
#include "tests/support/solver_bench.h"
#include "tests/verification/oracle/reference_solver.h"

namespace {

using namespace vkh;
using namespace vkh::test;

/// A sphere around the origin; 81,920 faces.
Mesh around() { return icosphere(1.0, 6); }
Mesh in_the_middle() { return icosphere(1e-3, 1); }

TEST_CASE("bounds of cells are true") {
  const Mesh a = in_the_middle(), b = around();
  CellTally tally;
  hold_pair(solver(), {a, b}, {},
            [&](const SurveyedPair& pair) { CellCheck(pair, b).check(pair.bound, 7, 16, tally); });
  CHECK(tally.cells == 16);
  CHECK(tally.below + tally.above + tally.means + tally.reached == 0);
}

TEST_CASE("and so is the interval, which does not fall back to nothing") {
  const Mesh a = in_the_middle(), b = around();
  for (const double tolerance : {1e-6, 1e-12}) {
    SolveOptions options;
    options.tolerance = tolerance;
    const Report r = solver().distance(a, b, options);
    CAPTURE(r.lower);
    CAPTURE(r.upper);
    CHECK(r.upper - r.lower <= 2e-3);
    const double there = point_mesh_distance(r.witness_a.point, b);
    CHECK(there >= r.lower - 1e-14);
    CHECK(there <= r.upper + 1e-14);
  }
}

}  // namespace
