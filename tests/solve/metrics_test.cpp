// Metrics by name: formulas against exact arithmetic, closed forms, and generated pairs whose
// distributions are known exactly. VKH_METRICS_PAIRS: how many pairs (nightly: 5000).
#include "vkhausdorff/metrics.h"

#include <doctest/doctest.h>
#include <gmpxx.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <glm/vec2.hpp>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <vector>

#include "host/answer/exit_code.h"
#include "host/solve/held_pairs.h"
#include "host/survey/metrics_of.h"
#include "host/survey/surveying.h"
#include "tests/shapes/shapes.h"
#include "tests/support/sanitized.h"
#include "tests/support/solver_bench.h"
#include "vkhausdorff/asking.h"
#include "vkhausdorff/error.h"
#include "vkhausdorff/length.h"

namespace {

using namespace vkh;
using namespace vkh::test;

Answer answered(Question question, const Mesh& a, const Mesh& b) {
  Solver* const on[] = {&solver()};
  return Asking(question, std::make_shared<const ReadMesh>(a), std::make_shared<const ReadMesh>(b),
                on)
      .answer();
}

Metrics metrics_between(const Mesh& a, const Mesh& b, double percentile,
                        const std::vector<double>& bands, std::optional<size_t> effort = {},
                        std::optional<double> normals = {}) {
  Question question;
  question.tolerance = {.requested = "1e-4", .number = 1e-4};
  question.metrics = MetricsOptions{.percentile = percentile, .normals = normals};
  for (const double band : bands)
    question.bands.push_back(
        {.requested = "", .number = band, .of = Length::Of::kFiles, .is_double = true});
  question.budget.effort = effort;
  return *answered(question, a, b).metrics;
}

// Truths are computed in double, which is off by less.
constexpr double kOff = 1e-12;

bool encloses(const Enclosure& e, double truth) {
  const bool has_estimate = e.estimate && *e.estimate >= e.lower && *e.estimate <= e.upper;
  return e.lower <= truth * (1 + kOff) && e.upper >= truth * (1 - kOff) && has_estimate;
}

// --- Formulas ---

mpq_class exact(double x) { return mpq_class(x); }

// Numbers of all sizes, zeros and ones among them.
double any_number(Random& random, int smallest) {
  const double kind = random.unit();
  if (kind < 0.1) return 0;
  if (kind < 0.2) return 1;
  return std::ldexp(random.unit(), -static_cast<int>(random.unit() * smallest));
}

Enclosure any_interval(Random& random, int smallest, double most) {
  const double x = std::min(any_number(random, smallest), most);
  const double y = std::min(any_number(random, smallest), most);
  return {std::min(x, y), std::max(x, y)};
}

// A rational number in the interval, often an end.
mpq_class within(Random& random, const Enclosure& e) {
  const double t = random.unit();
  if (t < 0.2) return exact(e.lower);
  if (t < 0.4) return exact(e.upper);
  return exact(e.lower) + exact(t) * (exact(e.upper) - exact(e.lower));
}

TEST_CASE("weighted means, harmonic means and weights enclose what exact arithmetic says") {
  Random random(31);
  for (int i = 0; i < 20000; ++i) {
    const int smallest = i % 2 == 0 ? 60 : 1060;
    const Enclosure w = any_interval(random, 60, 1), x = any_interval(random, smallest, 1);
    const Enclosure y = any_interval(random, smallest, 1);
    const mpq_class at_w = within(random, w), p = within(random, x), q = within(random, y);
    const Enclosure mean = weighted(w, x, y);
    const mpq_class truth = at_w * p + (1 - at_w) * q;
    REQUIRE(exact(mean.lower) <= truth);
    REQUIRE(exact(mean.upper) >= truth);
    const Enclosure harmonic = harmonic_mean(x, y);
    const mpq_class f1 = p + q == 0 ? mpq_class(0) : mpq_class(2 * p * q / (p + q));
    REQUIRE(exact(harmonic.lower) <= f1);
    REQUIRE(exact(harmonic.upper) >= f1);
    if (!(x.lower > 0 && y.lower > 0)) continue;
    const Enclosure weight = weight_of(x, y);
    const mpq_class part = p / (p + q);
    REQUIRE(exact(weight.lower) <= part);
    REQUIRE(exact(weight.upper) >= part);
  }
}

TEST_CASE("weighted root mean squares enclose what exact arithmetic says, at any scale") {
  Random random(37);
  for (int i = 0; i < 20000; ++i) {
    const int scale = static_cast<int>(random.unit() * 2000) - 1000;
    const auto scaled_by = [&](Enclosure e) {
      return Enclosure{std::ldexp(e.lower, scale), std::ldexp(e.upper, scale)};
    };
    const Enclosure w = any_interval(random, 60, 1);
    const Enclosure x = scaled_by(any_interval(random, 60, 1));
    const Enclosure y = scaled_by(any_interval(random, 60, 1));
    const mpq_class at_w = within(random, w), p = within(random, x), q = within(random, y);
    const mpq_class square = at_w * p * p + (1 - at_w) * q * q;
    const Enclosure e = weighted_rms(w, x, y);
    REQUIRE(exact(e.lower) * exact(e.lower) <= square);
    REQUIRE(exact(e.upper) * exact(e.upper) >= square);
  }
}

TEST_CASE("exact numbers stay exact") {
  const Enclosure w{0.3, 0.4}, one{1, 1, 1.0}, zero{0, 0, 0.0}, quarter{0.25, 0.25, 0.25};
  for (const Enclosure& e : {weighted(w, one, one), harmonic_mean(one, one)}) {
    CHECK(e.lower == 1);
    CHECK(e.upper == 1);
  }
  for (const Enclosure& e :
       {weighted(w, zero, zero), harmonic_mean(zero, one), weighted_rms(w, zero, zero)}) {
    CHECK(e.lower == 0);
    CHECK(e.upper == 0);
  }
  CHECK(weighted_rms(w, quarter, quarter).lower == 0.25);
  CHECK(weighted_rms(w, quarter, quarter).upper == 0.25);
}

// --- Closed forms ---

TEST_CASE("two parallel patches: every length is their distance") {
  const Metrics m = metrics_between(square_patch(4, 0.25), square_patch(3, 0.0), 95, {0.2, 0.3});
  CHECK(m.is_met());
  for (const Metric* metric : {&m.hausdorff, &m.hd_p, &m.hd_p_pooled, &m.masd, &m.assd, &m.rms})
    CHECK(encloses(metric->value, 0.25));
  CHECK(encloses(m.chamfer_l1.value, 0.5));
  CHECK(encloses(m.chamfer_l2.value, 0.125));
  for (const NamedShare& share : kNamedShares) {
    if (share.of_normals) continue;
    CHECK((m.within[0].*share.figure).value.upper == 0);
    CHECK((m.within[1].*share.figure).value.lower == 1);
  }
}

TEST_CASE("a share exactly at the distance is a jump, and does not meet its goal") {
  const Metrics m = metrics_between(square_patch(4, 0.25), square_patch(3, 0.0), 95, {0.25}, 20000);
  CHECK(m.within[0].nsd.value.upper == 1);
  CHECK(m.within[0].nsd.jump);
  CHECK_FALSE(m.is_met());
}

TEST_CASE("a surface and itself: every length is 0 and every share 1, exactly") {
  const Mesh a = noisy(icosphere(1.0, 2), 0.05, 3);
  const Metrics m = metrics_between(a, a, 95, {1e-3});
  CHECK(m.is_met());
  for (const NamedMetric& metric : kNamedMetrics) {
    if (metric.of_normals) continue;
    CAPTURE(metric.name);
    CHECK((m.*metric.figure).value.lower == 0);
    CHECK((m.*metric.figure).value.upper == 0);
  }
  for (const NamedShare& share : kNamedShares) {
    if (share.of_normals) continue;
    CHECK((m.within[0].*share.figure).value.lower == 1);
    CHECK((m.within[0].*share.figure).value.upper == 1);
  }
}

// --- Generated pairs ---

// A part of a pair: distances from 0 to `most`, evenly, or `most` everywhere, over an area.
struct Even {
  double most = 0, area = 0;
  bool is_flat = false;
  double slope = 0;  // of its normals to those of the other surface

  bool agrees(double degrees) const { return std::atan(slope) * 180 / std::numbers::pi <= degrees; }
  double cosine() const { return 1 / std::sqrt(1 + slope * slope); }

  double within(double t) const {
    if (is_flat) return t >= most ? 1 : 0;
    return std::clamp(t / most, 0.0, 1.0);
  }
  double mean() const { return is_flat ? most : most / 2; }
  double square() const { return is_flat ? most * most : most * most / 3; }
};

struct Distributed {
  std::vector<Even> parts;

  double area() const {
    double sum = 0;
    for (const Even& part : parts) sum += part.area;
    return sum;
  }
  template <class Of>
  double mean_of(const Of& of) const {
    double sum = 0;
    for (const Even& part : parts) sum += part.area * of(part);
    return sum / area();
  }
  double within(double t) const {
    return mean_of([&](const Even& part) { return part.within(t); });
  }
  double agreeing(double t, double degrees) const {
    return mean_of([&](const Even& part) { return part.agrees(degrees) ? part.within(t) : 0.0; });
  }
  double cosine() const {
    return mean_of([](const Even& part) { return part.cosine(); });
  }
  double mean() const {
    return mean_of([](const Even& part) { return part.mean(); });
  }
  double square() const {
    return mean_of([](const Even& part) { return part.square(); });
  }
  double largest() const {
    double most = 0;
    for (const Even& part : parts) most = std::max(most, part.most);
    return most;
  }
  double percentile(double share) const {
    double low = 0, high = largest();
    for (int i = 0; i < 200; ++i) {
      const double middle = (low + high) / 2;
      (within(middle) >= share ? high : low) = middle;
    }
    return high;
  }
};

struct DistributedPair {
  Mesh a, b;
  Distributed of_a, of_b;
};

// A rectangle of n x m quads: x from 0 to `length` along (dx, dz), y from 0 to `width`.
Mesh sheet(const glm::dvec3& from, const glm::dvec2& along, double width, uint32_t n, uint32_t m) {
  Mesh mesh;
  for (uint32_t i = 0; i <= n; ++i) {
    for (uint32_t j = 0; j <= m; ++j)
      mesh.vertices.emplace_back(from.x + along.x * i / n, from.y + width * j / m,
                                 from.z + along.y * i / n);
  }
  for (uint32_t i = 0; i < n; ++i) {
    for (uint32_t j = 0; j < m; ++j) {
      const uint32_t at = i * (m + 1) + j;
      mesh.faces.push_back({at, at + m + 1, at + m + 2});
      mesh.faces.push_back({at, at + m + 2, at + 1});
    }
  }
  return mesh;
}

uint32_t few(Random& random) { return 1 + static_cast<uint32_t>(random.unit() * 4); }

// A wedge: A rises from B's edge with slope s, over `length`; B reaches to the foot of A's upper
// edge, at length (1 + s^2). In the plane across, each distance is to the line of the other one:
// s x for A at x, and s x / sqrt(1 + s^2) for B.
void add_wedge(Random& random, double slope, double offset, DistributedPair& pair) {
  const double s = slope, length = 0.2 + random.unit();
  const double width = 0.2 + random.unit(), root = std::sqrt(1 + s * s);
  const glm::dvec3 from{offset, 0, 0};
  pair.a = joined(pair.a, sheet(from, {length, s * length}, width, few(random), few(random)));
  pair.b = joined(pair.b, sheet(from, {length * (1 + s * s), 0}, width, few(random), few(random)));
  pair.of_a.parts.push_back({s * length, length * root * width, false, s});
  pair.of_b.parts.push_back({s * length * root, length * (1 + s * s) * width, false, s});
}

// Two equal rectangles at a height: one distance everywhere.
void add_stack(Random& random, double offset, DistributedPair& pair) {
  const double length = 0.2 + random.unit(), width = 0.2 + random.unit(), height = random.unit();
  pair.a = joined(pair.a, sheet({offset, 0, height}, {length, 0}, width, few(random), few(random)));
  pair.b = joined(pair.b, sheet({offset, 0, 0}, {length, 0}, width, few(random), few(random)));
  pair.of_a.parts.push_back({height, length * width, true});
  pair.of_b.parts.push_back({height, length * width, true});
}

// Rises of up to 3: B's distances are then up to three times A's.
double any_slope(Random& random) {
  return random.unit() < 0.8 ? random.range(0.05, 0.95) : random.range(0.95, 3);
}

// Islands so far apart that none is nearer to another one.
DistributedPair distributed_pair(Random& random) {
  DistributedPair pair;
  const int count = 1 + static_cast<int>(random.unit() * 4);
  for (int i = 0; i < count; ++i) {
    if (random.unit() < 0.75) {
      add_wedge(random, any_slope(random), 40.0 * i, pair);
    } else {
      add_stack(random, 40.0 * i, pair);
    }
  }
  const double angle = 6 * random.unit();
  for (Mesh* mesh : {&pair.a, &pair.b}) *mesh = rotated(*mesh, {1, 2, 3}, angle);
  return pair;
}

double harmonic(double x, double y) { return x + y > 0 ? 2 * x * y / (x + y) : 0; }

// Counts the figures that do not enclose the truth.
int violations(const Metrics& m, const Distributed& a, const Distributed& b, double share) {
  Distributed both = a;
  both.parts.insert(both.parts.end(), b.parts.begin(), b.parts.end());
  int wrong = 0;
  const auto check = [&](const Metric& metric, double truth, const char* name) {
    CAPTURE(name);
    CAPTURE(truth);
    CAPTURE(metric.value.lower);
    CAPTURE(metric.value.upper);
    const bool holds = encloses(metric.value, truth);
    CHECK(holds);
    wrong += holds ? 0 : 1;
  };
  check(m.hausdorff, std::max(a.largest(), b.largest()), "hausdorff");
  check(m.hd_p, std::max(a.percentile(share), b.percentile(share)), "hd_p");
  check(m.hd_p_pooled, both.percentile(share), "hd_p_pooled");
  check(m.masd, (a.mean() + b.mean()) / 2, "masd");
  check(m.assd, both.mean(), "assd");
  check(m.rms, std::sqrt(both.square()), "rms");
  check(m.chamfer_l1, a.mean() + b.mean(), "chamfer_l1");
  check(m.chamfer_l2, a.square() + b.square(), "chamfer_l2");
  for (const MetricsWithin& at : m.within) {
    const double precision = a.within(at.distance), recall = b.within(at.distance);
    check(at.nsd, both.within(at.distance), "nsd");
    check(at.precision, precision, "precision");
    check(at.recall, recall, "recall");
    check(at.f1, harmonic(precision, recall), "f1");
    const double own = a.agreeing(at.distance, *m.normals);
    const double others = b.agreeing(at.distance, *m.normals);
    check(at.precision_normals, own, "precision_normals");
    check(at.recall_normals, others, "recall_normals");
    check(at.f1_normals, harmonic(own, others), "f1_normals");
  }
  check(m.normal_consistency, (a.cosine() + b.cosine()) / 2, "normal_consistency");
  return wrong;
}

size_t pair_count() {
  const char* asked = std::getenv("VKH_METRICS_PAIRS");
  return asked == nullptr ? (kIsSanitized ? 20 : 150) : std::strtoul(asked, nullptr, 10);
}

TEST_CASE("generated pairs with exact distributions: every figure is enclosed") {
  Random random(2024);
  int wrong = 0;
  size_t met = 0, wedges = 0;
  for (size_t i = 0; i < pair_count(); ++i) {
    CAPTURE(i);
    const DistributedPair pair = distributed_pair(random);
    const double percentile = 50 + 49 * random.unit();
    const double t = 0.05 + 0.4 * random.unit();
    const double degrees = 5 + 80 * random.unit();
    const Metrics m = metrics_between(pair.a, pair.b, percentile, {t}, 20000, degrees);
    wrong += violations(m, pair.of_a, pair.of_b, percentile / 100);
    const bool is_even = std::none_of(pair.of_a.parts.begin(), pair.of_a.parts.end(),
                                      [](const Even& part) { return part.is_flat; });
    wedges += is_even ? 1 : 0;
    met += is_even && m.is_met() ? 1 : 0;
  }
  CHECK(wrong == 0);
  MESSAGE(met, " of ", wedges, " pairs without jumps met all goals");
  CHECK(met * 10 >= wedges * 8);
}

// --- Answers ---

Answer answered(const Mesh& a, const Mesh& b, double percentile = 95) {
  Question question;
  question.metrics.emplace().percentile = percentile;
  return answered(question, a, b);
}

/// Both surveys of a pair on the device, with a percentile each.
struct Both {
  Both(std::span<const SurveyedPair> pairs, const SurveyOptions& options, const SymmetricReport& r)
      : in_a(pairs[0], options), in_b(pairs[1], options), report(r) {
    in_a.run(a);
    in_b.run(b);
  }
  Metrics metrics() {
    const Distribution of_a = in_a.distribution(), of_b = in_b.distribution();
    return metrics_of({.percentile = 30}, {report.a_to_b, *a.statistics, of_a},
                      {report.b_to_a, *b.statistics, of_b});
  }
  Surveying in_a, in_b;
  const SymmetricReport& report;
  SurveyResult a, b;
};

void narrow_pooled(const Mesh& a, const Mesh& b, const SurveyOptions& options) {
  const SymmetricReport report = solver().symmetric(a, b);
  const PairView views[] = {{.a = a, .b = b}, {.a = b, .b = a}};
  const Enclosure narrow = metrics_between(a, b, 30, {}).hd_p_pooled.value;
  hold_pairs(solver(), views, {}, [&](std::span<const SurveyedPair> pairs) {
    Both both(pairs, options, report);
    const Metrics wide = both.metrics();
    REQUIRE_FALSE(wide.hd_p_pooled.is_met);
    Enclosure known = wide.hd_p_pooled.value;
    for (int turn = 0; turn < 6 && !both.metrics().hd_p_pooled.is_met; ++turn) {
      const Distribution of_a = both.in_a.distribution(), of_b = both.in_b.distribution();
      const bool back = of_b.undecided_area(known) > of_a.undecided_area(known);
      const PooledSearch search{.other = back ? &of_a : &of_b, .share = 0.3, .known = known};
      const size_t before = back ? both.b.bounded : both.a.bounded;
      CHECK((back ? both.in_b : both.in_a).narrow(search, 60, back ? both.b : both.a));
      CHECK((back ? both.b.bounded : both.a.bounded) > before);
      known = both.metrics().hd_p_pooled.value;
      CHECK(known.lower >= wide.hd_p_pooled.value.lower);
      CHECK(known.upper <= wide.hd_p_pooled.value.upper);
    }
    CHECK(both.metrics().hd_p_pooled.is_met);
    // The same, by surveys that were narrow from the start.
    CHECK(known.lower <= narrow.upper);
    CHECK(known.upper >= narrow.lower);
  });
}

// A map's search for sides, and a comparison of normals, end before: what they named is gone.
TEST_CASE("a survey that goes on for the pooled percentile narrows it, and stays true") {
  SurveyOptions options;
  options.percentiles = {0.3};
  options.mean_tolerance = 0.5;
  options.statistics = true;
  const Mesh a = cube(1.0), b = icosphere(1.3, 3);
  narrow_pooled(a, b, options);
  options.map = MapOptions{.pixels = 2, .sides_if_cheap = true};
  narrow_pooled(a, b, options);
  options.map.reset();
  options.normals_within = 20;
  options.cosine_tolerance = 1;
  narrow_pooled(a, b, options);
}

TEST_CASE("a pooled percentile in a gap of the distribution is a jump, and costs no effort") {
  const auto stacks = [](double low, double high) {
    return joined(sheet({0, 0, low}, {1, 0}, 1, 2, 2), sheet({40, 0, high}, {1, 0}, 1, 2, 2));
  };
  const Answer answer = answered(stacks(0.1, 0.3), stacks(0, 0), 50);
  const Metric& pooled = answer.metrics->hd_p_pooled;
  CHECK(pooled.value.lower <= 0.1);
  CHECK(pooled.value.upper >= 0.1);
  if (!pooled.is_met) CHECK(pooled.jump);
  CHECK(answer.survey_a->bounded + answer.survey_b->bounded < 100000);
}

TEST_CASE("a question for metrics is of both directions, and its code is whether all are met") {
  const Answer answer = answered(square_patch(4, 0.25), square_patch(3, 0.0));
  REQUIRE(answer.metrics);
  CHECK(answer.b_to_a);
  CHECK(answer.command == "metrics");
  CHECK(answer.metrics->is_met());
  CHECK(code_of(answer) == kExitClosed);
  CHECK(to_json(answer_from_json(to_json(answer))) == to_json(answer));
}

/// Metrics within 0.03, and of normals that agree within so many degrees.
Answer asked(const Mesh& a, const Mesh& b, std::vector<std::string> figures,
             std::optional<double> normals = {}) {
  Question question;
  question.metrics = MetricsOptions{.percentile = 90, .normals = normals};
  question.metrics->figures = std::move(figures);
  question.bands = {parse_length("--bands", "0.03abs", PlainNumber::kRefused)};
  return answered(question, a, b);
}

/// Checks each figure against the same among all: it meets that, and is as narrow if it was asked
/// for.
void check_beside(const Metrics& few, const Metrics& whole) {
  const auto check = [&](const char* name, const Metric& one, const Metric& among, double enough) {
    CAPTURE(name);
    const Enclosure &e = one.value, &all = among.value;
    CHECK(e.lower <= all.upper);
    CHECK(e.upper >= all.lower);
    if (!few.asks_for(name)) return;
    CHECK(e.upper - e.lower <= std::max(enough, all.upper - all.lower));
    CHECK((one.is_met || !among.is_met));
  };
  for (const NamedMetric& m : kNamedMetrics) {
    if (m.of_normals && !few.normals) continue;
    check(m.name, few.*m.figure, whole.*m.figure, 0.041 * (whole.*m.figure).value.upper);
  }
  for (const NamedShare& share : kNamedShares) {
    if (share.of_normals && !few.normals) continue;
    check(share.name, few.within[0].*share.figure, whole.within[0].*share.figure, 0.00101);
  }
}

TEST_CASE("figures that are asked for alone are true, and as narrow as they are among all") {
  const Mesh a = noisy(square_patch(4, 0), 0.1, 1), b = noisy(square_patch(5, 0), 0.1, 2);
  const Answer whole = asked(a, b, {});
  std::vector<std::vector<std::string>> subsets = {{"hd_p", "f1"},
                                                   {"hausdorff", "hd_p"},
                                                   {"hd_p_pooled", "recall"},
                                                   {"masd", "chamfer_l2", "nsd"},
                                                   {"rms", "hd_p_pooled", "precision", "f1"}};
  for (const NamedMetric& metric : kNamedMetrics)
    if (!metric.of_normals) subsets.push_back({metric.name});
  for (const NamedShare& share : kNamedShares)
    if (!share.of_normals) subsets.push_back({share.name});
  for (const std::vector<std::string>& names : subsets)
    check_beside(*asked(a, b, names).metrics, *whole.metrics);
}

// Two roofs that differ in their slopes: where the closest faces change, normals stay open for
// long on hills.
TEST_CASE("figures of normals alone are as narrow, too") {
  const auto roof = [](double height) {
    return joined(sheet({0, 0, 0}, {0.5, height}, 1, 1, 1),
                  sheet({0.5, 0, height}, {0.5, -height}, 1, 1, 1));
  };
  const Mesh a = roof(0.25), b = roof(0.3125);
  const Answer whole = asked(a, b, {}, 2);
  CHECK(whole.metrics->is_met());
  for (const std::vector<std::string>& names :
       std::vector<std::vector<std::string>>{{"normal_consistency"},
                                             {"precision_normals"},
                                             {"recall_normals"},
                                             {"f1_normals"},
                                             {"f1_normals", "hd_p"},
                                             {"normal_consistency", "f1", "assd"}})
    check_beside(*asked(a, b, names, 2).metrics, *whole.metrics);
}

TEST_CASE("shares that are asked for alone decide, and take fewer cells") {
  const Mesh a = noisy(icosphere(1.0, 3), 0.02, 5), b = icosphere(1.0, 3);
  const Answer all = asked(a, b, {}), alone = asked(a, b, {"f1"});
  CHECK(alone.metrics->is_met());
  CHECK(code_of(alone) == kExitClosed);
  CHECK(alone.survey_a->bounded + alone.survey_b->bounded <
        all.survey_a->bounded + all.survey_b->bounded);
  CHECK(to_json(answer_from_json(to_json(alone))) == to_json(alone));
  const Answer stacks = asked(square_patch(1, 0.25), square_patch(1, 0.0), {"f1"});
  CHECK(stacks.survey_a->bounded == 2);  // faces decide
  CHECK_THROWS_AS(asked(a, b, {"normal_consistency"}), UsageError);
  CHECK_THROWS_AS(asked(a, b, {"hd95"}), UsageError);
}

TEST_CASE("a mesh without area is refused") {
  Mesh line;
  line.vertices = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  line.faces = {{0, 1, 2}};
  CHECK_THROWS_AS(answered(line, square_patch(3, 0.0)), InputError);
  CHECK_THROWS_AS(answered(square_patch(3, 0.0), line), InputError);
}

}  // namespace
