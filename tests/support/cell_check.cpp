#include "tests/support/cell_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "shaders/math/dyadic.h"
#include "tests/shapes/shapes.h"

namespace vkh::test {
namespace {

constexpr uint32_t kOne = gpu::kBaryOne;

glm::dvec3 place(const Mesh& a, uint32_t face, const glm::uvec2& p) {
  const glm::uvec3& f = a.faces[face];
  const double v = static_cast<double>(p.x) / kOne, w = static_cast<double>(p.y) / kOne;
  return a.vertices[f.x] + v * (a.vertices[f.y] - a.vertices[f.x]) +
         w * (a.vertices[f.z] - a.vertices[f.x]);
}

double wide(float x) { return static_cast<double>(x); }

glm::uvec2 random_corner(Random& random) {
  const uint32_t v = random.below(kOne + 1);
  return {v, random.below(kOne - v + 1)};
}

// A face halved some times, or any triangle in it, flat ones among them.
gpu::Cell random_cell(Random& random, uint32_t face_count) {
  lib::Bary3 t = lib::whole_root();
  const uint32_t halvings = random.below(24);
  for (uint32_t k = 0; k < halvings; ++k) {
    const uint32_t opposite = random.below(3);
    if (!lib::has_middle_opposite(t, opposite)) break;
    const lib::Halves halves = lib::halves_of(t, opposite, lib::middle_opposite(t, opposite));
    t = random.below(2) == 0 ? halves.first : halves.second;
  }
  if (random.below(8) == 0) {
    t.a = random_corner(random);
    t.b = random_corner(random);
    t.c = random.below(4) == 0 ? t.a : random_corner(random);
  }
  const glm::uvec4 w = lib::pack_corners(t);
  return {{w.x, w.y, w.z, w.w}, random.below(face_count), gpu::kNone};
}

}  // namespace

struct CellCheck::Placed {
  std::array<glm::dvec3, 3> at;
  gpu::CellBounds bounds;

  glm::dvec3 point(const glm::dvec3& w) const { return w.x * at[0] + w.y * at[1] + w.z * at[2]; }
};

namespace {

// Scales by a power of two, so that squares of lengths neither overflow nor vanish.
std::vector<glm::dvec3> scaled_by(const SurveyedPair& pair, std::vector<glm::dvec3> vertices) {
  for (glm::dvec3& v : vertices) {
    for (int axis = 0; axis < 3; ++axis) v[axis] = std::ldexp(v[axis], pair.frame.exponent);
  }
  return vertices;
}

double size_of(const std::vector<glm::dvec3>& vertices) {
  double size = 0;
  for (const glm::dvec3& v : vertices)
    size = std::max({size, std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  return size;
}

}  // namespace

CellCheck::CellCheck(const SurveyedPair& pair, const Mesh& b)
    : pair_(pair),
      a_{.name = {},
         .vertices = scaled_by(pair, pair.a.vertices),
         .faces = pair.a.faces,
         .counts = {}},
      tree_(scaled_by(pair, b.vertices), b.faces),
      margin_(256 * 0x1p-53 *
              std::max(size_of(a_.vertices), size_of(scaled_by(pair, b.vertices)))) {}

double CellCheck::distance(const glm::dvec3& p) const {
  Nearest nearest;
  tree_.query(p, nearest);
  return std::sqrt(nearest.squared);
}

void CellCheck::check_one(const Placed& cell, uint64_t seed, CellTally& tally) const {
  constexpr int kSamples = 12;
  const gpu::CellBounds& b = cell.bounds;
  const double more = pair_.displacement;
  Random random(seed);
  double farthest = 0;
  for (int k = 0; k < kSamples; ++k) {
    glm::dvec3 w(k == 0, k == 1, k == 2);
    if (k >= 3) w = {random.unit(), random.unit(), k % 3 == 0 ? 0 : random.unit()};
    w /= w.x + w.y + w.z;
    const double d = distance(cell.point(w));
    if (k < 3) farthest = std::max(farthest, d);
    const auto at = [&](float x, float y, float z, double moved) {
      return w.x * wide(x) + w.y * wide(y) + w.z * wide(z) + moved;
    };
    tally.below += at(b.lower_a, b.lower_b, b.lower_c, -more) > d + margin_;
    tally.above +=
        std::min(at(b.upper_a, b.upper_b, b.upper_c, more), wide(b.highest) + more) < d - margin_;
    ++tally.samples;
  }
  tally.reached += wide(b.reached) - more > farthest + margin_;
}

// Measures at the middles of kParts^2 equal parts: the distance differs by no more than their size.
void CellCheck::check_means(const Placed& cell, CellTally& tally) const {
  constexpr int kParts = 24;
  double sum = 0, squares = 0, most = 0;
  for (int i = 0; i < kParts; ++i) {
    for (int j = 0; j < 2 * (kParts - i) - 1; ++j) {
      const double third = j % 2 == 0 ? 1.0 / 3 : 2.0 / 3;
      const double v = (i + third) / kParts, w = (j / 2 + third) / kParts;
      const double d = distance(cell.point({1 - v - w, v, w}));
      sum += d;
      squares += d * d;
      most = std::max(most, d);
    }
  }
  const double size =
      std::max({glm::length(cell.at[1] - cell.at[0]), glm::length(cell.at[2] - cell.at[1]),
                glm::length(cell.at[0] - cell.at[2])});
  // Within a part by its affine piece far less; this much in any case.
  const double doubt = size / kParts + margin_ + pair_.displacement;
  const double mean = sum / (kParts * kParts), square = squares / (kParts * kParts);
  const double up = wide(cell.bounds.mean_upper), square_up = wide(cell.bounds.square_upper);
  tally.means += up < mean - doubt || square_up < square - 2 * (most + doubt) * doubt;
}

void CellCheck::check(std::span<const gpu::Cell> cells, std::span<const gpu::CellBounds> bounds,
                      uint64_t seed, CellTally& tally) const {
  for (size_t i = 0; i < cells.size(); ++i) {
    const gpu::uvec4& w = cells[i].corners;
    const lib::Bary3 t = lib::unpack_corners({w.x, w.y, w.z, w.w});
    const uint32_t face = cells[i].face;
    const Placed cell{{place(a_, face, t.a), place(a_, face, t.b), place(a_, face, t.c)},
                      bounds[i]};
    check_one(cell, seed + i, tally);
    if (i % 16 == 0) check_means(cell, tally);
    ++tally.cells;
  }
}

void CellCheck::check(const BoundCells& bound, uint64_t seed, size_t count,
                      CellTally& tally) const {
  Random random(seed);
  std::vector<gpu::Cell> cells;
  for (size_t i = 0; i < count; ++i)
    cells.push_back(random_cell(random, static_cast<uint32_t>(pair_.a.faces.size())));
  std::vector<gpu::CellBounds> bounds(count);
  bound({.cells = cells, .first = 0, .bounds = bounds});
  check(cells, bounds, seed, tally);
}

}  // namespace vkh::test
