// Cells of hard triangles about which a few hard triangles of B lie, and their exact distances.
// Include after shaders/report/cell.h, which the arithmetic is chosen for.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "tests/verification/model/exact_lib.h"
#include "tests/verification/model/lib_device.h"

namespace vkh::test {

struct CellCase {
  StoredTriangle root;
  math::Bary3 cell;
  std::vector<StoredTriangle> b;
};

inline math::Bary3 halved(Random& random) {
  math::Bary3 t = math::whole_root();
  for (uint32_t k = random.below(16); k > 0; --k) {
    const uint32_t opposite = random.below(3);
    if (!math::has_middle_opposite(t, opposite)) break;
    const math::Halves h = math::halves_of(t, opposite, math::middle_opposite(t, opposite));
    t = random.below(2) == 0 ? h.first : h.second;
  }
  return t;
}

inline CellCase hard_case(Random& random) {
  CellCase c{hard_triangle(random), halved(random), {}};
  const uint32_t count = 1 + random.below(4);
  const glm::dvec3 about = c.root.at(random.below(3));
  for (uint32_t k = 0; k < count; ++k)
    c.b.push_back(random.below(3) == 0
                      ? hard_triangle(random)
                      : hard_triangle_near(random, about, std::pow(2.0, -20 * random.unit())));
  return c;
}

inline math::CellFrame cell_frame(const CellCase& c) {
  return math::make_cell(
      math::make_root(math::given(c.root.corner[0]), math::given(c.root.corner[1]),
                      math::given(c.root.corner[2])),
      c.cell);
}

inline std::string hex(const CellCase& c) {
  std::string text = "root " + hex(c.root) + " B";
  for (const StoredTriangle& s : c.b) text += " " + hex(s);
  return text;
}

/// Barycentrics of a point of the cell; denominators are powers of two.
using Weights = std::array<Rational, 3>;

/// A point times 2^bits, in the units of fixed().
struct ScaledPoint {
  exact::Vector at;
  unsigned bits;
};

inline ScaledPoint exact_point(const CellCase& c, const Weights& weights) {
  size_t bits = 0;
  for (const Rational& w : weights) bits = std::max(bits, mpz_sizeinbase(w.get_den_mpz_t(), 2) - 1);
  const ExactTriangle root(c.root);
  const exact::Vector ab = root.b - root.a, ac = root.c - root.a;
  const Integer one = Integer(1) << bits;
  ScaledPoint p{Integer(gpu::kBaryOne) * (one * root.a),
                static_cast<unsigned>(bits) + gpu::kBaryBits};
  const std::array<glm::uvec2, 3> corners = {c.cell.a, c.cell.b, c.cell.c};
  for (size_t i = 0; i < 3; ++i) {
    const Integer weight(weights[i] * one);
    p.at = p.at + weight * (Integer(corners[i].x) * ab + Integer(corners[i].y) * ac);
  }
  return p;
}

/// The squared distance of the point from the nearest triangle.
inline Rational squared_distance(const CellCase& c, const Weights& weights) {
  const ScaledPoint p = exact_point(c, weights);
  const Integer scale = Integer(1) << p.bits;
  Rational least = -1;
  for (const StoredTriangle& s : c.b) {
    const ExactTriangle t(s);
    const Rational d = ExactTriangle(scale * t.a, scale * t.b, scale * t.c).squared_distance(p.at);
    if (least < 0 || d < least) least = d;
  }
  const Integer shrink = Integer(1) << (2 * p.bits);
  return least / Rational(shrink);
}

}  // namespace vkh::test
