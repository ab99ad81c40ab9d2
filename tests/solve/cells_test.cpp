// Bounds of cells: none is wrong, and each is as narrow as it should be.
#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "host/solve/held_pairs.h"
#include "host/survey/area_table.h"
#include "host/survey/wave_survey.h"
#include "tests/shapes/hard_pairs.h"
#include "tests/support/cell_check.h"
#include "tests/support/solver_bench.h"

namespace {

using namespace vkh;
using namespace vkh::test;

/// Calls `look` while a pair lies on the device.
void survey(const Mesh& a, const Mesh& b, const UsePair& look) {
  hold_pair(solver(), {a, b}, {}, look);
}

CellTally tally_of(const Mesh& a, const Mesh& b, size_t cells) {
  CellTally tally;
  survey(a, b,
         [&](const SurveyedPair& pair) { CellCheck(pair, b).check(pair.bound, 7, cells, tally); });
  return tally;
}

void check_right(const CellTally& tally, size_t cells) {
  CHECK(tally.cells == cells);
  CHECK(tally.below == 0);
  CHECK(tally.above == 0);
  CHECK(tally.means == 0);
  CHECK(tally.reached == 0);
}

std::vector<gpu::CellBounds> bounds_of_faces(const Mesh& a, const Mesh& b) {
  std::vector<gpu::CellBounds> bounds(a.faces.size());
  survey(a, b, [&](const SurveyedPair& pair) {
    pair.bound({.cells = {}, .first = 0, .bounds = bounds});
  });
  return bounds;
}

TEST_CASE("no bound of a cell is wrong, of hard pairs of every family") {
  const size_t families = family_names().size();
  for (size_t i = 0; i < 2 * families; ++i) {
    CAPTURE(family_names()[i % families]);
    const HardPair hard = hard_pair(i % families, 100 + i);
    check_right(tally_of(hard.pair.a, hard.pair.b, 200), 200);
  }
}

TEST_CASE("nor where B has more triangles near a cell than are looked at") {
  const Mesh b = joined(icosphere(1.0, 4), soup(3, 500));
  check_right(tally_of(single_triangle({-1, -1, 0}, {1, -1, 0.1}, {0, 1, 0}), b, 400), 400);
  check_right(tally_of(icosphere(1e-3, 1), b, 400), 400);
}

TEST_CASE("nor with low parts, far out, or tiny") {
  const Mesh a = icosphere(1, 2), b = icosphere(1.1, 2);
  check_right(tally_of(translated(a, {1e3, 0.1, 0}), translated(b, {1e3, 0, 0}), 400), 400);
  check_right(tally_of(scaled(a, -100), scaled(b, -100), 400), 400);
  check_right(tally_of(scaled(a, 100), scaled(b, 100), 400), 400);
}

/// Splits the cells whose mean is known worst, and bounds their parts.
void split_some(SurveyCells& cells, double whole) {
  gpu::SurveyPlan plan{};
  plan.mean = 1;
  plan.mean_classes = gpu::kAllClasses;
  plan.of_whole = static_cast<float>(1 / whole);
  plan.most = {3e38f, 3e38f};
  const CellRange all{0, static_cast<uint32_t>(cells.count())};
  const SurveyChoice choice = choose_cells(cells.score(plan, all), 0.9, 300);
  if (choice.count() == 0) return;
  REQUIRE(cells.split(choice));
  cells.bound(0, choice.parts * choice.count(), true);
}

TEST_CASE("nor of a survey's cells, which are parts of cells that were bounded") {
  for (size_t i = 0; i < family_names().size(); ++i) {
    CAPTURE(family_names()[i]);
    const HardPair hard = hard_pair(i, 300 + i);
    survey(hard.pair.a, hard.pair.b, [&](const SurveyedPair& pair) {
      const AreaWeights weights = weights_of(areas_of(hard.pair.a));
      const double farthest = pair.frame.to_frame(pair.farthest) + pair.displacement;
      pair.cells->begin(weights.of_face, static_cast<float>(1.001 * farthest));
      pair.cells->bound(0, pair.cells->count(), true);
      for (int round = 0; round < 5; ++round) split_some(*pair.cells, weights.whole);
      const CellsRead all = pair.cells->read({0, static_cast<uint32_t>(pair.cells->count())});
      CellTally tally;
      CellCheck(pair, hard.pair.b).check(all.cells, all.bounds, 7, tally);
      check_right(tally, all.cells.size());
    });
  }
}

TEST_CASE("a triangle over a plane: affine, to rounding") {
  // B's plane in four triangles, A's face above it: 0.125, 0.25 and 0.375 at its corners.
  const Mesh b = square_patch(2, 0.0);
  const Mesh a = single_triangle({0.25, 0.25, 0.125}, {0.5, 0.25, 0.25}, {0.25, 0.5, 0.375});
  const gpu::CellBounds f = bounds_of_faces(a, b)[0];
  const double scale = 0.5;  // of the frame
  CHECK(f.lower_a == doctest::Approx(scale * 0.125).epsilon(1e-4));
  CHECK(f.lower_b == doctest::Approx(scale * 0.25).epsilon(1e-4));
  CHECK(f.lower_c == doctest::Approx(scale * 0.375).epsilon(1e-4));
  CHECK(f.reached >= scale * 0.3749);
  CHECK(f.highest >= scale * 0.375);
  CHECK(f.highest <= scale * 0.3751);
}

TEST_CASE("every cell repeats, whichever others are asked about") {
  const Mesh a = icosphere(1, 2), b = icosphere(1.1, 3);
  survey(a, b, [&](const SurveyedPair& pair) {
    std::vector<gpu::CellBounds> all(a.faces.size()), some(10);
    pair.bound({.cells = {}, .first = 0, .bounds = all});
    pair.bound({.cells = {}, .first = 50, .bounds = some});
    for (size_t i = 0; i < some.size(); ++i) {
      CHECK(some[i].highest == all[50 + i].highest);
      CHECK(some[i].lower_a == all[50 + i].lower_a);
      CHECK(some[i].face == all[50 + i].face);
    }
  });
}

}  // namespace
