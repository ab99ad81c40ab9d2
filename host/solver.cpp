#include "host/solver.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>

#include "host/closest.h"
#include "host/error.h"
#include "host/frame.h"
#include "host/run.h"
#include "host/verify.h"

namespace vkh {
namespace {

constexpr std::pair<const char*, uint32_t> kSwitches[] = {
    {"centroid", VKH_SWITCH_CENTROID},
    {"parent_samples", VKH_SWITCH_PARENT_SAMPLES},
    {"tolerance_cull", VKH_SWITCH_TOLERANCE_CULL},
    {"thin", VKH_SWITCH_THIN},
    {"u3", VKH_SWITCH_PAIRS},
    {"u4", VKH_SWITCH_U4},
    {"warm_start", VKH_SWITCH_WARM_START}};

// Without low parts, a sample that is no vertex of A is queried at its position rounded to float32,
// up to sqrt(3) 2^-24 off: by so much the lower bound that steers the run can be above the one that
// is certified in the end.
constexpr double kRoundedPosition = 1.1e-7;
// Tolerances from here on can afford that.
constexpr double kPlainTolerance = 8 * kRoundedPosition;
// Of the tolerance, kept for rounding it and the sum of it and the lower bound to float32.
constexpr double kKept = 1e-4;
// 48-bit arithmetic in a frame of order 1 leaves less than this (3.9e-11 seen, where faces of A and
// B are as large as the frame); asking for less would refine noise.
constexpr double kToleranceFloor = 6e-11;

using Clock = std::chrono::steady_clock;
double ms_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

uint32_t switch_bit(const std::string& name) {
  for (const auto& [known, bit] : kSwitches) {
    if (name == known) return bit;
  }
  throw UsageError("no switch is called '" + name + "'");
}

uint32_t switches_of(const SolveOptions& options) {
  uint32_t on = VKH_SWITCH_DEFAULT;
  for (const std::string& name : options.enabled) on |= switch_bit(name);
  for (const std::string& name : options.disabled) on &= ~switch_bit(name);
  if (options.coverage) on |= VKH_SWITCH_COVERAGE;
  return on;
}

FileInterval to_files(const VkhReport& r, const Frame& frame, double joint_diagonal) {
  const double infinity = std::numeric_limits<double>::infinity();
  // Sums of two floats: exact in double, or off by half an ulp, which nextafter covers.
  const double lower =
      std::nextafter(static_cast<double>(r.base) + static_cast<double>(r.lowerAbove), -infinity);
  const double upper =
      std::nextafter(static_cast<double>(r.base) + static_cast<double>(r.upperAbove), infinity);
  return frame.to_files(lower, upper, joint_diagonal);
}

double joint_diagonal(const Mesh& a, const Mesh& b) {
  Box x = bounding_box(a);
  const Box y = bounding_box(b);
  for (int i = 0; i < 3; ++i) {
    x.lo[i] = std::min(x.lo[i], y.lo[i]);
    x.hi[i] = std::max(x.hi[i], y.hi[i]);
  }
  return diagonal(x);
}

Status status_of(const VkhReport& r, bool closed) {
  if (closed) return Status::kClosed;
  return r.status == VKH_STATUS_MEMORY ? Status::kMemory : Status::kPrecision;
}

void fill_counts(const VkhReport& r, const Frame& frame, Report& out) {
  out.waves = r.waves;
  out.candidates = r.candidateTotal;
  out.queries = r.queryTotal;
  out.peak_frontier = r.peakFrontier;
  const uint32_t* c = r.culled;
  out.culled = {c[0], c[1], c[2], c[3], c[4], c[5], c[6], c[7]};
  // The plan after a wave records it.
  const uint32_t recorded = r.status == VKH_STATUS_RUNNING ? r.waves - 1 : r.waves;
  const uint32_t first = recorded > VKH_MAX_WAVE_RECORDS ? recorded - VKH_MAX_WAVE_RECORDS : 0;
  for (uint32_t w = first; w < recorded; ++w) {
    const VkhWaveRecord& rec = r.waveRecords[w % VKH_MAX_WAVE_RECORDS];
    out.wave_stats.push_back({w, rec.parents, rec.candidates, rec.queries, rec.survivors,
                              rec.deferred, frame.length_down(static_cast<double>(rec.lower)),
                              frame.length_up(static_cast<double>(rec.upper))});
  }
}

void fill_stages(const RunOutput& run, Report& out) {
  for (const StageTime& s : run.stages) {
    auto at = std::find_if(out.stages.begin(), out.stages.end(),
                           [&](const StageStats& x) { return x.name == s.name; });
    if (at == out.stages.end())
      at = out.stages.insert(out.stages.end(), StageStats{s.name, 0, 0, 0, 0});
    at->gpu_ms += s.ms;
    ++at->dispatches;
    const bool building = at->name == "morton" || at->name == "sort" || at->name == "hierarchy";
    (building ? out.times.hierarchy_ms : out.times.solve_ms) += s.ms;
  }
}

void fill_witness(const VkhReport& r, const Mesh& a, const Mesh& b, Report& out) {
  if (r.witnessFaceA >= a.faces.size() || r.witnessFaceB >= b.faces.size()) return;
  const double one = 1 << 20;
  const double v = r.witnessBarycentric[0] / one;
  const double w = r.witnessBarycentric[1] / one;
  const glm::uvec3 fa = a.faces[r.witnessFaceA];
  const glm::dvec3 p = (1 - v - w) * a.vertices[fa.x] + v * a.vertices[fa.y] + w * a.vertices[fa.z];
  out.witness_a = {r.witnessFaceA, {1 - v - w, v, w}, p};
  const glm::uvec3 fb = b.faces[r.witnessFaceB];
  const ClosestPoint q = closest_point(p, b.vertices[fb.x], b.vertices[fb.y], b.vertices[fb.z]);
  out.witness_b = {r.witnessFaceB, q.barycentric, q.point};
}

}  // namespace

std::vector<std::string> switch_names() {
  std::vector<std::string> names;
  for (const auto& [name, bit] : kSwitches) names.emplace_back(name);
  return names;
}

struct Solver::Impl {
  explicit Impl(Device& d) : device(d), runner(d) {}
  Device& device;
  Runner runner;
};

Solver::Solver(Device& device) : impl_(std::make_unique<Impl>(device)) {}
Solver::~Solver() = default;

namespace {

// Watches the budgets between submissions and tells the caller how far the run is.
struct Watch {
  const SolveOptions& options;
  const Frame& frame;
  double diagonal_a, joint;
  Clock::time_point start;
  Status ended = Status::kClosed;

  bool operator()(const VkhReport& r) {
    if (r.status != VKH_STATUS_RUNNING) return false;
    const FileInterval now = to_files(r, frame, joint);
    const double gap =
        diagonal_a > 0 ? (now.upper - now.lower) / diagonal_a : now.upper - now.lower;
    if (options.progress && !options.progress({r.waves, r.remaining, now.lower, now.upper, gap})) {
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
};

}  // namespace

Report Solver::distance(const Mesh& a, const Mesh& b, const SolveOptions& options) {
  const auto start = Clock::now();
  if (!(options.tolerance > 0) || !std::isfinite(options.tolerance))
    throw UsageError("the tolerance must be positive and finite");
  const uint32_t switches = switches_of(options);
  const Frame frame = make_frame(a, b);
  Report out;
  out.diagonal_a = diagonal(bounding_box(a));
  out.tolerance =
      options.tolerance_is_absolute ? options.tolerance : options.tolerance * out.diagonal_a;
  const double joint = joint_diagonal(a, b);
  const double tolerance = frame.to_frame(out.tolerance);
  const bool two_float = frame.has_low || tolerance < kPlainTolerance;
  const double spare = tolerance * (1 - kKept) - 2 * frame.displacement() -
                       (two_float ? kToleranceFloor : kRoundedPosition);
  RunInput in{.frame = &frame,
              .a = &a,
              .b = &b,
              .switches = switches,
              .memory_bytes = options.memory_bytes,
              .wave_limit = options.wave_limit,
              .cull_tolerance = static_cast<float>(std::clamp(spare, kToleranceFloor, 1e30)),
              .two_float = two_float,
              .coverage = options.coverage,
              .advanced = {}};
  Watch watch{options, frame, out.diagonal_a, joint, start};
  in.advanced = [&](const VkhReport& r) { return watch(r); };
  const double framed_ms = ms_since(start);
  const RunOutput run = impl_->runner.run(in);

  const FileInterval interval = to_files(run.report, frame, joint);
  out.lower = interval.lower;
  out.upper = interval.upper;
  const bool closed = out.upper - out.lower <= out.tolerance;
  const bool budget = run.report.status == VKH_STATUS_RUNNING && watch.ended != Status::kClosed;
  out.status = budget && !closed ? watch.ended : status_of(run.report, closed);
  out.device = impl_->device.description();
  out.mesh_a = a.counts;
  out.mesh_b = b.counts;
  out.workspace_bytes = run.workspace_bytes;
  for (const auto& [name, bit] : kSwitches) {
    if ((switches & bit) == 0) out.switched_off.emplace_back(name);
  }
  fill_counts(run.report, frame, out);
  fill_stages(run, out);
  fill_witness(run.report, a, b, out);
  // Before every face of A has a bound, `upper` says so: 3e38.
  if (options.coverage) out.coverage_check = check_coverage(run.areas, run.report.upper < 3e38f);
  out.times.upload_ms = framed_ms + run.upload_ms;
  out.times.wall_ms = ms_since(start);
  return out;
}

}  // namespace vkh
