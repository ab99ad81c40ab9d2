#include "host/show/splat.h"

#include <algorithm>
#include <array>

namespace vkh::drawing {

void put_disc(const Camera& camera, const glm::dvec3& pixel, const Corner& look, Corner* corners) {
  constexpr double kHalfRoot3 = 0.8660254037844386;
  const double far = 2 * camera.disc();  // an inscribed circle has half the circle's radius
  constexpr std::array<glm::dvec2, 3> kWays{glm::dvec2{0, -1}, glm::dvec2{kHalfRoot3, 0.5},
                                            glm::dvec2{-kHalfRoot3, 0.5}};
  for (size_t i = 0; i < kWays.size(); ++i) {
    corners[i] = look.placed_at(camera.placed(pixel + glm::dvec3(far * kWays[i], 0)));
    corners[i].is_disc = 1;
  }
}

double light_at(const Camera& camera, double depth) {
  constexpr double kDarkest = 0.78;
  const double share = (depth + camera.reach) / (camera.before + camera.reach);
  return kDarkest + (1 - kDarkest) * std::clamp(share, 0.0, 1.0);
}

}  // namespace vkh::drawing
