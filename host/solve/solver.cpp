#include "host/solve/solver.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>

#include "host/base/error.h"
#include "host/base/float_environment.h"
#include "host/base/parallel.h"
#include "host/base/rounding.h"
#include "host/mesh/same_faces.h"
#include "host/run/frame.h"
#include "host/run/run.h"
#include "host/run/switches.h"
#include "host/solve/coverage.h"
#include "host/solve/pair.h"
#include "host/solve/run_report.h"

namespace vkh {
namespace {

using Clock = std::chrono::steady_clock;
double ms_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

// Where the device found the stored meshes' h to be 0, and only what storing displaced is left: is
// every face of A, as given, a face of B? Then h is 0, whatever the device did. A mesh that is off
// its exact place is not given.
bool is_surely_zero(const VkhReport& r, const Pair& pair) {
  if (r.base != 0 || r.upperAbove != 0 || !(pair.displacement > 0)) return false;
  if (pair.a.delta > 0 || pair.b.delta > 0) return false;
  try {
    return has_faces_of(pair.b, pair.a);
  } catch (const std::bad_alloc&) {
    return false;  // the answer that there is must not be lost over it
  }
}

Status status_of(const VkhReport& r, const Report& out, Status ended) {
  if (is_within(out.lower, out.upper, out.tolerance)) return Status::kClosed;
  if (out.known_lower > 0 && is_within(out.known_lower, out.upper, out.tolerance))
    return Status::kPruned;
  if (is_decided(out.lower, out.upper, out.limit)) return Status::kLimit;
  if (r.status == VKH_STATUS_RUNNING && ended != Status::kClosed) return ended;
  return r.status == VKH_STATUS_MEMORY ? Status::kMemory : Status::kPrecision;
}

}  // namespace

struct Solver::Impl {
  Impl(Device& d, const std::filesystem::path& cache) : device(d), runner(d, cache) {}
  std::vector<Report> distances(std::span<const PairView> meshes, const SolveOptions& options);
  std::vector<Report> solve(const std::vector<Pair>& pairs, const SolveOptions& options,
                            Clock::time_point start);
  std::vector<Report> solve_once(const std::vector<Pair>& pairs, const SolveOptions& options,
                                 Clock::time_point start);
  Device& device;
  Runner runner;
};

Solver::Solver(Device& device, const std::filesystem::path& cache_folder) {
  const FloatEnvironment ours;
  impl_ = std::make_unique<Impl>(device, cache_folder);
}
Solver::~Solver() = default;

struct PreparedMesh::Impl {
  Mesh mesh;
  Box box;
  Frame frame;
  double displacement = 0;
  bool has_low = false;
  ResidentMesh resident;
};

PreparedMesh::PreparedMesh(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
PreparedMesh::PreparedMesh(PreparedMesh&&) noexcept = default;
PreparedMesh& PreparedMesh::operator=(PreparedMesh&&) noexcept = default;
PreparedMesh::~PreparedMesh() = default;
const Mesh& PreparedMesh::mesh() const { return impl_->mesh; }

namespace {

// Watches the budgets between submissions and tells the caller how far the run is.
struct Watch {
  const SolveOptions& options;
  const Pair& pair;
  size_t number;  // of the pair
  double diagonal_a;
  Clock::time_point start;
  Status ended = Status::kClosed;

  double tolerance() const {
    return options.tolerance_is_absolute ? options.tolerance
                                         : multiply_down(options.tolerance, diagonal_a);
  }

  bool operator()(const VkhReport& r) {
    if (r.status != VKH_STATUS_RUNNING) return false;
    const FileInterval now = to_files(r, pair);
    if (is_decided(now.lower, now.upper, options.limit)) return false;
    if (options.progress && !options.progress(progress_of(r, now))) {
      ended = Status::kCancelled;
    } else if (ms_since(start) > 1000 * options.time_limit_s) {
      ended = Status::kTime;
    } else if (r.waves >= options.wave_limit) {
      ended = Status::kWaves;
    } else {
      return true;
    }
    return false;
  }

  Progress progress_of(const VkhReport& r, const FileInterval& now) const {
    return {.wave = r.waves,
            .candidates = r.remaining,
            .lower = now.lower,
            .upper = now.upper,
            .gap = gap_of(now.lower, now.upper, diagonal_a),
            .back = false,
            .pair = number};
  }
};

SurveyedPair surveyed(const Pair& pair, const VkhReport& report, bool on_cpu) {
  return {.a = pair.a,
          .frame = pair.frame,
          .displacement = pair.displacement,
          .farthest = to_files(report, pair).upper,
          .on_cpu = on_cpu};
}

Report report_of(const RunOutput& run, const Watch& watch) {
  const Pair& pair = watch.pair;
  const SolveOptions& options = watch.options;
  Report out;
  out.diagonal_a = watch.diagonal_a;
  out.tolerance = watch.tolerance();
  out.known_lower = options.known_lower;
  out.limit = options.limit;
  const FileInterval bounds = to_files(run.report, pair);
  out.lower = bounds.lower;
  out.upper = is_surely_zero(run.report, pair) ? 0 : bounds.upper;
  out.status = status_of(run.report, out, watch.ended);
  out.mesh_a = pair.a.counts;
  out.mesh_b = pair.b.counts;
  out.place_a = {pair.a.delta, pair.a.unit};
  out.place_b = {pair.b.delta, pair.b.unit};
  out.workspace_bytes = run.workspace_bytes;
  out.host_memory_bytes = run.host_memory_bytes;
  out.preset = options.preset.empty() ? "default" : options.preset;
  fill_counts(run.report, pair.frame, out);
  fill_stages(run, out);
  fill_witness(run.report, pair.a, pair.b, out);
  // Before every face of A has a bound, `upper` says so: 3e38.
  if (options.coverage) out.coverage_check = check_coverage(run.areas, run.report.upper < 3e38f);
  return out;
}

double most_diagonal(const std::vector<Pair>& pairs) {
  double most = 0;
  for (const Pair& pair : pairs) most = std::max(most, diagonal(pair.box_a));
  return most;
}

void check_options(const SolveOptions& options) {
  if (!(options.tolerance > 0) || !std::isfinite(options.tolerance))
    throw UsageError("the tolerance must be positive and finite");
  if (!(options.known_lower >= 0)) throw UsageError("the known lower bound must be 0 or more");
  const bool has_order = options.limit.within >= 0 && options.limit.within <= options.limit.beyond;
  if (!has_order || !std::isfinite(options.limit.beyond))
    throw UsageError("the limit must be 0 or more and finite");
}

// What the caller listens with runs in the caller's own floating-point environment.
SolveOptions heard_outside(SolveOptions options, FloatEnvironment& ours) {
  if (!options.progress) return options;
  options.progress = [&ours, listen = std::move(options.progress)](const Progress& progress) {
    return ours.outside([&] { return listen(progress); });
  };
  return options;
}

}  // namespace

std::vector<Report> Solver::Impl::solve(const std::vector<Pair>& pairs, const SolveOptions& options,
                                        Clock::time_point start) {
  const auto once = [&](const std::vector<Pair>& some, const SolveOptions& of_them) {
    return solve_once(some, of_them, start);
  };
  return options.limit.within > 0 ? decide_limits(pairs, options, once) : once(pairs, options);
}

std::vector<Report> Solver::Impl::solve_once(const std::vector<Pair>& pairs,
                                             const SolveOptions& options, Clock::time_point start) {
  const uint32_t switches = switches_for(options, most_diagonal(pairs), device);
  std::vector<Watch> watches;
  std::vector<RunInput> inputs;
  watches.reserve(pairs.size());  // inputs refer to them
  for (const Pair& pair : pairs) {
    watches.push_back({.options = options,
                       .pair = pair,
                       .number = watches.size(),
                       .diagonal_a = diagonal(pair.box_a),
                       .start = start});
    inputs.push_back(input_for(pair, options, switches, watches.back().tolerance()));
    inputs.back().advanced = [&watch = watches.back()](const VkhReport& r) { return watch(r); };
    if (options.survey) {
      const bool on_cpu = device.description().type == "cpu";
      inputs.back().survey = [&, on_cpu](const VkhReport& report, const BoundCells& bound) {
        options.survey(surveyed(pair, report, on_cpu), bound);
      };
    }
  }
  Times times;
  times.upload_ms = ms_since(start);
  const std::vector<RunOutput> runs = runner.run(inputs);
  if (!runs.empty()) times.upload_ms += runs[0].upload_ms;
  times.wall_ms = ms_since(start);

  std::vector<Report> reports;
  for (size_t i = 0; i < pairs.size(); ++i) {
    reports.push_back(report_of(runs[i], watches[i]));
    Report& out = reports.back();
    out.device = device.description();
    SwitchStates states = switch_states(switches);
    out.switched_on = std::move(states.on);
    out.switched_off = std::move(states.off);
    out.times.upload_ms = times.upload_ms;
    out.times.wall_ms = times.wall_ms;
  }
  return reports;
}

void Solver::make_ready(const SolveOptions& options) {
  const FloatEnvironment ours;
  // Of an absolute tolerance it is not known yet whether it is fine.
  impl_->runner.make_ready(switches_for(options, 0, impl_->device) & ~kSwitchMultiwave);
}

std::vector<Report> Solver::Impl::distances(std::span<const PairView> meshes,
                                            const SolveOptions& options) {
  const auto start = Clock::now();
  struct Framed {
    FramedPair pair;
    Box box_a, joint;
  };
  std::vector<Framed> framed(meshes.size());
  for_each_index(meshes.size(), [&](size_t i) {
    const auto& [a, b] = meshes[i];
    const Box box_a = bounding_box(a);
    framed[i] = {frame_pair(a, b), box_a, join(box_a, bounding_box(b))};
  });
  std::vector<Pair> pairs;
  for (size_t i = 0; i < meshes.size(); ++i) {
    const FramedPair& f = framed[i].pair;
    pairs.push_back({.a = meshes[i].a,
                     .b = meshes[i].b,
                     .frame = f.frame,
                     .stored_a = f.a,
                     .stored_b = &f.b,
                     .resident = nullptr,
                     .displacement = add_up(f.a.displacement, f.b.displacement),
                     .has_low = f.a.has_low || f.b.has_low,
                     .box_a = framed[i].box_a,
                     .joint = framed[i].joint});
  }
  return solve(pairs, options, start);
}

std::vector<Report> Solver::distances(std::span<const PairView> meshes,
                                      const SolveOptions& options) {
  FloatEnvironment ours;
  check_options(options);
  return impl_->distances(meshes, heard_outside(options, ours));
}

Report Solver::distance(const Mesh& a, const Mesh& b, const SolveOptions& options) {
  const PairView pair{a, b};
  return std::move(distances({&pair, 1}, options)[0]);
}

PreparedMesh Solver::prepare(Mesh b) {
  const FloatEnvironment ours;
  auto kept = std::make_unique<PreparedMesh::Impl>();
  kept->mesh = std::move(b);
  kept->box = bounding_box(kept->mesh);
  const FramedMesh framed = frame_mesh(kept->mesh);
  kept->frame = framed.frame;
  kept->displacement = framed.stored.displacement;
  kept->has_low = framed.stored.has_low;
  kept->resident = impl_->runner.build({&kept->mesh, &framed.stored});
  return PreparedMesh(std::move(kept));
}

// B's frame is B's alone, so that the answer does not depend on the A's before. B fills it; an A
// up to four times as far out costs two of the 48 bits. Farther ones would lose the tolerance, not
// the truth, and get a frame around both. A point has no size to choose a frame by.
bool PreparedMesh::serves(const Mesh& a) const {
  const FloatEnvironment ours;
  const double reach = impl_->frame.reach(join(bounding_box(a), impl_->box));
  return reach >= 0.5 && reach <= 4;
}

Report Solver::distance(const Mesh& a, const PreparedMesh& b, const SolveOptions& options) {
  if (!b.serves(a)) return distance(a, b.mesh(), options);
  FloatEnvironment ours;
  const auto start = Clock::now();
  check_options(options);
  const PreparedMesh::Impl& kept = *b.impl_;
  const StoredMesh stored = store_in(kept.frame, a);
  const Box box_a = bounding_box(a);
  const Pair pair{.a = a,
                  .b = kept.mesh,
                  .frame = kept.frame,
                  .stored_a = stored,
                  .stored_b = nullptr,
                  .resident = &kept.resident,
                  .displacement = add_up(stored.displacement, kept.displacement),
                  .has_low = stored.has_low || kept.has_low,
                  .box_a = box_a,
                  .joint = join(box_a, kept.box)};
  return std::move(impl_->solve({pair}, heard_outside(options, ours), start)[0]);
}

namespace {

// The way back has the way there's tolerance, which is a fraction of A's diagonal, and what is left
// of the time. Every candidate whose u is within the tolerance of the way there's lower bound can
// be closed: max(h(A,B), h(B,A)) is no smaller than that bound.
SolveOptions options_back(const SolveOptions& options, const Report& there, double elapsed_s) {
  constexpr double kLeastTime = 1e-3;  // even a spent budget buys a first, true interval
  SolveOptions back = options;
  back.tolerance = there.tolerance;  // 0 where A is one point
  back.tolerance_is_absolute = true;
  back.subroots = there.tolerance < kFineTolerance * there.diagonal_a || options.subroots;
  back.time_limit_s = std::max(options.time_limit_s - elapsed_s, kLeastTime);
  back.known_lower = std::max(options.known_lower, there.lower);
  const bool cancelled = there.status == Status::kCancelled;
  back.progress = [&options, cancelled](Progress progress) {
    progress.back = true;
    return !cancelled && (!options.progress || options.progress(progress));
  };
  return back;
}

// The way back where the way there has decided the limit: true, and nothing was sought.
Report unsought_back(const Mesh& a, const Mesh& b, const Report& there) {
  Report back;
  back.status = Status::kLimit;
  const Box box_b = bounding_box(b);
  back.upper = farthest_in(join(bounding_box(a), box_b), add_up(a.delta, b.delta));
  back.diagonal_a = diagonal(box_b);
  back.tolerance = there.tolerance;
  back.limit = there.limit;
  back.mesh_a = there.mesh_b;
  back.mesh_b = there.mesh_a;
  back.place_a = there.place_b;
  back.place_b = there.place_a;
  back.device = there.device;
  back.preset = there.preset;
  back.switched_on = there.switched_on;
  back.switched_off = there.switched_off;
  return back;
}

}  // namespace

SymmetricReport Solver::symmetric(const Mesh& a, const Mesh& b, const SolveOptions& options) {
  FloatEnvironment ours;
  const auto start = Clock::now();
  check_options(options);
  const SolveOptions heard = heard_outside(options, ours);
  const auto one = [&](const PairView& pair, const SolveOptions& of_it) {
    return std::move(impl_->distances({&pair, 1}, of_it)[0]);
  };
  SymmetricReport both;
  both.a_to_b = one({a, b}, heard);
  if (both.a_to_b.lower > options.limit.beyond && options.limit.beyond > 0) {
    both.b_to_a = unsought_back(a, b, both.a_to_b);
  } else {
    both.b_to_a = one({b, a}, options_back(heard, both.a_to_b, ms_since(start) / 1000));
  }
  return both;
}

}  // namespace vkh
