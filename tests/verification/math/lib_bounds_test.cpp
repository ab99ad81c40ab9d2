// shaders/math/bounds.h against samples: no point of a patch T is farther from the surfaces than
// the cascade's bounds, in any arithmetic Vulkan allows. A sample decides in doubles if it can,
// otherwise in exact arithmetic.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "tests/support/tally.h"
#include "tests/verification/model/exact_lib.h"
#include "tests/verification/model/lib_device.h"
#include "tests/verification/oracle/closest.h"

using namespace vkh;
using namespace vkh::test;

namespace {

constexpr uint32_t kWeightBits = 20;
constexpr uint32_t kWeightOne = 1u << kWeightBits;

/// T in the kernels' form: around its first corner.
struct PatchCase {
  Stored origin, b, c;
  std::array<StoredTriangle, 2> surface;
  float reach;
  float base;
  bool sharp;
  double inflation;  ///< increase of the corners' distances over the computed ones
  glm::dvec3 local(uint32_t i) const {
    return i == 0 ? glm::dvec3(0.0) : i == 1 ? b.value() : c.value();
  }
  double size() const { return std::max(glm::length(b.value()), glm::length(c.value())); }
};

StoredTriangle moved(const StoredTriangle& t, const glm::dvec3& by) {
  StoredTriangle out;
  for (uint32_t i = 0; i < 3; ++i) out.corner[i] = stored(t.at(i) + by);
  return out;
}
StoredTriangle mirrored(const StoredTriangle& t, const glm::dvec3& about,
                        const glm::dvec3& normal) {
  StoredTriangle out;
  for (uint32_t i = 0; i < 3; ++i) {
    out.corner[i] = stored(t.at(i) - 2.0 * glm::dot(t.at(i) - about, normal) * normal);
  }
  return out;
}

/// Two halves of a larger triangle over T, folded along the line between them by up to a few sizes.
std::array<StoredTriangle, 2> ridge(Random& random, const StoredTriangle& t, double size) {
  const glm::dvec3 lift = size * log_uniform(random, -20, 1) * random.direction();
  const glm::dvec3 a = t.at(0) - (t.at(1) - t.at(0)), b = t.at(1) + (t.at(1) - t.at(2));
  const glm::dvec3 c = t.at(2) + (t.at(2) - t.at(0));
  const glm::dvec3 fold = b + random.range(-0.5, 1.5) * (c - b) + lift;
  return {StoredTriangle{{stored(a), stored(b), stored(fold)}},
          StoredTriangle{{stored(a), stored(fold), stored(c)}}};
}

/// The same two halves in one plane, or nearly, under T: an edge of B that T lies across.
std::array<StoredTriangle, 2> nearly_flat(Random& random, const StoredTriangle& t, double size) {
  const glm::dvec3 x = t.at(1) - t.at(0), y = t.at(2) - t.at(0);
  const glm::dvec3 normal = glm::cross(x, y);
  const double length = glm::length(normal);
  if (!(length > 0)) return ridge(random, t, size);
  const glm::dvec3 up = (size * log_uniform(random, -12, 4) / length) * normal;
  const glm::dvec3 fold = (size * log_uniform(random, -30, -2) / length) * normal;
  const double edge = random.range(0.1, 0.9);
  const double reach = 4.0;
  const glm::dvec3 low = t.at(0) + edge * x - reach * y - up, high = low + 2.0 * reach * y;
  const glm::dvec3 left = t.at(0) - reach * x - up + fold, right = t.at(0) + reach * x - up;
  return {StoredTriangle{{stored(low), stored(high), stored(left)}},
          StoredTriangle{{stored(high), stored(low), stored(right)}}};
}

std::array<StoredTriangle, 2> hard_surfaces(Random& random, const StoredTriangle& t, double size) {
  const double range = size * log_uniform(random, -6, 3);
  const StoredTriangle s = hard_triangle_near(random, t.at(random.below(3)), range);
  const glm::dvec3 normal = random.direction();
  switch (random.below(9)) {
    case 0:
      return {s, s};
    case 1:
      return {moved(t, size * log_uniform(random, -30, 0) * random.direction()), s};
    // All points of the mirror plane through T's centre are as far from one as from the other.
    case 2:
      return {s, mirrored(s, on_triangle(t, barycentrics(random)), normal)};
    case 3:
      return ridge(random, t, size);
    case 7:
      return nearly_flat(random, t, size);
    case 4:
      return {hard_triangle(random), s};
    case 5:
      return {hard_triangle(random), hard_triangle(random)};
    case 6:
      return {hard_triangle(random, Shape::kAny), hard_triangle_near(random, t.at(1), range)};
    default:
      return {s, hard_triangle_near(random, t.at(random.below(3)), range)};
  }
}

PatchCase hard_patch(Random& random) {
  const StoredTriangle t = hard_triangle(random);
  PatchCase c;
  c.origin = random.below(3) == 0 ? stored_single(t.at(0)) : t.corner[0];
  c.b = stored(t.at(1) - t.at(0));
  c.c = stored(t.at(2) - t.at(0));
  c.surface = hard_surfaces(random, t, std::max(c.size(), 0x1p-24));
  c.reach = std::max({length_up(c.origin), length_up(c.b), length_up(c.c)});
  c.base = hard_base(random, c.surface[0], t.at(random.below(3)));
  c.sharp = random.below(2) == 0;
  c.inflation = random.below(3) == 0 ? log_uniform(random, -22, 2) : 0.0;
  return c;
}

struct Bounds {
  std::array<double, 2> single;
  double u1, u2, pair, bisector, thirds, radius;
};

/// u3's case 1, sharing a corner or not: a plane through any point will do.
auto bisector_of(const math::Patch& t, const math::Surface& s, const math::vec3& ds,
                 const math::Surface& r, const math::vec3& dr) {
  math::vec3 at;
  math::share_corner(s.at, r.at, at);
  return math::bound_bisector(t, s, ds, r, dr, at);
}

/// u3's case 2, corner 1 nearest to R.
auto thirds_of(const math::Patch& t, const math::Surface& s, const math::Surface& r) {
  const auto third = [&](uint32_t i, const math::Surface& x) {
    return math::bound_third(t, i, x, math::surface_distance_up(math::corner_at(t, i), x));
  };
  return math::max(third(0, s), math::max(third(1, r), third(2, s)));
}

/// `nearest`: the corners' distances from the nearer surface above the base, not below the exact.
Bounds bounds_of(const PatchCase& c, const glm::vec3& nearest, const Device& device) {
  return device.run([&]() -> Bounds {
    const math::Patch t = math::make_patch(math::two(math::vec3(0.0f, 0.0f, 0.0f)),
                                           math::given(c.b), math::given(c.c));
    const math::Surface s = math::surface_around(c.surface[0], c.origin, c.reach, c.sharp, c.base);
    const math::Surface r = math::surface_around(c.surface[1], c.origin, c.reach, c.sharp, c.base);
    math::vec3 ds = math::corner_distances(t, s), dr = math::corner_distances(t, r);
    const Bounds plain = {{math::wide(math::bound_single(ds)), math::wide(math::bound_single(dr))},
                          math::wide(math::bound_u1(t, math::given(nearest))),
                          math::wide(math::bound_u2(t, math::given(nearest))),
                          0.0,
                          math::wide(bisector_of(t, s, ds, r, dr)),
                          math::wide(thirds_of(t, s, r)),
                          math::wide(math::radius_up(t.at))};
    // Any upper bounds will do; they move the cut.
    const auto more = static_cast<float>(c.inflation);
    ds = math::vec3(ds.x + more * abs(ds.x), ds.y, ds.z);
    dr = math::vec3(dr.x, dr.y + more * abs(dr.y), dr.z);
    Bounds out = plain;
    out.pair = math::wide(math::bound_pair(t, s, ds, r, dr));
    return out;
  });
}

/// A point of T by the weights of its second and third corner, over 2^20.
struct Weights {
  uint32_t b, c;
};

/// Distances of points of T from both surfaces: near, and exact where asked.
class Sampler {
 public:
  explicit Sampler(const PatchCase& c)
      : c_(c), near_{prepared(c, 0), prepared(c, 1)}, margin_(0x1p-46 * scale(c)) {
    const exact::Vector origin = fixed_vector(c.origin);
    b_ = fixed_vector(c.b);
    c_exact_ = fixed_vector(c.c);
    for (size_t i = 0; i < 2; ++i) exact_[i] = ExactTriangle(c.surface[i]).moved(origin);
  }

  glm::dvec3 at(Weights w) const {
    return std::ldexp(1.0, -static_cast<int>(kWeightBits)) *
           (static_cast<double>(w.b) * c_.local(1) + static_cast<double>(w.c) * c_.local(2));
  }
  double near(Weights w, size_t surface) const { return near_[surface].distance(at(w)); }
  double margin() const { return margin_; }  ///< of what near() is off by

  Rational squared(Weights w, size_t surface) const {
    const exact::Vector x = Integer(w.b) * b_ + Integer(w.c) * c_exact_;
    const Integer one(kWeightOne);
    const ExactTriangle& t = exact_[surface];
    return exact::scaled(exact::to_triangle(x, one * t.a, one * t.b, one * t.c),
                         -kFixedBits - static_cast<int>(kWeightBits));
  }
  bool at_most(Weights w, size_t surface, double near, double bound) const {
    const double base = static_cast<double>(c_.base);
    return near + margin_ <= base + bound || is_upper_bound(base, bound, squared(w, surface));
  }

 private:
  static PreparedTriangle prepared(const PatchCase& c, size_t i) {
    const glm::dvec3 o = c.origin.value();
    const StoredTriangle& t = c.surface[i];
    return {t.at(0) - o, t.at(1) - o, t.at(2) - o};
  }
  static double scale(const PatchCase& c) {
    double largest = glm::length(c.origin.value()) + c.size();
    for (const StoredTriangle& t : c.surface) {
      for (uint32_t i = 0; i < 3; ++i) largest = std::max(largest, glm::length(t.at(i)));
    }
    return 2.0 * largest;
  }

  const PatchCase& c_;
  std::array<PreparedTriangle, 2> near_;
  double margin_;
  exact::Vector b_, c_exact_;
  std::array<ExactTriangle, 2> exact_;
};

/// The points along the edge where the two surfaces are equally far: the tightest places of a pair.
Weights crossing(const Sampler& sampler, Weights from, Weights to) {
  const auto between = [&](double s) -> Weights {
    const auto mix = [&](uint32_t p, uint32_t q) {
      return static_cast<uint32_t>(static_cast<double>(p) * (1.0 - s) + static_cast<double>(q) * s);
    };
    return {mix(from.b, to.b), mix(from.c, to.c)};
  };
  const auto excess = [&](double s) {
    return sampler.near(between(s), 0) - sampler.near(between(s), 1);
  };
  double lo = 0.0, hi = 1.0;
  const bool nearer_at_start = excess(0.0) < 0.0;
  for (int i = 0; i < 20; ++i) {
    const double middle = 0.5 * (lo + hi);
    (excess(middle) < 0.0 ? nearer_at_start : !nearer_at_start) ? lo = middle : hi = middle;
  }
  return between(lo);
}

std::vector<Weights> samples(const Sampler& sampler, uint32_t cells) {
  std::vector<Weights> out;
  const uint32_t step = kWeightOne / cells;
  for (uint32_t j = 0; j <= cells; ++j) {
    for (uint32_t k = 0; k + j <= cells; ++k) out.push_back({j * step, k * step});
  }
  const std::array<Weights, 3> corner = {Weights{0, 0}, {kWeightOne, 0}, {0, kWeightOne}};
  for (size_t i = 0; i < 3; ++i) {
    out.push_back(crossing(sampler, corner[i], corner[(i + 1) % 3]));
  }
  return out;
}

/// The corners' distances from the union above the base, rounded up.
glm::vec3 nearest_of(const Sampler& sampler, double base) {
  const auto up = [&](Weights w) {
    const double d = std::min(sqrt_near(sampler.squared(w, 0)), sqrt_near(sampler.squared(w, 1)));
    return float_up(d - base + 0x1p-50 * (d + base));
  };
  return {up({0, 0}), up({kWeightOne, 0}), up({0, kWeightOne})};
}

void check_sample(const Sampler& sampler, Weights w, const Bounds& bound, Tally& tally,
                  const auto& describe) {
  const double s = sampler.near(w, 0), r = sampler.near(w, 1);
  tally.require(sampler.at_most(w, 0, s, bound.single[0]), "d(x, S) <= bound_single", describe);
  tally.require(sampler.at_most(w, 1, r, bound.single[1]), "d(x, R) <= bound_single", describe);
  const size_t nearer = s <= r ? 0 : 1;
  const double near = std::min(s, r);
  const auto at_most = [&](double limit) {
    return sampler.at_most(w, nearer, near, limit) ||
           sampler.at_most(w, 1 - nearer, std::max(s, r), limit);
  };
  tally.require(at_most(bound.u1), "d(x, S + R) <= bound_u1", describe);
  tally.require(at_most(bound.u2), "d(x, S + R) <= bound_u2", describe);
  // 6 kUlp2 of T's radius: what the cut may be off by, left to LocalCorners::slack.
  const double cut = 6.0 * math::wide(math::kUlp2) * bound.radius;
  tally.require(at_most(bound.pair + cut), "d(x, S + R) <= bound_pair", describe);
  tally.require(at_most(bound.bisector + cut), "d(x, S + R) <= bound_bisector", describe);
  tally.require(at_most(bound.thirds + cut), "d(x, S + R) <= bound_third", describe);
}

}  // namespace

TEST_CASE("bounds.h: no sample is beyond bound_single, bound_u1, bound_u2, bound_pair") {
  const uint64_t count = case_count();
  Random random(20240621);
  Tally tally("bounds.h");
  for (uint64_t i = 0; i < count && !tally.hopeless(); ++i) {
    const PatchCase c = hard_patch(random);
    const Device device(i);
    const Sampler sampler(c);
    const Bounds bound = bounds_of(c, nearest_of(sampler, static_cast<double>(c.base)), device);
    const auto describe = [&] {
      return std::string(device.name()) + ": around " + hex(c.origin) + " b " + hex(c.b) + " c " +
             hex(c.c) + " S " + hex(c.surface[0]) + " R " + hex(c.surface[1]) +
             (c.sharp ? " sharp" : "") + " base " + hex(static_cast<double>(c.base)) +
             " inflated " + hex(c.inflation) + " bounds " + hex(bound.single[0]) + " " +
             hex(bound.single[1]) + " " + hex(bound.u1) + " " + hex(bound.u2) + " " +
             hex(bound.pair) + " " + hex(bound.bisector) + " " + hex(bound.thirds);
    };
    double farthest = 0.0;
    // 45 points and the crossings; 561 for one case in sixteen.
    for (const Weights& w : samples(sampler, i % 16 == 3 ? 32 : 8)) {
      check_sample(sampler, w, bound, tally, describe);
      farthest = std::max(farthest, std::min(sampler.near(w, 0), sampler.near(w, 1)));
    }
    const double single = std::min(bound.single[0], bound.single[1]);
    const double base = static_cast<double>(c.base);
    tally.count("pairs below both singles", bound.pair < single);
    tally.count("bisectors below both singles", bound.bisector < single);
    tally.count("thirds below both singles", bound.thirds < single);
    tally.count("pairs that the samples come within 1e-3 of",
                farthest > 0.999 * (base + bound.pair));
    if (farthest < 0x1p-30) continue;
    tally.measure("samples over bound_u1", farthest / (base + bound.u1), describe);
    tally.measure("samples over bound_u2", farthest / (base + bound.u2), describe);
    tally.measure("samples over bound_pair", farthest / (base + bound.pair), describe);
    tally.measure("samples over bound_bisector", farthest / (base + bound.bisector), describe);
    tally.measure("samples over bound_third", farthest / (base + bound.thirds), describe);
  }
  tally.conclude(100 * count);
  CHECK(tally.counted("pairs below both singles") > count / 50);
  CHECK(tally.counted("bisectors below both singles") > count / 100);
  CHECK(tally.counted("thirds below both singles") > count / 100);
}

TEST_CASE("bounds.h: a mark is the last bit, and raises a distance by one float at most") {
  const auto check = [](float d) {
    for (const bool inside : {false, true}) {
      const float up = static_cast<float>(math::wide(math::marked(math::vec3(d, d, d).x, inside)));
      CHECK(up >= d);
      CHECK(up <= std::nextafter(d, 4.0f));
      CHECK(((std::bit_cast<uint32_t>(up) & 1u) != 0) == inside);
    }
  };
  for (const float d : {0.0f, -0.0f, 1.0f, -1.0f, 0x1p-60f, -0x1p-60f, 0x1p-149f, -0x1p-149f})
    check(d);
  Random random(11);
  for (uint64_t i = 0; i < case_count(); ++i)
    check(static_cast<float>((random.below(2) == 0 ? -1 : 1) * log_uniform(random, -60, 1)));
}

// B is a plane, of two triangles on both sides of an edge that T crosses: T is at height H all
// over.
TEST_CASE("bounds.h: bound_pair is the height of T over two triangles in one plane") {
  Random random(12);
  for (uint64_t i = 0; i < case_count() / 10; ++i) {
    const double height = log_uniform(random, -12, 0);
    const auto corner = [&](double x) { return glm::dvec3(x, random.range(-0.4, 0.4), height); };
    const glm::dvec3 a = corner(random.range(-0.4, -0.05)), b = corner(random.range(0.05, 0.4)),
                     c = corner(random.range(-0.4, 0.4));
    const StoredTriangle s{{stored({0, -4, 0}), stored({0, 4, 0}), stored({-4, 0, 0})}};
    const StoredTriangle r{{stored({0, 4, 0}), stored({0, -4, 0}), stored({4, 0, 0})}};
    const auto base = static_cast<float>(height);
    const Stored origin = stored(a);
    const auto patch = math::make_patch(math::given(stored(a - a)), math::given(stored(b - a)),
                                        math::given(stored(c - a)));
    const math::Surface at_s = math::surface_around(s, origin, 2.0f, true, base);
    const math::Surface at_r = math::surface_around(r, origin, 2.0f, true, base);
    const double bound =
        math::wide(math::bound_pair(patch, at_s, math::corner_distances(patch, at_s), at_r,
                                    math::corner_distances(patch, at_r)));
    CAPTURE(height);
    CHECK(static_cast<double>(base) + bound >= height * (1 - 0x1p-45));
    CHECK(bound <= 0x1p-16 * height);
  }
}

// With two surfaces the centroid's distance never decides: the middles' are as large.
TEST_CASE("bounds_paper.h: three triangles, a third of T against each") {
  const uint64_t count = case_count() / 10;
  Random random(7);
  Tally tally("bound_third");
  for (uint64_t i = 0; i < count && !tally.hopeless(); ++i) {
    const std::array<glm::dvec3, 3> t = {glm::dvec3(0.0), random.in_cube(1.0), random.in_cube(1.0)};
    const auto given = [](const glm::dvec3& p) { return math::given(stored(p)); };
    const math::Patch patch = math::make_patch(given(t[0]), given(t[1]), given(t[2]));
    std::vector<PreparedTriangle> near;
    double bound = 0.0;
    for (uint32_t k = 0; k < 3; ++k) {
      // The surface lies around its corner of T, so that the centre is far from all three.
      const auto corner = [&] { return t[k] + random.range(0.0, 0.3) * random.direction(); };
      const StoredTriangle s{{stored(corner()), stored(corner()), stored(corner())}};
      near.emplace_back(s.at(0), s.at(1), s.at(2));
      const math::Surface surface = math::surface_around(s, stored(t[0]), 2.0f, true);
      const auto own = math::surface_distance_up(math::corner_at(patch, k), surface);
      bound = std::max(bound, math::wide(math::bound_third(patch, k, surface, own)));
    }
    const auto distance = [&](const glm::dvec3& p) {
      return std::min({near[0].distance(p), near[1].distance(p), near[2].distance(p)});
    };
    double farthest = 0.0;
    for (uint32_t b = 0; b <= 12; ++b) {
      for (uint32_t c = 0; b + c <= 12; ++c)
        farthest = std::max(
            farthest,
            distance((static_cast<double>(b) * t[1] + static_cast<double>(c) * t[2]) / 12.0));
    }
    const auto describe = [&] { return hex(t[1]) + " " + hex(t[2]) + " bound " + hex(bound); };
    tally.require(farthest <= bound + 1e-12, "d(x, S1 + S2 + S3) <= bound_third", describe);
    tally.count("tight within a tenth", farthest > 0.9 * bound);
  }
  tally.conclude(count);
  CHECK(tally.counted("tight within a tenth") > count / 100);
}
