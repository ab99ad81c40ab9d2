#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <glm/common.hpp>
#include <map>
#include <thread>

#include "host/base/decimal.h"
#include "tests/shapes/hard_pairs.h"
#include "tests/verification/oracle/reference_solver.h"
#include "tools/bench/sweep.h"
#include "vkhausdorff/solver.h"
#include "vkhausdorff/verify.h"

namespace vkh::bench {
namespace {

using namespace vkh::test;

struct Job {
  size_t family = 0;
  uint64_t seed = 0;
};

struct Gate {
  double limit = 0, tolerance = 0;
  double lower = 0, upper = 0;
  Status status = Status::kClosed;
  Verdict verdict = Verdict::kUndecided;
};

struct Outcome {
  Interval reference;  ///< in units of 2^-exponent
  Interval found, again;
  int exponent = 0;
  Status status = Status::kClosed;
  double tolerance = 0, diagonal_a = 0, solve_ms = 0;
  bool repeated = false;
  WitnessCheck witness;
  std::optional<CoverageCheck> coverage;
  std::optional<Gate> gate;
};

class Families {
 public:
  explicit Families(const SweepOptions& args) : args_(args), names_(family_names()) {
    if (args.family.empty()) return;
    const auto at = std::find(names_.begin(), names_.end(), args.family);
    if (at == names_.end()) throw std::runtime_error("no family is called '" + args.family + "'");
    only_ = static_cast<size_t>(at - names_.begin());
    all_ = false;
  }
  Job job(uint64_t i) const {
    const size_t family = all_ ? i % names_.size() : only_;
    return {family, Random(args_.seed * 0x9e3779b97f4a7c15u + i).bits()};
  }
  const SweepOptions& asked() const { return args_; }
  const char* name(const Job& job) const { return names_[job.family].c_str(); }

 private:
  const SweepOptions& args_;
  std::vector<std::string> names_;
  size_t only_ = 0;
  bool all_ = true;
};

/// A power of two that brings the joint box to about 1: the reference squares twice. Scaling up is
/// exact; scaling down loses less than 2^-1000 of the box.
int exponent_of(const MeshPair& pair) {
  glm::dvec3 lo = pair.a.vertices.front(), hi = lo;
  for (const Mesh* mesh : {&pair.a, &pair.b}) {
    for (const glm::dvec3& v : mesh->vertices) {
      lo = glm::min(lo, v);
      hi = glm::max(hi, v);
    }
  }
  const glm::dvec3 extent = hi - lo;
  const double largest = std::max({extent.x, extent.y, extent.z});
  return largest > 0 ? -std::ilogb(largest) : 0;
}

Mesh rescaled(const Mesh& mesh, int exponent) {
  std::vector<glm::dvec3> vertices = mesh.vertices;
  for (glm::dvec3& v : vertices) {
    for (int i = 0; i < 3; ++i) v[i] = std::ldexp(v[i], exponent);
  }
  return make_mesh(mesh.name, std::move(vertices), mesh.faces);
}

void ask_reference(const Job& job, Outcome& out) {
  constexpr double kTolerance = 1e-10;  // of the joint box
  constexpr uint64_t kCandidates = 100'000;
  const HardPair hard = hard_pair(job.family, job.seed);
  out.exponent = exponent_of(hard.pair);
  out.reference = reference_hausdorff(rescaled(hard.pair.a, out.exponent),
                                      rescaled(hard.pair.b, out.exponent), kTolerance, kCandidates);
}

SolveOptions options_for(const HardPair& hard, const Job& job, const SweepOptions& args) {
  SolveOptions options;
  options.tolerance = args.tolerance > 0 ? args.tolerance : hard.tolerance;
  if (args.closes) return options;
  Random random(job.seed ^ 0x5eed);
  // Most runs are as users run them; some are out of memory or cut short, where intervals hold too.
  const uint32_t way = random.below(16);
  if (way == 0 && !hard.largest_gap_at_zero) options.wave_limit = 1 + random.below(4);
  if (way == 1) options.memory_bytes = 1;
  options.engine.coverage = way < 3;
  // A mesh that is one point has no diagonal to take a fraction of.
  return options;
}

void ask_solver(Solver& solver, const Job& job, const SweepOptions& args, Outcome& out) {
  const HardPair hard = hard_pair(job.family, job.seed);
  const SolveOptions options = options_for(hard, job, args);
  const auto start = std::chrono::steady_clock::now();
  const Report r = solver.distance(hard.pair.a, hard.pair.b, options);
  out.solve_ms =
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  out.found = {r.lower, r.upper};
  out.status = r.status;
  out.tolerance = r.tolerance;
  out.diagonal_a = r.diagonal_a;
  out.witness = verify_witness(hard.pair.a, hard.pair.b, r);
  out.coverage = r.coverage_check;
  out.repeated = job.seed % 16 == 0;
  if (!out.repeated) return;
  const Report again = solver.distance(hard.pair.a, hard.pair.b, options);
  out.again = {again.lower, again.upper};
}

/// A limit at the distance, or off it by a tenth of it, a hundredth and so on; above or below.
double limit_near(const Job& job, const Outcome& out) {
  Random random(job.seed ^ 0x6a7e);
  const double upper = out.found.upper;
  const uint32_t way = random.below(12);
  if (way == 0 && out.found.lower > 0) return out.found.lower;
  if (way == 1 && upper > 0) return upper;
  const double off = std::pow(10.0, -9.0 * random.unit()) * (way % 2 == 0 ? 1 : -1);
  const double size = upper > 0 ? upper : out.diagonal_a;
  return std::max(upper > 0 ? upper + off * size : std::abs(off) * size, 1e-300);
}

void ask_gate(Solver& solver, const Job& job, Outcome& out) {
  const HardPair hard = hard_pair(job.family, job.seed);
  const double limit = limit_near(job, out);
  SolveOptions options;
  options.tolerance = 1e-7;
  options.limit = {limit, limit};
  const Report r = solver.distance(hard.pair.a, hard.pair.b, options);
  out.gate = Gate{.limit = limit,
                  .tolerance = r.tolerance,
                  .lower = r.lower,
                  .upper = r.upper,
                  .status = r.status,
                  .verdict = verdict_of(r.lower, r.upper, r.limit)};
}

/// The least possible distance of the limit from h, in the files' units.
double off_distance(const Outcome& out) {
  const double limit = std::ldexp(out.gate->limit, out.exponent);
  const double off = std::max({0.0, out.reference.lower - limit, limit - out.reference.upper});
  return std::ldexp(off, -out.exponent);
}

/// The error in a verdict; empty if there is none.
std::string fault_of_gate(const Outcome& out) {
  const double limit = std::ldexp(out.gate->limit, out.exponent);
  if (out.gate->verdict == Verdict::kWithin && out.reference.lower > limit)
    return "is not within the limit " + hex_float(out.gate->limit);
  if (out.gate->verdict == Verdict::kBeyond && out.reference.upper <= limit)
    return "is not beyond the limit " + hex_float(out.gate->limit);
  return {};
}

bool is_closed_by_reference(const Outcome& out) {
  const double width = out.reference.upper - out.reference.lower;
  return std::ldexp(width, -out.exponent) <= out.tolerance;
}

/// The error in an outcome; empty if there is none.
std::string fault_of(const Job& job, const Outcome& out, const SweepOptions& asked) {
  const Interval found = out.found;
  if (!(found.lower >= 0 && found.lower <= found.upper && std::isfinite(found.upper)))
    return "no interval";
  if (!out.witness.holds) return "has a witness closer than lower";
  if (out.coverage && !out.coverage->holds) return "has lost a part of A";
  const Interval unit = {std::ldexp(found.lower, out.exponent),
                         std::ldexp(found.upper, out.exponent)};
  if (!unit.meets(out.reference)) return "misses the reference";
  const HardPair hard = hard_pair(job.family, job.seed);
  if (hard.exact && !found.contains(*hard.exact)) return "misses the exact distance";
  if (out.gate && !fault_of_gate(out).empty()) return fault_of_gate(out);
  if (out.status == Status::kClosed && found.upper - found.lower > out.tolerance)
    return "says closed and is wider than the tolerance";
  if (asked.closes && out.status != Status::kClosed && is_closed_by_reference(out))
    return "stays open, and not the reference";
  if (out.repeated && (out.again.lower != found.lower || out.again.upper != found.upper))
    return "differs from run to run";
  return {};
}

/// A true interval that is wider than it should be. A mesh that is a point has no diagonal to take
/// a fraction of for a goal.
bool is_wide_around_zero(const Job& job, const Outcome& out) {
  const HardPair hard = hard_pair(job.family, job.seed);
  return hard.largest_gap_at_zero && out.diagonal_a > 0 &&
         out.found.upper > *hard.largest_gap_at_zero * out.diagonal_a;
}

struct Totals {
  uint64_t violations = 0, wide_around_zero = 0, closed = 0, wide_references = 0, repeated = 0,
           exact = 0;
  double solve_ms = 0;
  uint64_t passed = 0, failed = 0, undecided = 0;
  std::vector<double> bands;  ///< of undecided runs with a tolerance, in tolerances
  struct PerFamily {
    uint64_t count = 0, closed = 0, closed_by_reference = 0, violations = 0;
  };
  std::map<std::string, PerFamily> families;
};

void count_gate(const char* family, uint64_t i, const Outcome& out, Totals& totals) {
  const Verdict verdict = out.gate->verdict;
  totals.passed += verdict == Verdict::kWithin ? 1 : 0;
  totals.failed += verdict == Verdict::kBeyond ? 1 : 0;
  if (verdict != Verdict::kUndecided) return;
  ++totals.undecided;
  if (!(out.gate->tolerance > 0)) return;
  totals.bands.push_back(off_distance(out) / out.gate->tolerance);
  if (totals.bands.back() <= 1) return;
  std::printf("FAR pair %llu (%s) is undecided %.3g tolerances from the limit %s: [%s, %s] %s\n",
              static_cast<unsigned long long>(i), family, totals.bands.back(),
              hex_float(out.gate->limit).c_str(), hex_float(out.gate->lower).c_str(),
              hex_float(out.gate->upper).c_str(), status_name(out.gate->status));
}

void judge(const Families& families, uint64_t i, const Outcome& out, Totals& totals) {
  const Job job = families.job(i);
  const std::string fault = fault_of(job, out, families.asked());
  Totals::PerFamily& family = totals.families[families.name(job)];
  ++family.count;
  const bool closed = out.status == Status::kClosed;
  totals.closed += closed ? 1 : 0;
  family.closed += closed ? 1 : 0;
  family.closed_by_reference += is_closed_by_reference(out) ? 1 : 0;
  totals.repeated += out.repeated ? 1 : 0;
  totals.solve_ms += out.solve_ms;
  // Whether it is so wide that it would not show an error of the size of a float's ulp.
  totals.wide_references += out.reference.upper - out.reference.lower > 1e-8 ? 1 : 0;
  totals.exact += hard_pair(job.family, job.seed).exact ? 1 : 0;
  if (out.gate) count_gate(families.name(job), i, out, totals);
  const bool wide = is_wide_around_zero(job, out);
  totals.wide_around_zero += wide ? 1 : 0;
  if (fault.empty() && !wide) return;
  totals.violations += fault.empty() ? 0 : 1;
  family.violations += fault.empty() ? 0 : 1;
  std::printf("%s pair %llu (%s) %s: [%s, %s] %s, reference [%s, %s] 2^%d\n",
              fault.empty() ? "WIDE" : "VIOLATION", static_cast<unsigned long long>(i),
              families.name(job), fault.empty() ? "is wide around 0" : fault.c_str(),
              hex_float(out.found.lower).c_str(), hex_float(out.found.upper).c_str(),
              status_name(out.status), hex_float(out.reference.lower).c_str(),
              hex_float(out.reference.upper).c_str(), -out.exponent);
}

void print_summary(const SweepOptions& args, const Totals& t, const Solver& solver,
                   double seconds) {
  for (const auto& [name, f] : t.families) {
    std::printf("  %-12s %6llu pairs, %6llu closed, %6llu by the reference, %llu violations\n",
                name.c_str(), static_cast<unsigned long long>(f.count),
                static_cast<unsigned long long>(f.closed),
                static_cast<unsigned long long>(f.closed_by_reference),
                static_cast<unsigned long long>(f.violations));
  }
  std::printf(
      "sweep: %llu pairs (seed %llu, from %llu) on %s: %llu violations; %llu closed, %llu with an "
      "exact distance, %llu run twice, %llu references wider than 1e-8, %llu of h(A,A) above 1e-9 "
      "diag(A); "
      "solver %.1f s, all %.1f "
      "s\n",
      static_cast<unsigned long long>(args.count), static_cast<unsigned long long>(args.seed),
      static_cast<unsigned long long>(args.first), solver.description().name.c_str(),
      static_cast<unsigned long long>(t.violations), static_cast<unsigned long long>(t.closed),
      static_cast<unsigned long long>(t.exact), static_cast<unsigned long long>(t.repeated),
      static_cast<unsigned long long>(t.wide_references),
      static_cast<unsigned long long>(t.wide_around_zero), t.solve_ms / 1000, seconds);
}

void print_gates(Totals& t) {
  std::sort(t.bands.begin(), t.bands.end());
  const auto beyond = t.bands.end() - std::upper_bound(t.bands.begin(), t.bands.end(), 1.0);
  std::printf(
      "gates: %llu within, %llu beyond, %llu undecided, which lie off the distance by a median of "
      "%.3g and at most %.3g tolerances of 1e-7 diag(A), %lld of them by more than one\n",
      static_cast<unsigned long long>(t.passed), static_cast<unsigned long long>(t.failed),
      static_cast<unsigned long long>(t.undecided),
      t.bands.empty() ? 0 : t.bands[t.bands.size() / 2], t.bands.empty() ? 0 : t.bands.back(),
      static_cast<long long>(beyond));
}

}  // namespace

int sweep_distances(const SweepOptions& args) {
  const Families families(args);
  Swept swept(args.device);
  Solver& solver = swept.solver();
  std::vector<Outcome> outcomes(args.count);
  const auto start = std::chrono::steady_clock::now();
  std::atomic<uint64_t> next = 0;
  std::vector<std::thread> helpers;
  for (uint32_t t = 0; t < args.threads; ++t) {
    helpers.emplace_back([&] {
      for (uint64_t i = next++; i < args.count; i = next++)
        ask_reference(families.job(args.first + i), outcomes[i]);
    });
  }
  for (uint64_t i = 0; i < args.count; ++i) {
    const Job job = families.job(args.first + i);
    ask_solver(solver, job, args, outcomes[i]);
    if (args.gates) ask_gate(solver, job, outcomes[i]);
  }
  for (Outcome& out : outcomes)
    out.found.lower = std::min(out.found.lower * (1 + args.spoil), out.found.upper);
  for (std::thread& helper : helpers) helper.join();
  Totals totals;
  for (uint64_t i = 0; i < args.count; ++i) judge(families, args.first + i, outcomes[i], totals);
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  if (args.gates) print_gates(totals);
  print_summary(args, totals, solver, elapsed.count());
  return totals.violations > 0 || totals.closed < args.least_closed ? 1 : 0;
}

}  // namespace vkh::bench
