// A 5 x 7 bitmap font for captions.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace example {

constexpr uint32_t kGlyphColumns = 5;
constexpr uint32_t kGlyphRows = 7;
constexpr char kFirstGlyph = ' ';
constexpr uint32_t kGlyphs = 64;  // ' ' to '_'

using Glyph = std::array<uint8_t, kGlyphRows>;  // rows from the top, bit 4 at the left

/// Returns a blank if the font has no such character.
Glyph glyph(char character);

/// Five words per character, columns from the left, bit 0 at the top: as caption.frag reads them.
std::array<uint32_t, size_t{kGlyphColumns} * kGlyphs> font_columns();

}  // namespace example
