// Colours along a bar in three parts.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "vkhausdorff/colour_map.h"

namespace vkh::drawing {

/// Colours below, within and above two limits, which are shares of the bar. Each part has colours
/// at even steps, and is linear between them.
struct Palette {
  static constexpr size_t kOutside = 6, kWithin = 16;
  double from = 0, to = 1;
  uint32_t bands = 0;  ///< steps of colour along the bar; 0: smooth
  std::array<Rgb, kOutside> below{}, above{};
  std::array<Rgb, kWithin> within{};

  /// `share`: in [0, 1]. The limit itself counts as within.
  Rgb colour(double share) const {
    if (bands > 0) share = (std::min(std::floor(share * bands), bands - 1.0) + 0.5) / bands;
    if (share < from) return between(below, share / from);
    if (share > to) return between(above, (share - to) / (1 - to));
    return between(within, to > from ? (share - from) / (to - from) : 0);
  }

 private:
  template <size_t n>
  static Rgb between(const std::array<Rgb, n>& colours, double share) {
    const double at = std::clamp(share, 0.0, 1.0) * (n - 1);
    const auto i = std::min(static_cast<size_t>(at), n - 2);
    const double t = at - static_cast<double>(i);
    const auto mix = [t](uint8_t x, uint8_t y) {
      return static_cast<uint8_t>(std::lround(x + (y - x) * t));
    };
    const Rgb &p = colours[i], &q = colours[i + 1];
    return {mix(p.red, q.red), mix(p.green, q.green), mix(p.blue, q.blue)};
  }
};

}  // namespace vkh::drawing
