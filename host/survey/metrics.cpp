#include "vkhausdorff/metrics.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "host/base/decimal.h"
#include "host/base/rounding.h"
#include "host/survey/metrics_of.h"
#include "host/survey/pooled.h"
#include "vkhausdorff/error.h"

namespace vkh {
namespace {

// Every operation here rounds outward (host/base/rounding.h), and an exact result stays exact, so
// that of two equal meshes all lengths are 0 and all shares 1.

double known_to(const Enclosure& e) { return width_up(e.lower, e.upper); }

double square_root_down(double x) {
  const double root = std::sqrt(x);
  return float128(root) * float128(root) > float128(x) ? std::nextafter(root, 0.0) : root;
}
double square_root_up(double x) {
  const double root = std::sqrt(x);
  return float128(root) * float128(root) < float128(x)
             ? std::nextafter(root, std::numeric_limits<double>::infinity())
             : root;
}

// Sets the estimate of a figure, within its interval, if all figures that it is computed from have
// one.
template <class Formula, class... Parts>
void estimate(Enclosure& e, const Formula& formula, const Parts&... parts) {
  if (!(parts.estimate && ...)) return;
  const double likely = formula(*parts.estimate...);
  if (std::isfinite(likely)) e.estimate = std::clamp(likely, e.lower, e.upper);
}

Enclosure sum(const Enclosure& x, const Enclosure& y) {
  Enclosure e{add_down(x.lower, y.lower), add_up(x.upper, y.upper)};
  estimate(e, std::plus<>(), x, y);
  return e;
}

// Halving rounds a subnormal number alone: outward by one step.
Enclosure half(const Enclosure& x) {
  Enclosure e{divide_down(x.lower, 2), divide_up(x.upper, 2)};
  estimate(
      e, [](double likely) { return likely / 2; }, x);
  return e;
}

Enclosure larger(const Enclosure& x, const Enclosure& y) {
  Enclosure e{std::max(x.lower, y.lower), std::max(x.upper, y.upper)};
  estimate(
      e, [](double a, double b) { return std::max(a, b); }, x, y);
  return e;
}

Enclosure square(const Enclosure& x) {
  Enclosure e{multiply_down(x.lower, x.lower), multiply_up(x.upper, x.upper)};
  estimate(
      e, [](double likely) { return likely * likely; }, x);
  return e;
}

}  // namespace

// Increasing in a, decreasing in b: (a + b) is rounded against each end.
Enclosure weight_of(const Enclosure& a, const Enclosure& b) {
  Enclosure e{divide_down(a.lower, add_up(a.lower, b.upper)),
              std::min(divide_up(a.upper, add_down(a.upper, b.lower)), 1.0)};
  estimate(
      e, [](double x, double y) { return x / (x + y); }, a, b);
  return e;
}

// Monotone in x and y, and linear in w, so that each end lies at an end of w. A mean with weights
// that are not negative lies between x and y, so the result is clamped to them.
Enclosure weighted(const Enclosure& weight, const Enclosure& x, const Enclosure& y) {
  Enclosure e{std::max(x.lower, y.lower), std::min(x.upper, y.upper)};
  for (const double w : {weight.lower, weight.upper}) {
    e.lower = std::min(
        e.lower, add_down(multiply_down(w, x.lower), multiply_down(add_down(1, -w), y.lower)));
    e.upper =
        std::max(e.upper, add_up(multiply_up(w, x.upper), multiply_up(add_up(1, -w), y.upper)));
  }
  e.lower = std::max(e.lower, std::min(x.lower, y.lower));
  e.upper = std::min(e.upper, std::max(x.upper, y.upper));
  estimate(
      e, [](double w, double p, double q) { return w * p + (1 - w) * q; }, weight, x, y);
  return e;
}

namespace {

double harmonic(double x, double y) { return x + y > 0 ? 2 * x * y / (x + y) : 0; }

}  // namespace

// Increasing in both: the derivative in x is 2 y^2 / (x + y)^2. It lies between the smaller and the
// larger one. Doubling is exact for shares, whose products are far above the subnormal numbers
// unless one is below 2^-500, where the smaller one itself bounds it.
Enclosure harmonic_mean(const Enclosure& x, const Enclosure& y) {
  Enclosure e{0, 0};
  if (x.lower > 0 && y.lower > 0)
    e.lower = std::max(divide_down(2 * multiply_down(x.lower, y.lower), add_up(x.lower, y.lower)),
                       std::min(x.lower, y.lower));
  if (x.upper > 0 && y.upper > 0)
    e.upper = std::min(divide_up(2 * multiply_up(x.upper, y.upper), add_down(x.upper, y.upper)),
                       std::max(x.upper, y.upper));
  estimate(e, harmonic, x, y);
  return e;
}

namespace {

// x 2^exponent: exact unless it is subnormal, where it is off by less than one step.
double scaled_down(double x, int exponent) {
  const double scaled = std::ldexp(x, exponent);
  return scaled < 0x1p-1021 ? std::nextafter(scaled, 0.0) : scaled;
}
double scaled_up(double x, int exponent) {
  const double scaled = std::ldexp(x, exponent);
  const bool is_exact = x == 0 || scaled >= 0x1p-1021;
  return is_exact ? scaled : std::nextafter(scaled, 1.0);
}

}  // namespace

// The same as weighted(), of squares, for lengths that are scaled to at most 1 so that no square of
// the larger one over- or underflows. Scaling by a power of two rounds only what is below 2^-1022
// of the larger one: there `kTiny` bounds it.
Enclosure weighted_rms(const Enclosure& weight, const Enclosure& x, const Enclosure& y) {
  constexpr double kTiny = 0x1p-1022;
  const double largest = std::max(x.upper, y.upper);
  if (!(largest > 0)) return {0, 0, 0.0};
  const int exponent = std::ilogb(largest) + 1;
  const auto down = [&](double length) {
    const double scaled = std::ldexp(length, -exponent);
    return scaled < kTiny ? 0 : scaled;
  };
  const auto up = [&](double length) {
    return length > 0 ? std::max(std::ldexp(length, -exponent), kTiny) : 0;
  };
  const Enclosure squares =
      weighted(weight, square({down(x.lower), up(x.upper)}), square({down(y.lower), up(y.upper)}));
  Enclosure e{scaled_down(square_root_down(squares.lower), exponent),
              scaled_up(square_root_up(squares.upper), exponent)};
  e.lower = std::max(e.lower, std::min(x.lower, y.lower));
  e.upper = std::min(e.upper, std::max(x.upper, y.upper));
  const auto likely = [](double w, double p, double q) {
    return std::sqrt(w * p * p + (1 - w) * q * q);
  };
  estimate(e, likely, weight, x, y);
  return e;
}

namespace {

// Widths that are enough for lengths and shares: the surveys' goals, and what roundings add to
// them.
class Goals {
 public:
  Goals(const MeasuredDirection& a, const MeasuredDirection& b)
      : rounding_(std::max(a.distribution.rounding(), b.distribution.rounding())),
        least_(std::max(a.distribution.least_width(), b.distribution.least_width())) {}

  double of_length(double lower) const {
    return kSlack * std::max(MetricsOptions::kTolerance * lower + rounding_, least_);
  }
  bool is_met(const Enclosure& length) const { return known_to(length) <= of_length(length.lower); }
  // `parts`: whether the figures of both directions that it is computed from are as narrow as
  // asked.
  Metric length(const Enclosure& e, bool parts, bool jump = false) const {
    return {e, parts || is_met(e), jump};
  }
  static Metric share(const Enclosure& e, bool jump) {
    return {e, known_to(e) <= kSlack * MetricsOptions::kShareTolerance, jump};
  }

 private:
  static constexpr double kSlack = 1 + 1e-9;  // of what is added up in double
  double rounding_, least_;
};

MetricsWithin within_of(const Enclosure& weight, const AreaWithin& a, const AreaWithin& b) {
  const bool jump = a.jump || b.jump;
  MetricsWithin at;
  at.distance = a.distance;
  at.nsd = Goals::share(weighted(weight, a.share, b.share), jump);
  at.precision = Goals::share(a.share, a.jump);
  at.recall = Goals::share(b.share, b.jump);
  at.f1 = Goals::share(harmonic_mean(a.share, b.share), jump);
  if (!a.agreeing || !b.agreeing) return at;
  at.precision_normals = Goals::share(*a.agreeing, a.jump);
  at.recall_normals = Goals::share(*b.agreeing, b.jump);
  at.f1_normals = Goals::share(harmonic_mean(*a.agreeing, *b.agreeing), jump);
  return at;
}

// `between`: the percentiles of both parts, which it lies between.
Metric pooled_metric(const Distribution& a, const Distribution& b, double share,
                     const Enclosure& between, const Goals& goals) {
  Enclosure pooled = pooled_percentile(a, b, share, between);
  pooled.estimate = pooled.lower + (pooled.upper - pooled.lower) / 2;
  return goals.length(pooled, false, is_pooled_jump(a, b, pooled, goals.of_length(pooled.lower)));
}

Enclosure hausdorff_of(const Report& a, const Report& b) {
  Enclosure e{std::max(a.lower, b.lower), std::max(a.upper, b.upper)};
  if (std::isfinite(e.lower)) e.estimate = e.lower;  // the farthest point that was found
  return e;
}

}  // namespace

namespace {

bool is_named(const std::vector<std::string>& figures, std::string_view name) {
  return figures.empty() || std::find(figures.begin(), figures.end(), name) != figures.end();
}

}  // namespace

bool MetricsOptions::asks_for(std::initializer_list<std::string_view> names) const {
  return std::any_of(names.begin(), names.end(),
                     [&](std::string_view name) { return is_named(figures, name); });
}

bool Metrics::asks_for(std::string_view name) const { return is_named(figures, name); }

bool Metrics::is_met() const {
  const auto is_wanted = [&](const auto& named) {
    return asks_for(named.name) && (normals || !named.of_normals);
  };
  const bool lengths =
      std::all_of(kNamedMetrics.begin(), kNamedMetrics.end(),
                  [&](const NamedMetric& m) { return (this->*m.figure).is_met || !is_wanted(m); });
  return lengths && std::all_of(within.begin(), within.end(), [&](const MetricsWithin& at) {
           return std::all_of(kNamedShares.begin(), kNamedShares.end(), [&](const NamedShare& m) {
             return (at.*m.figure).is_met || !is_wanted(m);
           });
         });
}

std::string names_of_figures() {
  std::string names;
  for (const NamedMetric& metric : kNamedMetrics)
    names += (names.empty() ? "" : ", ") + std::string(metric.name);
  for (const NamedShare& share : kNamedShares) names += ", " + std::string(share.name);
  return names;
}

namespace {

// The name of a figure in the tables, or none.
std::string name_in_tables(const std::string& name, double percentile) {
  for (const NamedMetric& metric : kNamedMetrics) {
    if (name == metric.name || name == name_of(metric, percentile)) return metric.name;
  }
  for (const NamedShare& share : kNamedShares) {
    if (name == share.name) return name;
  }
  return "";
}

[[noreturn]] void refuse_figure(const std::string& option, const std::string& name) {
  throw UsageError(option + " '" + name + "': expected names of " + names_of_figures());
}

}  // namespace

std::vector<std::string> checked_figures(const std::string& option,
                                         const std::vector<std::string>& names, double percentile) {
  std::vector<std::string> known;
  for (const std::string& name : names) {
    known.push_back(name_in_tables(name, percentile));
    if (known.back().empty()) refuse_figure(option, name);
  }
  return known;
}

std::string name_of(const NamedMetric& metric, double percentile) {
  std::string name = metric.name;
  if (const size_t at = name.find("_p"); name.starts_with("hd_p"))
    name.replace(at, 2, shortest_decimal(percentile));
  return name;
}

Metrics metrics_of(const MetricsOptions& options, const MeasuredDirection& a,
                   const MeasuredDirection& b) {
  const Statistics &of_a = a.statistics, &of_b = b.statistics;
  const Percentile &p = of_a.percentiles[0], &q = of_b.percentiles[0];
  const Enclosure weight = weight_of(a.distribution.area(), b.distribution.area());
  const Goals goals(a, b);
  const Enclosure between{std::min(p.distance.lower, q.distance.lower),
                          std::max(p.distance.upper, q.distance.upper)};
  const bool means = goals.is_met(of_a.mean) && goals.is_met(of_b.mean);
  const bool roots = goals.is_met(of_a.rms) && goals.is_met(of_b.rms);
  Metrics m;
  m.percentile = options.percentile;
  m.figures = options.figures;
  m.normals = options.normals;
  m.hausdorff = goals.length(hausdorff_of(a.report, b.report), false);
  m.hd_p = goals.length(larger(p.distance, q.distance), false, p.jump || q.jump);
  m.hd_p_pooled = options.asks_for({"hd_p_pooled"})
                      ? pooled_metric(a.distribution, b.distribution, p.share, between, goals)
                      : goals.length(between, false);
  m.masd = goals.length(half(sum(of_a.mean, of_b.mean)), means);
  m.assd = goals.length(weighted(weight, of_a.mean, of_b.mean), means);
  m.rms = goals.length(weighted_rms(weight, of_a.rms, of_b.rms), roots);
  m.chamfer_l1 = goals.length(sum(of_a.mean, of_b.mean), means);
  const Enclosure squares = sum(square(of_a.rms), square(of_b.rms));
  m.chamfer_l2 = {squares,
                  roots || known_to(squares) <= 2 * MetricsOptions::kTolerance * squares.lower};
  if (of_a.normal_cosine && of_b.normal_cosine) {
    const Enclosure mean = half(sum(*of_a.normal_cosine, *of_b.normal_cosine));
    m.normal_consistency = {mean, known_to(mean) <= MetricsOptions::kNormalTolerance};
  }
  for (size_t i = 0; i < std::min(of_a.bands.size(), of_b.bands.size()); ++i)
    m.within.push_back(within_of(weight, of_a.bands[i], of_b.bands[i]));
  return m;
}

}  // namespace vkh
