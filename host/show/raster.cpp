#include "host/show/raster.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

#include "host/base/uint128.h"
#include "host/show/map_scale.h"

namespace vkh::drawing {
namespace {

// 72 MiB of corners at once.
constexpr size_t kFacesAtOnce = size_t{1} << 20;
constexpr int kMostSamples = 4;                      // per side: 16 a pixel
constexpr uint64_t kMostInAll = uint64_t{40} << 20;  // of samples: 320 MiB of colour and depth
constexpr int kTile = 64;                            // pixels a side: 512 KiB of samples
constexpr int64_t kSub = 256;                        // steps of a corner's place in a sample
constexpr size_t kPiece = 16384;                     // faces that a thread sorts into tiles
constexpr size_t kAhead = 12;                        // faces whose memory is asked for before

int samples_for(uint32_t width, uint32_t height) {
  int n = kMostSamples;
  while (n > 1 && uint64_t(n * n) * width * height > kMostInAll) --n;
  return n;
}

/// A bar's colours at even steps: a step is too short to be seen.
class Colours {
 public:
  explicit Colours(const Palette& palette) {
    at_[0] = kBelow;
    at_[kSteps + 2] = kOver;
    for (int i = 0; i <= kSteps; ++i)
      at_[static_cast<size_t>(i) + 1] = palette.colour(static_cast<double>(i) / kSteps);
  }
  Rgb operator()(float share) const {
    if (share < 0) return at_.front();
    return share > 1 ? at_.back() : at_[1 + static_cast<size_t>(share * kSteps)];
  }

 private:
  static constexpr int kSteps = 4096;
  std::array<Rgb, kSteps + 3> at_;
};

/// Samples of a tile, row by row.
struct Samples {
  std::vector<float> depth;
  std::vector<std::array<uint8_t, 4>> colour;

  void clear(size_t count) {
    depth.assign(count, 2);
    colour.assign(count, {255, 255, 255, 0});
  }
};

/// A value that is affine over the samples.
struct Plane {
  float at_origin, by_x, by_y;
  float at(int x, int y) const {
    return at_origin + by_x * static_cast<float>(x) + by_y * static_cast<float>(y);
  }
};

/// Finds the samples on one side of a line, by integers: a sample on an edge that two faces share
/// belongs to one of them.
struct Edge {
  int64_t at_origin, by_x, by_y;

  /// Narrows [from, to) to the samples of row y that are inside.
  void narrow(int y, int& from, int& to) const {
    const int64_t row = at_origin + by_y * y;
    if (by_x == 0) {
      if (row < 0) to = from;
    } else if (by_x > 0) {
      const int64_t first = row >= 0 ? 0 : (-row + by_x - 1) / by_x;
      from = static_cast<int>(std::clamp<int64_t>(first, from, std::max(from, to)));
    } else {
      to = static_cast<int>(std::min<int64_t>(to, row < 0 ? 0 : row / -by_x + 1));
    }
  }
};

using Triangle = std::array<std::array<int64_t, 2>, 3>;

/// Rounds halves away from 0, as llround() does, which is a call: a product of a float and a power
/// of two, or three times one, has room for the half that is added.
int64_t nearest(double product) {
  return static_cast<int64_t>(product + std::copysign(0.5, product));
}

class Raster {
 public:
  explicit Raster(const RasterOptions& options)
      : options_(options),
        samples_(samples_for(options.width, options.height)),
        colours_(options.palette),
        columns_((options.width + kTile - 1) / kTile),
        rows_((options.height + kTile - 1) / kTile),
        kept_(columns_ * rows_) {
    layer_.width = options.width;
    layer_.height = options.height;
    layer_.rgba.resize(size_t{4} * options.width * options.height);
  }

  Layer draw(size_t face_count, const FillFaces& fill) {
    std::vector<Corner> corners(3 * std::min(face_count, kFacesAtOnce));
    for (size_t first = 0; first < std::max<size_t>(face_count, 1); first += kFacesAtOnce) {
      const size_t count = std::min(kFacesAtOnce, face_count - first);
      fill(first, count, corners.data());
      corners_ = {corners.data(), 3 * count};
      sort_into_tiles(count);
      const bool is_last = first + count >= face_count;
      for_each_index(kept_.size(), [&](size_t tile) { draw_tile(tile, is_last); });
    }
    return std::move(layer_);
  }

 private:
  int side() const { return samples_ * kTile; }

  Triangle triangle_of(size_t face) const {
    Triangle places;
    const double scale = static_cast<double>(samples_ * kSub);
    for (size_t i = 0; i < 3; ++i) {
      const Corner& c = corners_[3 * face + i];
      places[i] = {nearest(static_cast<double>(c.x) * scale),
                   nearest(static_cast<double>(c.y) * scale)};
    }
    return places;
  }

  /// The first and the last tile, by column and row, that a face may touch; none: first > last.
  struct Range {
    int64_t x0, y0, x1, y1;
  };
  Range tiles_of(size_t face) const {
    const Triangle p = triangle_of(face);
    const auto size = static_cast<uint32_t>(side() * kSub);
    const auto [x0, x1] = std::minmax({p[0][0], p[1][0], p[2][0]});
    const auto [y0, y1] = std::minmax({p[0][1], p[1][1], p[2][1]});
    const auto tile = [&](int64_t at, size_t count) {
      const int64_t last = static_cast<int64_t>(count) * size - 1;
      return static_cast<uint32_t>(std::clamp<int64_t>(at, 0, last)) / size;
    };
    if (x1 < 0 || y1 < 0) return {1, 1, 0, 0};
    return {tile(x0, columns_), tile(y0, rows_), tile(x1, columns_), tile(y1, rows_)};
  }
  template <class Visit>
  void for_tiles(size_t face, const Visit& visit) const {
    const Range r = tiles_of(face);
    for (int64_t y = r.y0; y <= r.y1; ++y) {
      for (int64_t x = r.x0; x <= r.x1; ++x)
        visit(static_cast<size_t>(y) * columns_ + static_cast<size_t>(x));
    }
  }

  /// Lists the faces of each tile in their order: pieces count theirs, then write them.
  void sort_into_tiles(size_t count) {
    const size_t tiles = kept_.size(), pieces = (count + kPiece - 1) / kPiece;
    std::vector<size_t> to(pieces * tiles);  // by tile, then by piece
    for_each_range_of(kPiece, count, [&](size_t piece, size_t begin, size_t end) {
      for (size_t f = begin; f < end; ++f)
        for_tiles(f, [&](size_t tile) { ++to[tile * pieces + piece]; });
    });
    begins_.assign(1, 0);
    size_t sum = 0;
    for (size_t i = 0; i < to.size(); ++i) {
      sum += std::exchange(to[i], sum);
      if ((i + 1) % pieces == 0) begins_.push_back(sum);
    }
    begins_.resize(tiles + 1, 0);
    faces_.resize(sum);
    for_each_range_of(kPiece, count, [&](size_t piece, size_t begin, size_t end) {
      for (size_t f = begin; f < end; ++f)
        for_tiles(f, [&](size_t tile) {
          faces_[to[tile * pieces + piece]++] = static_cast<uint32_t>(f);
        });
    });
  }

  void draw_tile(size_t tile, bool is_last) {
    Samples samples = std::move(kept_[tile]);
    const bool is_empty = begins_[tile] == begins_[tile + 1] && samples.depth.empty();
    if (!is_empty && samples.depth.empty())
      samples.clear(static_cast<size_t>(side()) * static_cast<size_t>(side()));
    const size_t end = begins_[tile + 1];
    for (size_t i = begins_[tile]; i < end; ++i) {
      if (i + kAhead < end) fetch(faces_[i + kAhead]);
      draw_face(faces_[i], tile, samples);
    }
    if (is_last) {
      average(tile, samples);
    } else {
      kept_[tile] = std::move(samples);
    }
  }

  /// Prefetches, since a tile's faces are scattered in memory, and waiting for it took a third of
  /// the time.
  void fetch(size_t face) const {
    prefetch_to_read(&corners_[3 * face]);
    prefetch_to_read(&corners_[3 * face + 2].pad);
  }

  /// A face in the samples of a tile.
  struct Shape {
    std::array<size_t, 3> order;  ///< of the corners, so that the area is positive
    double area;                  ///< twice
    std::array<Edge, 3> edges;
    std::array<Plane, 2> weights;  ///< of the second and the third corner; only for discs
    Plane depth, share;
    int y0, y1;
  };
  int origin_x(size_t tile) const { return static_cast<int>(tile % columns_) * side(); }
  int origin_y(size_t tile) const { return static_cast<int>(tile / columns_) * side(); }

  /// Whether the face has an area; both of its sides are seen. `shape` gets no planes yet.
  bool shape_of(size_t face, size_t tile, Shape& shape) const {
    Triangle p = triangle_of(face);
    shape.order = {0, 1, 2};
    const auto twice_area = [&] {
      return (p[1][0] - p[0][0]) * (p[2][1] - p[0][1]) - (p[1][1] - p[0][1]) * (p[2][0] - p[0][0]);
    };
    int64_t area = twice_area();
    if (area == 0) return false;
    if (area < 0) {
      std::swap(p[1], p[2]);
      std::swap(shape.order[1], shape.order[2]);
      area = -area;
    }
    shape.area = static_cast<double>(area);
    const int64_t x = kSub * origin_x(tile) + kSub / 2, y = kSub * origin_y(tile) + kSub / 2;
    for (size_t i = 0; i < 3; ++i) {  // the edge that faces corner i
      const auto &a = p[(i + 1) % 3], &b = p[(i + 2) % 3];
      const int64_t dx = b[0] - a[0], dy = b[1] - a[1];
      const bool has_its_samples = dy > 0 || (dy == 0 && dx > 0);
      shape.edges[i] = {dx * (y - a[1]) - dy * (x - a[0]) - (has_its_samples ? 0 : 1), -dy * kSub,
                        dx * kSub};
    }
    const auto [least, most] = std::minmax({p[0][1], p[1][1], p[2][1]});
    shape.y0 = static_cast<int>(std::clamp<int64_t>((least - y) / kSub, 0, side()));
    shape.y1 = static_cast<int>(std::clamp<int64_t>((most - y) / kSub + 1, 0, side()));
    return true;
  }

  void set_planes(size_t face, Shape& shape) const {
    const auto weight = [&](size_t i) {
      const Edge& e = shape.edges[i];
      return std::array<double, 3>{static_cast<double>(e.at_origin) / shape.area,
                                   static_cast<double>(e.by_x) / shape.area,
                                   static_cast<double>(e.by_y) / shape.area};
    };
    const std::array<double, 3> one = weight(1), two = weight(2);
    const auto plane = [&](double a, double b, double c) {
      const double u = b - a, v = c - a;
      return Plane{static_cast<float>(a + u * one[0] + v * two[0]),
                   static_cast<float>(u * one[1] + v * two[1]),
                   static_cast<float>(u * one[2] + v * two[2])};
    };
    const Corner* c = &corners_[3 * face];
    const Corner &p = c[shape.order[0]], &q = c[shape.order[1]], &r = c[shape.order[2]];
    shape.depth =
        plane(static_cast<double>(p.z), static_cast<double>(q.z), static_cast<double>(r.z));
    shape.share = plane(static_cast<double>(p.share), static_cast<double>(q.share),
                        static_cast<double>(r.share));
    if (c->is_disc != 0) shape.weights = {plane(0, 1, 0), plane(0, 0, 1)};
  }

  void draw_face(size_t face, size_t tile, Samples& samples) const {
    Shape shape;
    if (!shape_of(face, tile, shape)) return;
    const Corner& look = corners_[3 * face];
    bool has_planes = false;  // a small face may have no sample
    for (int y = shape.y0; y < shape.y1; ++y) {
      int from = 0, to = side();
      for (const Edge& edge : shape.edges) edge.narrow(y, from, to);
      if (from >= to) continue;
      if (!has_planes) set_planes(face, shape);
      has_planes = true;
      const size_t row = static_cast<size_t>(y) * static_cast<size_t>(side());
      for (int x = from; x < to; ++x) {
        const float depth = shape.depth.at(x, y);
        const size_t at = row + static_cast<size_t>(x);
        if (!(depth < samples.depth[at])) continue;
        const float off = look.is_disc != 0 ? from_middle(shape, x, y) : 0;
        if (off > 1) continue;
        samples.depth[at] = depth;
        samples.colour[at] = colour_at(look, shape, {x, y}, {tile, off});
      }
    }
  }

  /// The square of the distance from a regular triangle's middle: 1 on the inscribed circle.
  static float from_middle(const Shape& shape, int x, int y) {
    const float v = shape.weights[0].at(x, y) - 1 / 3.0f, w = shape.weights[1].at(x, y) - 1 / 3.0f;
    return 6 * (v * v + w * w + (v + w) * (v + w));
  }

  struct Sample {
    int x, y;
  };
  struct Drawn {
    size_t tile;
    float off;
  };
  std::array<uint8_t, 4> colour_at(const Corner& look, const Shape& shape, Sample at,
                                   Drawn in) const {
    Rgb shown{look.colour[0], look.colour[1], look.colour[2]};
    if (look.by_share != 0) {
      const Rgb c = colours_(shape.share.at(at.x, at.y));
      const auto lit = [&](uint8_t part) {
        return static_cast<uint8_t>((part * look.colour[0] + 127) / 255);
      };
      shown = {lit(c.red), lit(c.green), lit(c.blue)};
    }
    if (look.hatched != 0 && is_stripe(origin_x(in.tile) + at.x + origin_y(in.tile) + at.y))
      shown = kStripe;
    if (look.is_disc != 0) {
      constexpr float kRim = 0.3f;  // the darkness of a rim, which tells discs from each other
      const float light = 1 - kRim * in.off * in.off;
      const auto lit = [&](uint8_t part) {
        return static_cast<uint8_t>(std::lround(static_cast<float>(part) * light));
      };
      shown = {lit(shown.red), lit(shown.green), lit(shown.blue)};
    }
    return {shown.red, shown.green, shown.blue, 255};
  }

  bool is_stripe(int along) const {
    constexpr double kLines = 7;  // of a period
    const double at = (along + 1) / (kLines * options_.line * samples_);
    return at - std::floor(at) < kStripeShare;
  }

  /// Writes a tile's pixels. One without samples is white, and covers nothing.
  void average(size_t tile, const Samples& samples) {
    const size_t n = static_cast<size_t>(samples_), in_all = n * n;
    const size_t x0 = tile % columns_ * kTile, y0 = tile / columns_ * kTile;
    const size_t x1 = std::min<size_t>(x0 + kTile, options_.width);
    const size_t y1 = std::min<size_t>(y0 + kTile, options_.height);
    for (size_t y = y0; y < y1; ++y) {
      for (size_t x = x0; x < x1; ++x) {
        std::array<size_t, 4> sum{255 * in_all, 255 * in_all, 255 * in_all, 0};
        if (!samples.colour.empty()) sum = sum_of(samples, (x - x0) * n, (y - y0) * n);
        for (size_t i = 0; i < 4; ++i)
          layer_.rgba[4 * (y * options_.width + x) + i] =
              static_cast<uint8_t>((sum[i] + in_all / 2) / in_all);
      }
    }
  }
  std::array<size_t, 4> sum_of(const Samples& samples, size_t x, size_t y) const {
    std::array<size_t, 4> sum{};
    const size_t n = static_cast<size_t>(samples_);
    for (size_t j = y; j < y + n; ++j) {
      for (size_t k = x; k < x + n; ++k) {
        const auto& c = samples.colour[j * static_cast<size_t>(side()) + k];
        for (size_t i = 0; i < 4; ++i) sum[i] += c[i];
      }
    }
    return sum;
  }

  const RasterOptions& options_;
  int samples_;  ///< per side of a pixel
  Colours colours_;
  size_t columns_, rows_;      ///< of tiles
  std::vector<Samples> kept_;  ///< of each tile, from one lot of faces to the next
  std::span<const Corner> corners_;
  std::vector<size_t> begins_;  ///< of each tile's faces in `faces_`, and the end
  std::vector<uint32_t> faces_;
  Layer layer_;
};

}  // namespace

Layer rasterized(const RasterOptions& options, size_t face_count, const FillFaces& fill) {
  return Raster(options).draw(face_count, fill);
}

}  // namespace vkh::drawing
