// Tolerances of few digits.
#include "host/show/page_figures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "host/base/decimal.h"
#include "host/base/from_chars.h"
#include "vkhausdorff/length.h"

namespace vkh {
namespace {

// Two digits with even ratios: E24 of IEC 60063, which engineers know from resistors.
constexpr std::array kSeries = {10, 11, 12, 13, 15, 16, 18, 20, 22, 24, 27, 30,
                                33, 36, 39, 43, 47, 51, 56, 62, 68, 75, 82, 91};
constexpr int kDecades = 6;           // below the largest distance; to the eye, less is 0
constexpr double kLinearSteps = 500;  // at least this many: finer than a hand drags
constexpr double kNiceFactors[] = {5, 2, 1};

// Makes the double nearest to a decimal of few digits. The decimal itself lies between its
// neighbours.
Step step_of(double digits, int exponent) {
  const std::string text =
      number_text(digits, std::chars_format::fixed, 0) + "e" + std::to_string(exponent);
  Step step;
  number_from_chars(text.data(), text.data() + text.size(), step.value);
  if (step.value > 0) {
    step.limit = {std::nextafter(step.value, 0.0),
                  std::nextafter(step.value, std::numeric_limits<double>::infinity())};
  }
  step.label = number_text(step.value, std::chars_format::general, 6);
  return step;
}

void add_linear(std::vector<Step>& steps, double top) {
  const double widest = top / kLinearSteps;
  const int exponent = static_cast<int>(std::floor(std::log10(widest)));
  const double unit = std::pow(10.0, exponent);
  double factor = 1;
  for (const double nice : kNiceFactors) {
    if (nice * unit <= widest) {
      factor = nice;
      break;
    }
  }
  // Ten times kLinearSteps is more than ever needed: no input makes this loop longer.
  for (double i = 0; i <= 10 * kLinearSteps; ++i) {
    steps.push_back(step_of(i * factor, exponent));
    steps.back().is_linear = true;
    if (steps.back().limit.within >= top) return;
  }
}

void add_log(std::vector<Step>& steps, double top) {
  const int last = static_cast<int>(std::ceil(std::log10(top)));
  for (int decade = last - kDecades - 1; decade <= last; ++decade) {
    for (const int digits : kSeries) {
      steps.push_back(step_of(digits, decade - 1));
      steps.back().is_log = true;
      if (steps.back().limit.within >= top) return;
    }
  }
}

// Inserts the limit. Removes steps that it overlaps, so that both ends of all limits ascend.
void add_asked(std::vector<Step>& steps, const Limit& asked) {
  std::erase_if(steps, [&](const Step& step) {
    return step.limit.beyond >= asked.within && step.limit.within <= asked.beyond;
  });
  const double value = asked.within / 2 + asked.beyond / 2;
  steps.push_back({value, asked, length_in_words(asked)});
}

void merge_equals(std::vector<Step>& steps) {
  std::sort(steps.begin(), steps.end(),
            [](const Step& a, const Step& b) { return a.value < b.value; });
  std::vector<Step> out;
  for (const Step& step : steps) {
    if (out.empty() || out.back().value != step.value) {
      out.push_back(step);
      continue;
    }
    out.back().is_linear |= step.is_linear;
    out.back().is_log |= step.is_log;
  }
  steps = std::move(out);
}

}  // namespace

std::vector<Step> tolerance_steps(double top, double fine, const std::optional<Limit>& asked) {
  std::vector<Step> steps = {step_of(0, 0)};
  if (top > 0 && std::isfinite(top)) {
    add_linear(steps, fine);
    add_log(steps, top);
  }
  if (asked && asked->within > 0) add_asked(steps, *asked);
  merge_equals(steps);
  if (std::isfinite(top) &&
      steps.back().limit.within < top) {  // the limit took the last one's place
    const double last = std::max(top, steps.back().limit.beyond);
    steps.push_back({last, {last, std::nextafter(last, last * 2)}, shortest_decimal(last)});
  }
  return steps;
}

}  // namespace vkh
