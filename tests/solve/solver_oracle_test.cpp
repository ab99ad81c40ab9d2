// Whole runs on small, hard, random pairs against the double-precision reference solver. Both
// enclose h(A, B), so their intervals must meet (CGAL's: cgal_test.cpp). VKH_ORACLE_SEEDS asks for
// more of them than the default.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>
#include <functional>
#include <string>

#include "tests/shapes/shapes.h"
#include "tests/support/solver_bench.h"
#include "tests/verification/oracle/reference_solver.h"

namespace {

using namespace vkh;
using namespace vkh::test;

uint32_t seed_count() {
  const char* asked = std::getenv("VKH_ORACLE_SEEDS");
  return asked != nullptr ? static_cast<uint32_t>(std::atoi(asked)) : 2;
}

using Maker = std::function<Mesh(uint64_t seed)>;
struct Kind {
  std::string name;
  Maker make;
};

uint32_t some(uint64_t seed, uint32_t most) { return 1 + Random(seed).below(most); }

const Kind kKinds[] = {
    {"soup", [](uint64_t s) { return soup(s, some(s, 60)); }},
    {"needles", [](uint64_t s) { return needles(s, some(s, 40)); }},
    {"slivers", [](uint64_t s) { return slivers(s, some(s, 40)); }},
    {"caps", [](uint64_t s) { return caps(s, some(s, 40)); }},
    {"degenerate", [](uint64_t s) { return degenerate_faces(s, some(s, 30)); }},
    {"float32 soup", [](uint64_t s) { return in_float32(soup(s, some(s, 60))); }},
    {"mixed",
     [](uint64_t s) { return joined(joined(soup(s, 10), needles(s, 10)), slivers(s, 10)); }},
    {"field", [](uint64_t s) { return height_field(4 + some(s, 8), 1); }},
    {"large triangle",
     [](uint64_t s) {
       Random r(s);
       return single_triangle(r.in_cube(1.0), r.in_cube(1.0), r.in_cube(1.0));
     }},
};

void check_against(const Interval& oracle, const Mesh& a, const Mesh& b,
                   const SolveOptions& options) {
  const Report r = solver().distance(a, b, options);
  CAPTURE(status_name(r.status));
  CAPTURE(a.faces.size());
  CAPTURE(b.faces.size());
  CHECK_MESSAGE(interval(r).meets(oracle), "[" << r.lower << ", " << r.upper << "] against ["
                                               << oracle.lower << ", " << oracle.upper << "]");
  CHECK(r.lower <= r.upper);
  if (r.status == Status::kClosed) CHECK(r.upper - r.lower <= r.tolerance);
}

/// The pair as it is, in pieces of the budget, and with stages switched off.
void check_pair(const Mesh& a, const Mesh& b, uint64_t seed) {
  const double size = diagonal(joined(a, b));
  const Interval oracle = reference_hausdorff(a, b, 1e-10 * size);
  check_against(oracle, a, b, {});
  Random random(seed);
  SolveOptions cut;
  cut.wave_limit = 1 + random.below(4);
  cut.memory_bytes = uint64_t{1} << (10 + random.below(12));
  for (const std::string& name : switch_names()) {
    if (random.below(3) == 0) cut.engine.disabled.push_back(name);
  }
  CAPTURE(cut.wave_limit);
  CAPTURE(cut.memory_bytes);
  check_against(oracle, a, b, cut);
}

}  // namespace

TEST_CASE("every kind against every kind") {
  for (uint64_t seed = 0; seed < seed_count(); ++seed) {
    for (const Kind& kind_a : kKinds) {
      for (const Kind& kind_b : kKinds) {
        CAPTURE(seed);
        CAPTURE(kind_a.name);
        CAPTURE(kind_b.name);
        check_pair(kind_a.make(1000 + seed), kind_b.make(2000 + seed), seed);
      }
    }
  }
}

TEST_CASE("every kind against itself moved a little: distances from nothing to 1e-1") {
  for (uint64_t seed = 0; seed < seed_count(); ++seed) {
    for (const Kind& kind : kKinds) {
      CAPTURE(seed);
      CAPTURE(kind.name);
      const Mesh mesh = kind.make(3000 + seed);
      for (const double amplitude : {0.0, 1e-9, 1e-7, 1e-5, 1e-3, 1e-1}) {
        CAPTURE(amplitude);
        check_pair(mesh, noisy(mesh, amplitude, seed), seed);
      }
    }
  }
}

TEST_CASE("every kind far from the origin, tiny and huge") {
  for (const Kind& kind : kKinds) {
    CAPTURE(kind.name);
    const Mesh a = kind.make(4000);
    const Mesh b = kind.make(4001);
    check_pair(translated(a, {1e5, 0, -1e5}), translated(b, {1e5, 0, -1e5}), 1);
    check_pair(scaled(a, -100), scaled(b, -100), 2);
    check_pair(scaled(a, 100), scaled(b, 100), 3);
    check_pair(scaled(a, -12), b, 4);
    check_pair(a, scaled(b, -12), 5);
    check_pair(a, translated(scaled(b, -12), {100, 0, 0}), 6);
  }
}

TEST_CASE("decimated twins and remeshed surfaces") {
  for (const auto& [cells, stride] : {std::pair(12u, 2u), std::pair(24u, 3u), std::pair(30u, 6u)}) {
    const auto& cell_count = cells;
    CAPTURE(cell_count);
    const Mesh fine = height_field(cells, 1);
    const Mesh coarse = height_field(cells, stride);
    check_pair(fine, coarse, cells);
    check_pair(coarse, fine, cells);
    check_pair(permuted(fine, 1), fine, cells);
  }
  check_pair(icosphere(1.0, 2), uv_sphere(1.0, 12, 24), 1);
  check_pair(uv_sphere(1.0, 12, 24), icosphere(1.0, 2), 2);
  check_pair(torus(1.0, 0.3, 24, 12), torus(1.0, 0.3, 30, 10), 3);
  check_pair(rotated(torus(1.0, 0.3, 24, 12), {0, 0, 1}, 0.1), torus(1.0, 0.3, 24, 12), 4);
  check_pair(cube(0.5), icosphere(0.75, 2), 5);
}
