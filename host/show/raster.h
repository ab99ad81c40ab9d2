// Draws faces to pixels, on all cores: the same bytes on every machine.
#pragma once

#include <functional>
#include <vector>

#include "host/base/parallel.h"
#include "host/show/camera.h"
#include "host/show/palette.h"

namespace vkh::drawing {

/// The colour of the stripes of unresolved cells, and their share of a period.
inline constexpr Rgb kStripe{74, 64, 51};
inline constexpr double kStripeShare = 0.42;

/// One corner of a face.
struct Corner {
  float x = 0, y = 0;      ///< pixels of the layer, from its upper left corner
  float z = 0;             ///< from the nearest, 0, to the farthest, 1
  float share = 0;         ///< of the bar, with `by_share`
  uint8_t colour[4] = {};  ///< three are used; with `by_share` the first is the light
  uint8_t hatched = 0, by_share = 0;
  uint8_t is_disc = 0;  ///< the circle inscribed in the face is drawn
  uint8_t pad = 0;

  /// The same corner at a place of a layer, as Camera::placed() returns it.
  Corner placed_at(const glm::dvec3& place) const {
    Corner corner = *this;
    corner.x = static_cast<float>(place.x);
    corner.y = static_cast<float>(place.y);
    corner.z = static_cast<float>(place.z);
    return corner;
  }
};

/// Writes the corners of `face_count` faces; an invisible face has three equal corners.
using FillFaces = std::function<void(size_t first_face, size_t face_count, Corner* corners)>;

/// Calls writer(face, its three corners) for each face, on several threads.
template <class Writer>
FillFaces filled_by(Writer writer) {
  return [writer](size_t first, size_t count, Corner* corners) {
    constexpr size_t kPiece = 4096;
    for_each_range_of(kPiece, count, [&](size_t, size_t begin, size_t end) {
      for (size_t i = begin; i < end; ++i) writer(first + i, corners + 3 * i);
    });
  };
}

/// A part of a picture; opacity is the share of a pixel that faces cover, white is the rest.
struct Layer {
  uint32_t width = 0, height = 0;
  std::vector<uint8_t> rgba;
};

struct RasterOptions {
  uint32_t width = 0, height = 0;  ///< of the layer, in pixels
  double line = 1;                 ///< the width of lines, in pixels; hatches go with it
  const Palette& palette;          ///< the colours of shares
};

/// Draws `face_count` faces, the nearest in front, with several samples a side of a pixel. Throws
/// std::bad_alloc if there is not enough memory.
Layer rasterized(const RasterOptions& options, size_t face_count, const FillFaces& fill);

}  // namespace vkh::drawing
