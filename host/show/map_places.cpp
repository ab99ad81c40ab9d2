#include "host/show/map_places.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "host/base/parallel.h"
#include "host/show/camera.h"
#include "host/show/page_words.h"
#include "host/show/shown_cells.h"

namespace vkh {
namespace {

constexpr double kLeastOfLargest = 0.1, kFall = 0.5;
constexpr int64_t kGrid = 64;
constexpr double kSpacings = 2.5;  // of points: a box has no empty boxes around it then

float largest_of(const MapCell& cell) {
  return std::max({cell.estimate[0], cell.estimate[1], cell.estimate[2]});
}

glm::dvec3 point_at(const Mesh& mesh, size_t face, const glm::dvec3& w) {
  const glm::uvec3 f = mesh.faces[face];
  const glm::dvec3 a = mesh.vertices[f.x], b = mesh.vertices[f.y], c = mesh.vertices[f.z];
  return w.x * a + w.y * b + w.z * c;
}

// The place at a corner of a cell, at that point.
MapPlace place_at(const glm::dvec3& point, const CellMap& map, const MapCell& cell, size_t corner) {
  const auto estimate = static_cast<double>(cell.estimate[corner]);
  return {.point = point,
          .distance = map.unit * estimate,
          .side = cell.side,
          .face = cell.face,
          .known = map.around(estimate, static_cast<double>(cell.width))};
}

// Whether a cell contains a point of its face, up to rounding.
bool has_point(const MapCell& cell, const glm::dvec3& barycentric) {
  const std::array<glm::dvec3, 3> t = weights_of(cell);
  const auto side = [&](const glm::dvec3& p, const glm::dvec3& q) {
    return (q.y - p.y) * (barycentric.z - p.z) - (q.z - p.z) * (barycentric.y - p.y);
  };
  constexpr double kRounding = 1e-9;
  return side(t[0], t[1]) >= -kRounding && side(t[1], t[2]) >= -kRounding &&
         side(t[2], t[0]) >= -kRounding;
}

// The place of the witness. It precedes places that are not proven to be farther.
MapPlace place_of_witness(const CellMap& map, const Witness& witness) {
  constexpr double kClosed = 1e-3;  // its ends are the same to the eye
  const Enclosure& known = witness.distance;
  const bool is_closed = known.upper <= known.lower * (1 + kClosed);
  MapPlace place{.point = witness.on_a.point,
                 .distance = is_closed ? known.upper : known.lower,
                 .face = witness.on_a.face,
                 .known = known,
                 .is_farthest = true};
  for (const MapCell& cell : map.cells) {
    if (cell.face == place.face && has_point(cell, witness.on_a.barycentric))
      place.side = cell.side;
  }
  return place;
}

// The boxes of a grid over the mesh, each with the farthest place in it. A cell that is larger than
// a box links the boxes of its corners, where they do not touch.
class MapGrid {
 public:
  explicit MapGrid(const Mesh& mesh) : number_(kRow * kRow * kRow, kNone) {
    glm::dvec3 lo = mesh.vertices[0], hi = lo;
    for (const glm::dvec3 v : mesh.vertices) {
      lo = glm::min(lo, v);
      hi = glm::max(hi, v);
    }
    const glm::dvec3 size = hi - lo;
    const double extent = std::max({size.x, size.y, size.z});
    lo_ = lo;
    step_ = extent > 0 ? extent / static_cast<double>(kGrid) : 1;
    step_ = std::max(step_, kSpacings * drawing::spacing_of(mesh));
  }

  /// Adds the corners of a cell that are at least `least` far; a point's three corners are one.
  void add(const Mesh& mesh, const CellMap& map, const MapCell& cell, float least) {
    if (largest_of(cell) < least) return;
    const std::array<glm::dvec3, 3> weights = weights_of(cell);
    std::optional<BoxAt> last;
    const size_t corners = mesh.are_points ? 1 : cell.estimate.size();
    for (size_t corner = 0; corner < corners; ++corner) {
      if (cell.estimate[corner] < least) continue;
      const glm::dvec3 point = point_at(mesh, cell.face, weights[corner]);
      const BoxAt box = box_of(point);
      put(box, map.unit * static_cast<double>(cell.estimate[corner]),
          [&] { return place_at(point, map, cell, corner); });
      if (last && !do_touch(*last, box)) link(number_[key_of(*last)], number_[key_of(box)]);
      last = box;
    }
  }

  void add(const MapPlace& place) {
    put(box_of(place.point), place.distance, [&] { return place; });
  }

  /// Adds the boxes of another grid over the same mesh, as if its cells had been added behind
  /// these.
  void add(const MapGrid& other) {
    for (const MapPlace& place : other.places_) add(place);
    const auto number = [&](size_t of_other) {
      return number_[key_of(box_of(other.places_[of_other].point))];
    };
    for (size_t box = 0; box < other.linked_.size(); ++box) {
      for (const size_t to : other.linked_[box]) linked_[number(box)].push_back(number(to));
    }
  }

  const std::vector<MapPlace>& places() const { return places_; }

  /// Calls visit(number) for the boxes around a box, and for the boxes that cells link to it.
  template <class Visit>
  void around(size_t number, const Visit& visit) const {
    for (const size_t other : linked_[number]) visit(other);
    const BoxAt box = box_of(places_[number].point);
    for (int64_t i = 0; i < 27; ++i) {
      const uint32_t found =
          number_[key_of({box[0] + i % 3 - 1, box[1] + i / 3 % 3 - 1, box[2] + i / 9 - 1})];
      if (found != kNone) visit(found);
    }
  }

 private:
  // Numbers along the axes. There are two more boxes at each end, since rounding may put a point
  // beside the mesh's box, and neighbours of its box are visited, too.
  using BoxAt = std::array<int64_t, 3>;
  static constexpr size_t kRow = kGrid + 5;
  static constexpr uint32_t kNone = UINT32_MAX;

  /// Keeps the farthest place of a box; make_place() makes it.
  template <class MakePlace>
  void put(const BoxAt& box, double distance, const MakePlace& make_place) {
    uint32_t& number = number_[key_of(box)];
    if (number == kNone) {
      number = static_cast<uint32_t>(places_.size());
      places_.push_back(make_place());
      linked_.emplace_back();
    } else if (distance > places_[number].distance) {
      places_[number] = make_place();
    }
  }
  static bool do_touch(const BoxAt& one, const BoxAt& two) {
    for (size_t axis = 0; axis < one.size(); ++axis) {
      if (std::abs(one[axis] - two[axis]) > 1) return false;
    }
    return true;
  }
  void link(size_t one, size_t two) {
    linked_[one].push_back(two);
    linked_[two].push_back(one);
  }
  BoxAt box_of(const glm::dvec3& p) const {
    const glm::dvec3 at = (p - lo_) / step_;
    return {number_along(at.x), number_along(at.y), number_along(at.z)};
  }
  static int64_t number_along(double at) {
    const double near = std::min(std::max(-1.0, at), kGrid + 1.0);
    const auto whole = static_cast<int64_t>(near);  // rounded down next: no call of a library
    return near < static_cast<double>(whole) ? whole - 1 : whole;
  }
  static size_t key_of(const BoxAt& box) {
    const auto along = [&](size_t axis) { return static_cast<size_t>(box[axis] + 2); };
    return along(0) + kRow * (along(1) + kRow * along(2));
  }

  glm::dvec3 lo_{};
  double step_ = 1;
  std::vector<uint32_t> number_;
  std::vector<MapPlace> places_;
  std::vector<std::vector<size_t>> linked_;
};

// Boxes from the farthest down: each joins the clusters beside it. Where two clusters meet, the
// less far one ends, unless its distance is twice the one where they meet.
class FarClusters {
 public:
  explicit FarClusters(const MapGrid& grid)
      : grid_(grid), first_(grid.places().size()), is_seen_(first_.size()) {
    std::vector<size_t> order(first_.size());
    for (size_t i = 0; i < order.size(); ++i) order[i] = first_[i] = i;
    std::sort(order.begin(), order.end(), [&](size_t x, size_t y) {
      const MapPlace &p = grid.places()[x], &q = grid.places()[y];
      return p.distance != q.distance ? p.distance > q.distance : x < y;
    });
    for (const size_t box : order) add(box);
    for (const size_t box : order) {
      if (first_of(box) == box) peaks_.push_back(box);
    }
    peaks_.insert(peaks_.end(), kept_.begin(), kept_.end());
    std::sort(peaks_.begin(), peaks_.end(), [&](size_t x, size_t y) { return is_before(x, y); });
  }

  const std::vector<size_t>& peaks() const { return peaks_; }

 private:
  bool is_before(size_t x, size_t y) const {
    const double p = grid_.places()[x].distance, q = grid_.places()[y].distance;
    return p != q ? p > q : x < y;
  }
  size_t first_of(size_t box) {
    while (first_[box] != box) box = first_[box] = first_[first_[box]];
    return box;
  }
  void add(size_t box) {
    is_seen_[box] = true;
    const MapPlace& here = grid_.places()[box];
    grid_.around(box, [&](size_t other) {
      if (!is_seen_[other]) return;
      size_t one = first_of(box), two = first_of(other);
      if (one == two) return;
      if (!is_before(one, two)) std::swap(one, two);
      if (here.distance < kFall * grid_.places()[two].distance) kept_.push_back(two);
      first_[two] = one;
    });
  }

  const MapGrid& grid_;
  std::vector<size_t> first_;
  std::vector<bool> is_seen_;
  std::vector<size_t> kept_, peaks_;
};

// A stray triangle must not make all other places too small: if the bar's end is nearer, that
// counts.
float least_of_places(const CellMap& map, float largest) {
  const double end = std::min(static_cast<double>(largest), map.bar / map.unit);
  return static_cast<float>(kLeastOfLargest * (end > 0 ? end : static_cast<double>(largest)));
}

// The boxes of all cells with a place that is at least `least` far. Cells are added in lots, with
// the same result as on one thread.
MapGrid grid_of(const Mesh& mesh, const CellMap& map, float least) {
  constexpr size_t kLeastLot = size_t{1} << 17;  // cells: a grid takes 1.3 MB
  const size_t count = map.cells.size(), size = std::max(kLeastLot, count / thread_count() + 1);
  std::vector<MapGrid> lots((count + size - 1) / size, MapGrid(mesh));
  for_each_range_of(size, count, [&](size_t lot, size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      if (!map.is_left_out(map.cells[i])) lots[lot].add(mesh, map, map.cells[i], least);
    }
  });
  MapGrid grid = std::move(lots.front());
  for (size_t lot = 1; lot < lots.size(); ++lot) grid.add(lots[lot]);
  return grid;
}

}  // namespace

std::vector<MapPlace> map_places(const Mesh& mesh, const CellMap& map, size_t most,
                                 const std::optional<Witness>& witness) {
  float largest = 0;
  for (const MapCell& cell : map.cells) {
    if (!map.is_left_out(cell)) largest = std::max(largest, largest_of(cell));
  }
  if (static_cast<double>(largest) <= map.least) return {};
  const float least = least_of_places(map, largest);
  MapGrid grid = grid_of(mesh, map, least);
  const double farthest = map.max_distance.value_or(std::numeric_limits<double>::infinity());
  if (witness && witness->distance.lower <= farthest &&
      witness->distance.lower > static_cast<double>(least) * map.unit)
    grid.add(place_of_witness(map, *witness));
  std::vector<MapPlace> places;
  const FarClusters clusters(grid);
  for (const size_t peak : clusters.peaks()) {
    if (places.size() == most) break;
    MapPlace& place = places.emplace_back(grid.places()[peak]);
    if (place.is_farthest) place.distance = place.known.lower;
    if (witness) place.known.upper = std::min(place.known.upper, witness->distance.upper);
    place.distance = std::clamp(place.distance, place.known.lower, place.known.upper);
  }
  return places;
}

std::vector<MapPlace> worst_places(const Picture& picture) {
  constexpr size_t kMostPlaces = 5;
  if (picture.map != nullptr)
    return map_places(picture.mesh, *picture.map, kMostPlaces, picture.witness);
  const CellMap map = map_of_lower_bounds(picture.mesh, picture.field);
  std::vector<MapPlace> places = map_places(picture.mesh, map, kMostPlaces, picture.witness);
  for (MapPlace& place : places) {
    if (place.is_farthest) continue;
    place.point = point_at(picture.mesh, place.face, glm::dvec3(1.0 / 3));
    place.known = picture.field.of(place.face);
    place.distance = std::clamp(place.distance, place.known.lower, place.known.upper);
  }
  return places;
}

std::string place_text(const Picture& picture, const MapPlace& place) {
  const bool is_signed = picture.map != nullptr && picture.map->has_sides;
  const std::string number = estimate_text(place.distance, place.known,
                                           picture.limit && !is_signed ? *picture.limit : Limit{});
  const bool is_under = is_signed && place.side == SurfaceSide::kUnder;
  const char* sign = is_under ? "\u2212" : is_signed && place.side == SurfaceSide::kOver ? "+" : "";
  return sign + number + (picture.unit.empty() ? "" : " " + picture.unit);
}

}  // namespace vkh
