// Surveys by waves: what is chosen follows from counts, a table's integers are what the cells say,
// the same bits come out however the work was cut, and whatever ends a survey leaves it true.
#include "host/survey/wave_survey.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <vector>

#include "host/base/parallel.h"
#include "host/solve/cell_corners.h"
#include "host/survey/shares_seen.h"
#include "host/survey/survey_with.h"
#include "shaders/math/parts.h"
#include "shaders/survey/score.h"
#include "tests/shapes/hard_pairs.h"
#include "tests/support/solver_bench.h"

namespace {

using namespace vkh;
using namespace vkh::test;

TEST_CASE("cells are chosen bin by bin, and of the last one the first") {
  std::vector<uint32_t> counts(gpu::kScoreBins, 0);
  counts[1000] = 100;  // an octave above the next
  counts[992] = 4000;
  counts[900] = 100000;
  const SurveyChoice none = choose_cells(counts, 0.9, 0);
  CHECK(none.count() == 0);
  const SurveyChoice few = choose_cells(counts, 0.9, 60);
  CHECK(few.bin == 1000);
  CHECK(few.above == 0);
  CHECK(few.ties == 60);
  const SurveyChoice some = choose_cells(counts, 0.9, 1000);
  CHECK(some.bin == 992);
  CHECK(some.above == 100);
  CHECK(some.ties == 900);
  // The two large bins have nearly all of the scores: whole bins are taken.
  const SurveyChoice all = choose_cells(counts, 0.5, 200000);
  CHECK(all.bin == 992);
  CHECK(all.above == 100);
  CHECK(all.ties == 4000);
  CHECK(choose_cells(std::vector<uint32_t>(gpu::kScoreBins, 0), 0.9, 1000).count() == 0);
}

TEST_CASE("edges ascend in both ends, and are no nearer than their thresholds") {
  Random random(1);
  std::vector<Threshold> at;
  for (int i = 0; i < 200; ++i) {
    const double d = random.unit();
    at.push_back({d - 0.1 * random.unit(), d + 0.1 * random.unit()});
  }
  const TallyEdges edges = edges_of(at);
  for (size_t k = 1; k < at.size(); ++k) {
    CHECK(edges.edges[k].down >= edges.edges[k - 1].down);
    CHECK(edges.edges[k].up >= edges.edges[k - 1].up);
  }
  for (size_t i = 0; i < at.size(); ++i) {
    const double down = static_cast<double>(edges.edges[edges.of[i].down].down);
    const double up = static_cast<double>(edges.edges[edges.of[i].up].up);
    CHECK(down <= at[i].down);
    CHECK(up >= at[i].up);
    CHECK(up - down <= at[i].up - at[i].down + 3e-7);
  }
}

TEST_CASE("a square that is rounded up is below the square of a tally's unit") {
  for (const float farthest :
       {0.0f, 0x1p-100f, 0x1p-60f, 0x1p-40f, 0x1p-30f, 0x1p-29f, 1e-6f, 2.0f}) {
    const double unit = std::ldexp(1.0, tally_unit(farthest) - 127);
    CHECK(static_cast<double>(farthest) < unit);
    CHECK(static_cast<double>(lib::round_up(farthest * farthest, 1)) < unit * unit);
  }
}

TEST_CASE("weights add up to nearly what can be, and their error covers what is rounded off") {
  Areas areas;
  Random random(2);
  for (int i = 0; i < 1000; ++i) areas.of_face.push_back(std::exp2(random.range(-80, 0)));
  for (const double area : areas.of_face) areas.whole += area;
  areas.error = 1e-13 * areas.whole;
  const AreaWeights weights = weights_of(areas);
  uint64_t whole = 0;
  double off = 0;
  const double unit = weights.whole / areas.whole;
  for (size_t i = 0; i < areas.of_face.size(); ++i) {
    whole += weights.of_face[i];
    off += std::abs(areas.of_face[i] * unit - static_cast<double>(weights.of_face[i]));
  }
  CHECK(static_cast<double>(whole) == weights.whole);
  CHECK(weights.whole >= 0x1p59);
  CHECK(weights.whole < 0x1p62);
  CHECK(weights.error >= 1e-13 * weights.whole);
  CHECK(weights.error <= 1.1e-13 * weights.whole + 2000);
  CHECK(off <= weights.error);
}

/// Compares to the last bit.
bool same(const Enclosure& x, const Enclosure& y) {
  return std::bit_cast<uint64_t>(x.lower) == std::bit_cast<uint64_t>(y.lower) &&
         std::bit_cast<uint64_t>(x.upper) == std::bit_cast<uint64_t>(y.upper);
}

TEST_CASE("what was seen of shares encloses any other, and the ends of percentiles") {
  // The share within d is d squared, up to 1, and is seen at random distances, more or less well.
  Random random(8);
  const auto truth = [](double d) { return std::min(std::max(d, 0.0) * std::max(d, 0.0), 1.0); };
  SharesSeen seen;
  CHECK(same(seen.within({0.5, 0.5}), {0, 1}));
  for (int round = 0; round < 50; ++round) {
    std::vector<Threshold> at;
    std::vector<Enclosure> shares;
    for (int i = 0; i < 20; ++i) {
      const double d = random.range(-0.1, 1.2), doubt = random.unit() / (1 + round);
      at.push_back({d - 0.001, d + 0.001});
      shares.push_back({std::max(truth(d - 0.001) - doubt * random.unit(), 0.0),
                        std::min(truth(d + 0.001) + doubt * random.unit(), 1.0)});
    }
    seen.add(at, shares);
    for (size_t i = 0; i < at.size(); ++i) {
      CHECK(seen.within(at[i]).lower >= shares[i].lower);
      CHECK(seen.within(at[i]).upper <= shares[i].upper);
    }
    for (int i = 0; i < 100; ++i) {
      const double d = random.range(-0.2, 1.3), p = random.unit();
      const Enclosure share = seen.within({d, d});
      CHECK(share.lower <= truth(d));
      CHECK(share.upper >= truth(d));
      const SharesSeen::Ends ends = seen.percentile(p, 0, 1.2);
      CHECK(ends.low <= std::sqrt(p));
      CHECK(ends.high >= std::sqrt(p));
      CHECK(ends.low <= ends.first);
      CHECK(ends.low <= ends.last);
      CHECK(std::max(ends.first, ends.last) <= ends.high);
    }
  }
  const SharesSeen::Ends ends = seen.percentile(0.5, 0, 1.2);
  CHECK(ends.high - ends.low < 0.1);
}

/// Runs a survey of its own on the pair, while it lies on the device.
void on_device(const Mesh& a, const Mesh& b, const UsePair& survey) {
  hold_pair(solver(), {a, b}, {}, survey);
}

SurveyOptions figures(std::vector<double> bands = {}) {
  SurveyOptions options;
  options.statistics = true;
  options.bands = std::move(bands);
  return options;
}

/// The shares that cells say in double, with the areas' integers.
struct Said {
  double surely = 0, perhaps = 0;
};

/// The share of a triangle on which the affine function with these values at its corners is at most
/// `t`.
double share_below(std::array<double, 3> at, double t) {
  std::sort(at.begin(), at.end());
  const auto& [least, middle, most] = at;
  if (t < least) return 0;
  if (t >= most) return 1;
  if (t < middle) return (t - least) / (middle - least) * ((t - least) / (most - least));
  return 1 - (most - t) / (most - middle) * ((most - t) / (most - least));
}

/// The share of its face that a cell has.
double share_of(const gpu::Cell& cell) {
  return std::ldexp(1.0, -static_cast<int>(lib::halvings_of(corners_of(cell))));
}

Said within(const CellsRead& cells, const AreaWeights& weights, const Threshold& at) {
  Said said;
  for (size_t i = 0; i < cells.cells.size(); ++i) {
    const gpu::Cell& cell = cells.cells[i];
    const gpu::CellBounds& b = cells.bounds[i];
    const double area =
        share_of(cell) * static_cast<double>(weights.of_face[cell.face]) / weights.whole;
    const bool is_all = at.down >= static_cast<double>(b.highest);
    said.surely += area * (is_all ? 1 : share_below({b.upper_a, b.upper_b, b.upper_c}, at.down));
    said.perhaps += area * share_below({b.lower_a, b.lower_b, b.lower_c}, at.up);
  }
  return said;
}

// The means that cells say in double.
Moments moments_said(const CellsRead& cells, const Areas& areas) {
  Moments sums{{0, 0}, {0, 0}};
  for (size_t i = 0; i < cells.cells.size(); ++i) {
    const gpu::CellBounds& b = cells.bounds[i];
    const double area = share_of(cells.cells[i]) * areas.of_face[cells.cells[i].face] / areas.whole;
    const lib::vec3 lower(b.lower_a, b.lower_b, b.lower_c);
    const auto highest = static_cast<double>(b.highest), mean = static_cast<double>(b.mean_upper);
    const double middle = (static_cast<double>(b.lower_a) + static_cast<double>(b.lower_b) +
                           static_cast<double>(b.lower_c)) /
                          3;
    sums.mean.lower += area * std::max(middle, static_cast<double>(lib::mean_over_down(lower)));
    sums.mean.upper += area * mean;
    sums.rms.lower += area * static_cast<double>(lib::square_over_down(lower));
    sums.rms.upper += area * std::min(static_cast<double>(b.square_upper), highest * mean);
  }
  return {sums.mean, {std::sqrt(sums.rms.lower), std::sqrt(sums.rms.upper)}};
}

TEST_CASE("a tally is what the cells say, as near as floats tell, and outside of it") {
  const auto check = [](const Mesh& a, const Mesh& b) {
    on_device(a, b, [&](const SurveyedPair& pair) {
      const Areas areas = areas_of(a);
      const AreaWeights weights = weights_of(areas);
      SurveyOptions options = figures();
      SurveyMeter meter(options, pair.on_cpu, false);
      WaveSurvey waves(pair, areas, meter, 4);
      FigureGoals goals(options, pair, waves.farthest());
      waves.refine(goals, 5000);
      std::vector<Threshold> at;
      for (int k = 0; k < 600; ++k) at.push_back({k / 400.0, k / 400.0 + 1e-4});  // three tallies
      constexpr double kAny = std::numeric_limits<double>::infinity();
      const Tallied tallied = waves.tally({at, Threshold{kAny, kAny}});
      const auto& [shares, moments] = std::pair(tallied.shares, tallied.moments);
      const CellsRead cells = waves.read({0, static_cast<uint32_t>(waves.count())});
      CHECK(cells.cells.size() > a.faces.size());
      for (size_t k = 0; k < at.size(); k += 7) {
        const Said said = within(cells, weights, at[k]);
        CHECK(shares[k].lower <= said.surely + 1e-12);
        CHECK(shares[k].upper >= said.perhaps - 1e-12);
        CHECK(shares[k].lower >= said.surely - 1e-5);
        CHECK(shares[k].upper <= said.perhaps + 1e-5);
      }
      const Moments of_store = moments_said(cells, areas);
      CHECK(moments.mean.lower >= of_store.mean.lower - 1e-6);
      CHECK(moments.mean.upper == doctest::Approx(of_store.mean.upper).epsilon(1e-6));
      CHECK(moments.rms.lower >= of_store.rms.lower - 1e-6);
      CHECK(moments.rms.upper == doctest::Approx(of_store.rms.upper).epsilon(1e-6));
      double area = 0;
      for (const gpu::Cell& cell : cells.cells) area += share_of(cell) * areas.of_face[cell.face];
      CHECK(area == doctest::Approx(areas.whole).epsilon(1e-12));
    });
  };
  check(icosphere(1, 2), translated(icosphere(1.1, 3), {0.1, 0.2, 0.05}));
  check(height_field(12, 1), height_field(12, 3));
  check(soup(1, 60), soup(2, 90));
}

void check_same(const SurveyResult& x, const SurveyResult& y) {
  CHECK(x.cells == y.cells);
  CHECK(x.bounded == y.bounded);
  CHECK(x.ended == y.ended);
  CHECK(x.field.lower == y.field.lower);
  CHECK(x.field.upper == y.field.upper);
  REQUIRE(x.statistics);
  REQUIRE(y.statistics);
  CHECK(same(x.statistics->mean, y.statistics->mean));
  CHECK(same(x.statistics->rms, y.statistics->rms));
  for (size_t i = 0; i < x.statistics->bands.size(); ++i)
    CHECK(same(x.statistics->bands[i].share, y.statistics->bands[i].share));
  for (size_t i = 0; i < x.statistics->percentiles.size(); ++i)
    CHECK(same(x.statistics->percentiles[i].distance, y.statistics->percentiles[i].distance));
  for (size_t i = 0; i < x.statistics->curve.size(); ++i)
    CHECK(same(x.statistics->curve[i].share, y.statistics->curve[i].share));
}

TEST_CASE("the same bits, whatever the submissions, the threads and the room at the start") {
  const Mesh a = soup(1, 150), b = soup(2, 220);
  SurveyOptions options = figures({0.005, 0.01, 0.02, 0.03});
  options.area_tolerance = 1e-9;
  const SurveyResult first = surveyed(a, b, options);
  CHECK(first.cells > 33'000);  // more than there is room for at first
  for (const size_t threads : {1, 2}) {
    limit_threads(threads);
    for (const double submission_ms : {2.0, 1e9}) {
      options.submission_ms = submission_ms;
      check_same(surveyed(a, b, options), first);
    }
  }
  limit_threads(0);
}

TEST_CASE("a survey that is called off anywhere is true") {
  const Mesh a = square_patch(4, 0.25), b = square_patch(3, 0.0);
  for (int calls = 0; calls < 12; ++calls) {
    CAPTURE(calls);
    SurveyOptions options = figures({0.2, 0.3});
    options.mean_tolerance = 1e-9;
    options.submission_ms = 0.01;
    int left = calls;
    options.goes_on = [&](size_t) { return left-- > 0; };
    const SurveyResult r = surveyed(a, b, options);
    CHECK((r.ended == SurveyEnd::kCancelled || r.ended == SurveyEnd::kBits || r.is_met()));
    REQUIRE(r.statistics);
    CHECK(r.statistics->mean.lower <= 0.25);
    CHECK(r.statistics->mean.upper >= 0.25);
    CHECK(r.statistics->bands[0].share.lower == 0);
    CHECK(r.statistics->bands[1].share.upper == 1);
    for (size_t f = 0; f < r.field.face_count(); ++f) {
      CHECK(r.field.lower[f] <= 0.25);
      CHECK(r.field.upper[f] >= 0.25);
    }
  }
}

/// Cells of a device that has room for no more than so many, or that stops getting memory.
class ShortOfRoom : public SurveyCells {
 public:
  ShortOfRoom(SurveyCells& cells, size_t most, int splits)
      : cells_(cells), most_(most), splits_(splits) {}
  void begin(std::span<const uint64_t> weights, float farthest) override {
    cells_.begin(weights, farthest);
  }
  size_t count() const override { return cells_.count(); }
  size_t most() const override { return std::min(most_, cells_.most()); }
  std::span<const uint32_t> score(const gpu::SurveyPlan& plan, const CellRange& some) override {
    return cells_.score(plan, some);
  }
  bool split(const SurveyChoice& choice) override {
    CHECK(count() + 3 * choice.count() <= most_);
    return splits_-- > 0 && cells_.split(choice);
  }
  void bound(size_t first, size_t count, bool wait) override { cells_.bound(first, count, wait); }
  const gpu::SurveyTable& tally(const gpu::SurveyPlan& plan, int unit,
                                const CellRange& some) override {
    return cells_.tally(plan, unit, some);
  }
  void find_sides(const SideSearch& search, float above, const CellRange& some) override {
    cells_.find_sides(search, above, some);
  }
  void begin_normals(const NormalSearch& search) override { cells_.begin_normals(search); }
  void find_normals(const CellRange& some) override { cells_.find_normals(some); }
  std::vector<float> faces(uint32_t reached_classes, uint32_t highest_classes) override {
    return cells_.faces(reached_classes, highest_classes);
  }
  CellsRead read(const CellRange& some) override { return cells_.read(some); }
  void write(const CellRange& some, std::span<const gpu::CellBounds> bounds) override {
    cells_.write(some, bounds);
  }

 private:
  SurveyCells& cells_;
  const size_t most_;
  int splits_;
};

TEST_CASE("a survey that gets no more room ends there, and is true") {
  const Mesh a = icosphere(1, 2), b = translated(icosphere(1.1, 3), {0.1, 0.2, 0.05});
  const SurveyResult whole = surveyed(a, b, figures({0.2}));
  REQUIRE(whole.is_met());
  const auto check = [&](size_t most, int splits) {
    SurveyResult r;
    const SurveyOptions options = figures({0.2});
    on_device(a, b, [&](const SurveyedPair& pair) {
      ShortOfRoom cells(*pair.cells, most, splits);
      SurveyedPair other = pair;
      other.cells = &cells;
      survey_with(options, r)(other);
    });
    CHECK(r.ended == SurveyEnd::kMemory);
    CHECK(r.cells <= most);
    REQUIRE(r.statistics);
    CHECK(r.statistics->mean.lower <= whole.statistics->mean.upper);
    CHECK(r.statistics->mean.upper >= whole.statistics->mean.lower);
    CHECK(FiguresAsked::width(r.statistics->mean) > FiguresAsked::width(whole.statistics->mean));
  };
  check(a.faces.size(), 1000);
  check(a.faces.size() + 300, 1000);
  check(1'000'000, 0);
  check(1'000'000, 1);
}

TEST_CASE("a surface from itself: every figure is nought") {
  const Mesh a = square_patch(1, 0.0);
  SurveyOptions options = figures({0.1});
  options.upper = 0;
  const SurveyResult r = surveyed(a, a, options);
  CHECK(r.is_met());
  REQUIRE(r.statistics);
  for (const Enclosure& e : {r.statistics->mean, r.statistics->rms}) {
    CHECK(e.lower == 0);
    CHECK(e.upper == 0);
  }
  CHECK(r.statistics->bands[0].share.lower == 1);
  for (const Percentile& p : r.statistics->percentiles) CHECK(p.distance.upper == 0);
}

TEST_CASE("the effort is kept, and what is left over is less than a split") {
  const Mesh a = icosphere(1, 2), b = translated(icosphere(1.1, 3), {0.1, 0.2, 0.05});
  for (const size_t effort : {0, 1, 3, 4, 7, 50, 1001, 4000}) {
    SurveyOptions options = figures();
    options.mean_tolerance = 1e-9;
    options.effort = effort;
    const SurveyResult r = surveyed(a, b, options);
    CHECK(r.ended == SurveyEnd::kEffort);
    CHECK(r.bounded == a.faces.size() + effort / 4 * 4);
    CHECK(r.cells == a.faces.size() + effort / 4 * 3);
  }
}

TEST_CASE("hard pairs: figures by waves meet those of the host's cells") {
  for (size_t i = 0; i < family_names().size(); ++i) {
    CAPTURE(family_names()[i]);
    const HardPair hard = hard_pair(i, 700 + i);
    SurveyOptions options = figures({0.01, 0.1, 1});
    options.effort = 20000;
    const SurveyResult waves = surveyed(hard.pair.a, hard.pair.b, options);
    options.normals_within = 30;  // for which the host refines
    options.effort = 40000;
    const SurveyResult host = surveyed(hard.pair.a, hard.pair.b, options);
    REQUIRE(waves.statistics.has_value() == host.statistics.has_value());
    if (!waves.statistics) continue;
    const auto meet = [](const Enclosure& x, const Enclosure& y) {
      CHECK(x.lower <= y.upper);
      CHECK(y.lower <= x.upper);
    };
    const Statistics &x = *waves.statistics, &y = *host.statistics;
    meet(x.mean, y.mean);
    meet(x.rms, y.rms);
    for (size_t k = 0; k < x.bands.size(); ++k) meet(x.bands[k].share, y.bands[k].share);
    for (size_t k = 0; k < x.percentiles.size(); ++k)
      meet(x.percentiles[k].distance, y.percentiles[k].distance);
    CHECK(x.curve.back().share.upper == 1);
  }
}

}  // namespace
