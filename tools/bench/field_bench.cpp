// Measures the accuracy and cost of a survey of A's cells: one CSV row per pair, beside the plain
// run.
//
//   vkh_field_bench MANIFEST.csv [--filter TEXT] [--max-faces N] [--device D] [--time SECONDS]
//                   [--field-tol FRACTION] [--statistics] [--effort N] [--points N] [--faces N]
//
// field_width: the widest face's bounds, over h. mean_width, rms_width, p99_width: over h.
// area_width: the widest of the shares of area within h/4, h/2, 3h/4. met_...: 1 where mean and
// root mean square are known to 1 % of h, those shares to 0.1 % of A.
//
// --points: so many random points of A are measured in double precision, and must agree within five
// times the random error of their mean, mean square and shares. --faces: of so many faces, evenly
// spread, the tests' double-precision solver must meet the bounds. Exit code 1 if one does not.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>

#include "host/answer/options.h"
#include "host/base/parallel.h"
#include "tests/shapes/shapes.h"
#include "tests/verification/oracle/reference_solver.h"
#include "tools/bench/manifest.h"
#include "vkhausdorff/mesh_io.h"
#include "vkhausdorff/solver.h"
#include "vkhausdorff/survey.h"

namespace vkh::bench {
namespace {

using test::ClosestTree;
using test::Interval;
using test::Random;

struct Arguments {
  std::string manifest, device;
  Choice choice;
  double field_tolerance = 0;  // of h
  SurveyOptions survey;
  size_t points = 0, faces = 0;
};

double width(const Enclosure& e) { return e.upper - e.lower; }

double widest(const std::vector<AreaWithin>& bands) {
  double most = 0;
  for (const AreaWithin& band : bands) most = std::max(most, width(band.share));
  return most;
}

double widest(const Field& field) {
  double most = 0;
  for (size_t f = 0; f < field.face_count(); ++f) most = std::max(most, width(field.of(f)));
  return most;
}

void print_row(const std::string& name, const Report& plain, const SurveyResult& r) {
  const double h = plain.upper;
  std::printf("%s,%zu,%.6g,%.3f,%.3f,%.3f,%zu,%zu,%d,%.3g", name.c_str(), r.field.face_count(), h,
              plain.times.wall_ms, r.ms, r.device_ms, r.cells, r.bounded, r.is_met() ? 1 : 0,
              widest(r.field) / h);
  if (r.statistics) {
    const Statistics& s = *r.statistics;
    std::printf(",%.6g,%.6g,%.3g,%.3g,%.3g,%.3g", s.mean.lower, s.mean.upper, width(s.mean) / h,
                width(s.rms) / h, widest(s.bands), width(s.percentiles.back().distance) / h);
    const bool moments = width(s.mean) <= 0.01 * h && width(s.rms) <= 0.01 * h;
    std::printf(",%d,%d", moments ? 1 : 0, widest(s.bands) <= 0.001 ? 1 : 0);
  }
  std::printf("\n");
  std::fflush(stdout);
}

// Sums over random points of A: of d, d^2 and d^4, and the number of points within each band.
struct Sampled {
  double d = 0, d2 = 0, d4 = 0;
  std::vector<double> within;
};

std::vector<double> area_sums(const Mesh& a) {
  std::vector<double> sums;
  double area = 0;
  for (const glm::uvec3& f : a.faces) {
    const glm::dvec3 p = a.vertices[f.x];
    area += glm::length(glm::cross(a.vertices[f.y] - p, a.vertices[f.z] - p)) / 2;
    sums.push_back(area);
  }
  return sums;
}

glm::dvec3 random_point(const Mesh& a, const std::vector<double>& sums, Random& random) {
  const auto at = std::lower_bound(sums.begin(), sums.end(), random.unit() * sums.back());
  const auto face = std::min<size_t>(static_cast<size_t>(at - sums.begin()), sums.size() - 1);
  double v = random.unit(), w = random.unit();
  if (v + w > 1) v = 1 - v, w = 1 - w;
  const glm::uvec3 f = a.faces[face];
  return a.vertices[f.x] + v * (a.vertices[f.y] - a.vertices[f.x]) +
         w * (a.vertices[f.z] - a.vertices[f.x]);
}

Sampled sample(const Mesh& a, const Mesh& b, const std::vector<double>& bands, size_t count) {
  const std::vector<double> sums = area_sums(a);
  const ClosestTree tree(b.vertices, b.faces);
  std::vector<Sampled> blocks(block_count(count));
  for_each_block(count, [&](size_t block, size_t begin, size_t end) {
    Random random(block + 1);
    Sampled& s = blocks[block];
    s.within.resize(bands.size());
    for (size_t i = begin; i < end; ++i) {
      test::Nearest nearest;
      tree.query(random_point(a, sums, random), nearest);
      s.d += std::sqrt(nearest.squared);
      s.d2 += nearest.squared;
      s.d4 += nearest.squared * nearest.squared;
      for (size_t k = 0; k < bands.size(); ++k)
        s.within[k] += nearest.squared <= bands[k] * bands[k] ? 1 : 0;
    }
  });
  Sampled all;
  all.within.resize(bands.size());
  for (const Sampled& s : blocks) {
    all.d += s.d;
    all.d2 += s.d2;
    all.d4 += s.d4;
    for (size_t k = 0; k < bands.size(); ++k) all.within[k] += s.within[k];
  }
  return all;
}

bool agrees(const char* what, const Enclosure& e, double seen, double sigma) {
  const double off = 5 * sigma + 1e-9 * std::abs(seen);
  if (seen >= e.lower - off && seen <= e.upper + off) return true;
  std::printf("  REFUTED %s: [%.9g, %.9g], seen %.9g +- %.3g\n", what, e.lower, e.upper, seen,
              sigma);
  return false;
}

bool points_agree(const Mesh& a, const Mesh& b, const Arguments& arguments, const Statistics& s) {
  const double n = static_cast<double>(arguments.points);
  const Sampled seen = sample(a, b, arguments.survey.bands, arguments.points);
  const double mean = seen.d / n, square = seen.d2 / n;
  bool good = agrees("mean", s.mean, mean, std::sqrt(std::max(square - mean * mean, 0.0) / n));
  const Enclosure squares{s.rms.lower * s.rms.lower, s.rms.upper * s.rms.upper};
  good = agrees("mean square", squares, square,
                std::sqrt(std::max(seen.d4 / n - square * square, 0.0) / n)) &&
         good;
  for (size_t k = 0; k < s.bands.size(); ++k) {
    const double share = seen.within[k] / n;
    good = agrees("share", s.bands[k].share, share,
                  std::sqrt(std::max(share * (1 - share), 1 / n) / n)) &&
           good;
  }
  return good;
}

bool faces_agree(const Mesh& a, const Mesh& b, const Arguments& arguments, const Field& field,
                 double h) {
  const size_t count = std::min(arguments.faces, a.faces.size());
  std::atomic<size_t> wrong = 0;
  for_each_index(count, [&](size_t i) {
    const size_t f = i * a.faces.size() / count;
    const glm::uvec3 face = a.faces[f];
    const Mesh one =
        test::single_triangle(a.vertices[face.x], a.vertices[face.y], a.vertices[face.z]);
    const Interval truth = test::reference_hausdorff(one, b, 1e-5 * h, 200000);
    if (field.lower[f] > truth.upper || field.upper[f] < truth.lower) ++wrong;
  });
  if (wrong > 0) std::printf("  REFUTED %zu of %zu faces\n", wrong.load(), count);
  return wrong == 0;
}

bool measure(Solver& solver, const Row& row, Arguments arguments) {
  const Mesh a = read_mesh(row.file_a), b = read_mesh(row.file_b);
  SolveOptions options;
  options.time_limit_s = 60;
  solver.distance(a, b, options);
  const Report plain = solver.distance(a, b, options);
  arguments.survey.faces = arguments.field_tolerance > 0;
  arguments.survey.field_tolerance = arguments.field_tolerance * plain.upper;
  for (const double part : {0.25, 0.5, 0.75}) arguments.survey.bands.push_back(part * plain.upper);
  SurveyResult result;
  options.survey = survey_with(arguments.survey, result);
  solver.distance(a, b, options);
  print_row(row.pair, plain, result);
  bool good = true;
  if (arguments.points > 0 && result.statistics)
    good = points_agree(a, b, arguments, *result.statistics);
  if (arguments.faces > 0) good = faces_agree(a, b, arguments, result.field, plain.upper) && good;
  std::fflush(stdout);
  return good;
}

int run(int argc, char** argv) {
  Arguments arguments;
  CLI::App app("bounds of the distance over all of A", "vkh_field_bench");
  app.add_option("MANIFEST", arguments.manifest)->required();
  app.add_option("--filter", arguments.choice.filter);
  app.add_option("--max-faces", arguments.choice.max_faces);
  app.add_option("--device", arguments.device);
  app.add_option("--time", arguments.survey.time_limit_s);
  app.add_option("--field-tol", arguments.field_tolerance);
  app.add_option("--effort", arguments.survey.effort);
  app.add_flag("--statistics", arguments.survey.statistics);
  app.add_option("--points", arguments.points);
  app.add_option("--faces", arguments.faces);
  CLI11_PARSE(app, argc, argv);
  Device device({.selector = arguments.device});
  Solver solver(device);
  std::printf(
      "pair,faces,h,plain_ms,survey_ms,device_ms,cells,bounded,met,field_width,mean_lower,mean_"
      "upper,"
      "mean_width,rms_width,area_width,p99_width,met_moments,met_areas\n");
  int refuted = 0;
  for (const Row& row : read_manifest(arguments.manifest, arguments.choice))
    refuted += !measure(solver, row, arguments);
  return refuted > 0 ? 1 : 0;
}

}  // namespace
}  // namespace vkh::bench

int main(int argc, char** argv) try {
  return vkh::bench::run(argc, argv);
} catch (const std::exception& e) {
  std::fprintf(stderr, "vkh_field_bench: %s\n", e.what());
  return 1;
}
