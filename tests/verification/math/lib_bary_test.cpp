// shaders/math/bary.h against integers and exact arithmetic: corners survive packing, four children
// cover their parent, and computed corners lie within the stated slack of the exact ones.
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "tests/support/tally.h"
#include "tests/verification/model/exact_lib.h"
#include "tests/verification/model/lib_device.h"

using namespace vkh;
using namespace vkh::test;

namespace {

constexpr uint32_t kOne = gpu::kBaryOne;
constexpr uint32_t kSplitCodes = 28;

std::string name_of(const glm::uvec2& p) {
  return "(" + std::to_string(p.x) + ", " + std::to_string(p.y) + ")";
}
std::string name_of(const math::Bary3& t) {
  return name_of(t.a) + " " + name_of(t.b) + " " + name_of(t.c);
}

glm::uvec2 any_bary(Random& random) {
  const auto edge = [&] {
    const std::array<uint32_t, 6> known = {0, 1, kOne, kOne - 1, 0x7ff, 0x800};
    return random.below(3) == 0 ? known[random.below(6)] : random.below(kOne + 1);
  };
  const uint32_t x = edge(), y = edge();
  return {x, y};
}

bool in_root(const glm::uvec2& p) { return p.x <= kOne && p.y <= kOne && p.x + p.y <= kOne; }

/// Twice the area, signed.
int64_t area(const math::Bary3& t) {
  const glm::i64vec2 ab = glm::i64vec2(t.b) - glm::i64vec2(t.a);
  const glm::i64vec2 ac = glm::i64vec2(t.c) - glm::i64vec2(t.a);
  return ab.x * ac.y - ab.y * ac.x;
}

/// Whether p lies in t, for t of positive area.
bool holds(const math::Bary3& t, const glm::uvec2& p) {
  return area({t.a, t.b, p}) >= 0 && area({t.b, t.c, p}) >= 0 && area({t.c, t.a, p}) >= 0;
}

/// A candidate as refinement makes it: `depth` splits down from the root.
math::Bary3 refined(Random& random, uint32_t depth, uint32_t& splits_done) {
  math::Bary3 t = math::whole_root();
  const bool mixed = random.below(2) == 0;
  for (splits_done = 0; splits_done < depth; ++splits_done) {
    const uint32_t split = mixed ? random.below(kSplitCodes) : 0;
    if (!math::can_split(t, split)) break;
    t = math::child_of(math::split_points(t, split), math::child_points(split, random.below(4)));
  }
  return t;
}
math::Bary3 refined(Random& random) {
  uint32_t done = 0;
  return refined(random, random.below(24), done);
}

bool same(const math::Bary3& s, const math::Bary3& t) {
  return s.a == t.a && s.b == t.b && s.c == t.c;
}

void check_packing(const math::Bary3& t, Tally& tally) {
  tally.require(same(t, math::unpack_corners(math::pack_corners(t))), "packing round trip",
                [&] { return name_of(t); });
}

/// The new points of a split in doubled coordinates at each bisection, without the header's help.
bool halves_are_integers(const math::Bary3& t, uint32_t split) {
  const std::array<glm::i64vec2, 3> c = {glm::i64vec2(t.a), glm::i64vec2(t.b), glm::i64vec2(t.c)};
  const auto even = [](const glm::i64vec2& p) { return p.x % 2 == 0 && p.y % 2 == 0; };
  if (split == 0) return even(c[1] + c[2]) && even(c[2] + c[0]) && even(c[0] + c[1]);
  const uint32_t x = (split - 1) % 3, y = (split - 1) / 3 % 3, z = (split - 1) / 9;
  const std::array<glm::i64vec2, 3> turned = {c[x], c[(x + 1) % 3], c[(x + 2) % 3]};
  const glm::i64vec2 sum = turned[1] + turned[2];
  if (!even(sum)) return false;
  const glm::i64vec2 m = sum / int64_t{2};
  const std::array<glm::i64vec2, 3> first = {turned[0], turned[1], m};
  const std::array<glm::i64vec2, 3> second = {turned[0], m, turned[2]};
  return even(first[(y + 1) % 3] + first[(y + 2) % 3]) &&
         even(second[(z + 1) % 3] + second[(z + 2) % 3]);
}

void check_split(const math::Bary3& t, uint32_t split, Tally& tally) {
  const auto describe = [&] { return name_of(t) + " split " + std::to_string(split); };
  const bool can = math::can_split(t, split);
  tally.require(can == halves_are_integers(t, split), "can_split iff the points are integers",
                describe);
  tally.count("splits", can);
  if (!can) return;
  const math::Bary6 points = math::split_points(t, split);
  std::array<math::Bary3, 4> child;
  int64_t sum = 0;
  bool inside = true, oriented = true;
  for (uint32_t i = 0; i < 4; ++i) {
    child[i] = math::child_of(points, math::child_points(split, i));
    sum += area(child[i]);
    oriented = oriented && area(child[i]) > 0;
    inside = inside && holds(t, child[i].a) && holds(t, child[i].b) && holds(t, child[i].c);
  }
  // The children lie inside the parent, none of them turned over and as large together: a tiling or
  // an overlap that leaves a gap. A point inside each child shows that there is no gap.
  tally.require(sum == area(t), "children's areas sum to the parent's", describe);
  tally.require(oriented, "children keep the orientation", describe);
  tally.require(inside, "children lie in the parent", describe);
  bool apart = true;
  for (uint32_t i = 0; i < 4; ++i) {
    const glm::uvec2 middle = child[i].a + child[i].b + child[i].c;
    for (uint32_t j = 0; j < 4; ++j) {
      const math::Bary3 tripled = {3u * child[j].a, 3u * child[j].b, 3u * child[j].c};
      apart = apart && (i == j || !holds(tripled, middle));
    }
  }
  tally.require(apart, "no child holds another's centroid", describe);
}

void check_centroid(const math::Bary3& t, Tally& tally) {
  const glm::uvec2 c = math::centroid_of(t);
  const auto describe = [&] { return name_of(t) + " centroid " + name_of(c); };
  tally.require(in_root(c), "the centroid is in the root", describe);
  const glm::i64vec2 off = glm::i64vec2(t.a + t.b + t.c) - int64_t{3} * glm::i64vec2(c);
  tally.require(off.x >= 0 && off.x < 3 && off.y >= 0 && off.y < 3,
                "the centroid is rounded to the integer below", describe);
}

}  // namespace

TEST_CASE("bary.h: packing, splits and centroids are exact") {
  const math::Bary3 root = math::whole_root();
  CHECK(root.a == glm::uvec2(0, 0));
  CHECK(root.b == glm::uvec2(kOne, 0));
  CHECK(root.c == glm::uvec2(0, kOne));
  const uint64_t count = case_count();
  Random random(20240618);
  Tally tally("bary.h, integers");
  for (uint32_t split = 0; split < kSplitCodes; ++split) check_split(root, split, tally);
  for (uint64_t i = 0; i < count && !tally.hopeless(); ++i) {
    const glm::uvec2 a = any_bary(random), b = any_bary(random), c = any_bary(random);
    check_packing({a, b, c}, tally);
    const math::Bary3 t = refined(random);
    check_packing(t, tally);
    check_split(t, static_cast<uint32_t>(i % kSplitCodes), tally);
    check_centroid(t, tally);
  }
  // Splits down to the last bit, midpoints only: exactly kBaryBits of them.
  for (int i = 0; i < 100; ++i) {
    math::Bary3 t = root;
    uint32_t depth = 0;
    for (; math::can_split(t, 0); ++depth) {
      check_split(t, 0, tally);
      t = math::child_of(math::split_points(t, 0), math::child_points(0, random.below(4)));
    }
    CHECK(depth == gpu::kBaryBits);
  }
  tally.conclude(5 * count);
}

TEST_CASE("bary.h: every packed bit comes back") {
  Tally tally("packing, every value of a corner");
  for (uint32_t value = 0; value <= kOne; ++value) {
    const uint32_t other = kOne - value;
    check_packing({{value, other}, {other, value}, {value, value}}, tally);
  }
  tally.conclude(kOne);
}

namespace {

/// Triangles small or large, anywhere; needles and collapsed ones too, for edges that cancel.
StoredTriangle any_root(Random& random) { return hard_triangle(random); }

/// origin + (x ab + y ac) / 2^20 in units of 2^-(kFixedBits + 20), from the exact corners.
exact::Vector exact_place(const ExactTriangle& root, const glm::uvec2& p) {
  return Integer(kOne) * root.a + Integer(p.x) * (root.b - root.a) +
         Integer(p.y) * (root.c - root.a);
}

struct PlaceAnswer {
  Stored origin, b, c, point, centroid;
  double slack, reach;
  Stored high_b, high_c;  ///< without_low_parts, and its slack
  double high_slack;
};

PlaceAnswer placed(const StoredTriangle& root, const math::Bary3& t, const glm::uvec2& p,
                   const Device& device) {
  return device.run([&]() -> PlaceAnswer {
    const math::Root r = math::make_root(math::given(root.corner[0]), math::given(root.corner[1]),
                                         math::given(root.corner[2]));
    const math::LocalCorners at = math::local_corners(r, t);
    const math::LocalCorners high = math::without_low_parts(at);
    return {math::answer(at.origin),
            math::answer(at.b),
            math::answer(at.c),
            math::answer(math::position_of(r, p)),
            math::answer(math::position_of(r, math::centroid_of(t))),
            math::wide(at.slack),
            math::wide(at.reach),
            math::answer(high.b),
            math::answer(high.c),
            math::wide(high.slack)};
  });
}

double off_from(const exact::Vector& got, const exact::Vector& exact) {
  return length_near(Integer(kOne) * got - exact, kFixedBits + gpu::kBaryBits);
}

}  // namespace

TEST_CASE("bary.h: placed corners lie within the slack of the exact ones") {
  const uint64_t count = case_count();
  Random random(20240619);
  Tally tally("place, local_corners");
  for (uint64_t i = 0; i < count && !tally.hopeless(); ++i) {
    const StoredTriangle root = any_root(random);
    const math::Bary3 t = refined(random);
    glm::uvec2 p = any_bary(random);
    if (!in_root(p)) p = {kOne - p.x, std::min(p.x, p.y)};
    const Device device(i);
    const PlaceAnswer got = placed(root, t, p, device);
    const auto describe = [&] {
      return std::string(device.name()) + ": " + hex(root) + " at " + name_of(t) + ", " +
             name_of(p);
    };
    const ExactTriangle exact(root);
    const exact::Vector origin = fixed_vector(got.origin);
    const double corner =
        std::max({off_from(origin, exact_place(exact, t.a)),
                  off_from(origin + fixed_vector(got.b), exact_place(exact, t.b)),
                  off_from(origin + fixed_vector(got.c), exact_place(exact, t.c))});
    tally.require(corner <= got.slack, "a corner is off by at most slack", describe);
    tally.measure("corner, error / slack", corner / got.slack, describe);
    const double high =
        std::max(off_from(origin + fixed_vector(got.high_b), exact_place(exact, t.b)),
                 off_from(origin + fixed_vector(got.high_c), exact_place(exact, t.c)));
    tally.require(high <= got.high_slack, "so is its high part", describe);
    tally.measure("high part, error / slack", high / got.high_slack, describe);

    const double place =
        std::max(off_from(fixed_vector(got.point), exact_place(exact, p)),
                 off_from(fixed_vector(got.centroid), exact_place(exact, math::centroid_of(t))));
    const double unit = math::wide(math::kUlp2) * got.reach;
    tally.require(place <= 8.0 * unit, "place is off by at most 8 kUlp2 reach", describe);
    tally.measure("place, error / 2^-44 reach", place / (0x1p-44 * got.reach), describe);
    for (const exact::Vector& v : {exact.a, exact.b, exact.c}) {
      tally.require(is_upper_bound(got.reach, square_of(v)), "reach covers the root", describe);
    }
  }
  tally.conclude(6 * count);
}

TEST_CASE(
    "bary.h: the whole root's corners are the root's, to the last bit where they are floats") {
  const uint64_t count = case_count();
  Random random(20240620);
  Tally tally("whole root");
  for (uint64_t i = 0; i < count && !tally.hopeless(); ++i) {
    StoredTriangle root = any_root(random);
    for (Stored& s : root.corner) s = stored_single(s.value());
    const Device device(i);
    const PlaceAnswer got = placed(root, math::whole_root(), {kOne, 0}, device);
    const ExactTriangle exact(root);
    const auto describe = [&] { return std::string(device.name()) + ": " + hex(root); };
    const exact::Vector origin = fixed_vector(got.origin);
    const bool first = length_near(origin - exact.a) == 0.0;
    const double off = std::max(length_near(origin + fixed_vector(got.b) - exact.b),
                                length_near(origin + fixed_vector(got.c) - exact.c));
    tally.require(first, "the first corner is exact", describe);
    tally.require(!device.nearest() || off == 0.0, "to nearest, so are the others", describe);
    tally.require(off <= got.slack, "the others are within slack", describe);
  }
  tally.conclude(3 * count);
}
