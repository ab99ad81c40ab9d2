// A Solver without a device: what it does as one with a device does, and what it refuses.
#include <doctest/doctest.h>

#include <algorithm>
#include <memory>
#include <numeric>
#include <stdexcept>
#include <thread>

#include "tests/shapes/hard_pairs.h"
#include "tests/shapes/shapes.h"
#include "tests/support/sanitized.h"
#include "vkhausdorff/asking.h"
#include "vkhausdorff/error.h"
#include "vkhausdorff/face_gate.h"
#include "vkhausdorff/prover.h"
#include "vkhausdorff/solver.h"
#include "vkhausdorff/stream.h"
#include "vkhausdorff/together.h"

using namespace vkh;
using namespace vkh::test;

namespace {

const double kDistance = v_lid_distance();  // of the lid from the sheet

/// Two tori that are nowhere alike: some levels of work.
Mesh large() { return torus(1, 0.25, 60, 40); }
Mesh larger() { return torus(1, 0.26, 55, 45); }

bool encloses(const Report& r, double distance) {
  return r.lower <= distance && distance <= r.upper;
}

}  // namespace

TEST_CASE("a native solver encloses distances, both ways and many") {
  Solver solver(NativeProcessor{2});
  CHECK(solver.description().type == kNative);
  CHECK(solver.description().name.ends_with(", 2 threads"));
  const Mesh lid = v_lid(), sheet = v_sheet();
  const Report r = solver.distance(lid, sheet);
  CHECK(r.status == Status::kClosed);
  CHECK(encloses(r, kDistance));
  CHECK(r.has_witness);
  CHECK(r.device.name == solver.description().name);
  const SymmetricReport both = solver.symmetric(lid, sheet);
  CHECK(both.a_to_b.lower == r.lower);
  CHECK(encloses(solver.distance(sheet, lid), solver.distance(sheet, lid).lower));
  CHECK(both.b_to_a.upper >= solver.distance(sheet, lid).lower);
  const PairView pairs[] = {{.a = lid, .b = sheet}, {.a = sheet, .b = lid}};
  const std::vector<Report> all = solver.distances(pairs);
  CHECK(all.at(0).lower == r.lower);
  CHECK(all.at(1).lower == solver.distance(sheet, lid).lower);
}

TEST_CASE("a limit and a known lower bound end a native run") {
  Solver solver(NativeProcessor{});
  SolveOptions options;
  options.limit = {2 * kDistance, 2 * kDistance};
  Report r = solver.distance(v_lid(), v_sheet(), options);
  CHECK(verdict_of(r.lower, r.upper, r.limit) == Verdict::kWithin);
  options.limit = {kDistance / 2, kDistance / 2};
  r = solver.distance(v_lid(), v_sheet(), options);
  CHECK((r.status == Status::kLimit || r.status == Status::kClosed));
  CHECK(verdict_of(r.lower, r.upper, r.limit) == Verdict::kBeyond);
  options.limit = {};
  options.known_lower = 2 * kDistance;
  r = solver.distance(v_lid(), v_sheet(), options);
  CHECK(r.status == Status::kPruned);
  CHECK(encloses(r, kDistance));
}

SolveOptions fine() {
  SolveOptions options;
  options.tolerance = 1e-9;
  return options;
}

TEST_CASE("progress is true, on the caller's thread, and may end a native run") {
  Solver solver(NativeProcessor{2});
  const Mesh a = large(), b = larger();
  SolveOptions options = fine();
  const Report whole = solver.distance(a, b, options);
  REQUIRE(whole.status == Status::kClosed);
  const std::thread::id home = std::this_thread::get_id();
  size_t calls = 0, most = 1000;
  options.progress = [&](const Progress& p) {
    CHECK(std::this_thread::get_id() == home);
    CHECK(p.lower <= whole.upper);
    CHECK(p.upper >= whole.lower);
    return ++calls < most;
  };
  const Report heard = solver.distance(a, b, options);
  CHECK(calls > 3);
  CHECK(heard.lower == whole.lower);
  CHECK(heard.upper == whole.upper);
  for (most = 1; most < 4; ++most) {
    calls = 0;
    const Report r = solver.distance(a, b, options);
    CHECK(calls == most);
    CHECK(r.status == Status::kCancelled);
    CHECK(r.lower <= whole.upper);
    CHECK(r.upper >= whole.lower);
  }
  options.progress = [](const Progress&) -> bool { throw std::runtime_error("no more"); };
  CHECK_THROWS_WITH_AS(solver.distance(a, b, options), "no more", std::runtime_error);
  options.progress = {};
  CHECK(solver.distance(a, b, options).lower == whole.lower);
}

TEST_CASE("budgets end a native run with a true interval") {
  Solver solver(NativeProcessor{2});
  const Mesh a = large(), b = larger();
  const Report whole = solver.distance(a, b, fine());
  const auto status_with = [&](const std::function<void(SolveOptions&)>& limit) {
    SolveOptions options = fine();
    limit(options);
    const Report r = solver.distance(a, b, options);
    CHECK(r.lower <= whole.upper);
    CHECK(r.upper >= whole.lower);
    return r.status;
  };
  CHECK(status_with([](SolveOptions& o) { o.time_limit_s = 0; }) == Status::kTime);
  CHECK(status_with([](SolveOptions& o) { o.wave_limit = 2; }) == Status::kWaves);
  CHECK(status_with([](SolveOptions& o) { o.memory_bytes = 4096; }) == Status::kMemory);
  CHECK(status_with([](SolveOptions&) {}) == Status::kClosed);
}

TEST_CASE("a native stream, and a question of C++") {
  std::vector<StreamResult> results(2);
  StreamOptions native;
  native.devices = {std::string(kNative)};
  native.threads = 1;
  PairStream stream(native, [&](StreamResult&& r) { results.at(r.number) = std::move(r); });
  const auto lid = std::make_shared<const Mesh>(v_lid()),
             sheet = std::make_shared<const Mesh>(v_sheet());
  for (size_t i = 0; i < 2; ++i) {
    StreamPair pair;
    pair.number = i;
    pair.a = lid;
    pair.b = sheet;
    pair.shares_b = true;
    pair.symmetric = i == 1;
    CHECK(stream.push(pair));
  }
  stream.finish();
  for (const StreamResult& r : results) {
    CHECK(r.error == nullptr);
    CHECK(encloses(r.a_to_b, kDistance));
  }
  CHECK(results[1].b_to_a);

  Solver solver(NativeProcessor{});
  Solver* const solvers[] = {&solver};
  const auto read = [](const Mesh& mesh) {
    ReadMesh out;
    static_cast<Mesh&>(out) = mesh;
    return std::make_shared<const ReadMesh>(std::move(out));
  };
  CHECK(encloses(Asking({}, read(*lid), read(*sheet), solvers).answer().a_to_b, kDistance));
  Question figures;
  figures.statistics = true;
  const Answer surveyed = Asking(figures, read(*lid), read(*sheet), solvers).answer();
  REQUIRE(surveyed.survey_a);
  REQUIRE(surveyed.survey_a->statistics);
  CHECK(surveyed.survey_a->statistics->mean.upper <= kDistance * (1 + 1e-12));
  Question proven;
  proven.certificate = true;
  proven.device = kNative;
  const Answer certified = Asking(proven, read(*lid), read(*sheet), solvers).answer();
  REQUIRE(certified.proof_a);
  CHECK(certified.proof_a->upper == certified.a_to_b.upper);
  Question verified;
  verified.verify = true;
  verified.device = kNative;
  const Answer checked = Asking(verified, read(*lid), read(*sheet), solvers).answer();
  REQUIRE(checked.a_to_b.coverage_check);
  CHECK(checked.a_to_b.coverage_check->holds);
  CHECK(checked.a_to_b.witness_check->holds);
}

// About all of a surface is as far as its farthest point, and the bound as tight as doubles make
// it: halves of a part come so close to it that none is proven before millions are.
TEST_CASE("a native bound of points equally far takes what tolerance and limit leave") {
  const std::vector<std::string> names = family_names();
  const auto offset = std::find(names.begin(), names.end(), "offset") - names.begin();
  const HardPair hard = hard_pair(static_cast<size_t>(offset), 67 * 1000003 + 83);
  Solver solver{NativeProcessor{}};
  SolveOptions options;
  options.tolerance = hard.tolerance;
  const auto& [a, b] = hard.pair;
  const Report r = solver.distance(a, b, options);
  const auto goes_on = [](size_t leaves) { return leaves < 100'000; };
  const Proof proof =
      prove(solver, {.a = a, .b = b, .report = r, .options = options, .goes_on = goes_on});
  CHECK(proof.unproven == 0);
  CHECK(proof.upper >= r.upper);
  CHECK(proof.upper - r.lower <= r.tolerance);

  REQUIRE(proof.upper > r.upper);
  if (kIsSanitized) return;  // the same code, with less to take
  Report gated = r;
  gated.limit.within = gated.limit.beyond = std::midpoint(r.upper, proof.upper);
  const Proof within =
      prove(solver, {.a = a, .b = b, .report = gated, .options = options, .goes_on = goes_on});
  CHECK(within.unproven == 0);
  CHECK(within.upper <= gated.limit.within);
}

// The bounds of a run are as tight as doubles allow. Were the prover less so, it would halve parts
// that halving cannot help, and raise the bound.
TEST_CASE("a native bound is proven as it stands, by as many leaves as a device's") {
  Solver solver(NativeProcessor{2});
  const auto check = [&](const Mesh& a, const Mesh& b, size_t most_leaves) {
    for (const double tolerance : {1e-6, 1e-9}) {
      SolveOptions options;
      options.tolerance = tolerance;
      const Report r = solver.distance(a, b, options);
      REQUIRE(r.status == Status::kClosed);
      const Proof proof =
          prove(solver, {.a = a, .b = b, .report = r, .options = options, .goes_on = {}});
      CHECK(proof.upper == r.upper);
      CHECK(proof.unproven == 0);
      CHECK(proof.leaves <= most_leaves);
    }
  };
  const Mesh small = height_field(6, 1);
  const Mesh plate = make_mesh("plate", {{-3, -3, 2.3}, {4, -3, 2.3}, {0, 5, 2.3}}, {{0, 1, 2}});
  const Mesh above = make_mesh("above", {{0, 0, 3.1}, {1, 0, 3.1}, {0, 1, 3.1}}, {{0, 1, 2}});
  check(above, plate, 1);  // as far everywhere: no part has anything to spare
  check(small, plate, small.faces.size());
  check(v_lid(), v_sheet(), 20000);
  if (kIsSanitized) return;  // the same code
  const Mesh a = large(), b = larger();
  check(a, b, 6 * a.faces.size());
}

TEST_CASE("a mesh that is prepared natively gives the same distances, and limits of faces") {
  Solver solver(NativeProcessor{2});
  const Mesh lid = v_lid();
  const PreparedMesh sheet = solver.prepare(v_sheet());
  const Report r = solver.distance(lid, sheet), alone = solver.distance(lid, sheet.mesh());
  CHECK(r.lower == alone.lower);
  CHECK(r.upper == alone.upper);
  std::vector<Limit> limits(lid.faces.size(), Limit{2, 2});
  CHECK(gate_faces(solver, lid, sheet.mesh(), limits, {}).verdict == Verdict::kWithin);
  limits.assign(lid.faces.size(), Limit{kDistance / 2, kDistance / 2});
  CHECK(gate_faces(solver, lid, sheet.mesh(), limits, {}).verdict == Verdict::kBeyond);
}

TEST_CASE("a native solver refuses what only devices do") {
  Solver solver(NativeProcessor{}), other(NativeProcessor{});
  const Mesh lid = v_lid(), sheet = v_sheet();
  CHECK_THROWS_AS(solver.device(), UsageError);
  Solver* const solvers[] = {&solver, &other};
  CHECK_THROWS_AS(distance_over(solvers, lid, sheet), UsageError);
  SolveOptions options;
  options.engine.preset = "paper";
  CHECK_THROWS_AS(solver.distance(lid, sheet, options), UsageError);
  options.engine = {.disabled = {"u3"}};
  CHECK_THROWS_AS(solver.distance(lid, sheet, options), UsageError);
  CHECK_NOTHROW(solver.make_ready({.fine = true}));
  CHECK_THROWS_AS(solver.distance(lid, Mesh{}), InputError);
  Solver shares(Solver::SharesPipelines{}, solver);
  CHECK(encloses(shares.distance(lid, sheet), kDistance));
}
