// Draws over the mesh, anti-aliased on the host: letters, lines, bars.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "host/show/raster.h"

namespace vkh::drawing {

inline constexpr Rgb kInk{32, 36, 42}, kGrey{105, 112, 122}, kPale{196, 201, 208},
    kPaper{255, 255, 255};

/// Coordinates are in pixels; the centre of the first pixel is at (0.5, 0.5).
class Canvas {
 public:
  explicit Canvas(Image& image) : image_(image) {}

  void paste(const Layer& layer, uint32_t x, uint32_t y);
  void blend(int64_t x, int64_t y, Rgb colour, double opacity);

  /// Corners are round if there is a `radius`.
  void fill(const Area& area, Rgb colour, double opacity = 1, double radius = 0);
  void frame(const Area& area, double width, Rgb colour);
  void line(glm::dvec2 from, glm::dvec2 to, double width, Rgb colour);
  void disc(glm::dvec2 centre, double radius, Rgb colour);
  /// Draws a convex polygon, its corners in the order of a clock's hand.
  void polygon(const std::vector<glm::dvec2>& corners, Rgb colour);
  /// Draws the stripes of an unresolved cell.
  void hatch(const Area& area, double period);
  /// Draws a line of this width, with a head at `to`.
  void arrow(glm::dvec2 from, glm::dvec2 to, double width, Rgb colour);

 private:
  /// `inside(p)`: the depth of p inside the shape, in pixels.
  template <class Inside>
  void cover(const Area& bounds, Rgb colour, double opacity, const Inside& inside);

  Image& image_;
};

enum class Align { kLeft, kCentre, kRight };

struct Ink {
  double size = 16;  ///< size of the em, in pixels
  Rgb colour = kInk;
  Align align = Align::kLeft;
};

/// Writes UTF-8; a character that the font lacks becomes a box. `at`: on the base line.
void write(Canvas& canvas, glm::dvec2 at, std::string_view text, const Ink& ink);
double text_width(std::string_view text, double size);
/// Shortens to no more than `width`: leaves out as much from the middle as is needed.
std::string shortened(const std::string& text, double size, double width);
/// Breaks into lines no wider than `width`, at most `most`; text without room is left out.
std::vector<std::string> wrapped(const std::string& text, double size, double width, size_t most);

}  // namespace vkh::drawing
