// The colour of a face, and the light on it.
#pragma once

#include <cstddef>
#include <cstdint>

#include "host/show/raster.h"
#include "vkhausdorff/colour_map.h"

namespace vkh::drawing {

inline constexpr Rgb kUnbounded{215, 215, 215};  ///< for a face with an infinite upper: hatched

/// Maps lengths to colours.
class Scale {
 public:
  Scale(const Picture& picture, const PictureOptions& options);

  const Enclosure& range() const { return range_; }
  uint32_t bands() const { return bands_; }
  double share_of(double length) const;  ///< share of the range, in [0, 1]
  Rgb at_share(double share) const;
  Rgb colour(double length) const { return at_share(share_of(length)); }

 private:
  ColourMap map_;
  uint32_t bands_;
  Enclosure range_;
};

/// A colour per verdict that all kinds of colour vision tell apart, also in grey.
Rgb verdict_colour(Verdict verdict);

struct FaceLook {
  Rgb colour;
  bool hatched = false;
};
FaceLook look_of(const Picture& picture, const Scale& scale, size_t face);

/// Fills in the picture's faces for a raster, as the camera sees them.
FillFaces faces_for(const Picture& picture, const Scale& scale, const Camera& camera);

/// Counts of faces, by verdict if there is a limit; otherwise of those that the scale does not
/// show.
struct FaceCounts {
  size_t within = 0, beyond = 0, undecided = 0;
  size_t above = 0;      ///< upper is above the range
  size_t unbounded = 0;  ///< upper is infinite
};
FaceCounts count_faces(const Picture& picture, const Scale& scale);

}  // namespace vkh::drawing
