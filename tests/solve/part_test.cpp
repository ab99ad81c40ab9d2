// Parts of A: each face is in one, each is the part of A that its name states, and h of all is
// h(A,B).
#include "host/solve/part.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/shapes/shapes.h"
#include "tests/support/solver_bench.h"
#include "tests/verification/oracle/reference_solver.h"

namespace {

using namespace vkh;
using namespace vkh::test;

size_t count_of(const FaceRanges& ranges) {
  size_t count = 0;
  for (const FaceRange& range : ranges) count += range.end - range.begin;
  return count;
}

using Deal = FaceRanges (*)(size_t, size_t, size_t);

void check_dealt(Deal deal, size_t faces, size_t count, size_t most_apart) {
  CAPTURE(faces);
  CAPTURE(count);
  std::vector<int> times(faces);
  size_t least = faces, most = 0;
  for (size_t i = 0; i < count; ++i) {
    const FaceRanges ranges = deal(faces, i, count);
    size_t local = 0;
    for (const FaceRange& range : ranges) {
      for (size_t face = range.begin; face < range.end; ++face, ++local) {
        ++times.at(face);
        if (local % 97 == 0) CHECK(face_of_whole(ranges, local) == face);
      }
    }
    least = std::min(least, count_of(ranges));
    most = std::max(most, count_of(ranges));
  }
  CHECK(std::all_of(times.begin(), times.end(), [](int n) { return n == 1; }));
  CHECK(least >= 1);
  CHECK(most - least <= most_apart);
}

const auto solve = [](const Mesh& a, const Mesh& b, const SolveOptions& options) {
  return solver().distance(a, b, options);
};

}  // namespace

TEST_CASE("every face is in one part, and parts are alike") {
  for (const size_t faces : {1u, 2u, 7u, 100u, 30268u, 300001u}) {
    for (const size_t count : {1u, 2u, 3u, 7u, 64u}) {
      if (count > faces) continue;
      check_dealt(part_in_order, faces, count, 1);
      check_dealt(part_by_turns, faces, count, std::max<size_t>(1, faces / count / 32));
    }
  }
  // Products of the two would overflow.
  const FaceRanges last = part_in_order(SIZE_MAX / 2, SIZE_MAX / 4 - 1, SIZE_MAX / 4);
  CHECK(last.back().end == SIZE_MAX / 2);
}

TEST_CASE("a part is those faces of A, and the vertices that they use") {
  const Mesh a = permuted(height_field(200, 1), 5);  // more than one block of each
  for (const FaceRanges& ranges :
       {part_in_order(a.faces.size(), 1, 3), part_by_turns(a.faces.size(), 2, 3)}) {
    const Mesh part = part_of(a, ranges);
    REQUIRE(part.faces.size() == count_of(ranges));
    std::vector<bool> used(part.vertices.size());
    bool is_same = true;
    for (size_t i = 0; i < part.faces.size(); ++i) {
      const glm::uvec3 mine = part.faces[i], its = a.faces[face_of_whole(ranges, i)];
      for (int k = 0; k < 3; ++k) {
        is_same = is_same && part.vertices[mine[k]] == a.vertices[its[k]];
        used[mine[k]] = true;
      }
    }
    CHECK(is_same);
    CHECK(std::all_of(used.begin(), used.end(), [](bool is_used) { return is_used; }));
    CHECK(part.counts.faces == part.faces.size());
    CHECK(part.counts.vertices == part.vertices.size());
  }
}

TEST_CASE("h of all parts is h of A, and each says where it is") {
  const Mesh a = height_field(24, 1), b = height_field(24, 3);
  const Interval exact = reference_hausdorff(a, b, 1e-9);
  SolveOptions options;
  const double tolerance = solver().distance(a, b, options).tolerance;
  double lower = 0, upper = 0;
  constexpr size_t kParts = 5;
  for (size_t i = 0; i < kParts; ++i) {
    const FaceRanges ranges = part_in_order(a.faces.size(), i, kParts);
    const Report r = distance_of_part(solve, a, ranges, b, options);
    CHECK(r.status == Status::kClosed);
    CHECK(r.tolerance == tolerance);  // of A's diagonal, not of the part's
    CHECK(r.diagonal_a == doctest::Approx(vkh::test::diagonal(a)));
    CHECK(r.mesh_a.faces == a.faces.size());
    CHECK(r.witness_a.face >= ranges[0].begin);
    CHECK(r.witness_a.face < ranges[0].end);
    CHECK(interval(r).meets(reference_hausdorff(part_of(a, ranges), b, 1e-9)));
    lower = std::max(lower, r.lower);
    upper = std::max(upper, r.upper);
  }
  CHECK(lower <= exact.upper);
  CHECK(upper >= exact.lower);
  CHECK(upper - lower <= tolerance);
}

TEST_CASE("what another part has shown ends a part, and its interval is true") {
  const Mesh a = height_field(24, 1), b = height_field(24, 3);
  const Report whole = solver().distance(a, b);
  int pruned = 0;
  for (size_t i = 0; i < 4; ++i) {
    const FaceRanges ranges = part_in_order(a.faces.size(), i, 4);
    SolveOptions options;
    options.known_lower = whole.lower;
    const Report r = distance_of_part(solve, a, ranges, b, options);
    CHECK((r.status == Status::kClosed || r.status == Status::kPruned));
    CHECK(r.upper <= whole.lower + r.tolerance * (1 + 1e-12));
    CHECK(interval(r).meets(reference_hausdorff(part_of(a, ranges), b, 1e-9)));
    pruned += r.status == Status::kPruned ? 1 : 0;
  }
  CHECK(pruned >= 1);
}

TEST_CASE("A that is a point has parts that are points") {
  const Mesh point = single_triangle({1, 0, 0}, {1, 0, 0}, {1, 0, 0});
  const Mesh b = single_triangle({0, 0, 0}, {0, 1, 0}, {0, 0, 1});
  const Report r = distance_of_part(solve, point, part_in_order(1, 0, 1), b, {});
  CHECK(r.lower <= 1);
  CHECK(r.upper >= 1);
}
