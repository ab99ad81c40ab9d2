// Measures the accuracy and cost of a survey of A's cells: one CSV row per pair, beside the plain
// run.
//
//   vkh_bench survey MANIFEST.csv [--filter TEXT] [--max-faces N] [--device D] [--time SECONDS]
//                    [--field-tol FRACTION] [--statistics] [--effort N]
//
// field_width: the widest face's bounds, over h. mean_width, rms_width, p99_width: over h.
// area_width: the widest of the shares of area within h/4, h/2, 3h/4. met_...: 1 where mean and
// root mean square are known to 1 % of h, those shares to 0.1 % of A. pairs.py --what estimates and
// vkh_sweep --kind cells hold them against something independent.
#include <algorithm>
#include <cstdio>
#include <memory>

#include "tools/bench/bench.h"
#include "tools/bench/manifest.h"
#include "vkhausdorff/mesh_io.h"
#include "vkhausdorff/solver.h"
#include "vkhausdorff/survey.h"

namespace vkh::bench {
namespace {

struct Arguments {
  std::string manifest, device;
  Choice choice;
  double field_tolerance = 0;  // of h
  SurveyOptions survey;
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

void measure(Solver& solver, const Row& row, Arguments arguments) {
  const Mesh a = read_mesh(row.file_a), b = read_mesh(row.file_b);
  SolveOptions options;
  options.time_limit_s = 60;
  solver.distance(a, b, options);
  const Report plain = solver.distance(a, b, options);
  arguments.survey.faces = arguments.field_tolerance > 0;
  arguments.survey.field_tolerance = arguments.field_tolerance * plain.upper;
  for (const double part : {0.25, 0.5, 0.75}) arguments.survey.bands.push_back(part * plain.upper);
  arguments.survey.upper = plain.upper;
  print_row(row.pair, plain, survey_mesh(solver, {a, b}, arguments.survey));
}

int run(const Arguments& arguments) {
  Device device({.selector = arguments.device});
  Solver solver(device);
  std::printf(
      "pair,faces,h,plain_ms,survey_ms,device_ms,cells,bounded,met,field_width,mean_lower,mean_"
      "upper,"
      "mean_width,rms_width,area_width,p99_width,met_moments,met_areas\n");
  for (const Row& row : read_manifest(arguments.manifest, arguments.choice))
    measure(solver, row, arguments);
  return 0;
}

}  // namespace

Measure add_survey(CLI::App& app) {
  const auto args = std::make_shared<Arguments>();
  app.add_option("MANIFEST", args->manifest)->required();
  app.add_option("--filter", args->choice.filter);
  app.add_option("--max-faces", args->choice.max_faces);
  app.add_option("--device", args->device);
  app.add_option("--time", args->survey.time_limit_s);
  app.add_option("--field-tol", args->field_tolerance);
  app.add_option("--effort", args->survey.effort);
  app.add_flag("--statistics", args->survey.statistics);
  return [args] { return run(*args); };
}

}  // namespace vkh::bench
