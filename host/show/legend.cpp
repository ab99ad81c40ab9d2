#include "host/show/legend.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "host/base/decimal.h"
#include "vkhausdorff/length.h"

namespace vkh::drawing {
namespace {

/// Prints number * 10^exponent, with as many decimals as the exponent has.
std::string fixed_text(int64_t number, int exponent) {
  std::string digits = std::to_string(std::abs(number));
  if (exponent >= 0) {
    if (number != 0) digits.append(static_cast<size_t>(exponent), '0');
  } else {
    const auto decimals = static_cast<size_t>(-exponent);
    if (digits.size() <= decimals) digits.insert(0, decimals + 1 - digits.size(), '0');
    digits.insert(digits.size() - decimals, 1, '.');
  }
  return (number < 0 ? "\u2212" : "") + digits;
}

int exponent_of(double x) { return static_cast<int>(std::floor(std::log10(x))); }

/// The least number that is 1, 2 or 5 times a power of ten and no smaller than x.
struct RoundNumber {
  int64_t digit;
  int exponent;
  double value() const { return static_cast<double>(digit) * std::pow(10.0, exponent); }
};
RoundNumber round_number(double x) {
  constexpr double kSlack = 1 + 1e-9;
  RoundNumber step{1, exponent_of(x)};
  for (const int64_t digit : {1, 2, 5}) {
    step.digit = digit;
    if (step.value() * kSlack >= x) return step;
  }
  return {1, step.exponent + 1};
}

}  // namespace

Ticks ticks_of(const Enclosure& range, size_t most) {
  constexpr int kPlainFrom = -3, kPlainTo = 5;
  const double width = range.upper - range.lower;
  const double largest = std::max(std::abs(range.lower), std::abs(range.upper));
  Ticks ticks;
  // In narrower ranges, powers of ten have few bits left, or none.
  if (!(width > 1e-12 * largest) || !std::isfinite(width) || largest < 1e-290) {
    ticks.at = {range.upper};
    ticks.text = {decimal(range.upper, 4, Rounding::kUp)};
    return ticks;
  }
  const RoundNumber step = round_number(width / static_cast<double>(std::max<size_t>(most, 1)));
  const int top = exponent_of(largest);
  const int power = top < kPlainFrom || top > kPlainTo ? top : 0;
  if (power != 0) ticks.power = "1e" + std::to_string(power);
  const double unit = step.value();
  const auto last = static_cast<int64_t>(std::floor(range.upper / unit + 1e-6));
  for (auto k = static_cast<int64_t>(std::ceil(range.lower / unit - 1e-6)); k <= last; ++k) {
    ticks.at.push_back(static_cast<double>(k) * unit);
    ticks.text.push_back(fixed_text(k * step.digit, step.exponent - power));
  }
  return ticks;
}

PrintedInterval printed(const Picture& picture) {
  constexpr int kEnough = 9;  // digits; more only if they decide on which side of the limit it is
  const Enclosure& h = picture.interval;
  double gap = h.upper - h.lower;
  int most = kEnough;
  if (picture.limit) {
    const Verdict verdict = verdict_of(h.lower, h.upper, *picture.limit);
    most = verdict == Verdict::kUndecided ? kEnough : kJsonDigits;
    if (verdict == Verdict::kWithin) gap = std::min(gap, picture.limit->within - h.upper);
    if (verdict == Verdict::kBeyond) gap = std::min(gap, h.lower - picture.limit->beyond);
  }
  const auto text = [&](double x, Rounding rounding) {
    return std::isinf(x) ? "\u221e"
                         : decimal(x, std::min(digits_that_matter(x, gap), most), rounding);
  };
  return {text(h.lower, Rounding::kDown), text(h.upper, Rounding::kUp)};
}

std::string with_unit(const Picture& picture, const std::string& number) {
  return picture.unit.empty() ? number : number + " " + picture.unit;
}

std::string limit_text(const Picture& picture) {
  if (!picture.limit_as.empty()) return picture.limit_as;
  return with_unit(picture, length_in_words(*picture.limit));
}

std::string limit_clause(const Picture& picture) {
  const auto length = [&](const Limit& limit) {
    return with_unit(picture, length_in_words(limit));
  };
  if (picture.sided)
    return "the limits are +" + length(picture.sided->over) + " over and \u2212" +
           length(picture.sided->under) + " under " + (picture.back ? "A" : "B");
  const bool is_share = !picture.limit_as.empty();
  return "the limit is " + limit_text(picture) + (is_share ? ", " + length(*picture.limit) : "");
}

Rgb verdict_colour(Verdict verdict) {
  if (verdict == Verdict::kWithin) return {133, 178, 216};
  return verdict == Verdict::kBeyond ? Rgb{203, 38, 35} : Rgb{246, 205, 116};
}

void draw_axes(const Sheet& sheet, const Axes& axes, glm::dvec2 origin) {
  constexpr std::array<Rgb, 3> kColours{{{190, 60, 52}, {58, 132, 62}, {48, 92, 180}}};
  constexpr std::array<const char*, 3> kNames{"x", "y", "z"};
  const double u = sheet.unit, size = 15 * u;
  for (size_t i = 0; i < kNames.size(); ++i) {
    const auto axis = static_cast<glm::length_t>(i);
    const glm::dvec2 along(axes.right[axis], -axes.up[axis]);
    if (glm::length(along) < 0.08) continue;  // it points at the viewer, or away
    const glm::dvec2 tip = origin + along * (34 * u);
    sheet.canvas.arrow(origin, tip, std::max(1.2, 2 * u), kColours[i]);
    const glm::dvec2 beyond = tip + glm::normalize(along) * (11 * u);
    write(sheet.canvas, {beyond.x, beyond.y + 0.3 * size}, kNames[i],
          {size, kColours[i], Align::kCentre});
  }
}

void draw_ruler(const Sheet& sheet, const Camera& camera, glm::dvec2 at) {
  const double u = sheet.unit, size = 15 * u, most = 190 * u;
  const double longest = most / camera.scale;
  if (!std::isfinite(longest) || !(longest > 0)) return;
  RoundNumber length = round_number(longest * 0.5);
  while (length.value() > longest) length = round_number(length.value() * 0.3);
  const double end = at.x + length.value() * camera.scale, width = std::max(1.0, 1.6 * u);
  for (const double x : {at.x, end})
    sheet.canvas.line({x, at.y - 5 * u}, {x, at.y + 5 * u}, width, kInk);
  sheet.canvas.line(at, {end, at.y}, width, kInk);
  const bool plain = length.exponent >= -4 && length.exponent <= 5;
  const std::string number =
      plain ? fixed_text(length.digit, length.exponent)
            : std::to_string(length.digit) + "e" + std::to_string(length.exponent);
  write(sheet.canvas, {at.x, at.y - 11 * u}, with_unit(sheet.picture, number), {.size = size});
}

}  // namespace vkh::drawing
