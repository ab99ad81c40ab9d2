// The legend beside the mesh, which explains the colours.
#pragma once

#include "host/show/canvas.h"

namespace vkh::drawing {

/// A picture while it is drawn. `unit`: pixels per unit of a picture of 1600 x 1000.
struct Sheet {
  Canvas& canvas;
  const Picture& picture;
  double unit;
};

/// Round numbers, with a power of ten if they are very small or large.
struct Ticks {
  std::vector<double> at;
  std::vector<std::string> text;
  std::string power;  ///< "1e-9", or empty
};
/// Returns round numbers in the range, from two to about `most`.
Ticks ticks_of(const Enclosure& range, size_t most);

/// The interval's ends as they are printed, rounded outward, but not across the limit.
struct PrintedInterval {
  std::string lower, upper;
};
PrintedInterval printed(const Picture& picture);
/// Returns "0.1 mm"; a number alone if the unit is not known.
std::string with_unit(const Picture& picture, const std::string& number);
/// The limit as the user typed it: a length, not a rounded bound.
std::string limit_text(const Picture& picture);
/// "the limit is 0.1 mm", for a share of a diagonal with its length, too; or "the limits are
/// +0.2 mm over and −0.1 mm under B".
std::string limit_clause(const Picture& picture);
/// A colour per verdict that all kinds of colour vision tell apart, also in grey.
Rgb verdict_colour(Verdict verdict);
/// Draws the directions of x, y and z.
void draw_axes(const Sheet& sheet, const Axes& axes, glm::dvec2 origin);
/// Draws a round length of the mesh, to scale; `at`: its left end.
void draw_ruler(const Sheet& sheet, const Camera& camera, glm::dvec2 at);

}  // namespace vkh::drawing
