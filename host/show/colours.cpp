#include "host/show/colours.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "host/show/light.h"
#include "host/show/splat.h"

namespace vkh::drawing {
namespace {

double largest_finite(const std::vector<double>& values) {
  double largest = 0;
  for (const double v : values) {
    if (std::isfinite(v)) largest = std::max(largest, v);
  }
  return largest;
}

/// The darkness of edges: 0 for a face so thin that its edges would be most of it.
uint8_t edge_strength(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  constexpr double kNone = 8, kFull = 22, kDarkest = 0.38;  // altitudes in pixels; share
  const glm::dvec2 u(b - a), v(c - a), w(c - b);
  const double longest = std::sqrt(std::max({glm::dot(u, u), glm::dot(v, v), glm::dot(w, w)}));
  if (!(longest > 0)) return 0;
  const double altitude = std::abs(u.x * v.y - u.y * v.x) / longest;
  const double share = std::clamp((altitude - kNone) / (kFull - kNone), 0.0, 1.0);
  return static_cast<uint8_t>(std::lround(255 * kDarkest * share));
}

class FaceWriter {
 public:
  FaceWriter(const Picture& picture, const Scale& scale, const Camera& camera)
      : picture_(picture), scale_(scale), camera_(camera) {}

  void operator()(size_t face, Corner* corners) const {
    const FaceLook look = look_of(picture_, scale_, face);
    if (picture_.mesh.are_points) {
      const glm::dvec3 pixel = camera_.pixel(picture_.mesh.vertices[face]);
      return put_disc(camera_, pixel, corner_of(look, light_at(camera_, pixel.z), 0), corners);
    }
    std::array<glm::dvec3, 3> at;
    for (size_t i = 0; i < at.size(); ++i) {
      const auto corner = static_cast<glm::length_t>(i);
      at[i] = camera_.pixel(picture_.mesh.vertices[picture_.mesh.faces[face][corner]]);
    }
    const double light = light_on(normal_seen(at, camera_.scale));
    const uint8_t edges = edge_strength(at[0], at[1], at[2]);
    for (size_t i = 0; i < at.size(); ++i) {
      corners[i] = corner_of(look, light, edges).placed_at(camera_.clipped(at[i]));
    }
  }

 private:
  static Corner corner_of(const FaceLook& look, double light, uint8_t edges) {
    const auto lit = [&](uint8_t c) { return static_cast<uint8_t>(std::lround(c * light)); };
    return {.colour = {lit(look.colour.red), lit(look.colour.green), lit(look.colour.blue), edges},
            .hatched = static_cast<uint8_t>(look.hatched ? 1 : 0)};
  }

  const Picture& picture_;
  const Scale& scale_;
  const Camera& camera_;
};

}  // namespace

FillFaces faces_for(const Picture& picture, const Scale& scale, const Camera& camera) {
  return filled_by(FaceWriter(picture, scale, camera));
}

Scale::Scale(const Picture& picture, const PictureOptions& options)
    : map_(options.map), bands_(options.bands) {
  const double upper = picture.interval.upper;
  const double shown = std::isfinite(upper) ? upper : 0;  // the bar has room for it, too
  range_ =
      options.range.value_or(Enclosure{0, std::max(shown, largest_finite(picture.field.upper))});
}

double Scale::share_of(double length) const {
  const double width = range_.upper - range_.lower;
  // A range without width has one colour, and lengths above it another.
  if (!(width > 0)) return length > range_.upper ? 1 : 0;
  return std::clamp(length / width - range_.lower / width, 0.0, 1.0);
}

Rgb Scale::at_share(double share) const {
  if (bands_ == 0) return map_colour(map_, share);
  const double band = std::max(std::ceil(share * bands_), 1.0);  // an edge is the lower band's
  return map_colour(map_, bands_ == 1 ? 0.5 : (band - 1) / (bands_ - 1));
}

Rgb verdict_colour(Verdict verdict) {
  if (verdict == Verdict::kWithin) return {133, 178, 216};
  return verdict == Verdict::kBeyond ? Rgb{203, 38, 35} : Rgb{246, 205, 116};
}

FaceLook look_of(const Picture& picture, const Scale& scale, size_t face) {
  if (picture.limit) {
    const Verdict verdict = verdict_of(picture.field, face, *picture.limit);
    return {verdict_colour(verdict), verdict == Verdict::kUndecided};
  }
  const double upper = picture.field.upper[face];
  if (!std::isfinite(upper)) return {kUnbounded, true};
  return {scale.colour(upper), false};
}

FaceCounts count_faces(const Picture& picture, const Scale& scale) {
  FaceCounts counts;
  for (size_t face = 0; face < picture.field.face_count(); ++face) {
    if (picture.limit) {
      const Verdict verdict = verdict_of(picture.field, face, *picture.limit);
      ++(verdict == Verdict::kWithin   ? counts.within
         : verdict == Verdict::kBeyond ? counts.beyond
                                       : counts.undecided);
      continue;
    }
    const double upper = picture.field.upper[face];
    if (!std::isfinite(upper)) {
      ++counts.unbounded;
    } else if (upper > scale.range().upper) {
      ++counts.above;
    }
  }
  return counts;
}

}  // namespace vkh::drawing
