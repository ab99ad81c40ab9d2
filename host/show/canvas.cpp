#include "host/show/canvas.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <new>
#include <string>
#include <string_view>

#include "host/show/deflate.h"
#include "vkhausdorff/error.h"

#ifdef VKH_HAS_STB
#ifdef VKH_HAS_ZLIB
namespace {

// Deflates a PNG's rows, as stb asks for it: null if there is no memory. zlib takes a third of the
// time of stb's own deflate, and gives fewer bytes. stb frees them by free().
unsigned char* deflated_rows(unsigned char* rows, int size, int* packed_size, int) {
  const std::string_view text(reinterpret_cast<const char*>(rows), static_cast<size_t>(size));
  std::string packed;
  try {
    packed = vkh::deflated(std::array{vkh::DeflatePart{text, vkh::Deflate::kQuick}});
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
  auto* bytes = static_cast<unsigned char*>(std::malloc(packed.size()));
  if (bytes == nullptr) return nullptr;
  std::copy(packed.begin(), packed.end(), bytes);
  *packed_size = static_cast<int>(packed.size());
  return bytes;
}

}  // namespace
#define STBIW_ZLIB_COMPRESS deflated_rows
#endif
#define STB_TRUETYPE_IMPLEMENTATION
#define STBTT_STATIC
#include <stb/stb_truetype.h>
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#define STBI_WRITE_NO_STDIO
#include <stb/stb_image_write.h>

#include "draw/font.h"
#endif

namespace vkh::drawing {

void Canvas::paste(const Layer& layer, uint32_t x, uint32_t y) {
  const uint32_t width = std::min(layer.width, image_.width - std::min(x, image_.width));
  const uint32_t height = std::min(layer.height, image_.height - std::min(y, image_.height));
  for (uint32_t row = 0; row < height; ++row) {
    const uint8_t* from = &layer.rgba[size_t{4} * row * layer.width];
    uint8_t* to = &image_.rgba[4 * (size_t{y + row} * image_.width + x)];
    std::memcpy(to, from, size_t{4} * width);
    for (uint32_t i = 0; i < width; ++i) to[4 * i + 3] = 255;
  }
}

void Canvas::blend(int64_t x, int64_t y, Rgb colour, double opacity) {
  if (x < 0 || y < 0 || x >= image_.width || y >= image_.height || opacity <= 0) return;
  uint8_t* pixel = &image_.rgba[4 * static_cast<size_t>(y * image_.width + x)];
  const auto mix = [&](uint8_t& under, uint8_t over) {
    under = static_cast<uint8_t>(std::lround(under + (over - under) * std::min(opacity, 1.0)));
  };
  mix(pixel[0], colour.red);
  mix(pixel[1], colour.green);
  mix(pixel[2], colour.blue);
}

template <class Inside>
void Canvas::cover(const Area& bounds, Rgb colour, double opacity, const Inside& inside) {
  const Area all = bounds.inner(-1);
  const auto within = [](double at, uint32_t size) {
    return static_cast<int64_t>(std::clamp(at, 0.0, static_cast<double>(size)));
  };
  const int64_t right = within(std::ceil(all.right()), image_.width);
  const int64_t bottom = within(std::ceil(all.bottom()), image_.height);
  for (int64_t y = within(all.y, image_.height); y < bottom; ++y) {
    for (int64_t x = within(all.x, image_.width); x < right; ++x) {
      const glm::dvec2 centre(static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5);
      blend(x, y, colour, opacity * std::clamp(inside(centre) + 0.5, 0.0, 1.0));
    }
  }
}

namespace {

double inside_of_rounded(const Area& area, double radius, glm::dvec2 p) {
  const glm::dvec2 half = glm::dvec2(area.width, area.height) * 0.5 - radius;
  const glm::dvec2 out = glm::abs(p - area.centre()) - half;
  const double beyond = glm::length(glm::max(out, glm::dvec2(0)));
  return radius - beyond - std::min(std::max(out.x, out.y), 0.0);
}

Area around(glm::dvec2 a, glm::dvec2 b, double margin) {
  const glm::dvec2 lo = glm::min(a, b), hi = glm::max(a, b);
  return Area{lo.x, lo.y, hi.x - lo.x, hi.y - lo.y}.inner(-margin);
}

}  // namespace

void Canvas::fill(const Area& area, Rgb colour, double opacity, double radius) {
  cover(area, colour, opacity, [&](glm::dvec2 p) { return inside_of_rounded(area, radius, p); });
}

void Canvas::frame(const Area& area, double width, Rgb colour) {
  cover(area.inner(-width), colour, 1,
        [&](glm::dvec2 p) { return width / 2 - std::abs(inside_of_rounded(area, 0, p)); });
}

void Canvas::line(glm::dvec2 from, glm::dvec2 to, double width, Rgb colour) {
  const glm::dvec2 along = to - from;
  const double square = glm::dot(along, along);
  cover(around(from, to, width), colour, 1, [&](glm::dvec2 p) {
    const double t = square > 0 ? std::clamp(glm::dot(p - from, along) / square, 0.0, 1.0) : 0.0;
    return width / 2 - glm::distance(p, from + along * t);
  });
}

void Canvas::disc(glm::dvec2 centre, double radius, Rgb colour) {
  cover(around(centre, centre, radius), colour, 1,
        [&](glm::dvec2 p) { return radius - glm::distance(p, centre); });
}

void Canvas::polygon(const std::vector<glm::dvec2>& corners, Rgb colour) {
  Area bounds = around(corners.front(), corners.front(), 0);
  for (const glm::dvec2& c : corners) {
    const Area both = around(glm::min(c, glm::dvec2(bounds.x, bounds.y)),
                             glm::max(c, glm::dvec2(bounds.right(), bounds.bottom())), 0);
    bounds = both;
  }
  cover(bounds, colour, 1, [&](glm::dvec2 p) {
    double inside = std::numeric_limits<double>::infinity();
    for (size_t i = 0; i < corners.size(); ++i) {
      const glm::dvec2 a = corners[i], along = corners[(i + 1) % corners.size()] - a;
      const double length = std::max(glm::length(along), 1e-9);
      inside = std::min(inside, (along.x * (p.y - a.y) - along.y * (p.x - a.x)) / length);
    }
    return inside;
  });
}

void Canvas::hatch(const Area& area, double period) {
  const double slant = std::sqrt(0.5);
  cover(area, kStripe, 1, [&](glm::dvec2 p) {
    const double at = (p.x + p.y) / period;
    const double off = std::abs(at - std::floor(at) - kStripeShare / 2);
    const double stripe = (kStripeShare / 2 - std::min(off, 1 - off)) * period * slant;
    return std::min(stripe, inside_of_rounded(area, 0, p));
  });
}

void Canvas::arrow(glm::dvec2 from, glm::dvec2 to, double width, Rgb colour) {
  const double length = glm::distance(from, to);
  if (length < width) return;
  const glm::dvec2 along = (to - from) / length, aside(-along.y, along.x);
  const double head = std::min(5 * width, 0.7 * length), half = 0.42 * head;
  const glm::dvec2 base = to - along * head;
  line(from, to - along * (0.8 * head), width, colour);
  polygon({to, base + aside * half, base - aside * half}, colour);
}

}  // namespace vkh::drawing

// Letters and PNG, by stb's single-file libraries.
#ifdef VKH_HAS_STB

namespace vkh {
namespace drawing {
namespace {

constexpr int kUnknown = 0xfffd;  // stands for an invalid character

const stbtt_fontinfo& font() {
  static const stbtt_fontinfo loaded = [] {
    stbtt_fontinfo info{};
    stbtt_InitFont(&info, kFont, 0);
    return info;
  }();
  return loaded;
}

/// The number of bytes of the character that `text` begins with; 1 for a byte that begins none.
size_t length_of_first(std::string_view text) {
  const auto first = static_cast<unsigned char>(text[0]);
  const size_t length = first < 0x80   ? 1
                        : first < 0xc2 ? 0
                        : first < 0xe0 ? 2
                        : first < 0xf0 ? 3
                                       : 4;
  if (length == 0 || first > 0xf4 || length > text.size()) return 1;
  for (size_t i = 1; i < length; ++i) {
    if ((static_cast<unsigned char>(text[i]) & 0xc0) != 0x80) return 1;
  }
  return length;
}

int character_of(std::string_view bytes) {
  const auto at = [&](size_t i) { return static_cast<unsigned char>(bytes[i]); };
  if (bytes.size() == 1) return at(0) < 0x20 || at(0) >= 0x7f ? kUnknown : at(0);
  int character = at(0) & (0xff >> (bytes.size() + 1));
  for (size_t i = 1; i < bytes.size(); ++i) character = character << 6 | (at(i) & 0x3f);
  return character;
}

/// Splits the text into one string per character.
std::vector<std::string_view> characters_of(std::string_view text) {
  std::vector<std::string_view> all;
  while (!text.empty()) {
    const size_t length = length_of_first(text);
    all.push_back(text.substr(0, length));
    text.remove_prefix(length);
  }
  return all;
}

/// Calls place(glyph, x) for each, x in pixels from the start; returns where the text ends.
template <class Place>
double place_glyphs(std::string_view text, double size, const Place& place) {
  const double scale = stbtt_ScaleForMappingEmToPixels(&font(), static_cast<float>(size));
  double x = 0;
  int last = 0;
  for (const std::string_view bytes : characters_of(text)) {
    const int glyph = stbtt_FindGlyphIndex(&font(), character_of(bytes));
    if (last != 0) x += scale * stbtt_GetGlyphKernAdvance(&font(), last, glyph);
    place(glyph, x);
    int advance = 0, bearing = 0;
    stbtt_GetGlyphHMetrics(&font(), glyph, &advance, &bearing);
    x += scale * advance;
    last = glyph;
  }
  return x;
}

void write_glyph(Canvas& canvas, glm::dvec2 at, int glyph, const Ink& ink) {
  const float scale = stbtt_ScaleForMappingEmToPixels(&font(), static_cast<float>(ink.size));
  const glm::dvec2 whole = glm::floor(at), part = at - whole;
  const auto shift_x = static_cast<float>(part.x), shift_y = static_cast<float>(part.y);
  int left = 0, top = 0, right = 0, bottom = 0;
  stbtt_GetGlyphBitmapBoxSubpixel(&font(), glyph, scale, scale, shift_x, shift_y, &left, &top,
                                  &right, &bottom);
  if (right <= left || bottom <= top) return;
  const int width = right - left, height = bottom - top;
  std::vector<unsigned char> shares(static_cast<size_t>(width) * static_cast<size_t>(height));
  stbtt_MakeGlyphBitmapSubpixel(&font(), shares.data(), width, height, width, scale, scale, shift_x,
                                shift_y, glyph);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const unsigned char share =
          shares[static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x)];
      canvas.blend(static_cast<int64_t>(whole.x) + left + x,
                   static_cast<int64_t>(whole.y) + top + y, ink.colour, share / 255.0);
    }
  }
}

}  // namespace

double text_width(std::string_view text, double size) {
  return place_glyphs(text, size, [](int, double) {});
}

void write(Canvas& canvas, glm::dvec2 at, std::string_view text, const Ink& ink) {
  const double width = ink.align == Align::kLeft ? 0 : text_width(text, ink.size);
  at.x -= ink.align == Align::kCentre ? width / 2 : width;
  at.y = std::round(at.y);  // letters stand on a row of pixels
  place_glyphs(text, ink.size, [&](int glyph, double x) {
    write_glyph(canvas, {at.x + x, at.y}, glyph, ink);
  });
}

std::string shortened(const std::string& text, double size, double width) {
  if (text_width(text, size) <= width) return text;
  const std::vector<std::string_view> characters = characters_of(text);
  const auto without = [&](size_t left_out) {
    const size_t kept = characters.size() - left_out;
    std::string shorter;
    for (size_t i = 0; i < (kept + 1) / 2; ++i) shorter += characters[i];
    shorter += "\u2026";
    for (size_t i = characters.size() - kept / 2; i < characters.size(); ++i)
      shorter += characters[i];
    return shorter;
  };
  size_t fits = characters.size(), fits_not = 0;
  while (fits - fits_not > 1) {
    const size_t middle = (fits + fits_not) / 2;
    (text_width(without(middle), size) <= width ? fits : fits_not) = middle;
  }
  return without(fits);
}

}  // namespace drawing

std::string encode_png(const Image& image) {
  constexpr size_t kChannels = 3;  // a picture is opaque
  std::vector<uint8_t> rgb(kChannels * image.width * image.height);
  for (size_t i = 0; i < size_t{image.width} * image.height; ++i)
    std::copy_n(&image.rgba[4 * i], kChannels, &rgb[kChannels * i]);
  // Paeth's filter alone gives about as few bytes as the best of five for each row, which stb finds
  // by trying all.
  constexpr int kPaeth = 4;
  [[maybe_unused]] static const int filter = stbi_write_force_png_filter = kPaeth;
  const int width = static_cast<int>(image.width), height = static_cast<int>(image.height);
  std::string file;
  const auto append = [](void* to, void* bytes, int size) {
    static_cast<std::string*>(to)->append(static_cast<const char*>(bytes),
                                          static_cast<size_t>(size));
  };
  if (stbi_write_png_to_func(append, &file, width, height, kChannels, rgb.data(),
                             static_cast<int>(kChannels) * width) == 0)
    throw std::bad_alloc();
  return file;
}

}  // namespace vkh

#else

namespace vkh {
namespace {

[[noreturn]] void refuse() {
  throw UsageError("this build draws no pictures: it was made without stb (libstb-dev)");
}

}  // namespace

namespace drawing {

void write(Canvas&, glm::dvec2, std::string_view, const Ink&) { refuse(); }
double text_width(std::string_view, double) { refuse(); }
std::string shortened(const std::string&, double, double) { refuse(); }

}  // namespace drawing

std::string encode_png(const Image&) { refuse(); }

}  // namespace vkh

#endif

namespace vkh::drawing {

std::vector<std::string> wrapped(const std::string& text, double size, double width, size_t most) {
  std::vector<std::string> lines;
  std::string line;
  size_t at = 0;
  while (at < text.size()) {
    const size_t end = std::min(text.find(' ', at), text.size());
    const std::string word = text.substr(at, end - at);
    std::string longer = line;
    if (!longer.empty()) longer += ' ';
    longer += word;
    const bool fits = line.empty() || text_width(longer, size) <= width;
    if (!fits && lines.size() + 1 < most) {
      lines.push_back(shortened(line, size, width));
      line = word;
    } else {
      line = longer;
    }
    at = end + 1;
  }
  lines.push_back(shortened(line, size, width));
  return lines;
}

}  // namespace vkh::drawing
