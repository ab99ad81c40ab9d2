// shaders/survey/tally.h and wide.h against exact integers: what a cell adds to the sums lies on
// the side that it is named for, and loses no more than a unit. Spoiled roundings must be noticed.
#include <doctest/doctest.h>
#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <utility>

#include "shaders/survey/score.h"
#include "shaders/survey/tally.h"
#include "tests/shapes/shapes.h"

namespace {

using namespace vkh;
using namespace vkh::test;
using lib::uvec2;

mpz_class exact(uint64_t x) {
  mpz_class high(static_cast<unsigned long>(x >> 32));
  return (high << 32) + static_cast<unsigned long>(x & 0xffffffffu);
}
mpz_class exact(const uvec2& x) { return exact(uint64_t{x.y} << 32 | x.x); }
uvec2 words(uint64_t x) { return {static_cast<uint32_t>(x), static_cast<uint32_t>(x >> 32)}; }

/// Integers under 2^62 of any size, all ones and powers of two among them.
uint64_t any_weight(Random& random) {
  const auto bits = static_cast<int>(random.below(63));
  const uint64_t mask = (uint64_t{1} << bits) - 1;
  switch (random.below(4)) {
    case 0:
      return mask;
    case 1:
      return mask + 1 < (uint64_t{1} << 62) ? mask + 1 : mask;
    default:
      return random.bits() & mask;
  }
}

constexpr int kCases = 200'000;

TEST_CASE("wide.h: sums, shifts and scaled products are exact, or rounded down") {
  Random random(1);
  for (int i = 0; i < kCases; ++i) {
    const uint64_t a = any_weight(random), b = any_weight(random);
    CHECK(exact(lib::wide_sum(words(a), words(b))) == exact(a) + exact(b));
    const auto shift = static_cast<uint32_t>(random.below(64));
    CHECK(exact(lib::wide_shifted(words(a), shift)) == exact(a) >> shift);
    const auto m = static_cast<uint32_t>(random.below((1u << 24) + 1));
    const auto far = static_cast<uint32_t>(24 + random.below(73));
    const mpz_class product = exact(a) * m;
    CHECK(exact(lib::wide_scaled(words(a), m, far)) == product >> far);
  }
}

TEST_CASE("tally.h: a cell is halved as often as its corners say") {
  Random random(2);
  for (int i = 0; i < 2000; ++i) {
    lib::Bary3 t = lib::whole_root();
    unsigned halvings = 0;
    while (random.below(12) != 0) {
      const auto opposite = static_cast<uint32_t>(random.below(3));
      if (!lib::has_middle_opposite(t, opposite)) break;
      const lib::Halves halves = lib::halves_of(t, opposite, lib::middle_opposite(t, opposite));
      t = random.below(2) != 0 ? halves.first : halves.second;
      ++halvings;
    }
    CHECK(lib::halvings_of(t) == halvings);
  }
}

TEST_CASE("tally.h: weights, shares and weighed values are rounded outward, by a unit or two") {
  Random random(3);
  for (int i = 0; i < kCases; ++i) {
    const uint64_t face = any_weight(random);
    const auto halvings = static_cast<uint32_t>(random.below(41));
    const lib::CellWeight w = lib::cell_weight(words(face), halvings);
    const mpq_class weight = mpq_class(exact(face)) / mpq_class(mpz_class(1) << halvings);
    CHECK(exact(w.down) <= weight);
    CHECK(exact(w.up) >= weight);
    CHECK(exact(w.up) - exact(w.down) <= 1);

    const auto share = static_cast<float>(random.below(3) == 0 ? random.below(2) : random.unit());
    const mpq_class part = weight * mpq_class(static_cast<double>(share));
    CHECK(exact(lib::share_down(w, share)) <= part);
    CHECK(exact(lib::share_up(w, share)) >= part);
    CHECK(exact(lib::share_up(w, share)) - part <= 3 + weight / (1 << 24));

    const int unit = static_cast<int>(127 - 40 + random.below(60));
    float value = std::ldexp(static_cast<float>(random.unit()),
                             unit - 127 - static_cast<int>(random.below(50)));
    if (random.below(20) == 0) value = 0;
    if (random.below(20) == 0) value = std::ldexp(1.0f, -140);  // a device may flush it
    mpq_class of_unit(static_cast<double>(value));
    of_unit *= weight;
    if (unit > 127) of_unit /= mpq_class(mpz_class(1) << (unit - 127));
    if (unit < 127) of_unit *= mpq_class(mpz_class(1) << (127 - unit));
    CHECK(exact(lib::weighed_down(w, value, unit)) <= of_unit);
    CHECK(exact(lib::weighed_up(w, value, unit)) >= of_unit);
    CHECK(exact(lib::weighed_up(w, value, unit)) - of_unit <= 2);
    CHECK(of_unit - exact(lib::weighed_down(w, value, unit)) <= 2);
  }
}

TEST_CASE("tally.h: a value of nought adds nothing, from above either") {
  const lib::CellWeight w = lib::cell_weight(words(uint64_t{1} << 61), 3);
  CHECK(exact(lib::weighed_up(w, 0.0f, 127)) == 0);
  CHECK(exact(lib::weighed_up(w, -0.0f, 127)) == 0);
  CHECK(exact(lib::weighed_up(w, 0x1p-140f, 127)) == 1);
}

TEST_CASE("tally.h: a cell is within no distance below its lowest, and within its highest") {
  gpu::CellBounds b{};
  b.lower_a = -0.5f, b.lower_b = 0.25f, b.lower_c = 1;
  b.upper_a = 0.5f, b.upper_b = 1, b.upper_c = 3;
  b.highest = 2, b.mean_upper = 5, b.square_upper = 100;
  const lib::TallyBounds t = lib::tally_bounds(b);
  CHECK(lib::lowest_of(t) == 0);
  CHECK(t.mean_upper == 2);
  CHECK(t.square_upper >= 4);
  CHECK(t.square_upper <= 4.001f);
  CHECK(lib::surely_within(t, 2) == 1);
  CHECK(lib::surely_within(t, 1.999f) < 1);
  CHECK(lib::surely_within(t, 0.4f) == 0);
  CHECK(lib::perhaps_within(t, 1) == 1);
  CHECK(lib::perhaps_within(t, 0.999f) >= 0.99f);
  CHECK(lib::perhaps_within(t, -0.6f) == 0);
}

TEST_CASE("tally.h: moments within a distance enclose those of what is within it") {
  Random random(6);
  for (int i = 0; i < kCases; ++i) {
    // d is an affine function over the cell, known to `doubt`.
    const auto any = [&] { return static_cast<float>(random.range(0.01, 2)); };
    const std::array<float, 3> d{any(), any(), any()};
    const auto doubt = static_cast<float>(random.range(0, 0.2));
    gpu::CellBounds b{};
    b.lower_a = d[0] - doubt, b.lower_b = d[1] - doubt, b.lower_c = d[2] - doubt;
    b.upper_a = d[0] + doubt, b.upper_b = d[1] + doubt, b.upper_c = d[2] + doubt;
    b.highest = std::max({b.upper_a, b.upper_b, b.upper_c});
    b.mean_upper = (b.upper_a + b.upper_b + b.upper_c) / 3 * 1.00001f;
    b.square_upper = b.highest * b.mean_upper;
    const auto most = static_cast<float>(random.range(-0.1, 2.3));
    const float width = random.below(2) != 0 ? 0 : 0.01f;
    const gpu::SurveyEdge edge{most - width, most + width};
    const lib::TallyBounds t = lib::within_most(lib::tally_bounds(b), edge);
    const auto size = [&](double of) { return of <= static_cast<double>(most) ? of : 0.0; };
    double mean = 0, square = 0;
    constexpr int kSteps = 12;
    for (int u = 0; u < kSteps; ++u) {
      for (int v = 0; u + v < kSteps; ++v) {
        const double x = (u + 1.0 / 3) / kSteps, y = (v + 1.0 / 3) / kSteps;
        const double at = size((1 - x - y) * static_cast<double>(d[0]) +
                               x * static_cast<double>(d[1]) + y * static_cast<double>(d[2]));
        mean = std::max(mean, at);
        square = std::max(square, at * at);
      }
    }
    const double highest = static_cast<double>(t.mean_upper);
    const bool is_cut = b.highest > edge.down;
    if (is_cut) {
      CHECK(t.lower.x == 0);
      CHECK(t.lower.y == 0);
      CHECK(t.lower.z == 0);
      // Any part of it may be within: no less than what a part at the limit has, or the mean of
      // all.
      if (mean > 0)
        CHECK(highest >= std::min(mean, static_cast<double>(b.mean_upper)) * (1 - 1e-6));
      if (mean > 0)
        CHECK(static_cast<double>(t.square_upper) >=
              std::min(square, static_cast<double>(b.square_upper)) * (1 - 1e-6));
      CHECK(t.mean_upper <= std::max(edge.up, 0.0f));
    } else {
      CHECK(t.mean_upper == lib::tally_bounds(b).mean_upper);
      CHECK(t.lower.x == b.lower_a);
    }
    if (lib::lowest_of(lib::tally_bounds(b)) > edge.up) {
      CHECK(t.mean_upper == 0);
      CHECK(t.square_upper == 0);
    }
  }
}

// The part that does not count may all lie in what is within; and so may all that may count.
TEST_CASE("tally.h: a cell that counts on a share of it counts no more, and no less") {
  Random random(31);
  for (int i = 0; i < 20'000; ++i) {
    gpu::CellBounds b{};
    const auto value = [&] { return static_cast<float>(random.unit()); };
    b.lower_a = value(), b.lower_b = value(), b.lower_c = value();
    b.upper_a = b.lower_a + value(), b.upper_b = b.lower_b + value(),
    b.upper_c = b.lower_c + value();
    b.highest = b.mean_upper = std::max({b.upper_a, b.upper_b, b.upper_c});
    const gpu::CellAgreement found{.least = 0.25f, .most = 0.5f, .sure = value(), .may = value()};
    const lib::TallyBounds all = lib::tally_bounds(b),
                           some = lib::with_normals(all, found, gpu::kClassCompared);
    const float at = 2 * value();
    const mpq_class sure(static_cast<double>(found.sure)),
        within(static_cast<double>(lib::surely_within(all, at)));
    REQUIRE(mpq_class(static_cast<double>(lib::surely_within(some, at))) <=
            (within + sure > 1 ? mpq_class(within + sure - 1) : mpq_class(0)));
    REQUIRE(lib::surely_within(some, at) >=
            static_cast<float>(within.get_d()) + found.sure - 1.001f);
    REQUIRE(lib::perhaps_within(some, at) == std::min(lib::perhaps_within(all, at), found.may));
    const lib::CellWeight w{{1u << 24, 5}, {(1u << 24) + 1, 5}};
    const auto units = [](const glm::uvec2& x) {
      return mpq_class(static_cast<double>((uint64_t{x.y} << 32) + x.x));
    };
    REQUIRE(units(lib::part_down(w, found.sure)) <= units(w.down) * sure);
    REQUIRE(units(lib::part_up(w, found.may)) >=
            units(w.up) * mpq_class(static_cast<double>(found.may)));
    REQUIRE(units(lib::part_down(w, 1)) == units(w.down));
    REQUIRE(units(lib::part_up(w, 1)) == units(w.up));
    REQUIRE(lib::counts_to(all) == b.highest);
    REQUIRE(lib::counts_from(all) == all.below.least);
    REQUIRE(lib::counts_to(some) > 1e38f);
    const lib::TallyBounds unseen = lib::with_normals(all, found, gpu::kClassOver);
    REQUIRE(unseen.sure == 0);
    REQUIRE(unseen.may == 1);
    REQUIRE(unseen.lower.x == 0);
    REQUIRE(unseen.mean_upper == 1);
  }
}

TEST_CASE("score.h: a cell is in its face's way above what the face reaches, or above a limit") {
  constexpr float kAny = 3e38f;
  CHECK(lib::face_score(1.0f, 0.5f, 0.25f, -kAny, kAny) == 0.25f);
  CHECK(lib::face_score(1.0f, 0.75f, 0.25f, -kAny, kAny) == 0);
  CHECK(lib::face_score(1.0f, 0.9f, 0.25f, -kAny, kAny) == 0);
  CHECK(lib::face_score(1.0f, 0.5f, -kAny, 0.875f, 2.0f) == 0.125f);
  CHECK(lib::face_score(1.0f, 0.5f, -kAny, 1.0f, 2.0f) == 0);
  CHECK(lib::face_score(1.0f, 0.5f, -kAny, 0.875f, 0.25f) == 0);
  CHECK(lib::face_score(1.0f, 0.5f, -kAny, 0.875f, 0.5f) == 0.125f);
}

TEST_CASE("score.h: bins ascend with scores, eight an octave, and nought has none") {
  CHECK(lib::score_bin(0.0f) == 0);
  CHECK(lib::score_bin(0x1p-130f) == 0);
  CHECK(lib::score_bin(2.0f) - lib::score_bin(1.0f) == 8);
  uint32_t last = 0;
  for (float score = 0x1p-120f; score < 1e30f; score *= 1.05f) {
    CHECK(lib::score_bin(score) >= last);
    last = lib::score_bin(score);
  }
  CHECK(last < gpu::kScoreBins);
}

TEST_CASE("score.h: halves are the two halves of the quarters, which are a quarter each") {
  lib::Bary3 at = lib::whole_root();
  unsigned depth = 0;
  for (; lib::has_quarters(at); ++depth) {
    const uint32_t code = lib::bisection_code(depth % 3, (depth + 1) % 3, depth / 3 % 3);
    for (uint32_t x = 0; x < 27; ++x)
      CHECK(lib::can_split(at, lib::bisection_code(x % 3, x / 3 % 3, x / 9)));
    const lib::Bary6 points = lib::split_points(at, code);
    for (uint32_t k = 0; k < 2; ++k) {
      const lib::Bary3 half = lib::child_of(points, lib::half_points(code, k));
      CHECK(lib::halvings_of(half) == 2 * depth + 1);
      const uint32_t inner = k == 0 ? (code - 1) / 3 % 3 : (code - 1) / 9;
      const lib::Bary6 of_half = lib::split_points(half, lib::bisection_code(inner, 0, 0));
      for (uint32_t side = 0; side < 2; ++side) {
        const lib::Bary3 quarter = lib::child_of(points, lib::child_points(code, 2 * k + side));
        const lib::Bary3 same = lib::child_of(of_half, lib::bisected({0, 1, 2}, inner, 3, side));
        CHECK(quarter.a == same.a);
        CHECK(quarter.b == same.b);
        CHECK(quarter.c == same.c);
        CHECK(lib::halvings_of(quarter) == 2 * depth + 2);
      }
    }
    at = lib::child_of(points, lib::child_points(code, 3));
  }
  CHECK(depth >= 9);
}

gpu::CellBounds any_bounds(Random& random) {
  const auto any = [&] { return static_cast<float>(random.range(-1, 3)); };
  gpu::CellBounds b{};
  b.lower_a = any(), b.lower_b = any(), b.lower_c = any();
  b.upper_a = std::max(b.lower_a, any()), b.upper_b = std::max(b.lower_b, any());
  b.upper_c = std::max(b.lower_c, any());
  b.highest = lib::lowest_of(b) + static_cast<float>(random.range(0, 3));
  return b;
}

// The ends of what the distance may be at a point with these barycentrics.
std::pair<double, double> ends_at(const gpu::CellBounds& b, const glm::dvec3& at) {
  const auto affine = [&](float x, float y, float z) { return dot(at, glm::dvec3(x, y, z)); };
  return {std::max(affine(b.lower_a, b.lower_b, b.lower_c), static_cast<double>(lib::lowest_of(b))),
          std::min(affine(b.upper_a, b.upper_b, b.upper_c), static_cast<double>(b.highest))};
}

TEST_CASE("score.h: no distance is farther from what is drawn than that is off") {
  Random random(5);
  for (int i = 0; i < 20000; ++i) {
    const gpu::CellBounds b = any_bounds(random);
    const lib::DrawnCell drawn = lib::drawn_of(b);
    const double off = static_cast<double>(drawn.off) * (1 + 0x1p-23);
    for (int k = 0; k < 12; ++k) {
      glm::dvec3 at(0);
      at[k % 3] = 1;
      if (k >= 3) {
        const double s = random.unit(), t = random.unit() * (1 - s);
        at = {1 - s - t, s, t};
      }
      const auto [from, to] = ends_at(b, at);
      const double there = dot(at, glm::dvec3(drawn.at));
      if (from > to) continue;
      CHECK(off >= to - there - 1e-12);
      CHECK(off >= there - from - 1e-12);
    }
    const double apart = static_cast<double>(b.highest) - static_cast<double>(lib::lowest_of(b));
    CHECK(off <= apart / 2 + 0x1p-20);
  }
}

}  // namespace
