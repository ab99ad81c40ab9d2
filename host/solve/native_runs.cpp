#include "host/solve/native_runs.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <deque>
#include <iterator>

#include "host/base/parallel.h"
#include "host/base/system.h"
#include "host/native/cells.h"
#include "host/native/closest.h"
#include "host/native/native.h"
#include "host/solve/coverage.h"
#include "host/solve/native_cells.h"
#include "host/solve/run_report.h"
#include "vkhausdorff/error.h"

namespace vkh {
namespace {

/// Ends a native run as its options say, and remembers why.
struct NativeWatch {
  const SolveOptions& options;
  size_t number;
  std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
  Status ended = Status::kCancelled;

  double elapsed_s() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }

  bool operator()(const native::NativeProgress& now) {
    const bool is_wanted = !options.progress || options.progress(progress_of(now));
    const bool has_time = elapsed_s() <= options.time_limit_s;
    ended = is_wanted ? Status::kTime : Status::kCancelled;
    return is_wanted && has_time;
  }

  Progress progress_of(const native::NativeProgress& now) const {
    return {.wave = now.levels,
            .candidates = now.open,
            .lower = now.lower,
            .upper = now.upper,
            .gap = gap_of(now.lower, now.upper, now.diagonal_a),
            .pair = number};
  }
};

native::NativeOptions native_options(const SolveOptions& options, size_t threads) {
  native::NativeOptions out{.tolerance = options.tolerance,
                            .tolerance_is_absolute = options.tolerance_is_absolute,
                            .known_lower = options.known_lower,
                            .limit = options.limit,
                            .level_limit = options.wave_limit,
                            .threads = threads,
                            .coverage = options.engine.coverage};
  if (options.memory_bytes != 0) out.memory_bytes = options.memory_bytes;
  return out;
}

size_t memory_of(const SolveOptions& options) {
  return options.memory_bytes != 0 ? options.memory_bytes : native::NativeOptions().memory_bytes;
}

size_t threads_of(const NativeProcessor& processor) {
  return processor.threads != 0 ? processor.threads : thread_count();
}

/// The most cells, since their places are words.
constexpr size_t kMostCells = size_t{1} << 31;

void fill_counts(const native::NativeReport& r, Report& out) {
  constexpr const char* kNames[] = {"exact", "u1", "u2", "ha", "u3", "lower_raised", "precision"};
  static_assert(std::size(kNames) == std::tuple_size_v<decltype(r.closed)>);
  out.waves = r.levels;
  out.candidates = r.candidates;
  out.queries = r.queries;
  out.peak_frontier = r.peak_candidates;
  out.workspace_bytes = r.peak_bytes;
  for (size_t i = 0; i < r.closed.size(); ++i) out.culled.push_back({kNames[i], r.closed[i]});
}

Status status_of(const native::NativeReport& r, const Report& out, Status ended) {
  if (const std::optional<Status> reached = reached_by(out)) return *reached;
  switch (r.status) {
    case native::NativeStatus::kStopped:
      return ended;
    case native::NativeStatus::kLevels:
      return Status::kWaves;
    case native::NativeStatus::kMemory:
      return Status::kMemory;
    default:
      return Status::kPrecision;
  }
}

}  // namespace

DeviceDescription describe(const NativeProcessor& processor) {
  const size_t threads = threads_of(processor);
  DeviceDescription d;
  d.name = "native, " + processor_name() + ", " + std::to_string(threads) +
           (threads == 1 ? " thread" : " threads");
  d.type = kNative;
  d.usable = true;
  return d;
}

void refuse_natively(const std::string& what) {
  throw UsageError("the native solver does not have everything: " + what +
                   " needs a Vulkan device");
}

void check_native(const EngineOptions& options) {
  const bool has_preset = !options.preset.empty() && options.preset != "default";
  if (has_preset || !options.enabled.empty() || !options.disabled.empty() || !options.certified)
    refuse_natively("another preset or switch");
}

namespace {

/// Pairs whose A's cells can be bounded; they stay where they are.
struct HeldNatively {
  std::deque<native::PlacedPair> pairs;
  std::deque<NativeCells> cells;

  SurveyedPair add(const PairView& view, const SolveOptions& options, size_t threads) {
    const Mesh &a = view.a, &b = view.b;
    const native::PlacedPair& pair = pairs.emplace_back(a, b);
    const size_t most = memory_of(options) / NativeCells::kBytesOfCell;
    NativeCells& own = cells.emplace_back(pair, a, threads, std::min(most, kMostCells));
    return {.a = a,
            .b = b,
            .frame = pair.frame(),
            .displacement = pair.displacement(),
            .farthest = pair.farthest(),
            .on_cpu = true,
            .bound = [&own](const CellBatch& batch) { own.bound(batch); },
            .cells = &own};
  }
};

}  // namespace

namespace {

/// Each takes microseconds.
constexpr size_t kPointsOfPiece = 64;

LaidB laid(const Mesh& b, const Frame& frame, size_t threads,
           std::shared_ptr<const native::PlacedMesh> placed) {
  const auto find = [placed, threads](const PointBatch& batch) {
    const size_t count = batch.points.size();
    for_each_index((count + kPointsOfPiece - 1) / kPointsOfPiece,
                   [&](size_t piece) {
                     const size_t begin = piece * kPointsOfPiece;
                     for (size_t i = begin; i < std::min(begin + kPointsOfPiece, count); ++i)
                       batch.found[i] = placed->closest(batch.points[i]);
                   },
                   threads);
  };
  return {.mesh = b, .frame = frame, .displacement = placed->displacement(), .find = find};
}

}  // namespace

KeptMesh NativeRuns::kept(Mesh b) const {
  const Frame frame = frame_mesh(b).frame;
  KeptMesh kept{.mesh = std::move(b), .box = {}, .frame = frame, .resident = {}, .placed = {}};
  kept.box = bounding_box(kept.mesh);
  kept.placed = std::make_shared<const native::PlacedMesh>(kept.mesh, frame);
  return kept;
}

ClosestPoints NativeRuns::closest(const KeptMesh& b, const ClosestQuestion& question) const {
  const size_t threads = threads_of(processor_);
  const LayB lay = [&](const Frame& frame) {
    return laid(b.mesh, frame, threads, std::make_shared<const native::PlacedMesh>(b.mesh, frame));
  };
  return find_closest_points(laid(b.mesh, b.frame, threads, b.placed), lay, question);
}

void NativeRuns::hold(std::span<const PairView> pairs, const std::vector<SolveOptions>& options,
                      const UsePairs& use) const {
  HeldNatively held;
  std::vector<SurveyedPair> surveyed;
  for (size_t i = 0; i < pairs.size(); ++i) {
    check_native(options[i].engine);
    check_mesh(pairs[i].a);
    check_mesh(pairs[i].b);
    surveyed.push_back(held.add(pairs[i], options[i], threads_of(processor_)));
    const Progress progress{.upper = surveyed[i].farthest, .pair = i};
    if (options[i].progress && !options[i].progress(progress)) return;
  }
  use(surveyed);
}

std::vector<Report> NativeRuns::distances(std::span<const PairView> pairs,
                                          const std::vector<SolveOptions>& options) const {
  std::vector<Report> reports;
  for (size_t i = 0; i < pairs.size(); ++i) {
    check_native(options[i].engine);
    reports.push_back(distance(pairs[i], options[i], i));
  }
  return reports;
}

Report NativeRuns::distance(const PairView& pair, const SolveOptions& options,
                            size_t number) const {
  const Mesh &a = pair.a, &b = pair.b;
  NativeWatch watch{.options = options, .number = number};
  native::NativeOptions asked = native_options(options, processor_.threads);
  asked.goes_on = [&watch](const native::NativeProgress& now) { return watch(now); };
  const native::NativeReport found = native::run_pair(a, b, asked);
  Report out = report_on(a, b, options);
  out.diagonal_a = found.diagonal_a;
  out.tolerance = found.tolerance;
  out.lower = found.lower;
  out.upper = found.upper;
  // Even a face of A that is a face of B may have a bound of 1e-14.
  if (out.lower == 0 && out.upper > 0 && is_within_faces_of(a, b)) out.upper = 0;
  out.status = status_of(found, out, watch.ended);
  out.device = description_;
  fill_counts(found, out);
  if (options.engine.coverage)
    out.coverage_check = check_coverage(found.areas, native::kWholeArea, found.levels > 0);
  if (found.has_witness) {
    const auto& [u, v, w] = found.witness.barycentric;
    fill_witness({found.witness.face_a, found.witness.face_b, {u, v, w}}, a, b, out);
  }
  out.times.solve_ms = out.times.wall_ms = 1000 * watch.elapsed_s();
  return out;
}

}  // namespace vkh
