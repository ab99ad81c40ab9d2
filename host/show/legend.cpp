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

double size_for(const std::string& text, double size, double width) {
  return std::min(size, size * width / std::max(text_width(text, size), 1e-9));
}

std::string in_units(const Picture& picture, const std::string& power) {
  const std::string unit = picture.unit.empty() ? "files' units" : picture.unit;
  return power.empty() ? unit : power + " " + unit;
}

Ticks ticks_of_bands(const Scale& scale) {
  Ticks ticks;
  const double width = scale.range().upper - scale.range().lower;
  for (uint32_t i = 0; i <= scale.bands(); ++i) {
    ticks.at.push_back(scale.range().lower + width * i / scale.bands());
    ticks.text.push_back(decimal(ticks.at.back(), 4, Rounding::kUp));
  }
  return ticks;
}

/// The bar itself; a tip stands on it if there are lengths above it.
struct Bar {
  Area area;
  const Scale& scale;
  double tip = 0;
  double height_of(double length) const {
    if (length > scale.range().upper) return area.y - tip / 2;
    return area.bottom() - scale.share_of(length) * area.height;
  }
};

void draw_colours(const Sheet& sheet, const Bar& bar) {
  const auto rows = static_cast<int>(bar.area.height);
  const bool has_width = sheet.scale.range().upper > sheet.scale.range().lower;
  for (int row = 0; row < rows; ++row) {
    const double share = has_width ? (rows - row - 0.5) / rows : 0;
    sheet.canvas.fill({bar.area.x, bar.area.y + row, bar.area.width, 1},
                      sheet.scale.at_share(share));
  }
  sheet.canvas.frame(bar.area, 1, kGrey);
  if (bar.tip <= 0) return;
  const glm::dvec2 top(bar.area.centre().x, bar.area.y - bar.tip);
  const glm::dvec2 left(bar.area.x, bar.area.y), right(bar.area.right(), bar.area.y);
  sheet.canvas.polygon({top, right, left}, sheet.scale.at_share(1));
  sheet.canvas.line(left, top, 1, kGrey);
  sheet.canvas.line(top, right, 1, kGrey);
}

void draw_ticks(const Sheet& sheet, const Bar& bar, const Ticks& ticks) {
  const double size = 16 * sheet.unit, x = bar.area.right();
  for (size_t i = 0; i < ticks.at.size(); ++i) {
    const double y = bar.height_of(ticks.at[i]);
    sheet.canvas.line({x, y}, {x + 6 * sheet.unit, y}, std::max(1.0, 1.2 * sheet.unit), kGrey);
    write(sheet.canvas, {x + 11 * sheet.unit, y + 0.36 * size}, ticks.text[i], {.size = size});
  }
}

void draw_marker(const Sheet& sheet, const Bar& bar, double length, const std::string& text,
                 double text_y) {
  const double u = sheet.unit, y = bar.height_of(length), tip = bar.area.x - 2 * u;
  const double width = 165 * u, text_x = tip - 34 * u;
  sheet.canvas.polygon({{tip, y}, {tip - 10 * u, y + 5 * u}, {tip - 10 * u, y - 5 * u}}, kInk);
  sheet.canvas.line({tip - 10 * u, y}, {text_x + 6 * u, text_y}, std::max(1.0, 1.2 * u), kInk);
  const double size = size_for(text, 18 * u, width);
  write(sheet.canvas, {text_x, text_y + 0.36 * size}, text, {size, kInk, Align::kRight});
}

/// Two lines of text must not meet, nor leave the bar's height.
void draw_interval(const Sheet& sheet, const Bar& bar) {
  const double apart = 27 * sheet.unit;
  const Enclosure& h = sheet.picture.interval;
  double upper_y = bar.height_of(h.upper), lower_y = bar.height_of(h.lower);
  if (lower_y - upper_y < apart) {
    const double middle =
        std::clamp((lower_y + upper_y) / 2, bar.area.y + apart / 2, bar.area.bottom() - apart / 2);
    upper_y = middle - apart / 2;
    lower_y = middle + apart / 2;
  }
  const PrintedInterval text = printed(sheet.picture);
  draw_marker(sheet, bar, h.upper, "h \u2264 " + text.upper, upper_y);
  draw_marker(sheet, bar, h.lower, "h \u2265 " + text.lower, lower_y);
}

std::string faces_text(const Picture& picture, size_t count) {
  return grouped(count) + (picture.mesh.are_points ? " point" : " face") + (count == 1 ? "" : "s");
}

/// Writes below the bar what it does not show.
double draw_notes(const Sheet& sheet, const Area& area) {
  const FaceCounts counts = count_faces(sheet.picture, sheet.scale);
  std::vector<std::string> notes;
  if (counts.above > 0) notes.push_back(faces_text(sheet.picture, counts.above) + " above the bar");
  if (counts.unbounded > 0)
    notes.push_back(faces_text(sheet.picture, counts.unbounded) + " without a bound");
  const double size = 15 * sheet.unit, line = 24 * sheet.unit;
  double y = area.bottom();
  for (const std::string& note : notes) {
    const Area swatch{area.x, y - size, 1.5 * size, size};
    const bool above = note.back() == 'r';
    sheet.canvas.fill(swatch, above ? sheet.scale.at_share(1) : kUnbounded);
    if (!above) sheet.canvas.hatch(swatch, 8 * sheet.unit);
    write(sheet.canvas, {swatch.right() + 8 * sheet.unit, y - 0.12 * size}, note,
          {size_for(note, size, area.width - 4 * size), kGrey, Align::kLeft});
    y -= line;
  }
  return line * static_cast<double>(notes.size());
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

void draw_bar(const Sheet& sheet, const Area& area) {
  const double u = sheet.unit, size = 16 * u;
  const double notes = draw_notes(sheet, area);
  const FaceCounts counts = count_faces(sheet.picture, sheet.scale);
  const bool has_tip = counts.above > 0 || sheet.picture.interval.upper > sheet.scale.range().upper;
  const double tip = has_tip ? std::round(20 * u) : 0;
  const double top = area.y + 58 * u + tip;
  const Bar bar{{std::round(area.x + 205 * u), std::round(top), std::round(30 * u),
                 std::round(std::max(area.bottom() - notes - 14 * u - top, 30 * u))},
                sheet.scale,
                tip};
  const size_t most = std::clamp<size_t>(static_cast<size_t>(bar.area.height / (46 * u)), 2, 8);
  const bool steps = sheet.scale.bands() > 0 && sheet.scale.bands() <= 2 * most;
  const Ticks ticks = steps ? ticks_of_bands(sheet.scale) : ticks_of(sheet.scale.range(), most);
  const std::string title =
      std::string("upper bound of each ") + (sheet.picture.mesh.are_points ? "point" : "face");
  write(sheet.canvas, {area.x, area.y + size}, title, {size, kGrey, Align::kLeft});
  write(sheet.canvas, {bar.area.x, area.y + 2.6 * size}, in_units(sheet.picture, ticks.power),
        {size, kInk, Align::kLeft});
  draw_colours(sheet, bar);
  draw_ticks(sheet, bar, ticks);
  draw_interval(sheet, bar);
}

void draw_verdicts(const Sheet& sheet, const Area& area) {
  const double u = sheet.unit, size = 18 * u, row = 62 * u;
  const FaceCounts counts = count_faces(sheet.picture, sheet.scale);
  const std::string limit = limit_text(sheet.picture);
  struct Row {
    Verdict verdict;
    std::string text;
    size_t count;
  };
  const std::array<Row, 3> rows{{{Verdict::kWithin, "proven within " + limit, counts.within},
                                 {Verdict::kBeyond, "proven beyond " + limit, counts.beyond},
                                 {Verdict::kUndecided, "undecided", counts.undecided}}};
  write(sheet.canvas, {area.x, area.y + 16 * u},
        sheet.picture.mesh.are_points ? "verdict on each point" : "verdict on each face",
        {16 * u, kGrey, Align::kLeft});
  double y = area.y + 38 * u;
  for (const Row& r : rows) {
    const Area swatch{std::round(area.x), std::round(y), std::round(46 * u), std::round(40 * u)};
    sheet.canvas.fill(swatch, verdict_colour(r.verdict));
    if (r.verdict == Verdict::kUndecided) sheet.canvas.hatch(swatch, 8 * u);
    sheet.canvas.frame(swatch, 1, kGrey);
    const double x = swatch.right() + 14 * u, width = area.right() - x;
    write(sheet.canvas, {x, y + 16 * u}, r.text,
          {size_for(r.text, size, width), kInk, Align::kLeft});
    write(sheet.canvas, {x, y + 38 * u}, faces_text(sheet.picture, r.count),
          {16 * u, kGrey, Align::kLeft});
    y += row;
  }
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
