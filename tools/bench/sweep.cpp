// Compares a device's answers on thousands of small, hard, generated pairs, or on a pair of files,
// with independent ones.
//
//   vkh_sweep [--kind distances|cells|proofs|sides] [--count N] [--first I] [--seed S] [--device D]
//   [--spoil X]
//
// distances: [--family NAME] [--tol T] [--threads N] [--gates] [--closes] [--least-closed N]
// cells: [--cells N]. proofs: --check PROGRAM, once for each. sides: A B [--effort N] [--cells N]
// [--samples N] [--head]
//
// Exit code 1 for any violation, 2 where it could not be run.
#include "tools/bench/sweep.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <map>
#include <thread>

namespace {

using vkh::bench::SweepOptions;

struct Kind {
  int (*sweep)(const SweepOptions&);
  uint64_t count;  ///< where none is given
  size_t cells;
};

const std::map<std::string, Kind>& kinds() {
  static const std::map<std::string, Kind> known{
      {"distances", {vkh::bench::sweep_distances, 10000, 0}},
      {"cells", {vkh::bench::sweep_cells, 1000, 40}},
      {"proofs", {vkh::bench::sweep_proofs, 1000, 0}},
#ifdef VKH_SWEEP_SIDES
      {"sides", {vkh::bench::sweep_sides, 1, 5000}},
#endif
  };
  return known;
}

int run(int argc, char** argv) {
  SweepOptions options;
  options.threads = std::max(1u, std::thread::hardware_concurrency());
  std::string kind = "distances";
  CLI::App app("What a device answers, against something independent.", "vkh_sweep");
  app.add_option("--kind", kind, "distances, cells, proofs, or sides where the build has GMP");
  CLI::Option* count = app.add_option("--count", options.count, "Pairs");
  app.add_option("--first", options.first, "Number of the first pair");
  app.add_option("--seed", options.seed, "Of the whole sweep");
  app.add_option("--device", options.device, "As for vkhausdorff, or native");
  app.add_option("--spoil", options.spoil, "Spoil answers by so much: the sweep must see it");
  app.add_option("--family", options.family, "distances: 'patch' is the paper's section 6.1");
  app.add_option("--tol", options.tolerance, "distances: instead of each family's own tolerance");
  app.add_option("--least-closed", options.least_closed, "distances: fewer are a failure");
  app.add_option("--threads", options.threads, "distances: for the reference");
  app.add_flag("--gates", options.gates, "distances: also ask about limits near them");
  app.add_flag("--closes", options.closes, "distances: close what the reference closes");
  CLI::Option* cells =
      app.add_option("--cells", options.cells, "cells, sides: random cells of each pair");
  app.add_option("--check", options.checks, "proofs: a checker")->allow_extra_args(false);
  app.add_option("a", options.a, "sides: mesh file");
  app.add_option("b", options.b, "sides: mesh file");
  app.add_option("--effort", options.effort, "sides: of the surveys");
  app.add_option("--samples", options.samples, "sides: area samples for the figures");
  app.add_flag("--head", options.head, "sides: print the columns' names first");
  CLI11_PARSE(app, argc, argv);
  const auto found = kinds().find(kind);
  if (found == kinds().end()) throw std::runtime_error("--kind " + kind + ": not in this build");
  if (count->empty()) options.count = found->second.count;
  if (cells->empty()) options.cells = found->second.cells;
  return found->second.sweep(options);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "vkh_sweep: %s\n", error.what());
    return 2;
  }
}
