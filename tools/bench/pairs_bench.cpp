// Times the solver over a manifest of pairs in one live context: presets and changes of them, a
// warm-up each, then alternating repeats (A B C A B C); one CSV row per pair and preset with
// medians: of times as a whole and, from a third as many runs more, of stages, whose timestamps
// take time themselves. Correctness comes first: if the intervals of all do not meet, or repeats
// differ by a bit, the exit code is 1. A run that does not close within its limits is not repeated,
// and counted; then the exit code is 3.
//
//   vkh_bench pairs MANIFEST.csv [--presets
//   default,paper,baseline-gpu,-sort,+packet,paper-thin,-u3@64MiB]
//             [--filter TEXT] [--max-faces N] [--repeat N] [--tol T] [--device D] [--time SECONDS]
//             [--memory BYTES] [--sort-from N] [--disable a,b] [--enable a,b] [--plain]
//             [--together N] [--not-robust] [--not-mapped]
//
// With --together, the default preset alone: each pair alone and N side by side, a row per group;
// then all pairs by a stream, N a submission.
#include <chrono>
#include <cstdio>
#include <map>
#include <memory>

#include "host/answer/quantities.h"
#include "tools/bench/bench.h"
#include "tools/bench/manifest.h"
#include "tools/bench/table.h"
#include "tools/bench/together.h"
#include "tools/bench/variant.h"
#include "vkhausdorff/mesh_io.h"
#include "vkhausdorff/solver.h"

namespace vkh::bench {
namespace {

enum ExitCode { kExitClosed = 0, kExitWrong = 1, kExitNotClosed = 3 };

struct Arguments {
  std::string manifest, device, memory;
  std::vector<std::string> presets = {"default"};
  Choice choice;
  bool plain = false, not_robust = false, not_mapped = false;
  int repeat = 5;
  size_t together = 0;
  SolveOptions common;
};

using Clock = std::chrono::steady_clock;
double ms_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

struct Tally {
  int closed = 0, timed_out = 0, out_of_memory = 0, otherwise_open = 0;
  double gpu_ms = 0;

  void add(const Outcome& o) {
    const Status status = o.last().status;
    ++(status == Status::kClosed   ? closed
       : status == Status::kTime   ? timed_out
       : status == Status::kMemory ? out_of_memory
                                   : otherwise_open);
    gpu_ms += bench::gpu_ms(o.last());
  }
};

class Race {
 public:
  explicit Race(const Arguments& args)
      : args_(args),
        made_at_(Clock::now()),
        device_({.selector = args.device,
                 .validation = false,
                 .robust = !args.not_robust,
                 .maps_memory = !args.not_mapped}),
        solver_(device_),
        device_ms_(ms_since(made_at_)) {
    for (const std::string& name : args.presets) variants_.push_back(variant_of(name, args.common));
  }

  ExitCode run() {
    print_device();
    if (args_.together > 0) return run_groups();
    print_header();
    warm_up();
    for (const Row& row : read_manifest(args_.manifest, args_.choice)) run_pair(row);
    return print_tail();
  }

 private:
  // Pipelines are made by the first run with a set of switches; this one has nothing else to do.
  void warm_up() {
    const Mesh point = make_mesh("point", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
    for (const Variant& v : variants_) {
      const auto start = Clock::now();
      solver_.distance(point, point, v.options);
      setup_ms_[v.name] = device_ms_ + ms_since(start);
    }
  }

  void run_pair(const Row& row) {
    const auto start = Clock::now();
    const Mesh a = read_mesh(row.file_a);
    const Mesh b = read_mesh(row.file_b);
    const double load_ms = ms_since(start);
    std::vector<Outcome> outcomes;
    for (const Variant& v : variants_)
      outcomes.push_back(
          {v.name, {solver_.distance(a, b, v.options)}, {}, load_ms, setup_ms_[v.name]});
    std::vector<bool> again;
    for (Outcome& o : outcomes) {
      again.push_back(o.closed());
      if (o.closed()) o.reports.clear();
    }
    for (int i = 0; i < args_.repeat; ++i) {
      for (size_t v = 0; v < variants_.size(); ++v) {
        if (!again[v]) continue;
        SolveOptions options = variants_[v].options;
        if (i % 3 == 0) outcomes[v].staged.push_back(solver_.distance(a, b, options));
        options.engine.stage_times = false;
        outcomes[v].reports.push_back(solver_.distance(a, b, options));
      }
    }
    const bool meets = intervals_meet(outcomes);
    for (const Outcome& o : outcomes) {
      print_row(row, o, meets);
      tallies_[o.variant].add(o);
      wrong_ += meets && o.repeats() ? 0 : 1;
    }
  }

  ExitCode run_groups() {
    const Groups groups{args_.together, args_.repeat};
    const std::vector<Row> rows = read_manifest(args_.manifest, args_.choice);
    const int wrong = run_together(solver_, rows, groups, args_.common);
    std::printf("# %d reports wrong\n", wrong);
    run_stream(args_.device, rows, groups, args_.common);
    return wrong > 0 ? kExitWrong : kExitClosed;
  }

  void print_device() const {
    std::printf("# device %s, driver %s, tolerance %g, repeat %d, time limit %g s%s%s%s\n",
                device_.description().name.c_str(), device_.description().driver.c_str(),
                args_.common.tolerance, args_.repeat, args_.common.time_limit_s,
                args_.plain ? "; NOT CERTIFIED" : "", args_.not_robust ? "; NOT ROBUST" : "",
                args_.not_mapped ? "; NOT MAPPED" : "");
  }

  ExitCode print_tail() const {
    int open = 0;
    for (const Variant& v : variants_) {
      const auto found = tallies_.find(v.name);
      const Tally t = found == tallies_.end() ? Tally{} : found->second;
      std::printf("# %s: %d closed, %d timed out, %d out of memory, %d open otherwise; %.1f ms\n",
                  v.name.c_str(), t.closed, t.timed_out, t.out_of_memory, t.otherwise_open,
                  t.gpu_ms);
      open += t.timed_out + t.out_of_memory + t.otherwise_open;
    }
    std::printf("# %d rows wrong\n", wrong_);
    return wrong_ > 0 ? kExitWrong : open > 0 ? kExitNotClosed : kExitClosed;
  }

  const Arguments& args_;
  Clock::time_point made_at_;
  Device device_;
  Solver solver_;
  double device_ms_;
  std::vector<Variant> variants_;
  std::map<std::string, double> setup_ms_;
  std::map<std::string, Tally> tallies_;
  int wrong_ = 0;
};

ExitCode run(Arguments& args) {
  args.common.engine.certified = !args.plain;
  if (!args.memory.empty()) args.common.memory_bytes = parse_size("memory", args.memory);
  return Race(args).run();
}

}  // namespace

Measure add_pairs(CLI::App& app) {
  const auto args = std::make_shared<Arguments>();
  args->common.time_limit_s = 60;
  app.add_option("manifest", args->manifest)->required();
  CLI::Option* presets = app.add_option("--presets", args->presets,
                                        "default, paper, baseline-gpu; +x, -x, paper-x, x@64MiB")
                             ->delimiter(',');
  app.add_option("--filter", args->choice.filter);
  app.add_option("--max-faces", args->choice.max_faces);
  app.add_option("--repeat", args->repeat)->check(CLI::PositiveNumber);
  app.add_option("--tol", args->common.tolerance);
  app.add_option("--device", args->device);
  app.add_option("--disable", args->common.engine.disabled, "in every preset")->delimiter(',');
  app.add_option("--enable", args->common.engine.enabled, "in every preset")->delimiter(',');
  app.add_flag("--plain", args->plain, "nothing certified: what the certificate costs");
  app.add_flag("--not-robust", args->not_robust, "without robustBufferAccess: what it costs");
  app.add_flag("--not-mapped", args->not_mapped, "meshes copied from the host: what that costs");
  app.add_option("--memory", args->memory);
  app.add_option("--time", args->common.time_limit_s);
  app.add_option("--together", args->together, "pairs side by side, and each alone")
      ->check(CLI::PositiveNumber)
      ->excludes(presets);
  app.add_option("--sort-from", args->common.engine.sort_from, "smaller frontiers are not sorted");
  return [args] { return run(*args); };
}

}  // namespace vkh::bench
