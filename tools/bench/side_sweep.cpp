#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <mutex>
#include <numeric>

#include "host/base/parallel.h"
#include "host/solve/cell_corners.h"
#include "host/survey/signed_figures.h"
#include "host/survey/survey_with.h"
#include "tests/shapes/shapes.h"
#include "tests/support/all_cells.h"
#include "tests/verification/oracle/exact_side.h"
#include "tools/bench/sweep.h"
#include "vkhausdorff/mesh_io.h"

namespace vkh::bench {
namespace {

using namespace vkh::test;
using glm::dvec3;

struct Checked {
  uint64_t cells = 0, with_side = 0, points = 0, wrong = 0, skipped = 0;
};

glm::uvec3 random_point(const gpu::Cell& cell, Random& random) {
  const lib::Bary3 t = corners_of(cell);
  const uint32_t x = random.below(17), y = random.below(17 - x), z = 16 - x - y;
  const glm::uvec2 sum = t.a * x + t.b * y + t.c * z;
  return {(1u << ExactSides::kBits) - sum.x - sum.y, sum.x, sum.y};
}

dvec3 near_point(const Mesh& a, uint32_t face, const glm::uvec3& w) {
  const glm::uvec3& f = a.faces[face];
  return (a.vertices[f.x] * double(w.x) + a.vertices[f.y] * double(w.y) +
          a.vertices[f.z] * double(w.z)) *
         0x1p-24;
}

// Whether the faces of a closed mesh look outward: by its volume.
bool is_outward(const Mesh& b) {
  double volume = 0;
  const dvec3 from = b.vertices[0];
  for (const glm::uvec3& f : b.faces)
    volume += glm::dot(b.vertices[f.x] - from,
                       glm::cross(b.vertices[f.y] - from, b.vertices[f.z] - from));
  return volume > 0;
}

// Whether a point of the cell is on the side that was told; nothing if the oracle cannot tell.
std::optional<bool> is_right(const SurveyedPair& pair, const ExactSides& oracle, const Sides& sides,
                             const gpu::Cell& cell, SurfaceSide told, Random& random) {
  const glm::uvec3 w = random_point(cell, random);
  const exact::Vector p = oracle.point(cell.face, w);
  const bool is_over = told == SurfaceSide::kOver;
  if (sides.is_solid()) {
    const std::optional<int> winding = oracle.winding(p);
    if (!winding) return std::nullopt;
    const bool is_outside = *winding == 0;
    if (!is_outside && *winding != (is_outward(pair.b) ? 1 : -1)) return false;
    return (is_outside == is_outward(pair.b)) == is_over;
  }
  const double off = 1e-12 * (diagonal(pair.b) + glm::length(dvec3(pair.b.vertices[0])));
  const ExactSides::Closest closest = oracle.closest(p, near_point(pair.a, cell.face, w), off);
  return (is_over ? closest.below : closest.above) == 0 && closest.in_plane == 0;
}

Checked check_cells(const SurveyedPair& pair, const CellsRead& cells, const Sides& sides,
                    size_t count) {
  const ExactSides oracle(pair.a, pair.b);
  std::vector<Checked> parts(64);
  for_each_index(parts.size(), [&](size_t part) {
    Random random(part + 1);
    Checked& mine = parts[part];
    for (size_t k = 0; k < count / parts.size() + 1; ++k) {
      const size_t i = random.below(static_cast<uint32_t>(cells.cells.size()));
      const SurfaceSide told = side_of_class(cells.classes[i]).side;
      ++mine.cells;
      if (told == SurfaceSide::kUnsigned) continue;
      ++mine.with_side;
      for (int point = 0; point < 2; ++point) {
        const auto right = is_right(pair, oracle, sides, cells.cells[i], told, random);
        mine.skipped += right ? 0 : 1;
        mine.points += right ? 1 : 0;
        mine.wrong += right && !*right ? 1 : 0;
      }
    }
  });
  Checked all;
  for (const Checked& one : parts) {
    all.cells += one.cells;
    all.with_side += one.with_side;
    all.points += one.points;
    all.wrong += one.wrong;
    all.skipped += one.skipped;
  }
  return all;
}

// Signed distances of random points of A, uniform in area, that ascend, in the files' unit.
std::vector<double> sampled(const Mesh& a, const Mesh& b, size_t count) {
  std::vector<double> area_to{0};
  for (uint32_t f = 0; f < a.faces.size(); ++f) {
    const auto t = corners(a, f);
    area_to.push_back(area_to.back() + glm::length(glm::cross(t[1] - t[0], t[2] - t[0])));
  }
  const ClosestTree tree({b.vertices.begin(), b.vertices.end()}, {b.faces.begin(), b.faces.end()});
  const Shells shells({b.vertices.begin(), b.vertices.end()}, b.faces);
  std::vector<std::vector<double>> parts(64);
  for_each_index(parts.size(), [&](size_t part) {
    Random random(1000 + part);
    for (size_t k = 0; k < count / parts.size(); ++k) {
      const double at = random.range(0, area_to.back());
      const auto f = std::upper_bound(area_to.begin(), area_to.end(), at) - area_to.begin() - 1;
      const auto t = corners(a, static_cast<uint32_t>(f));
      double v = random.unit(), w = random.unit();
      if (v + w > 1) v = 1 - v, w = 1 - w;
      const dvec3 p = t[0] + v * (t[1] - t[0]) + w * (t[2] - t[0]);
      Nearest nearest;
      tree.query(p, nearest);
      const std::optional<int> winding = shells.winding(p);
      const double d = std::sqrt(nearest.squared);
      parts[part].push_back(!winding ? 0 : *winding == shells.front() ? d : -d);
    }
  });
  std::vector<double> all;
  for (const std::vector<double>& part : parts) all.insert(all.end(), part.begin(), part.end());
  std::sort(all.begin(), all.end());
  return all;
}

// Whether the figures are within five standard errors of the samples; a percentile is between those
// of shares that are off by as much.
int figures_off(const SignedFigures& s, const std::vector<double>& all) {
  const double n = static_cast<double>(all.size());
  const double mean = std::accumulate(all.begin(), all.end(), 0.0) / n;
  double squares = 0;
  for (const double x : all) squares += (x - mean) * (x - mean);
  const double error = 5 * std::sqrt(squares / n / n);
  int off = s.mean->lower > mean + error || s.mean->upper < mean - error ? 1 : 0;
  for (const Percentile& p : s.percentiles) {
    const double share_error = 5 * std::sqrt(p.share * (1 - p.share) / n);
    const auto at = [&](double share) {
      return all[static_cast<size_t>(std::clamp(share * n, 0.0, n - 1))];
    };
    off += p.distance.lower > at(p.share + share_error) ||
           p.distance.upper < at(p.share - share_error);
  }
  return off;
}

double survey_ms(Solver& solver, const Mesh& a, const Mesh& b, const SweepOptions& args,
                 bool is_signed, SurveyResult& result) {
  SurveyOptions survey;
  survey.faces = survey.statistics = true;
  survey.is_signed = is_signed;
  survey.effort = args.effort;
  survey.upper = solver.distance(a, b).upper;
  result = survey_mesh(solver, {a, b}, survey);
  return result.ms;
}

// Splits all cells until there are enough, and finds the sides of all.
Checked check_pair(Solver& solver, const Mesh& a, const Mesh& b, const SweepOptions& args) {
  Checked checked;
  hold_pair(solver, {a, b}, {}, [&](const SurveyedPair& pair) {
    const Sides sides(pair);
    const CellsRead cells = sided_cells(pair, sides.search(), args.effort / 2);
    checked = check_cells(pair, cells, sides, args.cells);
  });
  return checked;
}

double percent_up(const Enclosure& share) { return 100 * share.upper; }

}  // namespace

int sweep_sides(const SweepOptions& args) {
  if (args.head)
    std::printf(
        "pair\tfaces_a\tfaces_b\tinside\tcells\twith_side\tpoints\tskipped\twrong\tover\tunder\t"
        "meets\tedge\tdegenerate\ttwo_sided\tmany\tmean_lower\tmean_upper\tsamples\toff\t"
        "plain_ms\tsigned_ms\tsides_ms\n");
  const Mesh a = read_mesh(args.a), b = read_mesh(args.b);
  Swept swept(args.device);
  Solver& solver = swept.solver();
  const Checked checked = args.cells > 0 ? check_pair(solver, a, b, args) : Checked();
  SurveyResult plain, found;
  const double plain_ms = survey_ms(solver, a, b, args, false, plain);
  const double signed_ms = survey_ms(solver, a, b, args, true, found);
  const SignedFigures& s = *found.sides;
  int off = -1;
  if (args.samples > 0 && s.inside == Inside::kProven && s.mean)
    off = figures_off(s, sampled(a, b, args.samples));
  const std::string name = args.a.substr(args.a.find_last_of('/') + 1);
  std::printf("%s\t%zu\t%zu\t%s\t%llu\t%llu\t%llu\t%llu\t%llu", name.c_str(), a.faces.size(),
              b.faces.size(), inside_name(s.inside), static_cast<unsigned long long>(checked.cells),
              static_cast<unsigned long long>(checked.with_side),
              static_cast<unsigned long long>(checked.points),
              static_cast<unsigned long long>(checked.skipped),
              static_cast<unsigned long long>(checked.wrong));
  const SignedFigures::Areas areas = s.areas.value_or(SignedFigures::Areas{});
  std::printf("\t%.3f\t%.3f", percent_up(areas.over), percent_up(areas.under));
  for (size_t k = 1; k < kDoubts; ++k) std::printf("\t%.3f", percent_up(areas.doubts[k]));
  const Enclosure mean = s.mean.value_or(Enclosure{});
  std::printf("\t%.6g\t%.6g\t%zu\t%d\t%.0f\t%.0f\t%.0f\n", mean.lower, mean.upper, args.samples,
              off, plain_ms, signed_ms, s.ms);
  return checked.wrong > 0 || off > 0 ? 1 : 0;
}

}  // namespace vkh::bench
