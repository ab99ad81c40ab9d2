// shaders/math/parts.h against exact arithmetic: over parts of cells, cut anywhere and measured
// against any triangle, the bounds enclose the distance, in any arithmetic that Vulkan allows.
// Spoiled parts must be noticed.
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <string>
#include <vector>

#include "tests/verification/model/exact_lib.h"
#include "tests/verification/model/lib_device.h"

#ifdef VKH_TEST_VULKAN_MODEL
#define float ::vkh::model::Real
#endif
#include "shaders/report/cell.h"
#undef float

#include "tests/support/tally.h"
#include "tests/verification/math/cell_cases.h"
#include "tests/verification/oracle/closest.h"

using namespace vkh;
using namespace vkh::test;

namespace {

using Tile = std::array<Weights, 3>;  // an exact part

Tile whole_tile() { return {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}; }

Weights between(const Weights& from, const Weights& to, const Rational& at) {
  Weights w;
  for (size_t i = 0; i < 3; ++i) w[i] = from[i] + at * (to[i] - from[i]);
  return w;
}

Rational area_of(const Tile& t) {
  const auto minor = [&](size_t i, size_t j) -> Rational {
    return t[1][i] * t[2][j] - t[1][j] * t[2][i];
  };
  return abs(t[0][0] * minor(1, 2) + t[0][1] * minor(2, 0) + t[0][2] * minor(0, 1));
}

/// The ways to spoil a part; a bound rests on each.
enum class Spoil { kNone, kCut, kMissing, kSide, kTau, kPlane };

struct Bound {
  std::array<double, 3> at;
  bool is_size;
  double off, mean, square, extreme;
};
struct PartAnswer {
  Tile tile;
  std::array<glm::vec3, 3> corners;
  double area, slack;
  unsigned cuts;
  Bound above, below;
  std::array<double, 2> shares;  // perhaps and surely within `t`
  double t;
};
struct Answer {
  Stored origin;
  std::vector<PartAnswer> parts;
};

Bound answer_of(const math::PartBound& b) {
  return {{math::wide(b.at.x), math::wide(b.at.y), math::wide(b.at.z)},
          b.is_size,
          math::wide(b.off),
          math::wide(b.mean),
          math::wide(b.square),
          math::wide(b.extreme)};
}

/// The choices of a case: cuts, and the triangle that each part is measured against.
struct Choices {
  std::array<std::array<float, 3>, 4> sides;
  std::array<uint32_t, 4> cut;  // the part that is cut
  std::array<uint32_t, 9> measured;
  float t;
};

Choices any_choices(Random& random) {
  Choices c{};
  for (std::array<float, 3>& side : c.sides) {
    for (float& s : side) s = hard_float(random, random.below(2) == 0 ? -30 : -4, 0);
  }
  for (uint32_t& k : c.cut) k = random.below(9);
  for (uint32_t& k : c.measured) k = random.below(64);
  c.t = std::abs(hard_float(random, -20, 0));
  return c;
}

/// A fan of triangles around a point next to T, which crosses some of their planes: T's plane bent
/// by 2^-2 to 2^-30 of the fan's size.
CellCase fan_case(Random& random) {
  CellCase c{hard_triangle(random, Shape::kAny), halved(random), {}};
  const glm::dvec3 a = c.root.at(0), ab = c.root.at(1) - a, ac = c.root.at(2) - a;
  const glm::dvec3 up = glm::cross(ab, ac);
  const double size = std::pow(2.0, -6 * random.unit()),
               bend = std::pow(2.0, -2 - 28 * random.unit());
  const auto near = [&](double v, double w) {
    return stored(a + v * ab + w * ac + size * bend * (2 * random.unit() - 1) * up);
  };
  const double v = 0.2 + 0.2 * random.unit(), w = 0.2 + 0.2 * random.unit();
  const Stored centre = near(v, w);
  std::array<Stored, 4> ring;
  for (size_t k = 0; k < ring.size(); ++k) {
    const double turn = 1.6 * static_cast<double>(k) + random.unit();
    ring[k] = near(v + size * std::cos(turn), w + size * std::sin(turn));
  }
  for (size_t k = 0; k < ring.size(); ++k)
    c.b.push_back({{centre, ring[k], ring[(k + 1) % ring.size()]}});
  return c;
}

struct Cutting {
  std::vector<math::Part> parts;
  std::vector<Tile> tiles;
  std::vector<unsigned> cuts;
};

std::array<Tile, 3> exact_cut(const Tile& t, const math::PartCut& c) {
  const Weights &o = t[c.cut.alone], &f = t[c.cut.first], &h = t[c.cut.second];
  const Weights p = between(o, f, Rational(math::wide(c.to_first)));
  const Weights q = between(o, h, Rational(math::wide(c.to_second)));
  return {{{o, p, q}, {p, f, h}, {p, h, q}}};
}

void cut(Cutting& all, size_t k, const std::array<float, 3>& side, Spoil spoil) {
  const math::vec3 s = math::given(glm::vec3(side[0], side[1], side[2]));
  math::PartCut c = math::part_cut(s, s);
  if (c.cut.none) return;
  const std::array<Tile, 3> tiles = exact_cut(all.tiles[k], c);
  if (spoil == Spoil::kCut) c.to_first = math::min(c.to_first + 0x1p-10f, 1.0f);
  const math::Part whole = all.parts[k];
  const unsigned cuts = all.cuts[k] + 1;
  for (uint32_t which = 0; which < 3; ++which) {
    math::Part part = math::cut_part(whole, c, which);
    if (which == 0) {
      all.parts[k] = part;
      all.tiles[k] = tiles[0];
      all.cuts[k] = cuts;
      continue;
    }
    all.parts.push_back(part);
    all.tiles.push_back(tiles[which]);
    all.cuts.push_back(cuts);
  }
}

math::PartBelow below_of(const math::Part& p, const math::Plane& plane, const math::vec3& h,
                         const std::vector<math::Surface>& surfaces, size_t s, Spoil spoil) {
  const math::vec3 middle = math::middle_of(p.at);
  const auto direction = [&](const math::Surface& r) {
    return math::shortened(math::closest_point(middle, r.at).offset);
  };
  math::PartBelow below = math::begin_below(h);
  const auto off = math::height_off(plane, math::radius_up(p.at), math::max3(math::sizes(h)));
  for (size_t i = 0; i < surfaces.size(); ++i) {
    if (spoil == Spoil::kMissing && i != s) continue;
    const math::Surface& r = surfaces[i];
    math::Excess e = math::excess_of_span(h, math::span_over(plane, r), off);
    e = math::with_minorant(e, h, math::part_minorant(p, r, direction(r)), below.at);
    e = math::with_minorant(e, h, math::part_minorant(p, r, direction(surfaces[s])), below.at);
    if (spoil == Spoil::kSide) std::swap(e.over, e.under);
    below = math::with_excess(below, e);
  }
  return below;
}

PartAnswer bounds_of(const math::Part& p, const std::vector<math::Surface>& surfaces, size_t s,
                     float t, Spoil spoil) {
  const math::Plane plane = math::plane_of(surfaces[s]);
  math::vec3 h = math::heights_of(plane, p.at);
  const math::PartBelow below = below_of(p, plane, h, surfaces, s, spoil);
  math::PartBound above =
      math::part_above(math::offsets_of(p, surfaces[s]), math::slack_of(p, surfaces[s]), plane, h);
  math::PartBound under = math::part_below(p, below);
  if (spoil == Spoil::kTau && above.is_size) above.off = p.slack + surfaces[s].slack;
  if (spoil == Spoil::kPlane && under.is_size)
    under.at = under.at + math::vec3(1e-5f, 1e-5f, 1e-5f);
  PartAnswer out;
  out.corners = {math::answer(p.at.a), math::answer(p.at.b), math::answer(p.at.c)};
  out.area = math::wide(p.area);
  out.slack = math::wide(p.slack);
  out.above = answer_of(above);
  out.below = answer_of(under);
  out.t = static_cast<double>(t);
  out.shares = {math::wide(math::perhaps_within(under, t)),
                math::wide(math::surely_within(above, t))};
  return out;
}

std::vector<math::Surface> surfaces_of(const CellCase& c, const math::CellFrame& frame) {
  math::View view = math::cell_view(frame);
  view.enough = 0.0f;  // in two floats
  std::vector<math::Surface> surfaces;
  for (const StoredTriangle& s : c.b)
    surfaces.push_back(math::make_surface(math::given(s.corner[0]), math::given(s.corner[1]),
                                          math::given(s.corner[2]), view));
  return surfaces;
}

size_t nearest(const math::Part& p, const std::vector<math::Surface>& surfaces) {
  const auto distance2 = [&](const math::Surface& s) {
    return math::wide(math::plain_distance2(math::middle_of(p.at), s.at));
  };
  size_t best = 0;
  for (size_t i = 1; i < surfaces.size(); ++i)
    if (distance2(surfaces[i]) < distance2(surfaces[best])) best = i;
  return best;
}

Answer bounded(const CellCase& c, const Choices& choices, const Device& device, Spoil spoil) {
  return device.run([&]() -> Answer {
    const math::CellFrame frame = cell_frame(c);
    const std::vector<math::Surface> surfaces = surfaces_of(c, frame);
    // No more than the corners need, so that it hides no cut's error.
    const auto slack =
        math::round_up(math::kUlp * frame.radius + 16.0f * math::kUlp2 * frame.reach, 4.0f);
    Cutting all{{math::whole_part(frame.at, slack)}, {whole_tile()}, {0}};
    for (size_t k = 0; k < choices.sides.size(); ++k)
      cut(all, choices.cut[k] % all.parts.size(), choices.sides[k], spoil);
    Answer out{math::answer(frame.origin), {}};
    for (size_t i = 0; i < all.parts.size(); ++i) {
      const uint32_t any = choices.measured[i % choices.measured.size()];
      const size_t s = any % 4 != 0 ? nearest(all.parts[i], surfaces) : any % surfaces.size();
      out.parts.push_back(bounds_of(all.parts[i], surfaces, s, choices.t, spoil));
      out.parts.back().tile = all.tiles[i];
      out.parts.back().cuts = all.cuts[i];
    }
    return out;
  });
}

Rational value_of(const Bound& b, const Weights& in_part, int sign) {
  Rational sum = 0;
  for (size_t i = 0; i < 3; ++i) sum += Rational(b.at[i]) * in_part[i];
  if (b.is_size) sum = abs(sum);
  return sum + sign * Rational(b.off);
}

/// Points of a part, by eighths of its corners.
constexpr std::array<std::array<int, 3>, 7> kPlaces = {
    {{8, 0, 0}, {0, 8, 0}, {0, 0, 8}, {4, 4, 0}, {1, 3, 4}, {5, 2, 1}, {1, 6, 1}}};

Weights in_eighths(const std::array<int, 3>& w) {
  return {Rational(w[0]) / 8, Rational(w[1]) / 8, Rational(w[2]) / 8};
}

Weights place_in(const Tile& tile, const Weights& in_part) {
  Weights w{0, 0, 0};
  for (size_t k = 0; k < 3; ++k)
    for (size_t i = 0; i < 3; ++i) w[i] += in_part[k] * tile[k][i];
  return w;
}

/// The squared distance of a computed corner from the exact one.
Rational moved2(const CellCase& c, const Stored& origin, const glm::vec3& corner,
                const Weights& at) {
  const ScaledPoint p = exact_point(c, at);
  const exact::Vector computed = fixed_vector(origin) + fixed_vector(corner);
  const exact::Vector off = (Integer(1) << p.bits) * computed - p.at;
  return square_of(off, kFixedBits + static_cast<int>(p.bits));
}

bool at_most(const Rational& value, const Rational& squared) {
  return value <= 0 || value * value <= squared;
}
bool at_least(const Rational& value, const Rational& squared) {
  return value >= 0 && value * value >= squared;
}

void check_place(const CellCase& c, const Answer& all, const PartAnswer& p, Tally& tally,
                 const auto& describe) {
  const Rational slack2 = Rational(p.slack) * Rational(p.slack);
  for (size_t k = 0; k < 3; ++k)
    tally.require(moved2(c, all.origin, p.corners[k], p.tile[k]) <= slack2,
                  "a corner is within its slack", describe);
  const Rational exact = area_of(p.tile), off = 3 * Rational(p.cuts) * Rational(0x1p-23 + 0x1p-42);
  const Rational area(p.area);
  const Rational flushed(0x1p-126);
  tally.require(abs(Rational(area - exact)) <= exact * off + flushed, "a part's area", describe);
}

void check_points(const CellCase& c, const PartAnswer& p, Tally& tally, const auto& describe) {
  for (const std::array<int, 3>& eighths : kPlaces) {
    const Weights in_part = in_eighths(eighths);
    const Rational d2 = squared_distance(c, place_in(p.tile, in_part));
    tally.require(at_least(value_of(p.above, in_part, 1), d2), "d(x, B) <= above(x)", describe);
    tally.require(at_most(value_of(p.below, in_part, -1), d2), "below(x) <= d(x, B)", describe);
    tally.require(at_least(Rational(p.above.extreme), d2), "d(x, B) <= the greatest", describe);
    tally.require(at_most(Rational(p.below.extreme), d2), "the least <= d(x, B)", describe);
  }
}

/// Figures of an affine function in rationals, by cutting the triangle where it is 0.
struct Figures {
  Rational mean, square, mean_size, mean_over, square_over;
};

Weights exact_of(const glm::vec3& v) {
  return {Rational(static_cast<double>(v.x)), Rational(static_cast<double>(v.y)),
          Rational(static_cast<double>(v.z))};
}

Rational mean_of(const Weights& s) { return (s[0] + s[1] + s[2]) / 3; }
Rational square_of_affine(const Weights& s) {
  return (s[0] * s[0] + s[1] * s[1] + s[2] * s[2] + s[0] * s[1] + s[1] * s[2] + s[2] * s[0]) / 6;
}

Figures figures_of(const Weights& s) {
  Figures f{mean_of(s), square_of_affine(s), abs(mean_of(s)), 0, 0};
  const std::array<bool, 3> under = {s[0] < 0, s[1] < 0, s[2] < 0};
  const int count = static_cast<int>(under[0]) + under[1] + under[2];
  if (count == 0 || count == 3) {
    if (count == 0) f.mean_over = f.mean, f.square_over = f.square;
    return f;
  }
  size_t k = 0;
  while (under[k] != (count == 1)) ++k;
  const Rational &o = s[k], &a = s[(k + 1) % 3], &b = s[(k + 2) % 3];
  const Rational p = o / (o - a), q = o / (o - b);
  const std::array<Rational, 3> areas = {p * q, 1 - p, p * (1 - q)};
  const std::array<Weights, 3> pieces = {{{o, 0, 0}, {0, a, b}, {0, b, 0}}};
  f.mean_size = 0;
  for (size_t i = 0; i < 3; ++i) {
    const Rational mean = mean_of(pieces[i]);
    f.mean_size += areas[i] * abs(mean);
    if (mean <= 0) continue;
    f.mean_over += areas[i] * mean;
    f.square_over += areas[i] * square_of_affine(pieces[i]);
  }
  return f;
}

/// The share on which s <= t; of a constant, all of it or nothing.
Rational exact_share(Weights s, const Rational& t) {
  std::sort(s.begin(), s.end());
  if (t < s[0]) return 0;
  if (t >= s[2]) return 1;
  const Rational below = t - s[0], above = s[2] - t;
  if (t < s[1]) return below * below / ((s[1] - s[0]) * (s[2] - s[0]));
  return 1 - above * above / ((s[2] - s[1]) * (s[2] - s[0]));
}
Rational exact_share_of_size(const Weights& s, const Rational& t) {
  if (t < 0) return 0;
  return exact_share(s, t) + exact_share({-s[0], -s[1], -s[2]}, t) - 1;
}

Weights values_of(const Bound& b, int sign) {
  Weights s{Rational(b.at[0]), Rational(b.at[1]), Rational(b.at[2])};
  for (Rational& x : s)
    if (!b.is_size) x += sign * Rational(b.off);
  return s;
}

/// The figures of a bound are those of its function, on its own side.
void check_figures(const PartAnswer& p, Tally& tally, const auto& describe) {
  const Figures below = figures_of(values_of(p.below, -1)),
                above = figures_of(values_of(p.above, 1));
  const Rational off(p.below.off), more(p.above.off), t(p.t);
  if (p.below.is_size) {
    tally.require(p.below.mean <= 0 || p.below.mean <= below.mean_size - off, "mean, below",
                  describe);
    tally.require(p.below.square <= 0 || p.below.square <= below.square - 2 * off * below.mean_size,
                  "mean square, below", describe);
    tally.require(p.shares[0] >= exact_share_of_size(values_of(p.below, -1), t + off),
                  "share perhaps within", describe);
  } else {
    tally.require(p.below.square <= below.square_over, "mean square, below", describe);
    tally.require(p.shares[0] >= exact_share(values_of(p.below, -1), t), "share perhaps within",
                  describe);
  }
  if (p.above.is_size) {
    tally.require(p.above.mean >= above.mean_size, "mean, above", describe);
    tally.require(p.above.extreme <= p.t ||
                      p.shares[1] <= exact_share_of_size(values_of(p.above, 1), t - more),
                  "share surely within", describe);
  } else {
    tally.require(p.above.extreme <= p.t || p.shares[1] <= exact_share(values_of(p.above, 1), t),
                  "share surely within", describe);
  }
}

/// The mean and the mean square over a part lie between its bounds: averages over 256 equal parts'
/// middles are off by less than their size.
void check_means(const CellCase& c, const PartAnswer& p, Tally& tally, const auto& describe) {
  constexpr int kSteps = 16;
  std::array<glm::dvec3, 3> corner;
  for (size_t k = 0; k < 3; ++k) {
    glm::dvec3 sum(0);
    const std::array<glm::uvec2, 3> of_cell = {c.cell.a, c.cell.b, c.cell.c};
    for (size_t i = 0; i < 3; ++i) {
      const double v = of_cell[i].x * 0x1p-20, w = of_cell[i].y * 0x1p-20;
      sum += p.tile[k][i].get_d() * on_triangle(c.root, {1 - v - w, v, w});
    }
    corner[k] = sum;
  }
  const glm::dvec3 ab = corner[1] - corner[0], ac = corner[2] - corner[0];
  double sum = 0, squares = 0, most = 0;
  for (int i = 0; i < kSteps; ++i) {
    for (int j = 0; j < 2 * (kSteps - i) - 1; ++j) {
      const double third = j % 2 == 0 ? 1.0 / 3 : 2.0 / 3;
      const glm::dvec3 x = corner[0] + (i + third) / kSteps * ab + (j / 2 + third) / kSteps * ac;
      double d = std::numeric_limits<double>::infinity();
      for (const StoredTriangle& s : c.b)
        d = std::min(d, point_triangle_distance(x, s.at(0), s.at(1), s.at(2)));
      sum += d, squares += d * d, most = std::max(most, d);
    }
  }
  const double off = (glm::length(ab) + glm::length(ac)) / kSteps + 1e-12 * (1 + most);
  const double mean = sum / (kSteps * kSteps), square = squares / (kSteps * kSteps);
  const double off2 = 2 * (most + off) * off;
  tally.require(p.above.mean >= mean - off && p.below.mean <= mean + off, "mean", describe);
  tally.require(p.above.square >= square - off2 && p.below.square <= square + off2, "mean square",
                describe);
}

/// Runs cases, the same for each spoil.
void check_cases(uint64_t count, Spoil spoil, Tally& tally) {
  Random random(20261128);
  for (uint64_t i = 0; i < count && !tally.hopeless(); ++i) {
    const CellCase c = random.below(2) == 0 ? hard_case(random) : fan_case(random);
    const Choices choices = any_choices(random);
    const Device device(i);
    const Answer got = bounded(c, choices, device, spoil);
    const auto describe = [&] { return std::string(device.name()) + ": " + hex(c); };
    for (const PartAnswer& p : got.parts) {
      check_place(c, got, p, tally, describe);
      check_points(c, p, tally, describe);
      check_figures(p, tally, describe);
      tally.count("|h| from below", p.below.is_size);
      tally.count("|h| from above", p.above.is_size);
      tally.count("parts", true);
    }
    if (i % 8 == 0) check_means(c, got.parts.back(), tally, describe);
  }
}

struct Spoiled {
  Spoil spoil;
  const char* what;
};
constexpr std::array<Spoiled, 5> kSpoiled = {{{Spoil::kCut, "a cut off by 2^-10"},
                                              {Spoil::kMissing, "a triangle missing"},
                                              {Spoil::kSide, "a wrong side"},
                                              {Spoil::kTau, "tau left out"},
                                              {Spoil::kPlane, "heights off by 1e-5"}}};

}  // namespace

TEST_CASE("parts.h: over parts of cells, the bounds enclose the distance at every point") {
  const uint64_t count = case_count() / 200;
  Tally tally("parts");
  check_cases(count, Spoil::kNone, tally);
  tally.conclude(count);
  CHECK(tally.counted("|h| from below") > 0);
  CHECK(tally.counted("|h| from above") > 0);
}

TEST_CASE("parts.h: what is spoiled is noticed") {
  for (const auto& [spoil, what] : kSpoiled) {
    Tally tally(what);
    check_cases(200, spoil, tally);
    MESSAGE(std::string(what) << ": noticed " << tally.violated() << " times");
    CHECK_MESSAGE(tally.violated() > 0, what);
  }
}

namespace {

/// A plane of a triangle around a cell's centre, a point next to it or anywhere, and an offset.
struct Heights {
  Stored origin, normal;
  std::array<double, 2> middle, span;
  double height, off, beside, minorant;
};

Heights heights_about(const CellCase& c, const glm::vec3& v, const glm::vec3& o,
                      const Device& device) {
  return device.run([&]() -> Heights {
    const math::CellFrame frame = cell_frame(c);
    const math::Surface s = surfaces_of(c, frame)[0];
    const math::Plane plane = math::plane_of(s);
    const math::vec3 at = math::given(v);
    const auto h = math::height_at(plane, math::two(at));
    const math::Span span = math::span_over(plane, s);
    return {math::answer(frame.origin),
            math::answer(plane.normal),
            {math::wide(plane.middle.hi), math::wide(plane.middle.lo)},
            {math::wide(span.least), math::wide(span.most)},
            math::wide(h),
            math::wide(math::height_off(plane, math::norm_up(at), math::abs(h))),
            math::wide(math::beside(math::given(o), h, plane)),
            math::wide(
                math::part_minorant(math::whole_part({at, at, at}, 0.0f), s, plane.normal.hi).x)};
  });
}

/// The origin in an arithmetic in which it is needed first.
glm::dvec3 origin_of(const CellCase& c) {
  return Device(0).run([&]() -> Stored { return math::answer(cell_frame(c).origin); }).value();
}

}  // namespace

TEST_CASE("parts.h: heights, and a plane's normal") {
  const uint64_t count = case_count() / 25;
  Random random(5);
  Tally tally("planes");
  for (uint64_t i = 0; i < count && !tally.hopeless(); ++i) {
    const CellCase c = hard_case(random);
    const glm::dvec3 on_s = on_triangle(c.b[0], barycentrics(random)) - origin_of(c);
    const glm::vec3 v(random.below(2) == 0 ? on_s : random.in_cube(1.0));
    const Device device(i);
    const glm::vec3 o(hard_float(random, -8, 0), hard_float(random, -8, 0),
                      hard_float(random, -8, 0));
    const Heights got = heights_about(c, v, o, device);
    const auto describe = [&] { return std::string(device.name()) + ": " + hex(c); };
    const exact::Vector g = fixed_vector(got.normal);
    const Rational middle = Rational(got.middle[0]) + Rational(got.middle[1]);
    const auto height = [&](const exact::Vector& x) -> Rational {
      const Rational product = exact::scaled({exact::dot(g, x), 1}, -kFixedBits);
      return product - middle;
    };
    tally.require(square_of(g) <= 1, "|g| <= 1", describe);
    tally.require(abs(Rational(got.height) - height(fixed_vector(v))) <= Rational(got.off),
                  "height_off", describe);
    const exact::Vector high = fixed_vector(got.normal.hi);
    for (const Stored& corner : c.b[0].corner) {
      const exact::Vector apart = fixed_vector(got.origin) + fixed_vector(v) - fixed_vector(corner);
      tally.require(
          Rational(got.minorant) <= exact::scaled({exact::dot(high, apart), 1}, -kFixedBits),
          "part_minorant", describe);
      const Rational h = height(fixed_vector(corner) - fixed_vector(got.origin));
      tally.require(h >= Rational(got.span[0]) && h <= Rational(got.span[1]), "span_over",
                    describe);
    }
    // An offset whose rounding to o took a kUlp of it, towards 0.
    const Integer scale = Integer(1) << kFixedBits, grown = (Integer(1) << 23) + 1;
    const exact::Vector along = (Integer(1) << 23) * (fixed(got.height) * g);
    const exact::Vector off = scale * (grown * fixed_vector(o)) - along;
    tally.require(at_least(Rational(got.beside), square_of(off, 2 * kFixedBits + 23)), "beside",
                  describe);
  }
  tally.conclude(count);
}

TEST_CASE("parts.h: a third, a sixth and a twelfth are on their sides, within an ulp") {
  const auto is_above = [](double up, double down, int of) {
    const Rational share = Rational(1) / of, ulp = share / (1 << 22);
    return Rational(up) > share && Rational(down) < share && Rational(up) - Rational(down) < ulp;
  };
  CHECK(is_above(math::wide(math::kThirdUp), math::wide(math::kThirdDown), 3));
  CHECK(is_above(math::wide(math::kSixthUp), math::wide(math::kSixthDown), 6));
  CHECK(is_above(math::wide(math::kTwelfthUp), math::wide(math::kTwelfthDown), 12));
}

TEST_CASE("parts.h: closed forms of affine functions, from both sides") {
  const uint64_t count = case_count() / 4;
  Random random(6);
  Tally tally("closed forms");
  for (uint64_t i = 0; i < count && !tally.hopeless(); ++i) {
    glm::vec3 v(hard_float(random, -24, 0), hard_float(random, -24, 0), hard_float(random, -24, 0));
    if (random.below(8) == 0) v[static_cast<int>(random.below(3))] = 0;
    if (random.below(8) == 0) v.y = v.x;
    const float t = random.below(4) == 0 ? std::abs(v.x) : std::abs(hard_float(random, -24, 0));
    const Device device(i);
    struct Forms {
      double size_down, size_up, square, over, square_over, mean_down, mean_up, square_up;
      std::array<double, 4> shares;
    };
    const glm::vec3 size(std::abs(v.x), std::abs(v.y), std::abs(v.z));
    const Forms got = device.run([&]() -> Forms {
      const math::vec3 s = math::given(v);
      const math::Between plain = math::share_of(s, t, false), both = math::share_of(s, t, true);
      return {math::wide(math::mean_size_down(s)),
              math::wide(math::mean_size_up(s)),
              math::wide(math::square_down(s)),
              math::wide(math::mean_over_down(s)),
              math::wide(math::square_over_down(s)),
              math::wide(math::mean_down(s)),
              math::wide(math::mean_up(math::given(size))),
              math::wide(math::mean_square_up(math::given(size))),
              {math::wide(plain.down), math::wide(plain.up), math::wide(both.down),
               math::wide(both.up)}};
    });
    const Weights s = exact_of(v);
    const Weights sizes{abs(s[0]), abs(s[1]), abs(s[2])};
    const Figures f = figures_of(s);
    const auto describe = [&] { return hex(glm::dvec3(v)); };
    tally.require(got.size_down <= f.mean_size && got.size_up >= f.mean_size, "mean size",
                  describe);
    tally.require(got.square <= f.square, "square_down", describe);
    tally.require(got.over <= f.mean_over, "mean_over_down", describe);
    tally.require(got.square_over <= f.square_over, "square_over_down", describe);
    tally.require(got.mean_down <= f.mean, "mean_down", describe);
    tally.require(got.mean_up >= mean_of(sizes), "mean_up", describe);
    tally.require(got.square_up >= square_of_affine(sizes), "mean_square_up", describe);
    const Rational at(static_cast<double>(t));
    const Rational plain = exact_share(s, at), both = exact_share_of_size(s, at);
    tally.require(got.shares[0] <= plain && got.shares[1] >= plain, "share", describe);
    tally.require(got.shares[2] <= both && got.shares[3] >= both, "share of a size", describe);
    tally.measure("width of a share in 2^-24", 0x1p24 * (got.shares[3] - got.shares[2]), describe);
    tally.measure("looseness of the mean size",
                  f.mean_size == 0 ? 0 : got.size_up / f.mean_size.get_d() - 1, describe);
  }
  tally.conclude(count);
}

namespace {

/// Values of any sign at a triangle's corners, some 0, alike or each other's opposites, or too
/// small for a quotient.
glm::vec3 corner_values(Random& random) {
  glm::vec3 v;
  for (int i = 0; i < 3; ++i) v[i] = hard_float(random, random.below(4) == 0 ? -24 : -3, 0);
  if (random.below(4) == 0) v = glm::abs(v) * (random.below(2) == 0 ? 1.0f : -1.0f);
  if (random.below(8) == 0) v[static_cast<int>(random.below(3))] = 0;
  if (random.below(8) == 0) v.y = v.x;
  if (random.below(8) == 0) v.z = -v.x;
  if (random.below(32) == 0) v *= 0x1p-100f;
  return v;
}

/// The points that tell an affine function where s has one sign: the corners, and where s is 0 on
/// an edge.
struct Place {
  Weights at;
  Rational s;
};
std::vector<Place> places_of(const Weights& s) {
  std::vector<Place> places;
  for (size_t i = 0; i < 3; ++i) {
    const size_t j = (i + 1) % 3;
    Weights corner{0, 0, 0};
    corner[i] = 1;
    places.push_back({corner, s[i]});
    if (s[i] * s[j] >= 0) continue;
    Weights crossing{0, 0, 0};
    crossing[i] = s[j] / (s[j] - s[i]);
    crossing[j] = 1 - crossing[i];
    places.push_back({crossing, 0});
  }
  return places;
}

Rational value_at(const Weights& function, const Weights& place) {
  return function[0] * place[0] + function[1] * place[1] + function[2] * place[2];
}

/// What one triangle gives from below: what is taken from |h| on either side, and an affine
/// function.
struct Taken {
  double over, under;
  glm::vec3 at;
};
Taken taken_of(const math::Excess& e) {
  return {math::wide(e.over), math::wide(e.under), math::answer(e.at)};
}

/// Whether x is nowhere above y less `off`.
bool is_under(const Weights& x, const Weights& y, const Rational& off) {
  return x[0] <= y[0] - off && x[1] <= y[1] - off && x[2] <= y[2] - off;
}

Weights opposite(const Weights& x) { return {-x[0], -x[1], -x[2]}; }

}  // namespace

TEST_CASE("parts.h: what a triangle gives from below, by its span and by a minorant") {
  const uint64_t count = case_count() / 4;
  Random random(7);
  Tally tally("excesses");
  for (uint64_t i = 0; i < count && !tally.hopeless(); ++i) {
    const glm::vec3 heights = corner_values(random), minorant = corner_values(random);
    const glm::vec3 kept = random.below(2) == 0 ? corner_values(random) : glm::vec3(3.0e38f);
    const float x = hard_float(random, -24, 0), y = hard_float(random, -24, 0);
    const float off = std::abs(hard_float(random, -24, 0));
    const Device device(i);
    struct Both {
      Taken by_span, by_both;
    };
    const Both got = device.run([&]() -> Both {
      const math::vec3 h = math::given(heights);
      const math::Excess e = math::excess_of_span(h, {std::min(x, y), std::max(x, y)}, off);
      return {taken_of(e),
              taken_of(math::with_minorant(e, h, math::given(minorant), math::given(kept)))};
    });
    const auto describe = [&] {
      return std::string(device.name()) + ": " + hex(glm::dvec3(heights)) + " " +
             hex(glm::dvec3(minorant)) + " " + hex(static_cast<double>(x)) + " " +
             hex(static_cast<double>(y)) + " " + hex(static_cast<double>(off));
    };
    const Weights h = exact_of(heights), m = exact_of(minorant);
    const Rational least(static_cast<double>(std::min(x, y))),
        most(static_cast<double>(std::max(x, y))), doubt(static_cast<double>(off));
    const Taken &span = got.by_span, &both = got.by_both;
    tally.require(Rational(span.over) >= most + doubt, "over a span", describe);
    tally.require(Rational(span.under) >= doubt - least, "under a span", describe);
    tally.require(is_under(exact_of(span.at), h, most + doubt) ||
                      is_under(exact_of(span.at), opposite(h), doubt - least),
                  "an affine function by a span", describe);
    tally.require(both.at == span.at || both.at == minorant, "one of two functions", describe);
    for (const Place& place : places_of(h)) {
      const Rational by_minorant = value_at(m, place.at);
      tally.require(
          both.over == span.over || place.s < 0 || Rational(both.over) >= place.s - by_minorant,
          "over a minorant", describe);
      tally.require(
          both.under == span.under || place.s > 0 || Rational(both.under) >= -place.s - by_minorant,
          "under a minorant", describe);
    }
    tally.count("taken by a minorant", both.over != span.over);
  }
  tally.conclude(count);
  CHECK(tally.counted("taken by a minorant") > 0);
}

namespace {

/// What some triangles give from below, and what a part makes of all of them.
struct BelowCase {
  glm::vec3 heights;
  std::vector<Taken> triangles;
  float slack, t;
};

BelowCase below_case(Random& random) {
  BelowCase c{corner_values(random),
              {},
              std::abs(hard_float(random, -24, -4)),
              std::abs(hard_float(random, -8, 0))};
  const int scale = -static_cast<int>(random.below(24));
  for (uint32_t k = 1 + random.below(3); k > 0; --k) {
    c.triangles.push_back({static_cast<double>(hard_float(random, scale - 6, scale)),
                           static_cast<double>(hard_float(random, scale - 6, scale)),
                           corner_values(random)});
  }
  return c;
}

PartAnswer below_of(const BelowCase& c, const Device& device) {
  return device.run([&]() -> PartAnswer {
    math::PartBelow below = math::begin_below(math::given(c.heights));
    for (const Taken& e : c.triangles) {
      below = math::with_excess(
          below, {static_cast<float>(e.over), static_cast<float>(e.under), math::given(e.at)});
    }
    const math::Corners nowhere = {math::given(glm::vec3(0)), math::given(glm::vec3(0)),
                                   math::given(glm::vec3(0))};
    const math::PartBound bound = math::part_below(math::whole_part(nowhere, c.slack), below);
    PartAnswer out{};
    out.below = answer_of(bound);
    out.shares[0] = math::wide(math::perhaps_within(bound, c.t));
    out.t = static_cast<double>(c.t);
    return out;
  });
}

/// Functions that some triangle says d is not under: |h| less these on either side, and the least
/// of `at`, which is concave.
struct Said {
  Weights h;
  Rational over = 0, under = 0;
  Weights at;
};
Said said_by(const BelowCase& c) {
  Said said{exact_of(c.heights), 0, 0, exact_of(c.triangles[0].at)};
  const Rational slack(static_cast<double>(c.slack));
  for (const Taken& e : c.triangles) {
    said.over = std::max(said.over, Rational(e.over));
    said.under = std::max(said.under, Rational(e.under));
    for (size_t i = 0; i < 3; ++i) said.at[i] = std::min(said.at[i], exact_of(e.at)[i]);
  }
  said.over += slack, said.under += slack;
  for (Rational& x : said.at) x -= slack;
  return said;
}

Weights less(const Weights& x, const Rational& y) { return {x[0] - y, x[1] - y, x[2] - y}; }

/// The mean of the positive part of what |h| leaves, and of its square: each side has its own.
Figures figures_of_size(const Said& said) {
  const Figures over = figures_of(less(said.h, said.over)),
                under = figures_of(less(opposite(said.h), said.under));
  return {0, 0, 0, over.mean_over + under.mean_over, over.square_over + under.square_over};
}

void check_below(const BelowCase& c, const Bound& b, Tally& tally, const auto& describe) {
  const Said said = said_by(c);
  Rational least = -1;
  for (const Place& place : places_of(said.h)) {
    const Rational at = value_at(said.at, place.at);
    const Rational from_over = place.s - said.over, from_under = -place.s - said.under;
    // Where h is 0 on an edge, both sides meet.
    const Rational of_size = place.s > 0   ? from_over
                             : place.s < 0 ? from_under
                                           : std::max(from_over, from_under);
    tally.require(value_of(b, place.at, -1) <= (b.is_size ? of_size : at), "part_below", describe);
    const Rational here = std::max(b.is_size ? of_size : at, Rational(0));
    if (least < 0 || here < least) least = here;
  }
  const Figures f = b.is_size ? figures_of_size(said) : figures_of(said.at);
  tally.require(Rational(b.mean) <= f.mean_over, "part_below's mean", describe);
  tally.require(Rational(b.square) <= f.square_over, "part_below's square", describe);
  tally.require(Rational(b.extreme) <= least, "part_below's least", describe);
}

}  // namespace

TEST_CASE("parts.h: what all triangles give a part from below") {
  const uint64_t count = case_count() / 4;
  Random random(8);
  Tally tally("below");
  for (uint64_t i = 0; i < count && !tally.hopeless(); ++i) {
    const BelowCase c = below_case(random);
    const Device device(i);
    const PartAnswer got = below_of(c, device);
    const auto describe = [&] {
      std::string text = std::string(device.name()) + ": " + hex(glm::dvec3(c.heights)) +
                         " slack " + hex(static_cast<double>(c.slack));
      for (const Taken& e : c.triangles)
        text += " " + hex(e.over) + " " + hex(e.under) + " " + hex(glm::dvec3(e.at));
      return text;
    };
    check_below(c, got.below, tally, describe);
    tally.require(
        Rational(got.shares[0]) >=
                (got.below.is_size ? exact_share_of_size(values_of(got.below, -1),
                                                         Rational(got.t) + Rational(got.below.off))
                                   : exact_share(values_of(got.below, -1), Rational(got.t))) ||
            got.t < got.below.extreme,
        "perhaps_within", describe);
    tally.count("by heights", got.below.is_size);
    tally.count("by corners", !got.below.is_size);
    tally.count("with a mean", got.below.mean > 0);
    tally.count("with a square", got.below.square > 0);
    tally.count("with a least value", got.below.extreme > 0);
  }
  tally.conclude(count);
  CHECK(tally.counted("by heights") > 0);
  CHECK(tally.counted("by corners") > 0);
  CHECK(tally.counted("with a square") > 0);
}
