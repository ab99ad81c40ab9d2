// A pair that is kept from call to call: what follows its search finds it on the device, and finds
// the same there.
#include <doctest/doctest.h>

#include <array>
#include <cstring>
#include <vector>

#include "host/solve/held_pairs.h"
#include "tests/shapes/shapes.h"
#include "tests/support/solver_bench.h"

namespace {

using namespace vkh;
using namespace vkh::test;

/// The start of a survey.
struct Start {
  double farthest = 0;
  std::vector<gpu::CellBounds> faces;

  bool has_bounds_of(const Start& other) const {
    return faces.size() == other.faces.size() &&
           std::memcmp(faces.data(), other.faces.data(), faces.size() * sizeof(faces[0])) == 0;
  }
};

Start seen_of(const SurveyedPair& pair) {
  Start start{.farthest = pair.farthest,
              .faces = std::vector<gpu::CellBounds>(pair.a.faces.size())};
  pair.bound({.cells = {}, .first = 0, .bounds = start.faces});
  return start;
}

Start start_of(const PairView& view) {
  Start start;
  hold_pair(solver(), view, {}, [&](const SurveyedPair& pair) { start = seen_of(pair); });
  return start;
}

/// By the pipelines that serve surveys, too.
SolveOptions search() {
  SolveOptions options;
  options.engine.cells = true;
  return options;
}

Report distance_of(const PairView& view) { return solver().distances({&view, 1}, search())[0]; }

struct TwoMeshes {
  Mesh a = icosphere(1, 3), b = translated(icosphere(1.1, 3), {0.3, 0.1, 0});
};

TEST_CASE(
    "a run that was searched is gone on with, and cells have the same bounds as in a new one") {
  if (is_native()) return;
  const TwoMeshes m;
  KeptPair kept;
  const PairView view{.a = m.a, .b = m.b, .kept = &kept};
  const double upper = distance_of(view).upper;
  const Start found = start_of(view), anew = start_of({.a = m.a, .b = m.b});
  CHECK(found.farthest == upper);
  CHECK(anew.farthest > upper);  // that of one wave
  CHECK(found.has_bounds_of(anew));
}

TEST_CASE("both directions lie side by side") {
  if (is_native()) return;
  const TwoMeshes m;
  KeptPair there, back;
  const PairView view{.a = m.a, .b = m.b, .kept = &there, .kept_back = &back};
  const SymmetricReport both = solver().symmetrics({&view, 1}, search())[0];
  const std::array<PairView, 2> views{view, {.a = m.b, .b = m.a, .kept = &back}};
  hold_pairs(solver(), views, {}, [&](std::span<const SurveyedPair> pairs) {
    CHECK(seen_of(pairs[0]).farthest == both.a_to_b.upper);
    CHECK(seen_of(pairs[1]).farthest == both.b_to_a.upper);
  });
  CHECK(start_of(views[1]).has_bounds_of(start_of({.a = m.b, .b = m.a})));
  CHECK(start_of(views[0]).has_bounds_of(start_of({.a = m.a, .b = m.b})));
}

TEST_CASE("a pair whose place another one took is laid anew") {
  if (is_native()) return;
  const TwoMeshes m;
  KeptPair kept, own;
  const PairView view{.a = m.a, .b = m.b, .kept = &kept};
  const Report first = distance_of(view);
  const Mesh small = icosphere(0.5, 1);
  for (const PairView& other :
       {PairView{.a = small, .b = m.b}, PairView{.a = m.b, .b = small, .kept = &own}}) {
    distance_of(other);
    const Report again = distance_of(view);
    CHECK(again.lower == first.lower);
    CHECK(again.upper == first.upper);
    distance_of(other);
    CHECK(start_of(view).has_bounds_of(start_of({.a = m.a, .b = m.b})));
  }
}

TEST_CASE("a pair that lies there is searched again as if it were new") {
  if (is_native()) return;
  const TwoMeshes m;
  KeptPair kept;
  const PairView view{.a = m.a, .b = m.b, .kept = &kept};
  const Report first = distance_of(view), again = distance_of(view);
  check_same(first, again);
}

TEST_CASE("a pair in a prepared B's frame may be asked without it, and the other way round") {
  if (is_native()) return;
  const TwoMeshes m;
  const PreparedMesh prepared = solver().prepare(m.b);
  const Report alone = solver().distance(m.a, m.b);
  for (const bool begins_prepared : {true, false}) {
    KeptPair kept;
    for (const bool is_prepared : {begins_prepared, !begins_prepared, begins_prepared}) {
      const Report r = distance_of(
          {.a = m.a, .b = m.b, .prepared = is_prepared ? &prepared : nullptr, .kept = &kept});
      CHECK(r.lower <= alone.upper);
      CHECK(r.upper >= alone.lower);
      CHECK(r.status == Status::kClosed);
    }
  }
}

}  // namespace
