// Faces that simplify keeps of a mesh, beside meshoptimizer by itself: with the largest target
// error of 40 geometric steps whose result passes, and with the limit as its target error.
#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "host/simplify/collapse.h"
#include "host/simplify/judge.h"
#include "tools/bench/bench.h"
#include "vkhausdorff/error.h"
#include "vkhausdorff/mesh_io.h"

namespace vkh::bench {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

struct Alone {
  size_t faces = 0;
  double seconds = 0;
};

// The largest of 40 errors, from a 400th of the limit to 25 times it, whose result passes. Steps
// of fewer faces come first, so that the first that passes is the answer.
Alone meshopt_that_passes(Solver& solver, const Mesh& a, const SimplifyOptions& options) {
  constexpr int kSteps = 40;
  const auto start = Clock::now();
  const Deadline deadline(options.time_limit_s);
  Judge judge(solver, a, options, deadline);
  const Collapser collapser(a, false, false);
  for (int step = kSteps - 1; step >= 0; --step) {
    const double error = options.max.within * std::pow(10.0, -2.6 + 4.0 * step / (kSteps - 1));
    const Faces faces = collapser.collapse(collapser.faces(), {.error = error, .by_blocks = false});
    if (faces.empty()) continue;
    if (judge.decide(collapser.mesh_of(faces)).verdict == Verdict::kWithin)
      return {faces.size(), seconds_since(start)};
  }
  return {a.faces.size(), seconds_since(start)};
}

struct Told {
  size_t faces = 0;
  double times_limit = 0;  ///< a lower bound of its distance, both ways, over the limit
};

Told meshopt_told_limit(Solver& solver, const Mesh& a, const SimplifyOptions& options) {
  const Collapser collapser(a, false, false);
  const Faces faces =
      collapser.collapse(collapser.faces(), {.error = options.max.within, .by_blocks = false});
  if (faces.empty()) return {};
  SolveOptions run;
  run.tolerance = 1e-3 * options.max.within;
  run.tolerance_is_absolute = true;
  const SymmetricReport r = solver.symmetric(a, collapser.mesh_of(faces), run);
  return {faces.size(), r.interval().lower / options.max.within};
}

void print_others(Solver& solver, const Mesh& a, const SimplifyOptions& options, size_t faces) {
  const Alone alone = meshopt_that_passes(solver, a, options);
  const Told told = meshopt_told_limit(solver, a, options);
  std::printf(",%zu,%.2f,%.3f,%zu,%.3f", alone.faces, alone.seconds,
              static_cast<double>(faces) / static_cast<double>(alone.faces), told.faces,
              told.times_limit);
}

struct Work {
  std::vector<double> shares;
  bool only_ours = false;
};

void measure(Solver& solver, const std::string& file, const Work& work) {
  const Mesh a = read_mesh(file);
  const double diagonal = solver.distance(a, a, {}).diagonal_a;
  for (const double share : work.shares) {
    SimplifyOptions options;
    options.max = {share * diagonal, share * diagonal};
    const auto start = Clock::now();
    const Simplified ours = simplify(solver, a, options);
    const double seconds = seconds_since(start);
    std::printf("%s,%zu,%g,%zu,%.4f,%zu,%.2f", file.c_str(), a.faces.size(), share,
                ours.mesh.faces.size(), ours.deviation.interval.upper / options.max.within,
                ours.tried, seconds);
    if (!work.only_ours) print_others(solver, a, options, ours.mesh.faces.size());
    std::printf("\n");
    std::fflush(stdout);
  }
}

struct Arguments {
  std::vector<std::string> files;
  Work work{.shares = {1e-4, 1e-3, 1e-2}};
  std::string device;
};

int run(const Arguments& args) {
  Device on({.selector = args.device});
  Solver solver(on);
  std::printf(
      "file,faces_a,share,faces,upper_of_limit,tried,s%s\n",
      args.work.only_ours ? "" : ",meshopt_faces,meshopt_s,of_meshopt,told_faces,told_of_limit");
  for (const std::string& file : args.files) measure(solver, file, args.work);
  return 0;
}

}  // namespace

Measure add_simplify(CLI::App& app) {
  const auto args = std::make_shared<Arguments>();
  app.add_option("FILE", args->files, "Meshes")->required();
  app.add_option("--shares", args->work.shares, "Limits, as shares of the diagonal")
      ->delimiter(',')
      ->allow_extra_args(false);
  app.add_flag("--only-ours", args->work.only_ours, "Without meshoptimizer by itself");
  app.add_option("--device", args->device, "An index, gpu, cpu or part of a name");
  return [args] { return run(*args); };
}

}  // namespace vkh::bench
