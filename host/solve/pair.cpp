#include "host/solve/pair.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "host/base/rounding.h"
#include "host/solve/switches.h"

namespace vkh {
namespace {

// Without low parts, a sample that is no vertex of A is queried at its position rounded to float32,
// up to sqrt(3) 2^-24 off: by so much the lower bound that steers the run can be above the one that
// is certified in the end.
constexpr double kRoundedPosition = 1.1e-7;
// Tolerances from here on can afford that.
constexpr double kPlainTolerance = 8 * kRoundedPosition;
// With low parts the position is exact enough, but the closest point on a triangle is computed from
// float32 barycentrics, of 24 bits, which misplaces it by as much. A tight tolerance gives up at
// most this share of itself for that.
constexpr double kMostForWeights = 0.1;
// The share of the tolerance that is kept for rounding it and the sum of it and the lower bound to
// float32.
constexpr double kKept = 1e-4;
// 48-bit arithmetic in a frame of order 1 leaves less than this (3.9e-11 seen, where faces of A and
// B are as large as the frame); asking for less would refine noise.
constexpr double kToleranceFloor = 6e-11;

// The limit in the frame, so that what the device proves of the stored meshes holds in the files'
// units: to_files() subtracts, or adds, the displacement by storing. A limit for which no float is
// left is replaced by the smallest float, within which no distance is.
float limit_in_frame(const Pair& pair, double within) {
  if (!(within > 0)) return 0;
  const double inner = pair.frame.to_frame(within) - pair.displacement;
  auto least = static_cast<float>(std::clamp(inner, 0.0, 1e30));
  for (int ulp = 0; ulp < 2; ++ulp) least = std::nextafter(least, 0.0f);
  return std::max(least, std::numeric_limits<float>::min());
}
float limit_up_in_frame(const Pair& pair, double beyond) {
  if (!(beyond > 0)) return 0;
  auto most =
      static_cast<float>(std::clamp(pair.frame.to_frame(beyond) + pair.displacement, 0.0, 1e30));
  for (int ulp = 0; ulp < 2; ++ulp) most = std::nextafter(most, std::numeric_limits<float>::max());
  return std::max(most, 2 * std::numeric_limits<float>::min());
}

// Rounds down: the known bound must not become larger.
float known_in_frame(const Pair& pair, double known_lower) {
  const double known = std::clamp(pair.frame.to_frame(known_lower), 0.0, 1e30);
  return known > 0 ? std::nextafter(static_cast<float>(known), 0.0f) : 0.0f;
}

// `pair` lives as long as the run.
std::function<float()> known_since(const Pair& pair) {
  if (!pair.known_since) return {};
  return [&pair] { return known_in_frame(pair, pair.known_since()); };
}

}  // namespace

// B's frame is B's alone, so that the answer does not depend on the A's before. B fills it; an A
// up to four times as far out costs two of the 48 bits. A farther A would still get a true
// interval, but not within the tolerance, so it gets a frame around both meshes. A single point has
// no size to choose a frame by.
bool serves(const Frame& frame_of_b, const Box& box_b, const Box& box_a) {
  const double extent = frame_of_b.extent(join(box_a, box_b));
  return extent >= 0.5 && extent <= 4;
}

FileInterval to_files(const VkhReport& r, const Pair& pair) {
  const double base = static_cast<double>(r.base);
  const double lower = add_down(base, static_cast<double>(r.lowerAbove));
  const double upper = add_up(base, static_cast<double>(r.upperAbove));
  const double farthest = farthest_in(pair.joint, add_up(pair.a.delta, pair.b.delta));
  return pair.frame.to_files(lower, upper, pair.displacement, farthest);
}

// Sets how finely the device has to work. Its errors are relative to the coordinates, which a
// prepared B's frame lets exceed 1.
RunInput input_for(const Pair& pair, uint32_t switches, double tolerance_given) {
  const SolveOptions& options = pair.options;
  const double size = std::max(1.0, pair.frame.extent(pair.joint));
  const double tolerance = pair.frame.to_frame(tolerance_given);
  const bool two_float = pair.has_low || tolerance < kPlainTolerance * size;
  const double floor = kToleranceFloor * size;
  const double weights = std::min(kRoundedPosition * size, kMostForWeights * tolerance);
  const double spare = tolerance * (1 - kKept) - 2 * pair.displacement -
                       (two_float ? floor + weights : kRoundedPosition * size);
  VkhRunOptions asked{};
  asked.cullTolerance = static_cast<float>(std::clamp(spare, floor, 1e30));
  asked.knownLower = known_in_frame(pair, options.known_lower);
  asked.limit = limit_in_frame(pair, options.limit.within);
  asked.limitUp = limit_up_in_frame(pair, options.limit.beyond);
  asked.sortFrom = options.engine.sort_from;
  asked.twoFloat = two_float ? VK_TRUE : VK_FALSE;
  return {.a = {&pair.a, &pair.stored_a},
          .b = {&pair.b, pair.stored_b},
          .resident = pair.resident,
          .switches = switches & ~kSwitchMultiwave,
          .memory_bytes = options.memory_bytes,
          .start_memory_bytes = options.engine.start_memory_bytes,
          .wave_limit = options.wave_limit,
          .multiwave = (switches & kSwitchMultiwave) != 0,
          .options = asked,
          .stage_times = options.engine.stage_times,
          .coverage = options.engine.coverage,
          .advanced = {},
          .known_since = known_since(pair),
          .kept = pair.kept};
}

namespace {

constexpr double kCoarse = 1e-6;  // a fraction of A's diagonal: the precision of plain floats

// Returns whether a run ended within its own tolerance of its lower bound, or of a known one, but
// not within the report's tolerance.
bool is_too_coarse(const Report& r) {
  return (r.status == Status::kClosed && !is_within(r.lower, r.upper, r.tolerance)) ||
         (r.status == Status::kPruned && !is_within(r.known_lower, r.upper, r.tolerance));
}

}  // namespace

void narrow(Report& r, const Report& other) {
  if (other.lower > r.lower && other.has_witness) {
    r.lower = other.lower;
    r.witness_a = other.witness_a;
    r.witness_b = other.witness_b;
    r.has_witness = true;
  }
  r.upper = std::min(r.upper, other.upper);
  r.waves += other.waves;
  r.candidates += other.candidates;
  r.queries += other.queries;
  r.peak_frontier = std::max(r.peak_frontier, other.peak_frontier);
  r.times.upload_ms += other.times.upload_ms;
  r.times.hierarchy_ms += other.times.hierarchy_ms;
  r.times.solve_ms += other.times.solve_ms;
}

double tolerance_of(const Pair& pair) {
  return pair.options.tolerance_is_absolute
             ? pair.options.tolerance
             : multiply_down(pair.options.tolerance,
                             Diagonal(diagonal(pair.box_a), pair.a.delta).least());
}

Pair coarser(const Pair& pair) {
  Pair coarse = pair;
  SolveOptions& options = coarse.options;
  if (!(options.limit.within > 0)) return coarse;
  const double unit = options.tolerance_is_absolute ? diagonal(pair.box_a) : 1;
  options.tolerance = std::max(options.tolerance, kCoarse * unit);
  options.engine.fine = options.engine.fine || pair.options.tolerance < kFineTolerance * unit;
  return coarse;
}

bool asks_for_more(Report& r, const Pair& first, const Pair& pair) {
  if (!(first.options.tolerance > pair.options.tolerance)) return false;
  const bool is_known = is_decided(r.lower, r.upper, r.limit);
  r.tolerance = tolerance_of(pair);
  if (is_too_coarse(r)) r.status = is_known ? Status::kLimit : Status::kPrecision;
  return !is_known && (r.status == Status::kClosed || r.status == Status::kPrecision);
}

}  // namespace vkh
