#include "host/show/map_scale.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "host/show/light.h"
#include "host/show/splat.h"

namespace vkh::drawing {
namespace {

Rgb mixed(Rgb from, Rgb to, double share) {
  const auto mix = [share](uint8_t x, uint8_t y) {
    return static_cast<uint8_t>(std::lround(x + (y - x) * share));
  };
  return {mix(from.red, to.red), mix(from.green, to.green), mix(from.blue, to.blue)};
}

// From blue over nearly white to red; paler within limits, so that distances beyond them stand out.
Rgb signed_colour(double share, bool is_pale) {
  constexpr Rgb kMiddle{238, 236, 230};
  const Rgb under = is_pale ? Rgb{126, 176, 214} : Rgb{33, 76, 168};
  const Rgb over = is_pale ? Rgb{243, 166, 138} : Rgb{178, 24, 43};
  return share < 0.5 ? mixed(under, kMiddle, 2 * share) : mixed(kMiddle, over, 2 * share - 1);
}

constexpr std::array<Rgb, 2> kBeyond{{{240, 100, 20}, {120, 0, 20}}};
constexpr std::array<Rgb, 2> kUnderBeyond{{{8, 28, 96}, {28, 84, 190}}};

}  // namespace

MapScale::MapScale(const Picture& picture, const PictureOptions& options)
    : map_(*picture.map),
      bar_(picture.shares != nullptr ? picture.shares->bar : bar_of(picture, options)) {
  set_palette(options);
}

MapBar MapScale::bar_of(const Picture& picture, const PictureOptions& options) {
  return vkh::bar_of(*picture.map, {.limit = picture.limit,
                                    .sided = picture.sided,
                                    .upper = picture.interval.upper,
                                    .range = options.range});
}

void MapScale::set_palette(const PictureOptions& options) {
  const auto at = [&](double limit) { return std::clamp(share_of(limit), 0.0, 1.0); };
  palette_.bands = std::min(options.bands, 255u);
  palette_.from = bar_.limit_under ? at(*bar_.limit_under) : 0;
  palette_.to = bar_.limit ? at(*bar_.limit) : 1;
  const auto step = [](size_t i, size_t count) {
    return static_cast<double>(i) / static_cast<double>(count - 1);
  };
  for (size_t i = 0; i < Palette::kOutside; ++i) {
    const double share = step(i, Palette::kOutside);
    palette_.below[i] = mixed(kUnderBeyond[0], kUnderBeyond[1], share);
    palette_.above[i] = mixed(kBeyond[0], kBeyond[1], share);
  }
  const double zero =
      std::clamp((share_of(0) - palette_.from) / (palette_.to - palette_.from), 1e-3, 1 - 1e-3);
  for (size_t i = 0; i < Palette::kWithin; ++i) {
    const double share = step(i, Palette::kWithin);
    const double turned = share < zero ? share / zero / 2 : 1 - (1 - share) / (1 - zero) / 2;
    palette_.within[i] = is_signed() ? signed_colour(turned, bar_.limit.has_value())
                                     : map_colour(options.map, share);
  }
}

Rgb MapScale::colour(double distance) const {
  const double share = share_of(distance);
  if (share > 1) return kOver;
  return share < 0 ? kBelow : palette_.colour(share);
}

std::optional<Rgb> MapScale::plain_colour(const MapCell& cell) const {
  if (is_left_out(cell)) return kLeftOut;
  return is_without_side(cell) ? std::optional(kNoSide) : std::nullopt;
}

namespace {

class CellWriter {
 public:
  CellWriter(const Picture& picture, const MapScale& scale, const Camera& camera)
      : picture_(picture), scale_(scale), camera_(camera) {}

  void operator()(size_t i, Corner* corners) const {
    const MapCell& cell = picture_.map->cells[i];
    if (picture_.mesh.are_points) {
      const glm::dvec3 at = camera_.pixel(picture_.mesh.vertices[cell.face]);
      Corner look = look_of(cell, light_at(camera_, at.z));
      look.share = share_at(cell, 0);
      return put_disc(camera_, at, look, corners);
    }
    const std::array<glm::dvec3, 3> at = pixels_of(cell);
    const Corner look = look_of(cell, light_on(normal_seen(at, camera_.scale)));
    for (size_t k = 0; k < at.size(); ++k) {
      corners[k] = look.placed_at(camera_.placed(at[k]));
      if (look.by_share != 0) corners[k].share = share_at(cell, k);
    }
  }

 private:
  // A corner of a cell without its place and its share.
  Corner look_of(const MapCell& cell, double light) const {
    const auto lit = [light](uint8_t c) {
      return static_cast<uint8_t>(std::floor(c * light + 0.5));
    };
    const auto hatched = static_cast<uint8_t>(scale_.is_unresolved(cell) ? 1 : 0);
    if (const std::optional<Rgb> plain = scale_.plain_colour(cell))
      return {.colour = {lit(plain->red), lit(plain->green), lit(plain->blue), 0},
              .hatched = hatched};
    return {.colour = {lit(255), 0, 0, 0}, .hatched = hatched, .by_share = 1};
  }
  float share_at(const MapCell& cell, size_t corner) const {
    const double share = scale_.share_of(scale_.distance_at(cell, corner));
    return static_cast<float>(std::clamp(share, -8.0, 8.0));
  }
  std::array<glm::dvec3, 3> pixels_of(const MapCell& cell) const {
    const glm::uvec3 f = picture_.mesh.faces[cell.face];
    const std::array<glm::dvec3, 3> face{picture_.mesh.vertices[f.x], picture_.mesh.vertices[f.y],
                                         picture_.mesh.vertices[f.z]};
    const std::array<glm::dvec3, 3> weights = weights_of(cell);
    std::array<glm::dvec3, 3> at;
    for (size_t i = 0; i < at.size(); ++i) {
      at[i] =
          camera_.pixel(weights[i].x * face[0] + weights[i].y * face[1] + weights[i].z * face[2]);
    }
    return at;
  }

  const Picture& picture_;
  const MapScale& scale_;
  const Camera& camera_;
};

}  // namespace

FillFaces cells_for(const Picture& picture, const MapScale& scale, const Camera& camera) {
  return filled_by(CellWriter(picture, scale, camera));
}

MapCounts counts_of(const CellMap& map, const MapScale& scale, const MapShares* known) {
  MapCounts counts{known != nullptr ? *known : shares_of(map, scale.bar()), {}};
  for (const MapCell& cell : map.cells) {
    const double share = scale.share_of(scale.distance_of(cell));
    if (scale.is_left_out(cell) || scale.is_without_side(cell) || share < 0 || share > 1) continue;
    const auto bin = static_cast<size_t>(share * MapCounts::kBins);
    counts.bins[std::min(bin, MapCounts::kBins - 1)] += static_cast<double>(cell.share);
  }
  return counts;
}

}  // namespace vkh::drawing
