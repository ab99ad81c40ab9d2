// Faces of more than three corners: whether their triangles are those of the outline.
//
// Looked at along an axis, triangles that all turn to one side, and whose edges add up to the
// outline, cover each point as often as the outline winds round it. If no two of them overlap, that
// is once or never: they tile the outline, whatever made them.
#pragma once

#include <map>
#include <span>
#include <utility>

#include "check/proof.h"
#include "vkhausdorff/polygon.h"

namespace vkh::check {

using Flat = std::array<Z, 2>;  ///< a corner, without its coordinate along the axis
using Ring = std::vector<Flat>;
using Ears = std::vector<std::array<uint32_t, 3>>;

/// Corners of a face, from its fan, as integers times their own power of two.
inline std::vector<Point> outline_of(std::span<const glm::dvec3> vertices,
                                     std::span<const glm::uvec3> fan) {
  std::vector<glm::dvec3> corners = {vertices[fan[0].x], vertices[fan[0].y]};
  for (const glm::uvec3& triangle : fan) corners.push_back(vertices[triangle.z]);
  int unit = INT_MAX;
  for (const glm::dvec3& p : corners)
    unit = std::min({unit, exponent_of(p.x), exponent_of(p.y), exponent_of(p.z)});
  std::vector<Point> out;
  for (const glm::dvec3& p : corners) out.push_back(point(p, unit == INT_MAX ? 0 : unit));
  return out;
}

inline Ring seen_along(const std::vector<Point>& corners, unsigned axis) {
  Ring out;
  for (const Point& p : corners) {
    const std::array<const Z*, 3> at = {&p.x, &p.y, &p.z};
    out.push_back({*at[(axis + 1) % 3], *at[(axis + 2) % 3]});
  }
  return out;
}

/// Twice the enclosed area, counted with its winding: Newell's normal has these three as
/// components.
inline Z area_of(const Ring& ring) {
  Z out = 0;
  for (size_t i = 0, before = ring.size() - 1; i < ring.size(); before = i++)
    out += ring[before][0] * ring[i][1] - ring[before][1] * ring[i][0];
  return out;
}

/// Whether the face lies across the axis: along others of its normal all may fall on a line.
inline bool is_across(const std::vector<Point>& corners, unsigned axis) {
  std::array<Z, 3> normal;
  for (unsigned i = 0; i < 3; ++i) normal[i] = abs(area_of(seen_along(corners, i)));
  const Z& mine = normal[axis];
  return mine > 0 && 2 * mine >= std::max({normal[0], normal[1], normal[2]});
}

/// The sign of the turn at b: 1 to the left, -1 to the right.
inline int turn_of(const Flat& a, const Flat& b, const Flat& c) {
  return sgn(Z((b[0] - a[0]) * (c[1] - b[1]) - (b[1] - a[1]) * (c[0] - b[0])));
}

/// All turns are to one side, none goes back, and there is one turn in all: the order of an edge's
/// ends changes twice a turn.
inline bool is_convex(Ring ring) {
  ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
  while (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
  int side = 0;
  size_t changes = 0;
  for (size_t i = 0; i < ring.size(); ++i) {
    const Flat &a = ring[i], &b = ring[(i + 1) % ring.size()], &c = ring[(i + 2) % ring.size()];
    const bool is_change = (a < b) != (b < c);
    const int turn = turn_of(a, b, c);
    if ((turn == 0 && is_change) || turn * side < 0) return false;
    if (turn != 0) side = turn;
    changes += is_change ? 1 : 0;
  }
  return side != 0 && changes == 2;
}

inline bool are_on_a_line(const std::vector<Point>& corners) {
  Point along{};  // between two that differ
  for (const Point& p : corners) {
    const Point from = p - corners[0];
    const Point normal = cross(along, from);
    if (dot(normal, normal) != 0) return false;
    if (dot(along, along) == 0) along = from;
  }
  return true;
}

/// Each edge counts with its direction.
inline bool do_edges_add_up(size_t corners, const Ears& triangles) {
  std::map<std::pair<uint32_t, uint32_t>, int64_t> sum;
  const auto add = [&](uint32_t from, uint32_t to, int64_t sign) {
    if (from != to) sum[std::minmax({from, to})] += from < to ? sign : -sign;
  };
  const auto count = static_cast<uint32_t>(corners);
  for (uint32_t i = 0; i < count; ++i) add(i, (i + 1) % count, -1);
  for (const auto& [a, b, c] : triangles) {
    add(a, b, 1);
    add(b, c, 1);
    add(c, a, 1);
  }
  return std::all_of(sum.begin(), sum.end(), [](const auto& edge) { return edge.second == 0; });
}

using Flats = std::array<Flat, 3>;

/// Whether a line along an edge of one has the other on its outer side; both turn to the left.
inline bool does_part(const Flats& a, const Flats& b) {
  for (size_t i = 0; i < 3; ++i) {
    const auto is_outside = [&](const Flat& p) { return turn_of(a[i], a[(i + 1) % 3], p) <= 0; };
    if (std::all_of(b.begin(), b.end(), is_outside)) return true;
  }
  return false;
}

/// Whether two of these triangles, which turn to the left, have an inner point in common.
inline bool do_overlap(std::vector<Flats> triangles) {
  const auto least = [](const Flats& t, size_t k) { return std::min({t[0][k], t[1][k], t[2][k]}); };
  const auto most = [](const Flats& t, size_t k) { return std::max({t[0][k], t[1][k], t[2][k]}); };
  std::sort(triangles.begin(), triangles.end(),
            [&](const Flats& a, const Flats& b) { return least(a, 0) < least(b, 0); });
  for (size_t i = 0; i < triangles.size(); ++i) {
    const Flats& a = triangles[i];
    const Z end = most(a, 0), low = least(a, 1), high = most(a, 1);
    for (size_t j = i + 1; j < triangles.size() && least(triangles[j], 0) < end; ++j) {
      const Flats& b = triangles[j];
      if (most(b, 1) <= low || high <= least(b, 1)) continue;
      if (!does_part(a, b) && !does_part(b, a)) return true;
    }
  }
  return false;
}

/// Whether the triangles tile what is inside the ring.
inline bool do_tile(const Ring& ring, const Ears& triangles) {
  const int side = sgn(area_of(ring));
  std::vector<Flats> solid;
  for (const auto& [a, b, c] : triangles) {
    const int turn = side * turn_of(ring[a], ring[b], ring[c]);
    if (turn < 0) return false;
    if (turn == 0) continue;  // seen as a segment
    solid.push_back({ring[a], ring[b], ring[c]});
    if (side < 0) std::swap(solid.back()[0], solid.back()[1]);
  }
  return side != 0 && do_edges_add_up(ring.size(), triangles) && !do_overlap(std::move(solid));
}

/// Makes the triangles that a certificate states for a file's polygons. Throws Refused if they are
/// not the polygon's, or if a polygon without stated triangles is not convex.
class GivenPolygons {
 public:
  GivenPolygons(const std::vector<Triangulation>& polygons, std::string name)
      : polygons_(polygons), name_(std::move(name)) {}

  PolygonResult operator()(uint64_t face, std::span<const glm::dvec3> vertices,
                           std::span<glm::uvec3> fan) const {
    const auto given =
        std::lower_bound(polygons_.begin(), polygons_.end(), face,
                         [](const Triangulation& t, uint64_t number) { return t.face < number; });
    const std::vector<Point> corners = outline_of(vertices, fan);
    if (given == polygons_.end() || given->face != face) {
      expect(is_fan_of(corners), face, " is not convex, and its triangles are not said");
      return {.kind = PolygonKind::kFan};
    }
    expect(given->corners == corners.size(), face, " has another number of corners");
    if (given->axis == Triangulation::kOnlyFan) return {.kind = PolygonKind::kCrossing};
    expect(is_across(corners, given->axis), face, " is looked at along its surface");
    expect(do_tile(seen_along(corners, given->axis), given->triangles), face,
           " is not tiled by its triangles");
    PolygonResult result{.kind = PolygonKind::kClipped, .axis = static_cast<int>(given->axis)};
    for (const auto& [a, b, c] : given->triangles) result.triangles.emplace_back(a, b, c);
    place_triangles(result.triangles, fan);
    return result;
  }

 private:
  static bool is_fan_of(const std::vector<Point>& corners) {
    for (unsigned axis = 0; axis < 3; ++axis) {
      if (is_across(corners, axis) && is_convex(seen_along(corners, axis))) return true;
    }
    return are_on_a_line(corners);
  }
  void expect(bool is_so, uint64_t face, const char* otherwise) const {
    if (!is_so) throw Refused(name_ + ": face " + std::to_string(face) + otherwise);
  }

  const std::vector<Triangulation>& polygons_;
  std::string name_;
};

}  // namespace vkh::check
