#include "vkhausdorff/solver.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "host/base/float_environment.h"
#include "host/base/parallel.h"
#include "host/base/rounding.h"
#include "host/solve/closest_search.h"
#include "host/solve/coverage.h"
#include "host/solve/held_pairs.h"
#include "host/solve/native_runs.h"
#include "host/solve/pair.h"
#include "host/solve/run.h"
#include "host/solve/run_report.h"
#include "host/solve/switches.h"
#include "host/solve/way_back.h"
#include "vkhausdorff/error.h"
#include "vkhausdorff/frame.h"

namespace vkh {
namespace {

using Clock = std::chrono::steady_clock;
double ms_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

// Whether the device found the stored meshes' h to be 0, so that at most the displacement by
// storing is left.
bool is_surely_zero(const VkhReport& r, const Pair& pair) {
  const bool is_zero_as_stored = r.base == 0 && r.upperAbove == 0 && pair.displacement > 0;
  return is_zero_as_stored && is_within_faces_of(pair.a, pair.b);
}

Status status_of(const VkhReport& r, const Report& out, Status ended) {
  if (const std::optional<Status> reached = reached_by(out)) return *reached;
  if (r.status == VKH_STATUS_RUNNING && ended != Status::kClosed) return ended;
  return r.status == VKH_STATUS_MEMORY ? Status::kMemory : Status::kPrecision;
}

struct Framed;

}  // namespace

struct Solver::Impl {
  Impl(Device& d, std::shared_ptr<Contexts> all)
      : device(d), contexts(std::move(all)), runner(d, contexts) {}
  std::vector<Report> distances(std::span<const PairView> meshes,
                                const std::vector<SolveOptions>& options,
                                const std::function<double()>& known_since = {});
  std::vector<Framed> framed(std::span<const PairView> meshes) const;
  void hold(std::span<const PairView> meshes, const std::vector<SolveOptions>& options,
            const UsePairs& use);
  std::vector<Report> solve_with_switches(const std::vector<Pair>& pairs, uint32_t switches,
                                          Clock::time_point start);
  std::vector<Report> solve(const std::vector<Pair>& pairs, Clock::time_point start);
  Device& device;
  const std::shared_ptr<Contexts> contexts;
  Runner runner;
};

Solver::Solver(Device& device, const std::filesystem::path& cache_folder) {
  const FloatEnvironment ours;
  impl_ = std::make_unique<Impl>(device, std::make_shared<Contexts>(device, cache_folder));
}
Solver::Solver(SharesPipelines, const Solver& other) {
  const FloatEnvironment ours;
  if (other.native_ != nullptr) {
    native_ = std::make_unique<const NativeRuns>(*other.native_);
  } else {
    impl_ = std::make_unique<Impl>(other.impl_->device, other.impl_->contexts);
  }
}
Solver::Solver(const NativeProcessor& processor)
    : native_(std::make_unique<const NativeRuns>(processor)) {}
Solver::~Solver() = default;

Solver::Impl& Solver::on_device() const {
  if (native_ != nullptr) refuse_natively("what is asked for");
  return *impl_;
}
const Device& Solver::device() const { return on_device().device; }
const DeviceDescription& Solver::description() const {
  return native_ != nullptr ? native_->description() : impl_->device.description();
}

std::vector<Report> Solver::run(std::span<const PairView> pairs,
                                const std::vector<SolveOptions>& options,
                                const std::function<double()>& known_since) {
  if (native_ == nullptr) return impl_->distances(pairs, options, known_since);
  if (known_since) refuse_natively("a run over several devices");
  return native_->distances(pairs, options);
}

struct PreparedMesh::Impl : KeptMesh {};

PreparedMesh::PreparedMesh(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
PreparedMesh::PreparedMesh(PreparedMesh&&) noexcept = default;
PreparedMesh& PreparedMesh::operator=(PreparedMesh&&) noexcept = default;
PreparedMesh::~PreparedMesh() = default;
const Mesh& PreparedMesh::mesh() const { return impl_->mesh; }

namespace {

// Watches the budgets between submissions and reports to the caller how far the run is.
struct Watch {
  const Pair& pair;
  double diagonal_a;
  Clock::time_point start;
  Status ended = Status::kClosed;

  bool operator()(const VkhReport& r) {
    const SolveOptions& options = pair.options;
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
            .pair = pair.number};
  }
};

SurveyedPair surveyed(const Pair& pair, const HeldPair& held, bool on_cpu) {
  return {.a = pair.a,
          .b = pair.b,
          .frame = pair.frame,
          .displacement = pair.displacement,
          .farthest = to_files(held.report, pair).upper,
          .on_cpu = on_cpu,
          .bound = held.bound,
          .cells = held.cells.get()};
}

Report report_of(const RunOutput& run, const Watch& watch) {
  if (run.report.status == VKH_STATUS_INPUT)  // cannot happen after check_mesh and the frame
    throw InputError("the device says that a mesh is none (VKH_STATUS_INPUT)");
  const Pair& pair = watch.pair;
  const SolveOptions& options = pair.options;
  Report out = report_on(pair.a, pair.b, options);
  out.diagonal_a = watch.diagonal_a;
  out.tolerance = tolerance_of(pair);
  const FileInterval bounds = to_files(run.report, pair);
  out.lower = bounds.lower;
  out.upper = is_surely_zero(run.report, pair) ? 0 : bounds.upper;
  out.status = status_of(run.report, out, watch.ended);
  out.workspace_bytes = run.workspace_bytes;
  out.host_memory_bytes = run.host_memory_bytes;
  out.preset = options.engine.preset.empty() ? "default" : options.engine.preset;
  fill_counts(run, pair.frame, out);
  fill_stages(run, out);
  fill_witness(run.report, pair.a, pair.b, out);
  // Before every face of A has a bound, `upper` is 3e38.
  if (options.engine.coverage)
    out.coverage_check = check_coverage(run.areas, kDeviceArea, run.report.upper < 3e38f);
  return out;
}

void check_options(const SolveOptions& options) {
  if (!(options.tolerance > 0) || !std::isfinite(options.tolerance))
    throw UsageError("the tolerance must be positive and finite");
  if (!(options.known_lower >= 0)) throw UsageError("the known lower bound must be 0 or more");
  const bool has_order = options.limit.within >= 0 && options.limit.within <= options.limit.beyond;
  if (!has_order || !std::isfinite(options.limit.beyond))
    throw UsageError("the limit must be 0 or more and finite");
}

// Runs the caller's callbacks in the caller's own floating-point environment.
SolveOptions in_callers_environment(SolveOptions options, FloatEnvironment& ours) {
  if (!options.progress) return options;
  options.progress = [&ours, listen = std::move(options.progress)](const Progress& progress) {
    return ours.outside([&] { return listen(progress); });
  };
  return options;
}

ClosestGoesOn in_callers_environment(const ClosestGoesOn& goes_on, FloatEnvironment& ours) {
  if (!goes_on) return {};
  return [&ours, goes_on](size_t done) { return ours.outside([&] { return goes_on(done); }); };
}

}  // namespace

// `pairs` have the same pipelines.
std::vector<Report> Solver::Impl::solve_with_switches(const std::vector<Pair>& pairs,
                                                      uint32_t switches, Clock::time_point start) {
  std::vector<Watch> watches;
  std::vector<RunInput> inputs;
  watches.reserve(pairs.size());  // inputs refer to them
  for (const Pair& pair : pairs) {
    watches.push_back({.pair = pair, .diagonal_a = diagonal(pair.box_a), .start = start});
    inputs.push_back(input_for(pair, switches, tolerance_of(pair)));
    inputs.back().advanced = [&watch = watches.back()](const VkhReport& r) { return watch(r); };
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

// Pairs with the same switches run side by side. A pair's switches depend on that pair alone, so
// that an answer does not depend on the pairs beside it.
std::vector<Report> Solver::Impl::solve(const std::vector<Pair>& pairs, Clock::time_point start) {
  std::map<uint32_t, std::vector<size_t>> alike;
  for (size_t i = 0; i < pairs.size(); ++i)
    alike[switches_for(pairs[i].options, diagonal(pairs[i].box_a), device)].push_back(i);
  std::vector<Report> reports(pairs.size());
  for (const auto& [switches, numbers] : alike) {
    std::vector<Pair> some;
    for (const size_t i : numbers) some.push_back(pairs[i]);
    std::vector<Report> found = solve_with_switches(some, switches, start);
    for (size_t i = 0; i < numbers.size(); ++i) reports[numbers[i]] = std::move(found[i]);
  }
  return reports;
}

void Solver::make_ready(const EngineOptions& options) {
  const FloatEnvironment ours;
  if (native_ != nullptr) return check_native(options);
  impl_->contexts->get(switches_of(options, impl_->device) & ~kSwitchMultiwave);
}

namespace {

// The frame that came with the pair, or that an earlier call left.
const FramedPair* known_frame(const PairView& m) {
  return m.kept != nullptr && *m.kept != nullptr ? m.kept->get() : m.framed;
}

// Checks each mesh once: many pairs may have one B. A prepared mesh was checked when it was
// prepared, and the meshes of a framed pair before.
void check_meshes(std::span<const PairView> pairs) {
  std::set<const Mesh*> meshes;
  for (const PairView& pair : pairs) {
    if (known_frame(pair) != nullptr) continue;
    meshes.insert(&pair.a);
    if (pair.prepared == nullptr || &pair.b != &pair.prepared->mesh()) meshes.insert(&pair.b);
  }
  const std::vector<const Mesh*> all(meshes.begin(), meshes.end());
  uint64_t bytes = 0;
  for (const Mesh* mesh : all) bytes += mesh_bytes(*mesh);
  for_each_index(
      all.size(), [&](size_t i) { check_mesh(*all[i]); }, threads_for(bytes));
}

// A caller's pair as it is stored: in a frame around both meshes, or in that of a prepared B.
struct Framed {
  KeptPair pair;
  const KeptMesh* kept = nullptr;  // B's, if it is prepared and its frame serves A
};

// Makes the frame unless it is known, and leaves it for later calls.
KeptPair shared_frame(const PairView& m, const std::function<FramedPair()>& make) {
  if (m.kept != nullptr && *m.kept != nullptr) return *m.kept;
  KeptPair made = std::make_shared<const FramedPair>(m.framed != nullptr ? *m.framed : make());
  if (m.kept != nullptr) *m.kept = made;
  return made;
}

Framed framed_alone(const PairView& m) {
  return {.pair = shared_frame(m, [&] { return frame_pair(m.a, m.b); })};
}

// Returns nothing if B's frame does not serve A. If it does, a pair that was framed before is in
// it.
std::optional<Framed> framed_by(const KeptMesh& kept, const PairView& m) {
  const FramedPair* const known = known_frame(m);
  const Box box_a = known != nullptr ? known->box_a : bounding_box(m.a);
  const bool is_in_it = known == nullptr || known->frame == kept.frame;
  if (!is_in_it || !serves(kept.frame, kept.box, box_a)) return std::nullopt;
  const auto make = [&]() -> FramedPair {
    const StoragePlan b{kept.frame, kept.has_low, kept.displacement};
    return {kept.frame, store_in(kept.frame, m.a), b, box_a, kept.box};
  };
  return Framed{.pair = shared_frame(m, make), .kept = &kept};
}

Pair pair_of(const PairView& view, const Framed& f) {
  return {.a = view.a,
          .b = f.kept != nullptr ? f.kept->mesh : view.b,
          .frame = f.pair->frame,
          .stored_a = f.pair->a,
          .stored_b = f.kept != nullptr ? nullptr : &f.pair->b,
          .resident = f.kept != nullptr ? &f.kept->resident : nullptr,
          .displacement = add_up(f.pair->a.displacement, f.pair->b.displacement),
          .has_low = f.pair->a.has_low || f.pair->b.has_low,
          .box_a = f.pair->box_a,
          .joint = join(f.pair->box_a, f.pair->box_b),
          .kept = view.kept != nullptr ? f.pair : nullptr};
}

}  // namespace

// `views` were checked.
std::vector<Framed> Solver::Impl::framed(std::span<const PairView> views) const {
  std::vector<Framed> all(views.size());
  uint64_t bytes = 0;
  for (const PairView& m : views)
    bytes += known_frame(m) != nullptr ? 0 : mesh_bytes(m.a) + mesh_bytes(m.b);
  const auto frame = [&](size_t i) {
    const PairView& m = views[i];
    std::optional<Framed> served;
    if (m.prepared != nullptr) served = framed_by(*m.prepared->impl_, m);
    all[i] = served ? std::move(*served) : framed_alone(m);
  };
  for_each_index(views.size(), frame, threads_for(bytes));
  return all;
}

std::vector<Report> Solver::Impl::distances(std::span<const PairView> views,
                                            const std::vector<SolveOptions>& options,
                                            const std::function<double()>& known_since) {
  const auto start = Clock::now();
  check_meshes(views);
  const std::vector<Framed> of_views = framed(views);
  std::vector<Pair> pairs, first;
  for (size_t i = 0; i < views.size(); ++i) {
    pairs.push_back(pair_of(views[i], of_views[i]));
    pairs[i].options = options[i];
    pairs[i].known_since = known_since;
    pairs[i].number = i;
    first.push_back(coarser(pairs[i]));
  }
  std::vector<Report> reports = solve(first, start);
  std::vector<Pair> open;
  for (size_t i = 0; i < pairs.size(); ++i) {
    if (asks_for_more(reports[i], first[i], pairs[i])) open.push_back(pairs[i]);
  }
  std::vector<Report> finer = solve(open, start);
  for (size_t i = 0; i < open.size(); ++i) {
    Report& coarse = reports[open[i].number];
    narrow(finer[i], coarse);
    coarse = std::move(finer[i]);
  }
  return reports;
}

// The kernels of cells do not depend on a run's switches: the first pair's serve all.
void Solver::Impl::hold(std::span<const PairView> views, const std::vector<SolveOptions>& options,
                        const UsePairs& use) {
  check_meshes(views);
  const std::vector<Framed> of_views = framed(views);
  std::vector<Pair> pairs;
  for (size_t i = 0; i < views.size(); ++i) {
    pairs.push_back(pair_of(views[i], of_views[i]));
    pairs[i].options = options[i];
    pairs[i].number = i;
  }
  const uint32_t switches = switches_for(pairs[0].options, diagonal(pairs[0].box_a), device);
  std::vector<Watch> watches;
  std::vector<RunInput> inputs;
  watches.reserve(pairs.size());  // inputs refer to them
  for (const Pair& pair : pairs) {
    watches.push_back({.pair = pair, .diagonal_a = diagonal(pair.box_a), .start = Clock::now()});
    inputs.push_back(input_for(pair, switches, tolerance_of(pair)));
    inputs.back().advanced = [&watch = watches.back()](const VkhReport& r) { return watch(r); };
    inputs.back().takes_begun = true;
  }
  const bool on_cpu = device.description().type == "cpu";
  runner.hold(inputs, [&](std::span<const HeldPair> held) {
    std::vector<SurveyedPair> on_device;
    for (size_t i = 0; i < held.size(); ++i)
      on_device.push_back(surveyed(pairs[i], held[i], on_cpu));
    use(on_device);
  });
}

namespace {

// The options of each pair, with its callbacks.
std::vector<SolveOptions> options_of(std::span<const PairView> pairs, const SolveOptions& options,
                                     FloatEnvironment& ours) {
  std::vector<SolveOptions> all;
  for (const PairView& pair : pairs) {
    const SolveOptions& own = pair.options != nullptr ? *pair.options : options;
    check_options(own);
    all.push_back(in_callers_environment(own, ours));
  }
  return all;
}

}  // namespace

std::vector<Report> Solver::distances(std::span<const PairView> meshes,
                                      const SolveOptions& options) {
  FloatEnvironment ours;
  check_options(options);
  return run(meshes, options_of(meshes, options, ours));
}

Report Solver::distance(const Mesh& a, const Mesh& b, const SolveOptions& options) {
  const PairView pair{.a = a, .b = b};
  return std::move(distances({&pair, 1}, options)[0]);
}

PreparedMesh Solver::prepare(Mesh b) {
  const FloatEnvironment ours;
  check_mesh(b);
  auto kept = std::make_unique<PreparedMesh::Impl>();
  if (native_ != nullptr) {
    static_cast<KeptMesh&>(*kept) = native_->kept(std::move(b));
    return PreparedMesh(std::move(kept));
  }
  kept->mesh = std::move(b);
  kept->box = bounding_box(kept->mesh);
  const FramedMesh framed = frame_mesh(kept->mesh);
  kept->frame = framed.frame;
  kept->displacement = framed.stored.displacement;
  kept->has_low = framed.stored.has_low;
  kept->resident = impl_->runner.build({&kept->mesh, &framed.stored});
  return PreparedMesh(std::move(kept));
}

ClosestPoints Solver::closest(const PreparedMesh& b, std::span<const DVec3> points,
                              const ClosestGoesOn& goes_on) {
  FloatEnvironment ours;
  const PreparedMesh::Impl& kept = *b.impl_;
  const ClosestQuestion question{points, in_callers_environment(goes_on, ours)};
  if (native_ != nullptr) return native_->closest(kept, question);
  return find_closest_points(impl_->runner,
                             {.mesh = kept.mesh,
                              .frame = kept.frame,
                              .displacement = kept.displacement,
                              .has_low = kept.has_low,
                              .resident = kept.resident},
                             question);
}

ClosestPoints Solver::closest(const Mesh& b, std::span<const DVec3> points,
                              const ClosestGoesOn& goes_on) {
  FloatEnvironment ours;
  check_mesh(b);
  const ClosestQuestion question{points, in_callers_environment(goes_on, ours)};
  if (native_ != nullptr) return native_->closest(native_->kept(b), question);
  const FramedMesh framed = frame_mesh(b);
  Runner& runner = impl_->runner;
  const ResidentMesh resident = runner.build({&b, &framed.stored});
  return find_closest_points(runner,
                             {.mesh = b,
                              .frame = framed.frame,
                              .displacement = framed.stored.displacement,
                              .has_low = framed.stored.has_low,
                              .resident = resident},
                             question);
}

bool PreparedMesh::serves(const Mesh& a) const {
  const FloatEnvironment ours;
  return vkh::serves(impl_->frame, impl_->box, bounding_box(a));
}

Report Solver::distance(const Mesh& a, const PreparedMesh& b, const SolveOptions& options) {
  const PairView pair{.a = a, .b = b.mesh(), .prepared = &b};
  return std::move(distances({&pair, 1}, options)[0]);
}

std::vector<SymmetricReport> Solver::symmetrics(std::span<const PairView> pairs,
                                                const SolveOptions& options) {
  FloatEnvironment ours;
  const auto start = Clock::now();
  check_options(options);
  const std::vector<SolveOptions> heard = options_of(pairs, options, ours);
  std::vector<SolveOptions> of_there = heard;
  for (SolveOptions& of_it : of_there) of_it.time_limit_s /= 2;
  std::vector<PairView> views(pairs.begin(), pairs.end());
  std::vector<Framed> frames;  // for both directions
  if (impl_ != nullptr) {
    check_meshes(views);
    frames = impl_->framed(views);
    for (size_t i = 0; i < views.size(); ++i) views[i].framed = frames[i].pair.get();
  }
  const double framing_ms = ms_since(start);
  std::vector<Report> there = run(views, of_there);
  for (Report& report : there) {
    report.times.upload_ms += framing_ms;
    report.times.wall_ms += framing_ms;
  }
  const double elapsed_s = ms_since(start) / 1000;
  std::vector<SymmetricReport> both(pairs.size());
  std::vector<size_t> sought;
  std::vector<PairView> back;
  std::vector<SolveOptions> of_back;
  std::vector<FramedPair> framed;
  framed.reserve(pairs.size());  // views refer to them
  for (size_t i = 0; i < pairs.size(); ++i) {
    const Mesh &a = pairs[i].a, &b = pairs[i].b;
    both[i].a_to_b = std::move(there[i]);
    const double limit = heard[i].limit.beyond;
    if (limit > 0 && both[i].a_to_b.lower > limit) {
      both[i].b_to_a = unsearched_back(a, b, both[i].a_to_b);
      continue;
    }
    sought.push_back(i);
    back.push_back({.a = b, .b = a, .kept = pairs[i].kept_back});
    const FramedPair* const known = known_frame(views[i]);
    if (known != nullptr && pairs[i].prepared == nullptr) {
      framed.push_back(known->reversed());
      back.back().framed = &framed.back();
    }
    of_back.push_back(options_back(heard[i], both[i].a_to_b, elapsed_s));
  }
  // Progress has the numbers of the caller's pairs.
  for (SolveOptions& of_it : of_back) {
    of_it.progress = [&sought, listen = std::move(of_it.progress)](Progress progress) {
      progress.pair = sought[progress.pair];
      return listen(progress);
    };
  }
  std::vector<Report> found = run(back, of_back);
  for (size_t i = 0; i < sought.size(); ++i) both[sought[i]].b_to_a = std::move(found[i]);
  return both;
}

SymmetricReport Solver::symmetric(const Mesh& a, const Mesh& b, const SolveOptions& options) {
  const PairView pair{.a = a, .b = b};
  return std::move(symmetrics({&pair, 1}, options)[0]);
}

Report distance_since(Solver& solver, const PairView& pair, const SolveOptions& options,
                      const std::function<double()>& known_since) {
  FloatEnvironment ours;
  const std::span<const PairView> alone(&pair, 1);
  const std::vector<SolveOptions> asked = options_of(alone, options, ours);
  return std::move(solver.run(alone, asked, known_since)[0]);
}

void hold_pairs(Solver& solver, std::span<const PairView> pairs, const SolveOptions& options,
                const UsePairs& use) {
  FloatEnvironment ours;
  std::vector<SolveOptions> runs = options_of(pairs, options, ours);
  for (SolveOptions& run : runs) {
    run.limit = {};
    run.known_lower = 0;
    run.wave_limit = std::numeric_limits<uint32_t>::max();
    run.time_limit_s = std::numeric_limits<double>::infinity();
    run.engine.cells = true;
  }
  if (solver.native_ != nullptr) return solver.native_->hold(pairs, runs, use);
  solver.impl_->hold(pairs, runs, use);
}

void hold_pair(Solver& solver, const PairView& pair, const SolveOptions& options,
               const UsePair& use) {
  hold_pairs(solver, {&pair, 1}, options,
             [&](std::span<const SurveyedPair> pairs) { use(pairs[0]); });
}

}  // namespace vkh
