// Colour maps that all kinds of colour vision read, as tables of sRGB.
#pragma once

#include <cstdint>
#include <string>

#include "vkhausdorff/error.h"

namespace vkh {

struct Rgb {
  uint8_t red = 0, green = 0, blue = 0;

  bool operator==(const Rgb&) const = default;
};

enum class ColourMap { kViridis, kBatlow, kCividis };

/// The colour at `share` of the map, in [0, 1]; between two steps the upper one's, for bounds are
/// upper ones.
Rgb map_colour(ColourMap map, double share);

/// Parses "viridis", "batlow" or "cividis". Throws UsageError that names `option`.
ColourMap parse_colour_map(const char* option, const std::string& text);

}  // namespace vkh
