// Fuzzes the C API with small pairs of meshes: for any meshes a run ends, its reports nest, and the
// interval meets that of the tests' own solver. tools/fuzz runs it, on lavapipe unless
// VKH_TEST_DEVICE names another device.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "tests/verification/fuzz/fuzz_target.h"
#include "tests/verification/fuzz/pair_bench.h"
#include "tests/verification/oracle/reference_solver.h"

namespace {

using namespace vkh;
using namespace vkh::test;

constexpr uint32_t kMostPairs = 4;
constexpr const char* kSpoil = "VKH_FUZZ_SPOIL";  // raises lower bounds, which must be noticed
constexpr uint32_t kWavesOfTurn = 8, kMostTurns = 400;

struct State {
  FuzzDevice device;
  std::vector<std::unique_ptr<PairBench>> benches;
  bool raises_lower = std::getenv(kSpoil) != nullptr;

  explicit State(size_t context_count) : device(context_count) {
    for (uint32_t i = 0; i < kMostPairs; ++i)
      benches.push_back(std::make_unique<PairBench>(device));
  }
};

State* g_state = nullptr;  // never destroyed: when a program ends, drivers go before it would

void require(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "api_fuzz: not so: %s\n", what);
  if (std::getenv(kSpoil) != nullptr) std::_Exit(1);  // expected: no crash
  std::abort();
}

/// Both forms of a report's interval.
std::array<Interval, 2> intervals_of(const VkhReport& report) {
  return {{{report.lower, report.upper},
           {double{report.base} + report.lowerAbove, double{report.base} + report.upperAbove}}};
}

void print(const VkhReport& report, const FuzzPair& pair, const Interval& exact) {
  std::fprintf(
      stderr,
      "api_fuzz: [%.9g, %.9g] = %.9g + [%.9g, %.9g], status %u, waves %u, %u open, tolerance "
      "%.9g, diagonal %.9g, two floats %d, reference [%.17g, %.17g]\n",
      report.lower, report.upper, report.base, report.lowerAbove, report.upperAbove, report.status,
      report.waves, report.remaining, pair.tolerance, pair.diagonal, pair.two_float ? 1 : 0,
      exact.lower, exact.upper);
}

void check_true(const VkhReport& report, const FuzzPair& pair, const Interval& exact) {
  require(report.status <= VKH_STATUS_MEMORY, "the status is one");
  for (const Interval& found : intervals_of(report)) {
    if (found.lower <= found.upper && found.meets(exact)) continue;
    print(report, pair, exact);
    require(found.lower <= found.upper, "lower <= upper");
    require(false, "the interval meets the reference");
  }
  require(report.witnessFaceA < pair.a.face_count(), "the witness is on a face of A");
  require(report.witnessFaceB < pair.b.face_count(), "its partner is on a face of B");
}

/// Reports of one run nest, except for rounding: of a sample's place and its closest point's in
/// single floats, and of numbers under 2^-48.
void check_nested(const VkhReport& before, const VkhReport& after, const FuzzPair& pair,
                  const Interval& exact) {
  const double slack = 1e-5 * double{after.upper} + 0x1p-21 * pair.largest + 0x1p-44;
  if (after.lower >= before.lower - slack && after.upper <= before.upper + slack) return;
  print(before, pair, exact);
  print(after, pair, exact);
  require(false, "a later report is within an earlier one");
}

Interval reference(const FuzzMesh& a, const FuzzMesh& b, const FuzzPair& pair) {
  constexpr uint64_t kMostCandidates = 3000;
  return reference_hausdorff(a.measured(pair.two_float), b.measured(pair.two_float),
                             std::max(1e-3 * pair.diagonal, 1e-300), kMostCandidates);
}

/// One input: pairs side by side or one after the other, on one context.
class Run {
 public:
  Run(State& state, FuzzBytes& bytes) : state_(state) {
    const uint8_t ways = bytes.byte();
    context_ = ways % state.device.context_count();
    in_tasks_ = ways / 8 % 2 == 1;
    const uint32_t count = 1 + ways / 16 % kMostPairs;
    for (uint32_t i = 0; i < count; ++i) pairs_.push_back(make_pair(bytes));
    for (size_t i = 0; i < pairs_.size(); ++i)
      bench(i).take(pairs_[i], context(), state.device.covers(context_));
    if (!state.device.surveys(context_)) return;
    for (size_t i = 0; i < pairs_.size(); ++i) reserve_survey(i, bytes.byte());
  }

  void check() {
    first_frame();
    for (size_t i = 0; i < pairs_.size(); ++i) {
      exact_.push_back(pairs_[i].is_promised ? reference(pairs_[i].a, pairs_[i].b, pairs_[i])
                                             : Interval{});
      check_reports(i);
    }
    if (!survey_ways_.empty()) survey();
    finish();
    if (std::any_of(pairs_.begin(), pairs_.end(), [](const FuzzPair& p) { return p.later; }))
      second_frame();
    require(state_.device.device().validation_messages() == 0, "the validation layer is silent");
  }

 private:
  PairBench& bench(size_t i) { return *state_.benches[i]; }
  VkhContext context() const { return state_.device.context(context_); }

  VkhReport report(size_t i, uint32_t slot) {
    VkhReport report = bench(i).report(slot);
    if (state_.raises_lower && report.upper < 1e30f) report.lower += 0.01f * report.upper;
    return report;
  }

  VkhTask task(size_t i, uint32_t waves, uint32_t slot) {
    return {.size = sizeof(VkhTask),
            .mesh = nullptr,
            .scratch = nullptr,
            .problem = &bench(i).problem,
            .begin = VK_FALSE,
            .waves = waves,
            .reportBuffer = bench(i).report_buffer(),
            .reportOffset = bench(i).report_offset(slot),
            .statisticsBuffer = VK_NULL_HANDLE,
            .statisticsOffset = 0};
  }

  /// The work of vkhCmdRunTasks, by the single functions.
  void record(VkCommandBuffer commands, const VkhTask& t) {
    if (t.mesh != nullptr && t.scratch != nullptr) {
      vkhCmdBuildHierarchy(context(), commands, t.mesh, &t.problem->b, t.scratch, nullptr);
    } else if (t.mesh != nullptr) {
      vkhCmdRefitHierarchy(context(), commands, t.mesh, &t.problem->b, nullptr);
    }
    if (t.begin != VK_FALSE) vkhCmdBegin(context(), commands, t.problem, nullptr);
    if (t.waves > 0) vkhCmdAdvance(context(), commands, t.problem, t.waves, nullptr);
    vkhCmdWriteReport(context(), commands, t.problem, t.reportBuffer, t.reportOffset, nullptr);
  }

  void run(const std::vector<std::vector<VkhTask>>& steps) {
    state_.device.run([&](VkCommandBuffer commands) {
      for (const std::vector<VkhTask>& tasks : steps) {
        if (in_tasks_) {
          vkhCmdRunTasks(context(), commands, static_cast<uint32_t>(tasks.size()), tasks.data(),
                         nullptr);
        } else {
          for (const VkhTask& t : tasks) record(commands, t);
        }
      }
    });
    for (size_t i = 0; i < pairs_.size(); ++i)
      require(bench(i).is_untouched_around(), "nothing is written around the buffers");
  }

  void first_frame() {
    std::vector<VkhTask> start, more;
    for (size_t i = 0; i < pairs_.size(); ++i) {
      start.push_back(task(i, pairs_[i].first_waves, 0));
      start.back().mesh = &bench(i).b;
      start.back().scratch = &bench(i).scratch;
      start.back().begin = VK_TRUE;
      more.push_back(task(i, pairs_[i].more_waves, 1));
    }
    run({start, more});
  }

  void check_reports(size_t i) {
    if (!pairs_[i].is_promised) return;
    check_true(report(i, 0), pairs_[i], exact_[i]);
    check_true(report(i, 1), pairs_[i], exact_[i]);
    check_nested(report(i, 0), report(i, 1), pairs_[i], exact_[i]);
    if (state_.device.covers(context_)) check_coverage(bench(i).coverage());
  }

  /// Without bytes: A's faces are the cells.
  void reserve_survey(size_t i, uint8_t ways) {
    const uint32_t cells_a_face = 1 + ways % 8, width = ways / 32;
    bench(i).reserve_survey(context(), cells_a_face,
                            pairs_[i].tolerance * static_cast<float>(width));
    survey_ways_.push_back(ways);
  }

  uint32_t waves_of_survey(size_t i) const { return survey_ways_[i] / 8 % 4; }

  void record_survey_output(VkCommandBuffer commands, size_t i, uint32_t slot) {
    PairBench& b = bench(i);
    vkhCmdWriteSurvey(context(), commands, &b.problem, &b.survey, b.report_buffer(),
                      b.survey_offset(slot), nullptr);
    vkhCmdWriteSurveyFaces(context(), commands, &b.problem, &b.survey, b.report_buffer(),
                           b.survey_offset(slot) + sizeof(VkhSurveyReport), nullptr);
  }

  void survey() {
    state_.device.run([&](VkCommandBuffer commands) {
      for (size_t i = 0; i < pairs_.size(); ++i) {
        PairBench& b = bench(i);
        vkhCmdBeginSurvey(context(), commands, &b.problem, &b.survey, nullptr);
        record_survey_output(commands, i, 0);
        vkhCmdAdvanceSurvey(context(), commands, &b.problem, &b.survey, waves_of_survey(i),
                            nullptr);
        record_survey_output(commands, i, 1);
      }
    });
    for (size_t i = 0; i < pairs_.size(); ++i) {
      require(bench(i).is_untouched_around(), "surveys write nothing around their memory");
      check_survey_report(i, 0);
      check_survey_report(i, 1);
      if (pairs_[i].is_promised) check_face_errors(i);
    }
  }

  void check_survey_report(size_t i, uint32_t slot) {
    const VkhSurveyReport told = bench(i).survey_report(slot);
    const uint32_t faces = pairs_[i].a.face_count();
    require(told.status <= VKH_STATUS_MEMORY, "a survey's status is one");
    require(told.cells >= faces && told.cells <= bench(i).survey.capacity, "cells have room");
    require(told.waves <= slot * waves_of_survey(i), "waves were recorded");
    require(
        (told.open > 0) == (told.status == VKH_STATUS_RUNNING || told.status == VKH_STATUS_MEMORY),
        "a survey goes on where cells are open");
  }

  /// One face of A against the reference of that face alone, and the largest ends of all faces
  /// against that of A.
  void check_face_errors(size_t i) {
    const std::vector<float> before = bench(i).face_errors(0), after = bench(i).face_errors(1);
    const uint32_t faces = pairs_[i].a.face_count();
    float reached = 0, highest = 0;
    for (uint32_t face = 0; face < faces; ++face) {
      require(after[face] >= before[face] && after[faces + face] <= before[faces + face],
              "errors of faces only get narrower");
      reached = std::max(reached, after[face]);
      highest = std::max(highest, after[faces + face]);
    }
    check_error(reached, highest, exact_[i]);
    const uint32_t face = survey_ways_[i] % faces;
    FuzzMesh alone = pairs_[i].a;
    const auto corners = alone.corners.begin() + 3 * ptrdiff_t{face};
    alone.corners = {corners, corners + 3};
    check_error(after[face], after[faces + face], reference(alone, pairs_[i].b, pairs_[i]));
  }

  void check_error(float reached, float highest, const Interval& exact) {
    const double raised = state_.raises_lower ? 0.01 * double{highest} : 0.0;
    require(double{reached} + raised <= exact.upper, "some point of the faces is so far");
    require(double{highest} >= exact.lower, "no point of the faces is farther");
  }

  void check_coverage(const std::vector<uint64_t>& words) {
    const size_t faces = words.size() / 2;
    for (size_t f = 0; f < faces; ++f) {
      const uint64_t sum = words[f] + words[faces + f];
      require(sum == 0 || sum == uint64_t{1} << 40, "every part of a face is closed or open");
    }
  }

  /// A run ends for any coordinates.
  void finish() {
    for (uint32_t turn = 0; turn < kMostTurns; ++turn) {
      std::vector<VkhTask> going;
      for (size_t i = 0; i < pairs_.size(); ++i) {
        if (report(i, 1).status == VKH_STATUS_RUNNING && pairs_[i].has_end)
          going.push_back(task(i, kWavesOfTurn, 1));
      }
      if (going.empty()) break;
      run({going});
    }
    for (size_t i = 0; i < pairs_.size(); ++i) {
      const VkhReport last = report(i, 1);
      if (pairs_[i].is_promised) check_true(last, pairs_[i], exact_[i]);
      const bool is_stuck = last.status == VKH_STATUS_RUNNING && pairs_[i].has_end;
      if (is_stuck) print(last, pairs_[i], exact_[i]);
      require(!is_stuck, "the run ends");
    }
  }

  void second_frame() {
    std::vector<VkhTask> tasks;
    for (size_t i = 0; i < pairs_.size(); ++i) {
      if (!pairs_[i].later) continue;
      bench(i).move();
      tasks.push_back(task(i, pairs_[i].more_waves, 2));
      tasks.back().mesh = &bench(i).b;
      tasks.back().begin = VK_TRUE;
    }
    run({tasks});
    for (size_t i = 0; i < pairs_.size(); ++i) {
      const FuzzPair& pair = pairs_[i];
      if (pair.later && pair.is_promised)
        check_true(report(i, 2), pair, reference(pair.later_a, pair.later_b, pair));
    }
  }

  State& state_;
  size_t context_ = 0;
  bool in_tasks_ = false;
  std::vector<FuzzPair> pairs_;
  std::vector<uint32_t> survey_ways_;  // of each pair; none: the context has no surveys
  std::vector<Interval> exact_;
};

}  // namespace

// --contexts=N: only the first N, whose pipelines take seconds each.
extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
  constexpr std::string_view kOption = "--contexts=";
  size_t contexts = FuzzDevice::kMostContexts;
  for (int i = 1; i < *argc; ++i) {
    const std::string word = (*argv)[i];
    if (word.starts_with(kOption)) contexts = std::stoul(word.substr(kOption.size()));
  }
  try {
    g_state = new State(contexts);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "api_fuzz: not tested: %s\n", error.what());
    std::_Exit(77);
  }
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  FuzzBytes bytes(data, size);
  Run(*g_state, bytes).check();
  return 0;
}

extern "C" size_t LLVMFuzzerCustomMutator(uint8_t* data, size_t size, size_t max_size, unsigned) {
  return LLVMFuzzerMutate(data, size, max_size);
}
