// What a survey of A's cells reaches, and at what cost: one CSV row a pair, beside the plain run.
//
//   vkh_field_bench MANIFEST.csv [--filter TEXT] [--max-faces N] [--device D] [--time SECONDS]
//                   [--field-tol FRACTION] [--statistics] [--cells N]
//
// field_width: the widest face's bounds, over h. mean_width, rms_width, p99_width: over h.
// area_width: the widest of the shares of area within h/4, h/2, 3h/4.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>

#include "host/answer/options.h"
#include "host/field/survey.h"
#include "host/read/mesh_io.h"
#include "host/solve/solver.h"
#include "tools/bench/manifest.h"

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
  std::printf("%s,%zu,%.6g,%.3f,%.3f,%zu,%zu,%d,%.3g", name.c_str(), r.field.face_count(), h,
              plain.times.wall_ms, r.ms, r.cells, r.bounded, r.is_met ? 1 : 0, widest(r.field) / h);
  if (r.statistics) {
    const Statistics& s = *r.statistics;
    std::printf(",%.6g,%.6g,%.3g,%.3g,%.3g,%.3g", s.mean.lower, s.mean.upper, width(s.mean) / h,
                width(s.rms) / h, widest(s.bands), width(s.percentiles.back().distance) / h);
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
  SurveyResult result;
  options.survey = survey_with(arguments.survey, result);
  solver.distance(a, b, options);
  print_row(row.pair, plain, result);
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
  app.add_option("--cells", arguments.survey.cell_limit);
  app.add_flag("--statistics", arguments.survey.statistics);
  CLI11_PARSE(app, argc, argv);
  Device device({.selector = arguments.device});
  Solver solver(device);
  std::printf(
      "pair,faces,h,plain_ms,survey_ms,cells,bounded,met,field_width,mean_lower,mean_upper,"
      "mean_width,rms_width,area_width,p99_width\n");
  for (const Row& row : read_manifest(arguments.manifest, arguments.choice))
    measure(solver, row, arguments);
  return 0;
}

}  // namespace
}  // namespace vkh::bench

int main(int argc, char** argv) try {
  return vkh::bench::run(argc, argv);
} catch (const std::exception& e) {
  std::fprintf(stderr, "vkh_field_bench: %s\n", e.what());
  return 1;
}
