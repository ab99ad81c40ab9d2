#include <algorithm>
#include <cmath>
#include <cstdio>

#include "host/base/parallel.h"
#include "host/survey/survey_with.h"
#include "tests/shapes/hard_pairs.h"
#include "tests/support/cell_check.h"
#include "tests/verification/oracle/reference_solver.h"
#include "tools/bench/sweep.h"

namespace vkh::bench {
namespace {

using namespace vkh::test;

struct Totals {
  CellTally cells;
  uint64_t faces = 0, wrong_faces = 0, pairs_wrong = 0, unmet = 0;
};

Mesh face_of(const Mesh& mesh, size_t face) {
  const glm::uvec3 f = mesh.faces[face];
  return single_triangle(mesh.vertices[f.x], mesh.vertices[f.y], mesh.vertices[f.z]);
}

/// Scales by a power of two, so that the reference's squares neither overflow nor vanish.
Mesh in_unit(Mesh mesh, int exponent) {
  for (glm::dvec3& v : mesh.vertices) {
    for (int axis = 0; axis < 3; ++axis) v[axis] = std::ldexp(v[axis], exponent);
  }
  return mesh;
}

bool is_true(const Mesh& a, const Mesh& b, size_t face, const Enclosure& found) {
  const double size = std::max(found.upper, 1e-9);
  const Interval truth = reference_hausdorff(face_of(a, face), b, 0.01 * size, 20000);
  constexpr double kRounding = 1e-13;  // of coordinates of order 1
  return found.lower <= truth.upper + kRounding && found.upper >= truth.lower - kRounding;
}

/// Faces whose bounds the reference refutes.
uint64_t wrong_faces(const MeshPair& pair, const Field& field, int exponent, double spoil) {
  const Mesh a = in_unit(pair.a, exponent), b = in_unit(pair.b, exponent);
  std::atomic<uint64_t> wrong = 0;
  for_each_index(field.face_count(), [&](size_t f) {
    const Enclosure found{std::ldexp(field.lower[f], exponent) * (1 + spoil),
                          std::ldexp(field.upper[f], exponent) * (1 - spoil)};
    if (!is_true(a, b, f, found)) ++wrong;
  });
  return wrong;
}

void sweep_pair(Solver& solver, const SweepOptions& args, uint64_t i, Totals& totals) {
  const size_t families = family_names().size();
  const size_t family = i % families;
  const HardPair hard = hard_pair(family, args.seed * 1000003 + i);
  SurveyOptions asked;
  asked.faces = asked.statistics = true;
  asked.time_limit_s = 0.1;
  SurveyResult result;
  CellTally tally;
  int exponent = 0;
  hold_pair(solver, {hard.pair.a, hard.pair.b}, {}, [&](const SurveyedPair& pair) {
    exponent = pair.frame.exponent;
    CellCheck(pair, hard.pair.b).check(pair.bound, args.seed + i, args.cells, tally);
    survey_with(asked, result)(pair);
  });
  const uint64_t faces = wrong_faces(hard.pair, result.field, exponent, args.spoil);
  totals.cells.add(tally);
  totals.faces += result.field.face_count();
  totals.wrong_faces += faces;
  totals.unmet += !result.is_met();
  if (faces == 0 && tally.wrong() == 0) return;
  ++totals.pairs_wrong;
  std::printf(
      "VIOLATION pair %llu (%s): %llu faces; of cells %llu below, %llu above, %llu means, "
      "%llu reached\n",
      static_cast<unsigned long long>(i), family_names()[family].c_str(),
      static_cast<unsigned long long>(faces), static_cast<unsigned long long>(tally.below),
      static_cast<unsigned long long>(tally.above), static_cast<unsigned long long>(tally.means),
      static_cast<unsigned long long>(tally.reached));
}

}  // namespace

int sweep_cells(const SweepOptions& args) {
  Swept swept(args.device);
  Solver& solver = swept.solver();
  Totals totals;
  for (uint64_t i = args.first; i < args.first + args.count; ++i)
    sweep_pair(solver, args, i, totals);
  std::printf(
      "cell sweep: %llu pairs (seed %llu, from %llu) on %s: %llu faces and %llu cells at "
      "%llu points, %llu faces and %llu bounds of cells wrong; %llu surveys ended by time\n",
      static_cast<unsigned long long>(args.count), static_cast<unsigned long long>(args.seed),
      static_cast<unsigned long long>(args.first), solver.description().name.c_str(),
      static_cast<unsigned long long>(totals.faces),
      static_cast<unsigned long long>(totals.cells.cells),
      static_cast<unsigned long long>(totals.cells.samples),
      static_cast<unsigned long long>(totals.wrong_faces),
      static_cast<unsigned long long>(totals.cells.wrong()),
      static_cast<unsigned long long>(totals.unmet));
  return totals.pairs_wrong > 0 ? 1 : 0;
}

}  // namespace vkh::bench
