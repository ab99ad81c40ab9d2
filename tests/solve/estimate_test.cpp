// Estimates of figures and of cells, goals relative to each figure, and maps by cells.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "tests/shapes/hard_pairs.h"
#include "tests/support/solver_bench.h"

namespace {

using namespace vkh;
using namespace vkh::test;

SurveyResult survey_of(const Mesh& a, const Mesh& b, const SurveyOptions& survey) {
  return surveyed(a, b, survey);
}

SurveyOptions statistics_alone(std::vector<double> bands = {}) {
  SurveyOptions options;
  options.statistics = true;
  options.bands = std::move(bands);
  return options;
}

double distance_to(const ClosestTree& tree, const glm::dvec3& p) {
  Nearest nearest;
  tree.query(p, nearest);
  return std::sqrt(nearest.squared);
}

/// Checks that the estimate is the interval's middle.
void check_middle(const Enclosure& e) {
  REQUIRE(e.estimate);
  CHECK(*e.estimate >= e.lower);
  CHECK(*e.estimate <= e.upper);
  CHECK(*e.estimate == doctest::Approx((e.lower + e.upper) / 2));
}

TEST_CASE("a lifted plane: estimates are its height") {
  const SurveyResult r =
      survey_of(square_patch(4, 0.25), square_patch(3, 0.0), statistics_alone({0.2, 0.3}));
  REQUIRE(r.statistics);
  const Statistics& s = *r.statistics;
  CHECK(*s.mean.estimate == doctest::Approx(0.25).epsilon(1e-6));
  CHECK(*s.rms.estimate == doctest::Approx(0.25).epsilon(1e-6));
  for (const Percentile& p : s.percentiles)
    CHECK(*p.distance.estimate == doctest::Approx(0.25).epsilon(1e-5));
  CHECK(*s.bands[0].share.estimate == 0);
  CHECK(*s.bands[1].share.estimate == 1);
}

// A: x from 0 to 1 at height x / 4 above B's plane. A distance is affine, so that each estimate is
// the truth but for rounding, however few cells there are.
TEST_CASE("a wedge: estimates are exact before any cell is split") {
  Mesh a = square_patch(3, 0.0);
  for (glm::dvec3& v : a.vertices) v.z = 0.25 * v.x;
  const Mesh b = translated(scaled(square_patch(1, 0.0), 2), {-1.5, -1.5, 0});
  SurveyOptions options = statistics_alone({0.05, 0.125, 0.2});
  options.effort = 0;
  const SurveyResult r = survey_of(a, b, options);
  REQUIRE(r.statistics);
  const Statistics& s = *r.statistics;
  CHECK(*s.mean.estimate == doctest::Approx(0.125).epsilon(1e-5));
  CHECK(*s.rms.estimate == doctest::Approx(0.25 / std::sqrt(3.0)).epsilon(1e-5));
  for (const AreaWithin& band : s.bands)
    CHECK(*band.share.estimate == doctest::Approx(4 * band.distance).epsilon(1e-4));
  for (const Percentile& p : s.percentiles)
    CHECK(*p.distance.estimate == doctest::Approx(p.share / 4).epsilon(1e-3));
}

TEST_CASE("shares alone have the estimates that they have beside all figures") {
  const Mesh a = icosphere(1.1, 0), b = icosphere(1, 4);
  SurveyOptions options = statistics_alone({0.02, 0.05, 0.08, 0.11});
  options.effort = 0;
  const SurveyResult all = survey_of(a, b, options);
  options.narrows_mean = options.narrows_rms = options.narrows_percentiles = false;
  const SurveyResult alone = survey_of(a, b, options);
  REQUIRE(all.statistics);
  REQUIRE(alone.statistics);
  for (size_t i = 0; i < options.bands.size(); ++i) {
    const Enclosure &of_all = all.statistics->bands[i].share,
                    &of_alone = alone.statistics->bands[i].share;
    CHECK(of_all.lower < of_all.upper);
    CHECK(of_alone.estimate == of_all.estimate);
  }
  CHECK(all.statistics->mean.estimate);
  CHECK_FALSE(alone.statistics->mean.estimate);
}

// All faces are bounded when it is called off, and there is no effort for more.
TEST_CASE("a survey is called off while it estimates normals, and its figures hold") {
  const Mesh a = icosphere(1.1, 0), b = icosphere(1, 4);
  SurveyOptions options = statistics_alone({0.05});
  options.effort = 0;
  options.normals_within = 10;  // for which cells are measured
  options.goes_on = [&](size_t bounded) { return bounded < a.faces.size(); };
  const SurveyResult r = survey_of(a, b, options);
  CHECK(r.ended == SurveyEnd::kCancelled);
  CHECK(r.bounded == a.faces.size());
  REQUIRE(r.statistics);
  check_middle(r.statistics->mean);
  check_middle(r.statistics->bands[0].share);
}

TEST_CASE("hard pairs: an estimate is the middle of its interval") {
  for (size_t i = 0; i < family_names().size(); ++i) {
    CAPTURE(family_names()[i]);
    const HardPair hard = hard_pair(i, 500 + i);
    SurveyOptions options = statistics_alone({0.1});
    options.effort = 3000;
    options.map.emplace();
    const SurveyResult r = survey_of(hard.pair.a, hard.pair.b, options);
    if (!r.statistics) continue;
    check_middle(r.statistics->mean);
    check_middle(r.statistics->rms);
    for (const AreaWithin& step : r.statistics->curve) check_middle(step.share);
    for (const Percentile& p : r.statistics->percentiles) check_middle(p.distance);
    REQUIRE(r.map);
    for (const MapCell& cell : r.map->cells) {
      for (const float e : cell.estimate) CHECK(e >= 0);
      CHECK(cell.width >= 0);
    }
  }
}

/// Squares of one size at two heights: half of the area each.
Mesh two_heights(double low, double high) {
  Mesh a = square_patch(4, low);
  const Mesh other = translated(square_patch(4, 0.0), {2, 0, high});
  const auto first = static_cast<uint32_t>(a.vertices.size());
  std::vector<DVec3> vertices = a.vertices;
  std::vector<UVec3> faces = a.faces;
  for (const DVec3& v : other.vertices) vertices.push_back(v);
  for (const UVec3& f : other.faces) faces.push_back({f.x + first, f.y + first, f.z + first});
  return make_mesh("two heights", vertices, faces);
}

TEST_CASE("a level in a gap of the distribution is a jump, and costs no effort") {
  const Mesh b = translated(scaled(square_patch(2, 0.0), 3), {-2, -2, 0});
  const SurveyResult r = survey_of(two_heights(0.1, 0.2), b, statistics_alone());
  REQUIRE(r.statistics);
  CHECK(r.is_met());
  CHECK(r.bounded < 5000);
  const std::vector<Percentile>& p = r.statistics->percentiles;
  CHECK(p[0].jump);
  CHECK(p[0].distance.lower <= 0.1);
  CHECK(p[0].distance.upper >= 0.2);
  for (size_t i = 1; i < p.size(); ++i) CHECK(!p[i].jump);
}

// Slopes beside the gap: cells there have no least size.
TEST_CASE("a gap between slopes is a jump") {
  Mesh a = two_heights(0.1, 0.2);
  for (DVec3& v : a.vertices) v.z += v.x < 1.5 ? 0.05 * (v.x - 1) : 0.05 * (v.x - 2);
  const Mesh b = translated(scaled(square_patch(2, 0.0), 3), {-2, -2, 0});
  SurveyOptions options = statistics_alone();
  options.percentiles = {0.25, 0.5, 0.75};
  const SurveyResult r = survey_of(a, b, options);
  REQUIRE(r.statistics);
  CHECK(r.is_met());
  const std::vector<Percentile>& p = r.statistics->percentiles;
  CHECK(!p[0].jump);
  CHECK(p[1].jump);
  CHECK(!p[2].jump);
  CHECK(p[1].distance.upper - p[1].distance.lower > 0.09);
}

TEST_CASE("area at the very distance of a band is a jump") {
  const Mesh b = translated(scaled(square_patch(2, 0.0), 3), {-2, -2, 0});
  const SurveyResult r = survey_of(two_heights(0.1, 0.2), b, statistics_alone({0.15, 0.2, 0.3}));
  REQUIRE(r.statistics);
  CHECK(r.is_met());
  const std::vector<AreaWithin>& bands = r.statistics->bands;
  CHECK(!bands[0].jump);
  CHECK(bands[1].jump);
  CHECK(!bands[2].jump);
  CHECK(bands[1].share.lower <= 0.5 + 1e-9);
  CHECK(bands[1].share.upper == 1);
}

// Nine tenths of A are near, and the rest is a hundred times farther.
TEST_CASE("each figure is as narrow as its own size asks") {
  Mesh a = square_patch(20, 0.0);
  for (DVec3& v : a.vertices) v.z = 0.002 + 0.001 * v.x + (v.x > 0.9 ? 5 * (v.x - 0.9) : 0);
  const Mesh b = translated(scaled(square_patch(3, 0.0), 2), {-1.5, -1.5, 0});
  const SurveyResult r = survey_of(a, b, statistics_alone());
  REQUIRE(r.statistics);
  CHECK(r.is_met());
  for (const Percentile& p : r.statistics->percentiles)
    CHECK(p.distance.upper - p.distance.lower <= 0.0201 * p.distance.lower + 1e-5);
  CHECK(r.statistics->mean.upper - r.statistics->mean.lower <= 0.0201 * r.statistics->mean.lower);
}

double shares(const CellMap& map) {
  double sum = 0;
  for (const MapCell& cell : map.cells) sum += static_cast<double>(cell.share);
  return sum;
}

TEST_CASE("what is drawn of a cell is off by its width at most") {
  const auto check = [](const Mesh& a, const Mesh& b) {
    SurveyOptions options;
    options.map = MapOptions{.pixels = 200};
    options.effort = 20000;
    const SurveyResult r = survey_of(a, b, options);
    REQUIRE(r.map);
    const CellMap& map = *r.map;
    const ClosestTree tree(b.vertices, b.faces);
    CHECK(shares(map) == doctest::Approx(1.0).epsilon(1e-5));
    Random random(7);
    for (const MapCell& cell : map.cells) {
      const double s = random.unit(), t = random.unit() * (1 - s);
      const auto& [wa, wb, wc] = weights_of(cell);
      const glm::dvec3 w = (1 - s - t) * wa + s * wb + t * wc;
      const glm::uvec3 f = a.faces[cell.face];
      const glm::dvec3 p = w.x * glm::dvec3(a.vertices[f.x]) + w.y * glm::dvec3(a.vertices[f.y]) +
                           w.z * glm::dvec3(a.vertices[f.z]);
      const double drawn = (1 - s - t) * static_cast<double>(cell.estimate[0]) +
                           s * static_cast<double>(cell.estimate[1]) +
                           t * static_cast<double>(cell.estimate[2]);
      const Enclosure known = map.around(drawn, static_cast<double>(cell.width));
      CHECK(known.lower <= distance_to(tree, p) + 1e-12);
      CHECK(known.upper >= distance_to(tree, p) - 1e-12);
      CHECK(known.upper - known.lower <= 2.01 * map.unit * static_cast<double>(cell.width) + 1e-6);
    }
  };
  check(height_field(12, 1), height_field(12, 3));
  check(icosphere(1, 2), translated(icosphere(1.1, 3), {0.1, 0.2, 0.05}));
  check(soup(1, 60), soup(2, 90));
}

TEST_CASE("a map is cut until cells are resolved, or pixels") {
  const Mesh a = icosphere(1, 2), b = translated(icosphere(1.1, 3), {0.1, 0.2, 0.05});
  SurveyOptions options;
  options.map = MapOptions{.pixels = 300, .bar = 0.4};
  const SurveyResult r = survey_of(a, b, options);
  CHECK(r.is_met());
  REQUIRE(r.map);
  CHECK(r.map->bar == 0.4);
  const double pixel = std::sqrt(12.0) / 300, least = 0.125 * pixel * pixel / 12.3;
  for (const MapCell& cell : r.map->cells) {
    const bool is_resolved =
        static_cast<double>(cell.width) * r.map->unit <= 0.4 * CellMap::kUnresolved * 1.001;
    CHECK((is_resolved || static_cast<double>(cell.share) <= least));
    CHECK(!r.map->is_unresolved(cell, 1000));
  }
}

// A strip of needles along x, each with an eighteenth of a pixel's area, beside waves along it.
TEST_CASE("needles of a map are cut until they are resolved, or two pixels long") {
  constexpr uint32_t kNeedles = 40;
  Mesh a, b;
  for (uint32_t i = 0; i <= kNeedles; ++i) {
    const double y = 1e-5 * i;
    a.vertices.insert(a.vertices.end(), {{-1, y, 0}, {1, y, 0}});
    if (i == kNeedles) break;
    a.faces.insert(a.faces.end(), {{2 * i, 2 * i + 1, 2 * i + 3}, {2 * i, 2 * i + 3, 2 * i + 2}});
  }
  constexpr uint32_t kSteps = 64;
  for (uint32_t i = 0; i <= kSteps; ++i) {
    const double x = -1.1 + 2.2 * i / kSteps, z = 0.1 + (i % 2 == 0 ? 0 : 0.05);
    b.vertices.insert(b.vertices.end(), {{x, -1, z}, {x, 1, z}});
    if (i == kSteps) break;
    b.faces.insert(b.faces.end(), {{2 * i, 2 * i + 2, 2 * i + 3}, {2 * i, 2 * i + 3, 2 * i + 1}});
  }
  SurveyOptions options;
  options.map = MapOptions{.pixels = 150, .bar = 0.15};
  const SurveyResult r = survey_of(a, b, options);
  CHECK(r.is_met());
  REQUIRE(r.map);
  const double pixel = 2.0 / 150;
  size_t open = 0;
  for (const MapCell& cell : r.map->cells) {
    if (!r.map->is_unresolved(cell, 0.15)) continue;
    ++open;
    const std::array<glm::dvec3, 3> w = weights_of(cell);
    const glm::uvec3 f = a.faces[cell.face];
    const auto x_of = [&](const glm::dvec3& at) {
      return at.x * a.vertices[f.x].x + at.y * a.vertices[f.y].x + at.z * a.vertices[f.z].x;
    };
    const auto [least, most] = std::minmax({x_of(w[0]), x_of(w[1]), x_of(w[2])});
    CHECK(most - least <= 2 * pixel * 1.001);
  }
  CHECK(open < r.map->cells.size() / 2);
}

TEST_CASE("the colours of a cell with more faces about it than a device examines are true") {
  const Mesh a = square_patch(1, 0.0), b = height_field(48, 1);
  SurveyOptions options;
  options.map.emplace();
  options.effort = 0;
  const SurveyResult r = survey_of(a, b, options);
  REQUIRE(r.map);
  REQUIRE(r.map->cells.size() == a.faces.size());
  const ClosestTree tree(b.vertices, b.faces);
  for (const MapCell& cell : r.map->cells) {
    CHECK(static_cast<double>(cell.width) * r.map->unit > 0.02);  // little is proven of it
    const std::array<glm::dvec3, 3> weights = weights_of(cell);
    const glm::uvec3 f = a.faces[cell.face];
    for (size_t i = 0; i < weights.size(); ++i) {
      const glm::dvec3 p = weights[i].x * glm::dvec3(a.vertices[f.x]) +
                           weights[i].y * glm::dvec3(a.vertices[f.y]) +
                           weights[i].z * glm::dvec3(a.vertices[f.z]);
      const double estimate = static_cast<double>(cell.estimate[i]) * r.map->unit;
      const Enclosure drawn =
          r.map->around(estimate / r.map->unit, static_cast<double>(cell.width));
      const double truth = distance_to(tree, p);
      CHECK(drawn.lower <= truth);
      CHECK(drawn.upper >= truth);
    }
  }
}

TEST_CASE("the estimate of a point is its distance, near a surface and far from it") {
  const Mesh b = height_field(48, 1);
  Random random(11);
  std::vector<glm::dvec3> points;
  for (size_t i = 0; i < 400; ++i) {
    const double height = std::exp2(random.range(-20, 1));
    points.emplace_back(random.range(-1, 1), random.range(-1, 1), random.range(-height, height));
  }
  for (size_t i = 0; i < 50; ++i) points.emplace_back(b.vertices[i * 7]);
  const Mesh a = make_points("points", points);
  SurveyOptions options = statistics_alone();
  options.map.emplace();
  const SurveyResult r = survey_of(a, b, options);
  REQUIRE(r.map);
  REQUIRE(r.map->cells.size() == points.size());
  const ClosestTree tree(b.vertices, b.faces);
  double sum = 0;
  for (const MapCell& cell : r.map->cells) {
    const double distance = distance_to(tree, points[cell.face]);
    sum += distance;
    for (const float estimate : cell.estimate)
      CHECK(static_cast<double>(estimate) * r.map->unit ==
            doctest::Approx(distance).epsilon(1e-5).scale(1e-2));
  }
  REQUIRE(r.statistics);
  CHECK(*r.statistics->mean.estimate ==
        doctest::Approx(sum / static_cast<double>(points.size())).epsilon(1e-5));
}

TEST_CASE("a map has sides where they cost little") {
  const Mesh a = icosphere(1.2, 2);
  const auto sides_against = [&](const Mesh& b, SurveyOptions options) {
    const SurveyResult r = survey_of(a, b, options);
    REQUIRE(r.map);
    CHECK(r.sides.has_value() == options.is_signed);
    size_t over = 0;
    for (const MapCell& cell : r.map->cells) over += cell.side == SurfaceSide::kOver ? 1 : 0;
    CHECK((over == 0 || over == r.map->cells.size()));
    CHECK(r.map->has_sides == (over > 0));
    return r.map->has_sides;
  };
  SurveyOptions options;
  options.map = MapOptions{.sides_if_cheap = true};
  options.effort = 2000;
  CHECK(sides_against(icosphere(1, 2), options));
  CHECK_FALSE(sides_against(square_patch(2, 0.0), options));  // it is open
  CHECK_FALSE(sides_against(joined(icosphere(1, 1), translated(icosphere(1, 1), {0.3, 0, 0})),
                            options));                          // it crosses itself
  CHECK_FALSE(sides_against(uv_sphere(1, 160, 160), options));  // it is large
  options.map->sides_if_cheap = false;
  CHECK_FALSE(sides_against(icosphere(1, 2), options));
  options.is_signed = true;
  CHECK(sides_against(icosphere(1, 2), options));
}

TEST_CASE("one stray triangle does not move the end of the colours") {
  Mesh a = square_patch(8, 0.0);
  for (DVec3& v : a.vertices) v.z = 0.001 * (1 + v.x);
  std::vector<DVec3> vertices = a.vertices;
  std::vector<UVec3> faces = a.faces;
  const auto first = static_cast<uint32_t>(vertices.size());
  for (const DVec3& v : {DVec3(0, 0, 1), DVec3(0.05, 0, 1), DVec3(0, 0.05, 1)})
    vertices.push_back(v);
  faces.push_back({first, first + 1, first + 2});
  a = make_mesh("with a stray", vertices, faces);
  SurveyOptions options;
  options.map.emplace();
  const SurveyResult r = survey_of(a, square_patch(3, 0.0), options);
  REQUIRE(r.map);
  CHECK(r.map->bar > 0.0018);
  CHECK(r.map->bar < 0.003);
}

TEST_CASE("equal surfaces are resolved") {
  SurveyOptions options;
  options.map.emplace();
  const SurveyResult r = survey_of(square_patch(8, 0.5), square_patch(3, 0.5), options);
  CHECK(r.is_met());
  REQUIRE(r.map);
  for (const MapCell& cell : r.map->cells) CHECK(!r.map->is_unresolved(cell, r.map->bar));
}

}  // namespace
