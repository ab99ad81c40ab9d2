// The paper's method and its ablations: every preset and every switch, the schedules, and the loss
// if nothing may wait.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "engine/vkhausdorff_experimental.h"
#include "host/solve/switches.h"
#include "tests/shapes/shapes.h"
#include "tests/support/kernel_bench.h"
#include "tests/support/solver_bench.h"
#include "tests/verification/oracle/reference_solver.h"

namespace {

using namespace vkh;
using namespace vkh::test;

/// Pairs that close at 1e-6 with any switch off.
const std::vector<ReferencePair>& pairs() {
  static const std::vector<ReferencePair> all = {
      with_reference("V", v_lid(), v_sheet()),
      with_reference("twin", height_field(24, 1), height_field(24, 3)),
      with_reference("thin", needles(1, 12), soup(2, 40)),
      with_reference("spheres", icosphere(1.0, 2),
                     translated(icosphere(1.1, 3), {0.1, 0.2, 0.05}))};
  return all;
}

// Options that sort from the first candidate on.
SolveOptions with(std::string preset, std::vector<std::string> enabled = {},
                  std::vector<std::string> disabled = {}) {
  SolveOptions options;
  options.engine.preset = std::move(preset);
  options.engine.enabled = std::move(enabled);
  options.engine.disabled = std::move(disabled);
  options.engine.sort_from = 1;
  options.wave_limit = 20'000;
  return options;
}

Report solve(const ReferencePair& pair, const SolveOptions& options) {
  const Report r = solver().distance(pair.a, pair.b, options);
  CAPTURE(pair.name);
  CAPTURE(status_name(r.status));
  CHECK(r.lower <= r.upper);
  CHECK(interval(r).meets(pair.exact));
  return r;
}

void check_closes(const SolveOptions& options) {
  for (const ReferencePair& pair : pairs()) {
    const Report r = solve(pair, options);
    CAPTURE(pair.name);
    CHECK(r.status == Status::kClosed);
    CHECK(r.upper - r.lower <= r.tolerance);
  }
}

/// Options with little room: the reserve and little more, and bounds that leave more open.
SolveOptions in_least_memory(std::vector<std::string> enabled,
                             std::vector<std::string> disabled = {}) {
  disabled.insert(disabled.end(), {"centroid", "parent_samples", "u3"});
  SolveOptions options = with("default", std::move(enabled), std::move(disabled));
  options.memory_bytes = 1;
  return options;
}

/// Whether room was short at all.
bool some_waited(const Report& r) {
  return std::any_of(r.wave_stats.begin(), r.wave_stats.end(),
                     [](const WaveStats& w) { return w.deferred > 0; });
}

}  // namespace

TEST_CASE("every preset closes") {
  for (const std::string& preset : preset_names()) {
    CAPTURE(preset);
    check_closes(with(preset));
  }
}

// All of A is as far as its farthest point: no part falls under that, but for rounding. Every part
// was split until its bits ran out, 4^20 of them, before those over B's edges were looked at.
TEST_CASE("a triangle parallel to a face closes, or ends by itself, with every preset") {
  const Mesh a = single_triangle({-0.9, -0.8, 0}, {0.8, -0.5, 0}, {-0.2, 0.7, 0});
  for (const double height : {0.02, 0.5, 3.0}) {
    for (const std::string& preset : preset_names()) {
      CAPTURE(height);
      CAPTURE(preset);
      const Report r =
          solver().distance(a, translated(cube(1.0), {0, 0, -1 - height}), with(preset));
      CHECK(r.status == Status::kClosed);
      CHECK(r.lower <= height * (1 + 1e-12));
      CHECK(r.upper >= height * (1 - 1e-12));
      CHECK(r.candidates < 100'000);
    }
  }
}

// Each switch off: workspace_test. Pipelines for a set of switches take lavapipe a second and more.
TEST_CASE("what is off is closed without, and named") {
  const ReferencePair& pair = pairs()[0];
  const std::vector<std::string> on = {"thin",   "u4",    "warm_start", "sort",
                                       "packet", "defer", "u3_paper"};
  CHECK(solve(pair, with("paper")).switched_on == on);
  CHECK(solve(pair, with("baseline-gpu")).switched_on ==
        std::vector<std::string>{"u4", "u3_paper"});
  const Report r = solve(pair, with("default", {"largest_first"}, {"multiwave"}));
  CHECK(std::count(r.switched_on.begin(), r.switched_on.end(), "largest_first") == 1);
  CHECK(std::count(r.switched_off.begin(), r.switched_off.end(), "multiwave") == 1);
  CHECK(r.switched_on.size() + r.switched_off.size() == switch_names().size());
}

TEST_CASE("sorting and packets change no count of the work, but its order") {
  for (const ReferencePair& pair : pairs()) {
    const Report plain = solve(pair, with("default"));
    const Report sorted = solve(pair, with("default", {"sort"}));
    CHECK(sorted.candidates == plain.candidates);
    CHECK(sorted.queries == plain.queries);
    CHECK(sorted.lower == plain.lower);
    CHECK(sorted.upper == plain.upper);
    // The traversals may find different ones of equally near triangles.
    const Report packets = solve(pair, with("default", {"packet"}));
    CHECK(std::abs(packets.lower - plain.lower) <= 1e-6 * plain.diagonal_a);
  }
}

TEST_CASE("a sorted frontier that has to wait is gone through all the same") {
  bool waited = false;
  for (const ReferencePair& pair : pairs()) {
    const SolveOptions options = in_least_memory({"sort"});
    const Report r = solve(pair, options);
    CHECK(r.status == Status::kClosed);
    waited = waited || some_waited(r);
    check_same(solve(pair, options), r);
  }
  CHECK(waited);
}

TEST_CASE("largest u first ends, repeats, and goes another way") {
  bool another_way = false;
  for (const ReferencePair& pair : pairs()) {
    const SolveOptions options = in_least_memory({"largest_first"});
    const Report r = solve(pair, options);
    CHECK(r.status == Status::kClosed);
    check_same(solve(pair, options), r);
    const Report smallest = solve(pair, in_least_memory({}));
    another_way = another_way || (some_waited(r) && smallest.waves != r.waves);
  }
  CHECK(another_way);
}

TEST_CASE("where nothing may wait, what does not fit is lost, but not its bound") {
  bool lost = false;
  for (const ReferencePair& pair : pairs()) {
    SolveOptions options = in_least_memory({}, {"defer"});
    options.engine.coverage = true;
    const Report r = solve(pair, options);
    CAPTURE(pair.name);
    CHECK(std::isfinite(r.upper));
    REQUIRE(r.coverage_check);
    CHECK(r.coverage_check->holds);
    CHECK((r.status == Status::kMemory || r.status == Status::kClosed));
    lost = lost || r.status == Status::kMemory;
    if (r.status == Status::kMemory) CHECK(r.upper - r.lower > r.tolerance);
    check_same(solve(pair, options), r);
  }
  CHECK(lost);
}

TEST_CASE("a wave a submission: the same run, and the host hears of every wave") {
  for (const ReferencePair& pair : pairs()) {
    SolveOptions options = with("default", {}, {"multiwave"});
    std::vector<uint32_t> heard;
    options.progress = [&](const Progress& p) {
      heard.push_back(p.wave);
      return true;
    };
    const Report r = solve(pair, options);
    REQUIRE(!heard.empty());
    CHECK(heard[0] <= 1);  // 0: a CPU device builds the BVH in a submission of its own
    for (size_t i = 1; i < heard.size(); ++i) CHECK(heard[i] == heard[0] + i);
    CHECK(heard.size() >= r.waves - 1);
    check_same(solve(pair, with("default")), r);
  }
}

namespace {

/// A row of the page's table, `| a | b |`, without its first and last bar.
std::vector<std::string> cells(const std::string& row) {
  std::vector<std::string> out;
  std::istringstream in(row.substr(1));
  for (std::string cell; std::getline(in, cell, '|');) {
    const size_t first = cell.find_first_not_of(" `"), last = cell.find_last_not_of(" `");
    out.push_back(first == std::string::npos ? "" : cell.substr(first, last - first + 1));
  }
  return out;
}

std::map<std::string, std::vector<std::string>> table_of_switches() {
  std::ifstream page(VKH_SOURCE_DIR "/docs/method.md");
  std::map<std::string, std::vector<std::string>> rows;
  bool inside = false;
  for (std::string line; std::getline(page, line);) {
    if (line.starts_with("| switch |")) inside = true;
    if (!line.starts_with("|")) inside = false;
    if (inside && line.starts_with("| `")) rows[cells(line)[0]] = cells(line);
  }
  return rows;
}

}  // namespace

TEST_CASE("the page's table has every switch, and where it is on") {
  const auto rows = table_of_switches();
  const uint32_t host = kSwitchMultiwave;
  EngineOptions paper, baseline;
  paper.preset = "paper";
  baseline.preset = "baseline-gpu";
  const uint32_t columns[] = {VKH_SWITCH_DEFAULT_WIDE | kSwitchWide | host,
                              VKH_SWITCH_DEFAULT_NARROW | host, switches_of(paper, test_device()),
                              switches_of(baseline, test_device())};
  CHECK(rows.size() == switch_names().size());
  for (size_t column = 0; column < std::size(columns); ++column) {
    CAPTURE(column);
    for (const std::string& name : switch_states(columns[column]).on) {
      CAPTURE(name);
      REQUIRE(rows.contains(name));
      CHECK(rows.at(name)[column + 1] == "on");
    }
    for (const std::string& name : switch_states(columns[column]).off) {
      CAPTURE(name);
      REQUIRE(rows.contains(name));
      CHECK(rows.at(name)[column + 1] == "");
    }
  }
}
