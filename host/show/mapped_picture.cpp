#include "host/show/mapped_picture.h"

#include <algorithm>
#include <cmath>

#include "host/show/shown_cells.h"

namespace vkh::drawing {
namespace {

/// The distance that 99 % of the area, or of the points, is within, or the largest if that is not
/// known.
double bar_of(const Picture& picture) {
  const double top = largest_known(picture);
  const bool has_any = picture.statistics && !picture.statistics->percentiles.empty();
  const double end = has_any ? picture.statistics->percentiles.back().distance.upper : top;
  return end > 0 && end < top ? end : top;
}

}  // namespace

double largest_known(const Picture& picture) {
  if (std::isfinite(picture.interval.upper)) return picture.interval.upper;
  double top = 0;
  for (size_t f = 0; f < picture.field.face_count(); ++f) {
    const double upper = picture.field.upper[f];
    top = std::max(top, std::isfinite(upper) ? upper : picture.field.lower[f]);
  }
  return top;
}

MappedPicture::MappedPicture(const Picture& picture, const PictureOptions& options)
    : drawn(picture), places(worst_places(picture)) {
  if (drawn.map == nullptr)
    drawn.map = &bounds.emplace(map_of_bounds(drawn.mesh, drawn.field, bar_of(drawn)));
  scale.emplace(drawn, options);
  counts = counts_of(*drawn.map, *scale, drawn.shares);
}

std::string MappedPicture::colours_of_bounds() const {
  return std::string("Each ") + (drawn.mesh.are_points ? "point" : "face") +
         " has the colour of the middle of its bounds; those of hatched ones are farther apart "
         "than a tenth of the bar.";
}

}  // namespace vkh::drawing
