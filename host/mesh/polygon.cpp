// Uses exact orientations of the corners' projection along the axis in which Newell's normal is
// largest: to drop a coordinate rounds nothing.
//
// Triangles that turn to the left, or not at all, and whose directed edges add up to the outline,
// cover each point of the projection as often as the outline winds round it. So ears that are
// clipped tile the polygon if and only if no two of them overlap, which is tested: that finds every
// outline that crosses itself, no matter how ears were clipped.
#include "vkhausdorff/polygon.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>
#include <optional>
#include <vector>

#include "host/base/decimal.h"
#include "host/mesh/exact_sum.h"
#include "host/mesh/make_mesh.h"
#include "vkhausdorff/note.h"

namespace vkh {
namespace {

// A fan's corners, in their order.
class Corners {
 public:
  Corners(std::span<const glm::dvec3> vertices, std::span<const glm::uvec3> fan)
      : vertices_(vertices), fan_(fan) {}
  size_t size() const { return fan_.size() + 2; }
  uint32_t number(size_t i) const { return i < 2 ? fan_[0][static_cast<int>(i)] : fan_[i - 2][2]; }
  const glm::dvec3& operator[](size_t i) const { return vertices_[number(i)]; }

 private:
  std::span<const glm::dvec3> vertices_;
  std::span<const glm::uvec3> fan_;
};

using Ring = std::vector<Point2>;

// The number of tests of a corner against an ear, or of two triangles, for each corner of a
// polygon: enough to always decide 4,096 corners, and few enough to keep a file's cost proportional
// to its size.
constexpr uint64_t kTestsPerCorner = 4096;

// Scales the largest coordinate to about 1, so that products neither overflow nor vanish.
double scale_of(const Corners& corners) {
  double largest = 0;
  for (size_t i = 0; i < corners.size(); ++i) {
    const glm::dvec3& p = corners[i];
    largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  }
  if (largest > 1e-60 && largest < 1e60) return 1;
  return largest == 0 ? 1 : std::ldexp(1.0, std::clamp(-std::ilogb(largest), -1000, 1000));
}

glm::dvec3 newell(const Corners& corners) {
  const double scale = scale_of(corners);
  const glm::dvec3 first = corners[0] * scale;
  glm::dvec3 sum(0);
  for (size_t i = 2; i < corners.size(); ++i)
    sum += glm::cross(corners[i - 1] * scale - first, corners[i] * scale - first);
  return sum;
}

// Orders axes from the largest component of the normal to the smallest; of equal ones the first
// axis first. std::stable_sort would take memory for its buffer.
std::array<int, 3> axes_by_size(const glm::dvec3& normal) {
  std::array<int, 3> axes = {0, 1, 2};
  std::sort(axes.begin(), axes.end(), [&](int i, int j) {
    const double a = std::abs(normal[i]), b = std::abs(normal[j]);
    return a > b || (a == b && i < j);
  });
  return axes;
}

Ring projected(const Corners& corners, int axis) {
  Ring ring;
  ring.reserve(corners.size());
  for (size_t i = 0; i < corners.size(); ++i) {
    const glm::dvec3& p = corners[i];
    ring.push_back({p[(axis + 1) % 3], p[(axis + 2) % 3]});
  }
  return ring;
}

enum class Shape { kConvex, kWindsOften, kOther };

// A ring is convex if all turns are to one side, no straight corner turns back, and there is one
// turn in all. Directions, which are told apart by the order of an edge's ends, change from one
// half to the other twice a turn.
Shape shape_of(Ring ring) {
  ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
  while (ring.size() > 1 && ring.back() == ring.front()) ring.pop_back();
  const size_t count = ring.size();
  if (count < 3) return Shape::kOther;
  int side = 0;
  size_t changes = 0;
  for (size_t i = 0; i < count; ++i) {
    const Point2 &a = ring[i], &b = ring[(i + 1) % count], &c = ring[(i + 2) % count];
    const bool is_change = (a < b) != (b < c);
    const int turn = turn_of(a, b, c);
    if ((turn == 0 && is_change) || turn * side < 0) return Shape::kOther;
    if (turn != 0) side = turn;
    changes += is_change ? 1 : 0;
  }
  if (side == 0) return Shape::kOther;
  return changes == 2 ? Shape::kConvex : Shape::kWindsOften;
}

int area_sign(const Ring& ring) {
  ExactSum twice;
  for (size_t i = 0, before = ring.size() - 1; i < ring.size(); before = i++) {
    twice.add_product(ring[before][0], ring[i][1], false);
    twice.add_product(ring[before][1], ring[i][0], true);
  }
  return twice.sign();
}

// Whether each pair of corners that differ, and any third, is a segment.
bool are_on_a_line(const Corners& corners) {
  size_t other = 0;
  while (other < corners.size() && corners[other] == corners[0]) ++other;
  for (size_t i = other; i < corners.size(); ++i) {
    if (!is_degenerate(corners[0], corners[other], corners[i])) return false;
  }
  return true;
}

using Triangle = std::array<uint32_t, 3>;

class Clipper {
 public:
  /// Requires a ring that turns to the left in all.
  explicit Clipper(const Ring& ring) : ring_(ring), tests_left_(kTestsPerCorner * ring.size()) {
    const auto count = static_cast<uint32_t>(ring.size());
    next_.reserve(count);
    before_.reserve(count);
    for (uint32_t i = 0; i < count; ++i) {
      next_.push_back((i + 1) % count);
      before_.push_back((i + count - 1) % count);
    }
    fill_cells();
  }

  /// Returns the triangles, or nothing if they do not tile the ring's inside.
  std::optional<std::vector<Triangle>> clip() {
    uint32_t left = static_cast<uint32_t>(ring_.size());
    uint32_t at = without_spikes(left);
    while (left > 3) {
      const std::optional<uint32_t> corner = find_ear(at, left);
      if (!corner) return std::nullopt;
      take(*corner);
      at = next_[next_[*corner]];
      --left;
    }
    if (turn_at(at) < 0) return std::nullopt;
    take(at);
    if (do_overlap()) return std::nullopt;
    return std::move(triangles_);
  }
  /// Whether clip() ended only because its tests ran out.
  bool is_out_of_tests() const { return tests_left_ == 0; }

 private:
  const Point2& point(uint32_t corner) const { return ring_[corner]; }
  int turn(uint32_t a, uint32_t b, uint32_t c) const {
    return turn_of(point(a), point(b), point(c));
  }
  int turn_at(uint32_t corner) const { return turn(before_[corner], corner, next_[corner]); }

  void take(uint32_t corner) {
    const uint32_t before = before_[corner], next = next_[corner];
    triangles_.push_back({before, corner, next});
    next_[before] = next;
    before_[next] = before;
    is_gone_[corner] = true;
  }

  // Removes the corners at which the outline turns back, or stays where it is: the triangle of each
  // is a segment, and the outline winds round every point as often without it. An ear beside a
  // spike may lie outside. `left` counts the others; returns one of them.
  uint32_t without_spikes(uint32_t& left) {
    uint32_t at = 0;
    for (uint32_t passed = 0; left > 3 && passed < left;) {
      if (!is_spike(at)) {
        at = next_[at];
        ++passed;
        continue;
      }
      take(at);
      at = before_[at];
      --left;
      passed = passed > 0 ? passed - 1 : 0;  // the corner before may be a spike now
    }
    return at;
  }

  bool is_spike(uint32_t corner) const {
    const Point2 &a = point(before_[corner]), &b = point(corner), &c = point(next_[corner]);
    return turn_of(a, b, c) == 0 && !(a < b && b < c) && !(c < b && b < a);
  }

  // Returns a straight corner only if there is no ear: its triangle is a segment.
  std::optional<uint32_t> find_ear(uint32_t at, uint32_t left) {
    std::optional<uint32_t> straight;
    for (uint32_t i = 0; i < left && tests_left_ > 0; ++i, at = next_[at]) {
      spend(1);
      const int turn = turn_at(at);
      if (turn > 0 && is_ear(at)) return at;
      if (turn == 0 && !straight) straight = at;
    }
    return tests_left_ > 0 ? straight : std::nullopt;
  }

  bool is_ear(uint32_t corner) {
    const Triangle ear = {before_[corner], corner, next_[corner]};
    Point2 low = point(corner), high = low;
    for (const uint32_t i : ear) {
      for (size_t k = 0; k < 2; ++k) {
        low[k] = std::min(low[k], point(i)[k]);
        high[k] = std::max(high[k], point(i)[k]);
      }
    }
    const std::array<size_t, 2> first = cell_of(low), last = cell_of(high);
    for (size_t y = first[1]; y <= last[1]; ++y) {
      for (size_t x = first[0]; x <= last[0]; ++x) {
        if (is_blocked_in(y * side_ + x, ear)) return false;
      }
    }
    return true;
  }

  bool is_blocked_in(size_t cell, const Triangle& ear) {
    spend(1);
    for (uint32_t i = cells_[cell]; i < cells_[cell + 1]; ++i) {
      const uint32_t q = sorted_[i];
      spend(1);
      if (!is_gone_[q] && std::find(ear.begin(), ear.end(), q) == ear.end() && does_block(q, ear))
        return true;
    }
    return false;
  }

  // Whether q lies inside the ear, or on its rim with an edge that goes inside.
  bool does_block(uint32_t q, const Triangle& ear) const {
    std::array<bool, 3> is_on{};
    for (size_t k = 0; k < 3; ++k) {
      const int side = turn(ear[k], ear[(k + 1) % 3], q);
      if (side < 0) return false;
      is_on[k] = side == 0;
    }
    const auto goes_inside = [&](uint32_t to) {
      for (size_t k = 0; k < 3; ++k) {
        if (is_on[k] && turn(ear[k], ear[(k + 1) % 3], to) <= 0) return false;
      }
      return true;
    };
    return goes_inside(before_[q]) || goes_inside(next_[q]) ||
           std::none_of(is_on.begin(), is_on.end(), [](bool on) { return on; });
  }

  void spend(uint64_t tests) { tests_left_ -= std::min(tests, tests_left_); }

  // Makes cells of about eight corners each.
  void fill_cells() {
    low_ = high_ = ring_[0];
    for (const Point2& p : ring_) {
      for (size_t k = 0; k < 2; ++k) {
        low_[k] = std::min(low_[k], p[k]);
        high_[k] = std::max(high_[k], p[k]);
      }
    }
    side_ =
        std::max<size_t>(1, static_cast<size_t>(std::sqrt(static_cast<double>(ring_.size()) / 8)));
    cells_.assign(side_ * side_ + 1, 0);
    const auto number = [&](const Point2& p) { return cell_of(p)[1] * side_ + cell_of(p)[0]; };
    for (const Point2& p : ring_) ++cells_[number(p) + 1];
    std::partial_sum(cells_.begin(), cells_.end(), cells_.begin());
    std::vector<uint32_t> to(cells_.begin(), cells_.end() - 1);
    sorted_.resize(ring_.size());
    for (uint32_t i = 0; i < ring_.size(); ++i) sorted_[to[number(ring_[i])]++] = i;
    is_gone_.assign(ring_.size(), false);
  }

  // Rounds in order: between the cells of a triangle's least and greatest coordinates are the cells
  // of all points in it.
  std::array<size_t, 2> cell_of(const Point2& p) const {
    std::array<size_t, 2> cell{};
    for (size_t k = 0; k < 2; ++k) {
      const double share = (p[k] / 2 - low_[k] / 2) / (high_[k] / 2 - low_[k] / 2);
      if (share > 0)  // not nan
        cell[k] = std::min(side_ - 1,
                           static_cast<size_t>(std::min(share, 1.0) * static_cast<double>(side_)));
    }
    return cell;
  }

  double least(const Triangle& t, size_t k) const {
    return std::min({point(t[0])[k], point(t[1])[k], point(t[2])[k]});
  }
  double most(const Triangle& t, size_t k) const {
    return std::max({point(t[0])[k], point(t[1])[k], point(t[2])[k]});
  }

  // Returns true also if tests run out.
  bool do_overlap() {
    std::vector<Triangle> solid;
    for (const Triangle& t : triangles_) {
      if (turn(t[0], t[1], t[2]) > 0) solid.push_back(t);
    }
    const std::array<double, 2> extents = {extent(solid, 0), extent(solid, 1)};
    const size_t k = extents[1] < extents[0] ? 1 : 0;
    std::sort(solid.begin(), solid.end(),
              [&](const Triangle& a, const Triangle& b) { return least(a, k) < least(b, k); });
    for (size_t i = 0; i < solid.size(); ++i) {
      const double end = most(solid[i], k);
      for (size_t j = i + 1; j < solid.size() && least(solid[j], k) < end; ++j) {
        spend(1);
        if (tests_left_ == 0 || (!do_part(solid[i], solid[j]) && !do_part(solid[j], solid[i])))
          return true;
      }
    }
    return false;
  }

  // Sums the triangles' widths along an axis, as a multiple of the outline's: the less, the fewer
  // lie beside each other.
  double extent(const std::vector<Triangle>& triangles, size_t k) const {
    double sum = 0;
    for (const Triangle& t : triangles) sum += most(t, k) / 2 - least(t, k) / 2;
    return sum / (high_[k] / 2 - low_[k] / 2);
  }

  // Tests for a separating line: two triangles have no inner point in common if and only if a line
  // along an edge of one has the other on its outer side.
  bool do_part(const Triangle& a, const Triangle& b) const {
    for (size_t k = 0; k < 3; ++k) {
      if (std::all_of(b.begin(), b.end(),
                      [&](uint32_t q) { return turn(a[k], a[(k + 1) % 3], q) <= 0; }))
        return true;
    }
    return false;
  }

  const Ring& ring_;
  uint64_t tests_left_;
  std::vector<uint32_t> next_, before_, cells_, sorted_;
  std::vector<bool> is_gone_;
  Point2 low_{}, high_{};
  size_t side_ = 1;
  std::vector<Triangle> triangles_;
};

// Returns the largest difference of the corners' heights e over a plane, along the axis. A
// triangulation whose projection is the outline's has over each point of it a point whose height
// over the plane is between the least and the greatest e, so two such are that near to each other
// both ways.
//
// Each of e's three terms passes at most four roundings of u = 2^-53: e is off by less than 5 u
// times the sum of their sizes, and by 2^-1072 where products underflow. 8 u covers the rounding
// of that sum, of the difference and of the result.
double plane_ambiguity(const Corners& corners, const glm::dvec3& normal, int axis) {
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  const auto slope = [&](int k) {
    const double s = normal[k] / normal[axis];
    return std::isfinite(s) ? s : 0.0;
  };
  const double a = slope(u), b = slope(v);
  double least = 0, most = 0, size = 0;
  for (size_t i = 1; i < corners.size(); ++i) {
    const glm::dvec3 d = corners[i] - corners[0];
    const double e = d[axis] + a * d[u] + b * d[v];
    least = std::min(least, e);
    most = std::max(most, e);
    size = std::max(size, std::abs(d[axis]) + std::abs(a * d[u]) + std::abs(b * d[v]));
  }
  if (size == 0) return 0;
  constexpr double kUnit = std::numeric_limits<double>::epsilon() / 2;
  return (most - least) * (1 + 8 * kUnit) + 16 * kUnit * size + 0x1p-1068;
}

// Returns how wide the corners lie round the line through the first and the one farthest from it.
//
// Let x be a point of one triangulation, at s along the line. Another triangulation is connected
// and has all corners, so it has a point y at s, too. Both lie in the corners' hull, so x - y is at
// most the greatest distance between the corners' feet r on a plane across the line. The same holds
// for everything else that is connected, has all corners, and lies in their hull: for an outline
// that crosses itself, its fan, and each way to fill it.
//
// The axes' widths of r bound that distance. r = d - s t, of differences d and t = the longest of
// them, whose sum of sizes is L at most: with u = 2^-53, s is off by 10 u |d| / |t|, and a
// coordinate of r by 20 u L with its own roundings. 80 u L covers both ends of three axes, and 8 u
// the roundings of the sum. scale_of keeps the products within double.
double line_ambiguity(const Corners& corners) {
  const double scale = scale_of(corners);
  const auto from_first = [&](size_t i) { return corners[i] * scale - corners[0] * scale; };
  glm::dvec3 line(0);
  double size = 0;
  for (size_t i = 1; i < corners.size(); ++i) {
    const glm::dvec3 d = from_first(i);
    if (glm::dot(d, d) > glm::dot(line, line)) line = d;
    size = std::max(size, std::abs(d.x) + std::abs(d.y) + std::abs(d.z));
  }
  if (size == 0) return 0;
  glm::dvec3 least(0), most(0);
  for (size_t i = 1; i < corners.size(); ++i) {
    const glm::dvec3 d = from_first(i);
    const glm::dvec3 across = d - glm::dot(d, line) / glm::dot(line, line) * line;
    least = glm::min(least, across);
    most = glm::max(most, across);
  }
  constexpr double kUnit = std::numeric_limits<double>::epsilon() / 2;
  const glm::dvec3 width = most - least;
  const double across = std::sqrt(glm::dot(width, width)) * (1 + 8 * kUnit) + 80 * kUnit * size;
  return across / scale * (1 + 2 * kUnit) + 0x1p-1068;
}

// The triangles of the ring: none if it has its fan.
struct Outline {
  PolygonKind kind = PolygonKind::kCrossing;
  std::vector<Triangle> triangles;
  int axis = 0;
  bool is_line = false;  ///< each triangulation is the same segment
};

// The normal of corners near a line is noise, and a plane says little of them.
double ambiguity_of(const Corners& corners, const glm::dvec3& normal, const Outline& outline) {
  constexpr double kNearPlane = 0x1p-20, kNearLine = 0x1p-10;  // of the corners' extent
  if (outline.is_line) return 0;
  if (has_only_fan(outline.kind)) return line_ambiguity(corners);
  const double off_plane = plane_ambiguity(corners, normal, outline.axis);
  const double extent = glm::length(corners[1] - corners[0]) + glm::length(corners[2] - corners[0]);
  if (off_plane <= kNearPlane * extent) return off_plane;
  const double off_line = line_ambiguity(corners);
  return off_line <= kNearLine * extent ? std::min(off_plane, off_line) : off_plane;
}

Outline clipped(Ring&& ring, int axis, int sign) {
  if (sign < 0) {
    for (Point2& p : ring) std::swap(p[0], p[1]);
  }
  Clipper clipper(ring);
  auto triangles = clipper.clip();
  if (!triangles)
    return {clipper.is_out_of_tests() ? PolygonKind::kIntricate : PolygonKind::kCrossing, {}, axis};
  return {PolygonKind::kClipped, std::move(*triangles), axis};
}

// Needs no memory or exact arithmetic, for meshes of quads. Four turns to one side of less than
// half a turn each are one turn in all.
bool is_surely_convex_quad(const Corners& corners, int axis) {
  if (corners.size() != 4) return false;
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  std::array<Point2, 4> ring;
  for (size_t i = 0; i < 4; ++i) ring[i] = {corners[i][u], corners[i][v]};
  const int side = sure_turn(ring[0], ring[1], ring[2]);
  return side != 0 && sure_turn(ring[1], ring[2], ring[3]) == side &&
         sure_turn(ring[2], ring[3], ring[0]) == side &&
         sure_turn(ring[3], ring[0], ring[1]) == side;
}

// The outline along one axis; nothing if it encloses no area there.
std::optional<Outline> outline_along(const Corners& corners, int axis) {
  const Shape shape = shape_of(projected(corners, axis));
  if (shape == Shape::kConvex) return Outline{PolygonKind::kFan, {}, axis};
  if (shape == Shape::kWindsOften) return Outline{PolygonKind::kCrossing, {}, axis};
  Ring ring = projected(corners, axis);
  const int sign = area_sign(ring);
  if (sign == 0) return std::nullopt;
  return clipped(std::move(ring), axis, sign);
}

// Corners off a plane may cross as seen along the axis that the polygon faces most, and not along
// another that it faces nearly as much: then that axis decides the surface and its ambiguity. Along
// an axis that it hardly faces, a bow tie may look like a simple sliver.
Outline outline_of(const Corners& corners, const glm::dvec3& normal) {
  constexpr double kFaces = 0.5;  // of the largest component
  const std::array<int, 3> axes = axes_by_size(normal);
  if (is_surely_convex_quad(corners, axes[0])) return {PolygonKind::kFan, {}, axes[0]};
  std::optional<Outline> refused;
  for (const int axis : axes) {
    if (refused && std::abs(normal[axis]) < kFaces * std::abs(normal[axes[0]])) break;
    std::optional<Outline> outline = outline_along(corners, axis);
    if (!outline) continue;
    if (!has_only_fan(outline->kind)) return std::move(*outline);
    if (!refused) refused = std::move(outline);
  }
  if (refused) return std::move(*refused);
  const bool is_line = are_on_a_line(corners);
  return {is_line ? PolygonKind::kFan : PolygonKind::kNoArea, {}, axes[0], is_line};
}

}  // namespace

PolygonResult triangulate_fan(std::span<const glm::dvec3> vertices, std::span<glm::uvec3> fan) {
  const Corners corners(vertices, fan);
  const glm::dvec3 normal = newell(corners);
  const Outline outline = outline_of(corners, normal);
  PolygonResult result{.kind = outline.kind, .axis = outline.axis};
  result.ambiguity = ambiguity_of(corners, normal, outline);
  if (outline.kind != PolygonKind::kClipped) return result;
  result.triangles.reserve(fan.size());
  for (const Triangle& t : outline.triangles) result.triangles.emplace_back(t[0], t[1], t[2]);
  place_triangles(result.triangles, fan);
  return result;
}

Note note_on_ambiguity(const Polygons& polygons) {
  std::string text = std::string("corners off a plane") +
                     (polygons.fanned > 0 ? ", or slivers that cross themselves," : "") +
                     " leave the surface open by up to " +
                     decimal(polygons.ambiguity, 3, Rounding::kUp) + ", at face " +
                     std::to_string(polygons.ambiguous_face);
  if (polygons.any_triangulation) text += ", and the interval is wider by it";
  Note note = note_of(NoteCode::kAmbiguity, std::move(text), {polygons.ambiguity, ""});
  note.face = polygons.ambiguous_face;
  return note;
}

void place_triangles(std::span<const UVec3> triangles, std::span<glm::uvec3> fan) {
  const Corners corners({}, fan);
  std::vector<uint32_t> numbers(corners.size());
  for (size_t i = 0; i < numbers.size(); ++i) numbers[i] = corners.number(i);
  for (size_t i = 0; i < fan.size(); ++i) {
    const UVec3& t = triangles[i];
    fan[i] = {numbers[t.x], numbers[t.y], numbers[t.z]};
  }
}

}  // namespace vkh
