// Two small meshes far apart: in a float every face of B is as far as the nearest, so the device
// names any. A proof must not halve A if halving cannot help.
#include <cmath>

#include "tests/shapes/shapes.h"
#include "tests/support/solver_bench.h"
#include "vkhausdorff/prover.h"

using namespace vkh;
using namespace vkh::test;

namespace {

Mesh square(double height) {
  return make_mesh("square", {{0, 0, height}, {1, 0, height}, {0, 1, height}, {1, 1, height}},
                   {{0, 1, 2}, {1, 3, 2}});
}

}  // namespace

TEST_CASE("what is far away is proven with few leaves, for the run's own upper") {
  for (const double height : {100.0, 30854.32826379653, 1e7}) {
    CAPTURE(height);
    const Mesh a = square(0), b = square(height);
    SolveOptions options;
    options.tolerance = 1e-4;
    const Report r = solver().distance(a, b, options);
    const Proof proof =
        prove(solver(), {.a = a, .b = b, .report = r, .options = options, .goes_on = {}});
    CHECK(proof.upper == r.upper);
    CHECK(proof.unproven == 0);
    CHECK(proof.leaves < 2000);
  }
}
