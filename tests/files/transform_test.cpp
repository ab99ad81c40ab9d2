// Affine maps of nodes against exact rationals: no entry and no moved point is farther from its
// exact place than stated, and exact results are marked as exact.
#include "host/read/transform.h"

#include <doctest/doctest.h>

#include <cmath>

#include "tests/shapes/adversarial.h"
#include "tests/support/tally.h"
#include "tests/verification/model/arithmetic.h"
#include "tests/verification/oracle/exact.h"

using namespace vkh;
using namespace vkh::scene;
using namespace vkh::test;

namespace {

using Exact = std::array<std::array<Rational, 4>, 3>;

Exact exact_of(const Affine& map) {
  Exact out;
  for (size_t r = 0; r < 3; ++r)
    for (size_t c = 0; c < 4; ++c) out[r][c] = Rational(map.m[r][c]);
  return out;
}

/// The map by its definition: t + R(q / |q|) (s x), where R needs |q|^2 alone.
Exact exact_of(const Placing& p) {
  const Rational x(p.rotation[0]), y(p.rotation[1]), z(p.rotation[2]), w(p.rotation[3]);
  const Rational n = x * x + y * y + z * z + w * w;
  const Rational rotation[3][3] = {
      {1 - 2 * (y * y + z * z) / n, 2 * (x * y - z * w) / n, 2 * (x * z + y * w) / n},
      {2 * (x * y + z * w) / n, 1 - 2 * (x * x + z * z) / n, 2 * (y * z - x * w) / n},
      {2 * (x * z - y * w) / n, 2 * (y * z + x * w) / n, 1 - 2 * (x * x + y * y) / n}};
  Exact out;
  for (size_t r = 0; r < 3; ++r) {
    for (size_t c = 0; c < 3; ++c) out[r][c] = rotation[r][c] * Rational(p.scale[c]);
    out[r][3] = Rational(p.translation[r]);
  }
  return out;
}

Exact product(const Exact& outer, const Exact& inner) {
  Exact out;
  for (size_t r = 0; r < 3; ++r) {
    for (size_t c = 0; c < 4; ++c) {
      out[r][c] = c == 3 ? outer[r][3] : Rational(0);
      for (size_t k = 0; k < 3; ++k) out[r][c] += outer[r][k] * inner[k][c];
    }
  }
  return out;
}

double hard_number(Random& random) {
  const double simple[] = {0, 1, -1, 0.5, 2, 0.1, 1e-7, 1e6, 1.0 / 3};
  if (random.below(3) == 0) return simple[random.below(9)];
  return (random.below(2) == 0 ? 1 : -1) * log_uniform(random, -30, 30);
}

Placing hard_placing(Random& random) {
  Placing p;
  const uint32_t parts = random.below(8);
  const auto as_float = [&](double x) { return static_cast<double>(static_cast<float>(x)); };
  for (double& t : p.translation) t = (parts & 1) != 0 ? hard_number(random) : 0;
  for (double& s : p.scale) s = (parts & 2) != 0 ? hard_number(random) : 1;
  if ((parts & 4) == 0) return p;
  for (double& q : p.rotation) q = as_float(random.range(-1, 1));
  if (random.below(3) == 0) p.rotation = {as_float(std::sqrt(0.5)), 0, 0, as_float(std::sqrt(0.5))};
  if (random.below(16) == 0)
    for (double& q : p.rotation) q *= random.below(2) == 0 ? 1e-160 : 1e150;
  return p;
}

void check_entries(const Affine& map, const Exact& exact, const char* claim, Tally& tally) {
  for (size_t r = 0; r < 3; ++r) {
    for (size_t c = 0; c < 4; ++c) {
      const Rational off = abs(exact[r][c] - Rational(map.m[r][c]));
      const auto describe = [&] {
        return hex(map.m[r][c]) + " off " + hex(map.off[r][c]) + " truly " + hex(off.get_d());
      };
      tally.require(off <= Rational(map.off[r][c]), claim, describe);
      if (map.off[r][c] > 0x1p-900 && off != 0)
        tally.measure(claim, off.get_d() / map.off[r][c], describe);
    }
  }
}

void check_moved(const Affine& map, const Exact& exact, Random& random, Tally& tally) {
  const double relative = random.below(2) == 0 ? 0 : 0x1p-53;
  const Mover mover(map, relative);
  for (int i = 0; i < 4; ++i) {
    const glm::dvec3 p = {hard_number(random), hard_number(random), hard_number(random)};
    double delta = 0;
    const glm::dvec3 moved = mover(p, delta);
    Rational squared = 0;
    for (size_t r = 0; r < 3; ++r) {
      Rational image = exact[r][3];
      for (int c = 0; c < 3; ++c) {
        // A point that is itself off, as far as it may be, to the worse side.
        const Rational sign = random.below(2) == 0 ? 1 : -1;
        const Rational worst = Rational(p[c]) * (1 + sign * Rational(relative));
        image += exact[r][static_cast<size_t>(c)] * worst;
      }
      const Rational off = image - Rational(moved[static_cast<int>(r)]);
      squared += off * off;
    }
    const auto describe = [&] { return hex(p) + " moved " + hex(moved) + " delta " + hex(delta); };
    tally.require(squared <= Rational(delta) * Rational(delta), "moved within delta", describe);
    tally.count("moved exactly", squared == 0);
    tally.count("and said to be", delta == 0);
    if (delta > 0x1p-900)
      tally.measure("of delta", std::sqrt(Rational(squared / delta / delta).get_d()), describe);
  }
}

}  // namespace

TEST_CASE("no entry of a node's map, and no moved point, is farther off than is said") {
  const uint64_t count = case_count() / 40;
  Random random(20261122);
  Tally tally("transform");
  for (uint64_t i = 0; i < count && !tally.hopeless(); ++i) {
    Affine map;
    Exact exact = exact_of(Affine{});
    for (uint32_t levels = 1 + random.below(4); levels > 0; --levels) {
      const Placing placing = hard_placing(random);
      const std::optional<Affine> inner = affine_of(placing);
      REQUIRE(inner);
      check_entries(*inner, exact_of(placing), "an entry of one node", tally);
      map = compose(map, *inner);
      exact = product(exact, exact_of(placing));
      check_entries(map, exact, "an entry of a product", tally);
    }
    check_moved(map, exact, random, tally);
  }
  tally.conclude(count);
  CHECK(tally.counted("and said to be") > count / 40);
}

Rational determinant(const Exact& m) {
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) +
         m[0][1] * (m[1][2] * m[2][0] - m[1][0] * m[2][2]) +
         m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

/// Rows of which one is nearly, or exactly, a sum of the others.
Affine::Rows nearly_flat(Random& random) {
  Affine::Rows rows{};
  const double scale = std::ldexp(1.0, static_cast<int>(random.below(300)) - 150);
  const auto number = [&] { return std::ldexp(random.below(1 << 21) - 0x1p20, -20); };
  for (size_t c = 0; c < 4; ++c) {
    rows[1][c] = number();
    rows[2][c] = number();
    rows[0][c] = scale * (rows[2][c] - rows[1][c]);
  }
  const size_t c = random.below(3);
  const double way = random.below(2) == 0 ? -INFINITY : INFINITY;
  for (uint32_t steps = random.below(3); steps > 0; --steps)
    rows[2][c] = std::nextafter(rows[2][c], way);
  std::swap(rows[random.below(3)], rows[random.below(3)]);
  return rows;
}

TEST_CASE("the sign of a chain's determinant is exact, however flat its maps are") {
  const uint64_t count = case_count() / 40;
  Random random(20261128);
  Tally tally("sign of the determinant");
  for (uint64_t i = 0; i < count && !tally.hopeless(); ++i) {
    Affine map;
    int sign = 1;
    for (uint32_t levels = 1 + random.below(4); levels > 0; --levels) {
      const bool is_matrix = random.below(2) == 0;
      const Placing placing = hard_placing(random);
      const Affine inner = is_matrix ? affine_of(nearly_flat(random)) : *affine_of(placing);
      const Rational exact = determinant(is_matrix ? exact_of(inner) : exact_of(placing));
      tally.count("flat", exact == 0);
      tally.count("mirrors", exact < 0);
      sign *= sgn(exact);
      map = compose(map, inner);
    }
    tally.require(map.sign == sign, "sign of a chain",
                  [&] { return std::to_string(map.sign) + " for " + std::to_string(sign); });
  }
  tally.conclude(count);
  CHECK(tally.counted("flat") > count / 40);
  CHECK(tally.counted("mirrors") > count / 4);
}

TEST_CASE("what moves nothing, or turns by right angles, is exact") {
  const glm::dvec3 p = {0.1, -1.0 / 3, 1e300};
  double delta = 0;
  CHECK(Mover(Affine{}, 0)(p, delta) == p);
  CHECK(Mover(*affine_of(Placing{}), 0)(p, delta) == p);
  CHECK(Mover(compose(Affine{}, Affine{}), 0)(p, delta) == p);
  // z up to y up, twice as large.
  const Affine turned = {.m = {{{2, 0, 0, 0}, {0, 0, 2, 0}, {0, -2, 0, 0}}}, .off = {}};
  CHECK(Mover(compose(turned, turned), 0)({0.1, 0.2, 0.3}, delta) == glm::dvec3(0.4, -0.8, -1.2));
  CHECK(delta == 0);
  CHECK(!affine_of({.rotation = {0, 0, 0, 0}}));
  Mover({.m = {{{1, 0, 0, 0.1}, {0, 1, 0, 0}, {0, 0, 1, 0}}}, .off = {}}, 0)(p, delta);
  CHECK(delta > 0);
}
