// Points as discs that face the viewer.
#pragma once

#include "host/show/raster.h"

namespace vkh::drawing {

/// Writes a disc around `pixel` as a triangle around it, out of which the raster cuts it. `look`: a
/// corner's colours.
void put_disc(const Camera& camera, const glm::dvec3& pixel, const Corner& look, Corner* corners);

/// The light on a point, which has no normal: points farther from the viewer are darker.
double light_at(const Camera& camera, double depth);

}  // namespace vkh::drawing
