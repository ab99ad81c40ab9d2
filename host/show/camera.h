// The place from which a mesh is seen, without perspective: lengths in a picture can be compared.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <string>
#include <vector>

#include "host/show/draw.h"

namespace vkh::drawing {

/// A part of the picture, in pixels from its upper left corner.
struct Area {
  double x = 0, y = 0, width = 0, height = 0;

  double right() const { return x + width; }
  double bottom() const { return y + height; }
  glm::dvec2 centre() const { return {x + width / 2, y + height / 2}; }
  bool has(glm::dvec2 p) const { return p.x >= x && p.x <= right() && p.y >= y && p.y <= bottom(); }
  Area inner(double by) const { return {x + by, y + by, width - 2 * by, height - 2 * by}; }
};

/// Three axes of a viewer: to the right, up, and from the mesh towards the viewer.
struct Axes {
  glm::dvec3 right, up, back;
};

inline Axes axes_of(glm::dvec3 towards_viewer, Up up) {
  const glm::dvec3 back = glm::normalize(towards_viewer);
  glm::dvec3 above = up == Up::kZ ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0);
  // A view from above or below has the same side at the top as for a person who leans forward.
  constexpr double kSteep = 0.999;
  if (std::abs(glm::dot(above, back)) > kSteep)
    above = up == Up::kZ ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, back.y > 0 ? -1 : 1);
  const glm::dvec3 right = glm::normalize(glm::cross(above, back));
  return {right, glm::cross(back, right), back};
}

/// x and y in pixels of the picture, z in units towards the viewer.
struct Camera {
  Axes axes;
  glm::dvec3 centre{};    ///< the point in the middle of the area
  double scale = 1;       ///< pixels a unit
  double reach = 1;       ///< distance behind `centre` up to which something is drawn
  double before = 1;      ///< the same before it, towards the viewer
  double spacing = 0;     ///< between points, in units; 0: there are faces
  double widest = 0.009;  ///< the widest disc of a point, as a share of the area's width
  Area area;

  glm::dvec3 turned(glm::dvec3 v) const {
    return {glm::dot(v, axes.right), glm::dot(v, axes.up), glm::dot(v, axes.back)};
  }
  glm::dvec3 pixel(glm::dvec3 p) const {
    const glm::dvec3 t = turned(p - centre);
    const glm::dvec2 middle = area.centre();
    return {middle.x + scale * t.x, middle.y - scale * t.y, t.z};
  }
  /// The radius of a point's disc, in pixels: discs of a surface hide what is behind it.
  double disc() const {
    constexpr double kOfSpacing = 0.9, kLeast = 0.7;
    return std::clamp(kOfSpacing * spacing * scale, kLeast, std::max(widest * area.width, kLeast));
  }
  /// The place in a layer of the area, of a pixel with its depth: z is 0 for the nearest.
  glm::dvec3 placed(const glm::dvec3& pixel) const {
    return {pixel.x - area.x, pixel.y - area.y, (before - pixel.z) / (before + reach)};
  }
};

struct Box {
  glm::dvec3 lo{std::numeric_limits<double>::infinity()};
  glm::dvec3 hi{-std::numeric_limits<double>::infinity()};

  void add(glm::dvec3 p) {
    lo = glm::min(lo, p);
    hi = glm::max(hi, p);
  }
  glm::dvec3 centre() const { return lo + (hi - lo) * 0.5; }
};

inline Box box_of(const Mesh& mesh) {
  Box box;
  for (const glm::dvec3& v : mesh.vertices) box.add(v);
  return box;
}

/// The diagonal; for a mesh that is one point, anything that is not 0.
inline double drawn_diagonal_of(const Mesh& mesh) {
  const Box box = box_of(mesh);
  const double diagonal = glm::distance(box.lo, box.hi);
  return diagonal > 0 ? diagonal : 1;
}

/// Fits the whole mesh into the area, as large as it gets.
inline Camera fitted(const Mesh& mesh, const Axes& axes, const Area& area) {
  Camera camera{.axes = axes, .area = area};
  camera.centre = box_of(mesh).centre();
  Box seen;
  for (const glm::dvec3& v : mesh.vertices) seen.add(camera.turned(v - camera.centre));
  const glm::dvec3 size = seen.hi - seen.lo, middle = seen.centre();
  camera.centre += axes.right * middle.x + axes.up * middle.y + axes.back * middle.z;
  const double most = std::max(size.x / area.width, size.y / area.height);
  camera.scale = most > 0 ? 1 / most : 1;
  const double deep = size.z / 2;
  camera.reach = 1.01 * (deep > 0 ? deep : std::max(std::max(size.x, size.y), 1e-300));
  camera.before = camera.reach;
  return camera;
}

/// Returns whether the triangle is before `p` (a pixel, with its depth), by more than `slack`.
inline bool hides(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                  const glm::dvec3& p, double slack) {
  if (std::max({a.z, b.z, c.z}) <= p.z + slack) return false;
  if (p.x < std::min({a.x, b.x, c.x}) || p.x > std::max({a.x, b.x, c.x})) return false;
  if (p.y < std::min({a.y, b.y, c.y}) || p.y > std::max({a.y, b.y, c.y})) return false;
  const auto area = [](const glm::dvec3& s, const glm::dvec3& t, const glm::dvec3& u) {
    return (t.x - s.x) * (u.y - s.y) - (u.x - s.x) * (t.y - s.y);
  };
  const double all = area(a, b, c), u = area(p, b, c), v = area(a, p, c), w = area(a, b, p);
  if (all == 0 || u * all < 0 || v * all < 0 || w * all < 0) return false;
  return (u * a.z + v * b.z + w * c.z) / all > p.z + slack;
}

/// The approximate distance of a surface's points from their neighbours, in the files' units: the
/// root of the area per point. 0 for a mesh that is not points.
double spacing_of(const Mesh& mesh);

/// Returns whether no disc of another point stands before the point.
inline bool is_seen_among(const Mesh& points, const Camera& camera, glm::dvec3 point) {
  const glm::dvec3 p = camera.pixel(point);
  // Neighbours on a surface that is seen at a slant are somewhat before it.
  const double slack = 4 * std::max(camera.disc() / camera.scale, camera.spacing);
  const double most = camera.disc() * camera.disc();
  return std::none_of(points.vertices.begin(), points.vertices.end(), [&](const glm::dvec3& v) {
    const glm::dvec3 off = camera.pixel(v) - p;
    return off.z > slack && off.x * off.x + off.y * off.y <= most;
  });
}

/// Returns whether no face, or disc of a point, stands before the point.
inline bool is_seen(const Mesh& mesh, const Camera& camera, glm::dvec3 point) {
  if (mesh.are_points) return is_seen_among(mesh, camera, point);
  constexpr double kSlack = 1e-5;  // fraction of the diagonal: the point's own faces are no screen
  const glm::dvec3 p = camera.pixel(point);
  const double slack = kSlack * drawn_diagonal_of(mesh);
  return std::none_of(mesh.faces.begin(), mesh.faces.end(), [&](const glm::uvec3& f) {
    return hides(camera.pixel(mesh.vertices[f.x]), camera.pixel(mesh.vertices[f.y]),
                 camera.pixel(mesh.vertices[f.z]), p, slack);
  });
}

/// A part of the picture with a view of the mesh in it.
struct Panel {
  Camera camera;
  std::string label = {};
};

/// Chooses views of a mesh.
class Views {
 public:
  /// `unit`: pixels per unit of a picture of 1600 x 1000.
  Views(const Picture& picture, const PictureOptions& options, double unit)
      : picture_(picture),
        options_(options),
        unit_(unit),
        diagonal_(drawn_diagonal_of(picture.mesh)),
        spacing_(spacing_of(picture.mesh)) {}

  std::vector<Panel> panels_in(const Area& area) const;

 private:
  Panel corner_view(const Area& area) const;
  std::vector<size_t> seeing_directions() const;
  std::vector<Panel> six_views(const Area& area) const;
  Panel view_from(glm::dvec3 direction, const Area& area) const;

  const Picture& picture_;
  const PictureOptions& options_;
  double unit_;
  double diagonal_, spacing_;
};

}  // namespace vkh::drawing
