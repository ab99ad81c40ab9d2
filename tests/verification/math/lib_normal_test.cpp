// shaders/report/normal.h against exact rationals: cosines, and the corners on which a closest
// point lies, hold wherever points and normals may be that floats stand for. Spoiled terms must be
// noticed.
#include <doctest/doctest.h>
#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "host/mesh/round_to_float.h"
#include "shaders/report/normal.h"
#include "tests/shapes/shapes.h"

namespace {

using namespace vkh;
using namespace vkh::test;
using glm::dvec3;
using lib::vec3;

using Exact = std::array<mpq_class, 3>;

Exact exact(const dvec3& p) { return {mpq_class(p.x), mpq_class(p.y), mpq_class(p.z)}; }
Exact operator-(const Exact& p, const Exact& q) { return {p[0] - q[0], p[1] - q[1], p[2] - q[2]}; }
mpq_class dot(const Exact& x, const Exact& y) { return x[0] * y[0] + x[1] * y[1] + x[2] * y[2]; }
Exact cross(const Exact& x, const Exact& y) {
  return {x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]};
}

vec3 rounded(const dvec3& p) {
  return {nearest_float(p.x), nearest_float(p.y), nearest_float(p.z)};
}
dvec3 wide(const vec3& p) { return {p.x, p.y, p.z}; }

/// A float point that is `off` from a point at most, along a direction: to its end as a rule.
vec3 moved(const dvec3& p, const dvec3& along, double off) {
  const double size = glm::length(along);
  return rounded(size > 0 ? p + along * (0.99 * off / size) : p);
}

constexpr int kCases = 60'000;

// --- Cosines ---

/// A vector of floats whose length is nearly 1, so that rounding is what is left of the errors.
vec3 nearly_unit(Random& random, const dvec3& about, double spread) {
  vec3 best(1, 0, 0);
  double least = 1;
  for (int i = 0; i < 400 && least > 2e-9; ++i) {
    const vec3 v = rounded(glm::normalize(about + random.in_cube(spread)));
    const double off = std::abs(glm::length(wide(v)) - 1);
    if (off < least) best = v;
    least = std::min(least, off);
  }
  return best;
}

// cos^2 of the exact normals lies between the squares of the ends.
void check_cosine(const dvec3& m, const dvec3& n, const lib::Cosine& c) {
  const Exact x = exact(m), y = exact(n);
  const mpq_class product = dot(x, y), sizes = dot(x, x) * dot(y, y);
  const mpq_class least(static_cast<double>(c.least)), most(static_cast<double>(c.most));
  REQUIRE(least * least * sizes <= product * product);
  REQUIRE((c.most == 1 || most * most * sizes >= product * product));
}

TEST_CASE("cosine_between: nearly perpendicular normals, of which rounding is what is off") {
  Random random(1);
  int told = 0;
  for (int i = 0; i < kCases / 4; ++i) {
    const dvec3 along = random.direction();
    const vec3 m = nearly_unit(random, along, 1e-3);
    const dvec3 across = glm::normalize(glm::cross(wide(m), random.direction()));
    const double tilt = std::exp2(random.range(-30, -18));
    const vec3 n = nearly_unit(random, across + along * tilt, 1e-6);
    const auto off = [](const vec3& v) {
      return static_cast<float>(1.01 * std::abs(glm::length(wide(v)) - 1) + 1e-15);
    };
    const lib::Cosine c = lib::cosine_between(m, off(m), n, off(n));
    told += c.most < 1e-4f ? 1 : 0;
    check_cosine(wide(m), wide(n), c);
  }
  CHECK(told > kCases / 8);
}

// Each normal is turned away from the exact one as far as it may be, together with the other or
// alone.
TEST_CASE("cosine_between: the cosine holds wherever the normals may be") {
  Random random(2);
  int told = 0;
  for (int i = 0; i < kCases; ++i) {
    const dvec3 m = random.direction(),
                n = glm::normalize(m * random.range(-1, 1) + random.direction());
    const double off = std::exp2(random.range(-20, -2)), to = random.below(2) == 0 ? 1 : -1;
    const bool turns_m = random.below(2) == 0, turns_n = !turns_m || random.below(2) == 0;
    const dvec3 from_n = n - m * glm::dot(m, n), from_m = m - n * glm::dot(m, n);
    const vec3 seen_m = turns_m ? moved(m, to * from_n, off) : rounded(m);
    const vec3 seen_n = turns_n ? moved(n, to * from_m, off) : rounded(n);
    const auto allowed = [](const vec3& seen, const dvec3& right) {
      return static_cast<float>(glm::length(wide(seen) - right) * (1 + 1e-6));
    };
    const lib::Cosine c =
        lib::cosine_between(seen_m, allowed(seen_m, m), seen_n, allowed(seen_n, n));
    told += c.most - c.least < 1 ? 1 : 0;
    check_cosine(m, n, c);
  }
  CHECK(told > kCases / 2);
  CHECK(lib::cosine_between(vec3(0), 1, vec3(0), 1).most == 1);
  CHECK(lib::cosine_between(vec3(1, 0, 0), 0, vec3(0), 0.3f).least == 0);
}

// --- Signs ---

/// Points that are off, or, if nothing is, floats: then rounding is what is left.
double any_off(Random& random) {
  return random.below(3) == 0 ? 0 : std::exp2(random.range(-24, -10));
}
dvec3 kept(const dvec3& p, double off) { return off == 0 ? round_to_float(p) : p; }

/// The largest of some distances, as a float above it.
class Allowed {
 public:
  explicit Allowed(double off) : is_any_(off > 0) {}
  vec3 see(const dvec3& p, const dvec3& along, double off) {
    const vec3 seen = is_any_ ? moved(p, along, off) : rounded(p);
    most_ = std::max(most_, glm::length(wide(seen) - p));
    return seen;
  }
  float value() const { return is_any_ ? std::nextafter(static_cast<float>(most_), 1.0f) : 0; }

 private:
  const bool is_any_;
  double most_ = 0;
};

TEST_CASE("sign_along: a sign holds wherever the points may be") {
  Random random(3);
  int told = 0, wrong = 0;
  for (int i = 0; i < 2 * kCases; ++i) {
    const double off = any_off(random), to = random.below(2) == 0 ? 1 : -1;
    const dvec3 s = kept(random.in_cube(1), off);
    const dvec3 u = kept(s + random.direction() * std::exp2(random.range(-10, 1)), off);
    const dvec3 along = glm::normalize(u - s);
    const dvec3 across = glm::normalize(glm::cross(along, random.direction()));
    const double by = std::exp2(random.range(-30, -6)) * (random.below(2) == 0 ? 1 : off / 0x1p-17);
    const dvec3 p = kept(s + across * std::exp2(random.range(-10, 1)) - along * (to * by), off);
    const dvec3 d = p - s, e = u - s;
    Allowed allowed(off);
    const vec3 seen_p = allowed.see(p, to * e, off), seen_u = allowed.see(u, to * d, off),
               seen_s = allowed.see(s, -to * (d + e), off);
    const int sign = lib::sign_along(seen_p, seen_s, seen_u, allowed.value());
    if (sign == 0) continue;
    ++told;
    const Exact from = exact(s);
    wrong += sign != sgn(dot(exact(p) - from, exact(u) - from)) ? 1 : 0;
  }
  CHECK(wrong == 0);
  CHECK(told > kCases / 4);
}

mpq_class height_over_edge(const dvec3& p, const dvec3& s, const dvec3& u, const dvec3& v) {
  const Exact e = exact(u) - exact(s), f = exact(v) - exact(s);
  return dot(exact(p) - exact(s), cross(e, cross(e, f)));
}

// Each point goes where the height falls or rises most.
TEST_CASE("is_over_edge: what is told holds wherever the points may be") {
  Random random(4);
  int told = 0, wrong = 0;
  for (int i = 0; i < 2 * kCases; ++i) {
    const double off = any_off(random);
    const dvec3 s = kept(random.in_cube(1), off);
    const dvec3 along = random.direction();
    const dvec3 across = glm::normalize(glm::cross(along, random.direction()));
    const double length = std::exp2(random.range(-6, 1)), width = std::exp2(random.range(-8, 1));
    const dvec3 u = kept(s + along * length, off);
    const dvec3 v = kept(s + along * (length * random.range(-1, 2)) + across * width, off);
    const dvec3 normal = glm::cross(along, across);
    const double by = std::exp2(random.range(-30, -6)) * (random.below(2) == 0 ? 1 : off / 0x1p-17);
    const dvec3 p = kept(s + along * (length * random.range(-2, 3)) +
                             normal * random.range(-2, 2) * std::exp2(random.range(-8, 0)) +
                             across * (random.below(2) == 0 ? by : -width),
                         off);
    const dvec3 d = p - s, e = u - s, f = v - s;
    const double de = glm::dot(d, e), ef = glm::dot(e, f), ee = glm::dot(e, e), df = glm::dot(d, f);
    const dvec3 for_p = e * ef - f * ee, for_v = e * de - d * ee,
                for_u = d * ef + f * de - e * (2 * df);
    Allowed allowed(off);
    const uint32_t which = random.below(3);  // all of them, the edge, or the others
    const auto see = [&](const dvec3& at, const dvec3& to, bool goes) {
      return allowed.see(at, goes ? to : dvec3(0), off);
    };
    const vec3 seen_p = see(p, for_p, which != 1), seen_u = see(u, for_u, which != 2),
               seen_v = see(v, for_v, which != 1),
               seen_s = see(s, -(for_p + for_u + for_v), which == 0);
    if (!lib::is_over_edge(seen_p, seen_s, seen_u, seen_v, allowed.value())) continue;
    ++told;
    wrong += sgn(height_over_edge(p, s, u, v)) <= 0 ? 1 : 0;
  }
  CHECK(wrong == 0);
  CHECK(told > kCases / 10);
}

// --- Features ---

/// Whether the closest point of a triangle to p lies on the corners that are named.
bool lies_on(const dvec3& p, const std::array<dvec3, 3>& t, uint32_t named) {
  for (uint32_t i = 0; i < 3; ++i) {
    const uint32_t j = (i + 1) % 3, k = (i + 2) % 3;
    const Exact x = exact(p), s = exact(t[i]), u = exact(t[j]), v = exact(t[k]);
    if (named == 1u << i) return dot(x - s, u - s) <= 0 && dot(x - s, v - s) <= 0;
    if (named == (1u << i | 1u << j)) {
      return dot(x - s, u - s) >= 0 && dot(x - u, s - u) >= 0 &&
             height_over_edge(p, t[i], t[j], t[k]) >= 0;
    }
  }
  return false;
}

// One of the three errors is there at a time: a cell's, a triangle's, or that of both meshes.
TEST_CASE("closest_feature: what is named holds wherever the points may be") {
  Random random(5);
  std::array<int, 8> told{};
  int wrong = 0;
  for (int i = 0; i < kCases; ++i) {
    std::array<dvec3, 3> t;
    for (dvec3& p : t) p = random.in_cube(1);
    const double off = std::exp2(random.range(-20, -6)), size = std::exp2(random.range(-20, -2));
    const uint32_t near = random.below(3), next = (near + 1) % 3;
    const dvec3 edge = glm::normalize(t[next] - t[near]);
    const dvec3 about = t[near] + random.direction() * std::exp2(random.range(-4, 1)) -
                        edge * (random.below(2) == 0 ? size : -size);
    const uint32_t of = random.below(3);
    lib::CellFrame cell{};
    lib::Surface s{};
    std::array<dvec3, 3> points;
    const std::array<vec3*, 3> corners{&cell.at.a, &cell.at.b, &cell.at.c},
        ends{&s.at.a, &s.at.b, &s.at.c};
    Allowed allowed(off);
    for (size_t k = 0; k < 3; ++k) {
      points[k] = about + random.in_cube(size);
      *corners[k] = allowed.see(points[k], of == 1 ? dvec3(0) : random.direction(), off);
      *ends[k] = allowed.see(t[k], of == 0 ? dvec3(0) : random.direction(), off);
    }
    cell.slack = of == 0 ? allowed.value() : 0;
    s.slack = of == 1 ? allowed.value() : 0;
    const uint32_t named = lib::closest_feature(cell, s, of == 2 ? allowed.value() : 0);
    ++told[named];
    for (const dvec3& p : points) wrong += named != 0 && !lies_on(p, t, named) ? 1 : 0;
  }
  CHECK(wrong == 0);
  for (const uint32_t named : {1, 2, 3, 4, 5, 6}) CHECK(told[named] > kCases / 200);
  CHECK(told[7] == 0);
}

TEST_CASE("corners are named by bits") {
  const glm::uvec3 one(4, 7, 9);
  CHECK(lib::has_corners({9, 4, 1}, one, 5));
  CHECK_FALSE(lib::has_corners({9, 4, 1}, one, 2));
  CHECK_FALSE(lib::has_corners({9, 4, 1}, one, 3));
  CHECK_FALSE(lib::has_corners({1, 4, 2}, one, 4));
  CHECK_FALSE(lib::has_corners({7, 9, 2}, one, 1));
  CHECK(lib::has_corners({7, 9, 2}, one, 6));
}

// --- Sums ---

/// A cell in pieces, on each of which some faces are closest and the cosine is one of theirs.
struct Pieces {
  std::vector<lib::Cosine> faces;
  std::vector<mpq_class> shares;  // of each face's pieces
  mpq_class mean = 0, agree = 0;
};

// As a rule one face is closest on a piece, so that nothing is counted twice.
Pieces any_pieces(Random& random, float limit) {
  Pieces all;
  const uint32_t faces = 1 + random.below(6), count = 1 + random.below(8);
  for (uint32_t k = 0; k < faces; ++k) {
    const double least = random.unit();
    const double width = random.below(2) == 0 ? 0 : 0.3 * random.unit();
    all.faces.push_back(
        {static_cast<float>(least), static_cast<float>(std::min(least + width, 1.0))});
  }
  all.shares.assign(faces, 0);
  const int to = random.below(2) == 0 ? 1 : -1;
  mpq_class left = 1;
  for (uint32_t i = 0; i < count; ++i) {
    const mpq_class area = i + 1 == count ? left : left * mpq_class(random.unit());
    left -= area;
    float least = 2, most = -1;
    for (uint32_t k = 0, more = random.below(4) == 0 ? 2 : 1; k < more; ++k) {
      const uint32_t face = random.below(faces);
      all.shares[face] += area;
      least = std::min(least, all.faces[face].least);
      most = std::max(most, all.faces[face].most);
    }
    const float cosine = to > 0 ? most : least;
    all.mean += area * mpq_class(static_cast<double>(cosine));
    all.agree += cosine >= limit ? area : mpq_class(0);
  }
  return all;
}

TEST_CASE("agreement_of: the mean and the share that agrees, whatever the pieces") {
  Random random(6);
  int narrow = 0;
  for (int i = 0; i < kCases; ++i) {
    const auto limit = static_cast<float>(random.unit());
    const Pieces right = any_pieces(random, limit);
    lib::Cosine all{1, 0};
    for (const lib::Cosine& c : right.faces)
      all = {std::min(all.least, c.least), std::max(all.most, c.most)};
    lib::Comparison sums = lib::comparison_of(all, limit, limit);
    for (size_t k = 0; k < right.faces.size(); ++k) {
      if (right.shares[k] == 0) continue;
      const float share = std::min(float_up(std::nextafter(right.shares[k].get_d(), 2.0)), 1.0f);
      sums = lib::with_face(sums, right.faces[k], right.faces[k].least, share);
    }
    const lib::Agreement found = lib::agreement_of(sums);
    narrow += found.most - found.least < 0.5f * (all.most - all.least) ? 1 : 0;
    REQUIRE(mpq_class(static_cast<double>(found.least)) <= right.mean);
    REQUIRE(mpq_class(static_cast<double>(found.most)) >= right.mean);
    REQUIRE(mpq_class(static_cast<double>(found.sure)) <= right.agree);
    REQUIRE(mpq_class(static_cast<double>(found.may)) >= right.agree);
  }
  CHECK(narrow > kCases / 5);
}

// --- Shares ---

/// The share of a triangle on which the affine function with these values at its corners is at most
/// 0.
mpq_class share_below(std::array<mpq_class, 3> at) {
  std::sort(at.begin(), at.end());
  const auto& [least, middle, most] = at;
  if (least > 0) return 0;
  if (most <= 0) return 1;
  if (middle > 0) return least * least / ((middle - least) * (most - least));
  return 1 - most * most / ((most - middle) * (most - least));
}

// A cell over a large face in the plane z = 0: no point of the face is nearer than the height. The
// heights are those of the meshes, which may be `moved`.
TEST_CASE("closest_share: no less of a cell than where a face may be closest") {
  Random random(7);
  int cut = 0;
  for (int i = 0; i < kCases; ++i) {
    const float height = static_cast<float>(std::exp2(random.range(-6, 1)));
    const double moved = random.below(2) == 0 ? 0 : height * std::exp2(random.range(-20, -4));
    lib::CellFrame t{};
    std::array<vec3*, 3> corners{&t.at.a, &t.at.b, &t.at.c};
    for (vec3* p : corners) *p = rounded(random.in_cube(0.4 * static_cast<double>(height)));
    t.radius = lib::radius_up(t.at);
    t.reach = 2;
    lib::Surface s{};
    s.at = {{-90, -80, -height}, {90, -70, -height}, {3, 95, -height}};
    lib::Above above{};
    std::array<mpq_class, 3> beyond;
    for (int k = 0; k < 3; ++k) {
      const float z = height + corners[static_cast<size_t>(k)]->z;
      const auto upper =
          static_cast<float>(static_cast<double>(z) * (1 + 1e-5 * random.range(-1, 1)) +
                             (random.below(2) == 0 ? 0.1 * random.range(-1, 1) : 0));
      above.at_corners[k] = upper;
      above.highest = std::max(above.highest, upper);
      beyond[static_cast<size_t>(k)] =
          mpq_class(static_cast<double>(height)) +
          mpq_class(static_cast<double>(corners[static_cast<size_t>(k)]->z)) -
          2 * mpq_class(static_cast<double>(static_cast<float>(moved))) -
          mpq_class(static_cast<double>(upper));
    }
    const mpq_class right = share_below(beyond);
    const float found = lib::closest_share(t, s, above, static_cast<float>(moved));
    cut += found > 0.01f && found < 0.99f ? 1 : 0;
    REQUIRE(mpq_class(static_cast<double>(found)) >= right);
  }
  CHECK(cut > kCases / 20);
}

}  // namespace
