#include "host/native/native.h"

#include <algorithm>
#include <chrono>
#include <thread>

#include "host/base/float_environment.h"
#include "host/base/rounding.h"
#include "host/native/levels.h"
#include "host/native/witness.h"
#include "vkhausdorff/error.h"
#include "vkhausdorff/frame.h"
#include "vkhausdorff/length.h"

namespace vkh::native {
namespace {

using Clock = std::chrono::steady_clock;

// Rounding leaves less between the two ends than this, in a frame of order 1: some 30 kUlp of
// surfaces' slack, whose radius is under 4, on either side. Less would refine noise.
constexpr double kToleranceFloor = 0x1p-44;

constexpr std::chrono::milliseconds kBetweenAsking(20);
// A lower end for a progress report is proven at most this often, since a proof visits all of B.
constexpr std::chrono::milliseconds kBetweenProofs(100);

double tolerance_in_files(const Problem& problem, const NativeOptions& options) {
  if (options.tolerance_is_absolute) return options.tolerance;
  return multiply_down(options.tolerance,
                       Diagonal(diagonal(problem.box_a), problem.a.delta).least());
}

/// The distances, in the frame, within which candidates are closed. They are small enough that
/// to_files() of such an upper end meets what was asked.
Goal goal_of(const Problem& problem, const NativeOptions& options) {
  const Frame& frame = problem.frame;
  const double tolerance =
      frame.to_frame(tolerance_in_files(problem, options)) - 2 * problem.displacement;
  return {.tolerance = std::max(tolerance - kToleranceFloor, kToleranceFloor),
          .known_lower = frame.to_frame(options.known_lower),
          .within = add_down(frame.to_frame(options.limit.within), -problem.displacement)};
}

class Run {
 public:
  Run(const Mesh& a, const Mesh& b, const NativeOptions& options)
      : options_(options),
        problem_(a, b),
        levels_(problem_, goal_of(problem_, options), options, [this] { return is_going(); }) {}

  NativeReport report() {
    run();
    prove();
    NativeReport r = counts();
    const FileInterval ends = interval();
    r.lower = ends.lower;
    r.upper = ends.upper;
    r.diagonal_a = diagonal(problem_.box_a);
    r.tolerance = tolerance_in_files(problem_, options_);
    r.status = status_of(r);
    if (levels_.total().best.face != kNone) put_witness(r);
    return r;
  }

 private:
  void run() {
    try {
      levels_.ask_vertices();
      if (is_decided() || !is_to_go_on()) return;
      levels_.bound_faces();
      while (!levels_.is_over() && levels_.count() < options_.level_limit) {
        if (is_decided() || !is_to_go_on()) return;
        levels_.advance();
      }
    } catch (const Interrupted&) {
      if (!is_ended_) throw;
    }
  }

  // Any thread of a level calls this; goes_on() is called only on the caller's.
  bool is_going() {
    if (std::this_thread::get_id() != home_ || Clock::now() - asked_at_ < kBetweenAsking)
      return true;
    return ask();
  }

  bool is_to_go_on() {
    if (options_.goes_on && Clock::now() - proven_at_ > kBetweenProofs) prove();
    return ask();
  }

  bool ask() {
    if (!options_.goes_on) return true;
    const FileInterval ends = interval();
    is_ended_ = !options_.goes_on({.levels = levels_.count(),
                                   .open = levels_.open(),
                                   .lower = ends.lower,
                                   .upper = ends.upper,
                                   .diagonal_a = diagonal(problem_.box_a)});
    asked_at_ = Clock::now();
    return !is_ended_;
  }

  // If the distance is within the limit, nothing is left open; only a distance beyond it ends a run
  // sooner.
  bool is_decided() {
    const Limit& limit = options_.limit;
    if (!(limit.within > 0)) return false;
    const double beyond = problem_.frame.to_frame(limit.beyond) + problem_.displacement;
    if (!(levels_.total().best.distance > beyond)) return false;
    prove();
    return interval().lower > limit.beyond;
  }

  // Makes the lower end that of the best sample.
  void prove() {
    const Sample& best = levels_.total().best;
    if (best.face == kNone || best.distance == proven_distance_) return;
    lower_ = witness_distance_down(problem_, best, levels_.threads());
    proven_distance_ = best.distance;
    proven_at_ = Clock::now();
  }

  FileInterval interval() const {
    const double farthest = farthest_in(problem_.joint, add_up(problem_.a.delta, problem_.b.delta));
    return problem_.frame.to_files(lower_, std::max(lower_, levels_.upper()), problem_.displacement,
                                   farthest);
  }

  NativeReport counts() const {
    NativeReport r;
    const Gain& total = levels_.total();
    r.levels = levels_.count();
    r.candidates = total.candidates;
    r.queries = total.queries;
    r.peak_candidates = levels_.peak();
    r.peak_bytes = levels_.peak() * kBytesOfCandidate;
    r.closed = total.closed;
    r.areas = levels_.areas();
    return r;
  }

  NativeStatus status_of(const NativeReport& r) const {
    if (is_within(r.lower, r.upper, r.tolerance)) return NativeStatus::kClosed;
    if (levels_.is_over())
      return levels_.has_given_up() ? NativeStatus::kMemory : NativeStatus::kPrecision;
    return levels_.count() < options_.level_limit ? NativeStatus::kStopped : NativeStatus::kLevels;
  }

  void put_witness(NativeReport& r) const {
    const Sample& s = levels_.total().best;
    const double v = s.at.x * kUnit, w = s.at.y * kUnit;
    r.witness = {
        .face_a = s.face, .face_b = problem_.tree.face(s.place), .barycentric = {1 - v - w, v, w}};
    r.has_witness = true;
  }

  const NativeOptions& options_;
  const Problem problem_;
  Levels levels_;
  double lower_ = 0, proven_distance_ = -1;
  bool is_ended_ = false;
  const std::thread::id home_ = std::this_thread::get_id();
  Clock::time_point asked_at_ = Clock::now(), proven_at_ = asked_at_;
};

}  // namespace

NativeReport run_pair(const Mesh& a, const Mesh& b, const NativeOptions& options) {
  const FloatEnvironment ours;
  check_mesh(a);
  check_mesh(b);
  return Run(a, b, options).report();
}

}  // namespace vkh::native
