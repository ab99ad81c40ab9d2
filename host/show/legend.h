// What explains the colours, beside the mesh.
#pragma once

#include "host/show/canvas.h"

namespace vkh::drawing {

/// A picture while it is drawn. `unit`: pixels of what is one in a picture of 1600 x 1000.
struct Sheet {
  Canvas& canvas;
  const Picture& picture;
  const Scale& scale;
  double unit;
};

/// Round numbers, of a power of ten where they are very small or large.
struct Ticks {
  std::vector<double> at;
  std::vector<std::string> text;
  std::string power;  ///< "1e-9", or empty
};
/// Round numbers in the range, from two to about `most`.
Ticks ticks_of(const Enclosure& range, size_t most);

/// The interval's ends as they are printed, rounded outward, and neither on the other side of the
/// limit.
struct PrintedInterval {
  std::string lower, upper;
};
PrintedInterval printed(const Picture& picture);
/// "0.1 mm"; a number alone where nobody knows the unit.
std::string with_unit(const Picture& picture, const std::string& number);
/// What was asked about: a length, and no bound.
std::string limit_text(const Picture& picture);
/// And, of a share of a diagonal, how long that is.
std::string limit_caption(const Picture& picture);
/// "12,345".
std::string grouped(size_t count);

/// A bar with ticks, and the interval on it.
void draw_bar(const Sheet& sheet, const Area& area);
/// The three verdicts, and how many faces have each.
void draw_verdicts(const Sheet& sheet, const Area& area);
/// Where x, y and z point to.
void draw_axes(const Sheet& sheet, const Axes& axes, glm::dvec2 origin);
/// A round length of the mesh, to scale; `at`: its left end.
void draw_ruler(const Sheet& sheet, const Camera& camera, glm::dvec2 at);

}  // namespace vkh::drawing
