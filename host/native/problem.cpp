#include "host/native/problem.h"

#include <cmath>
#include <limits>

#include "host/base/rounding.h"

namespace vkh::native {
namespace {

double extent_of(const Box& box, const glm::dvec3& centre) {
  double extent = 0;
  for (int i = 0; i < 3; ++i)
    extent = std::max({extent, std::fabs(box.lo[i] - centre[i]), std::fabs(box.hi[i] - centre[i])});
  return extent;
}

// Halves first: a sum of large coordinates overflows.
glm::dvec3 middle_of(const Box& box) { return glm::dvec3(box.lo) / 2.0 + glm::dvec3(box.hi) / 2.0; }

// x * 2^exponent in two steps, since one power of two may overflow: exact, unless it underflows.
struct Scale {
  double first, second;
  explicit Scale(int exponent)
      : first(std::ldexp(1.0, exponent / 2)), second(std::ldexp(1.0, exponent - exponent / 2)) {}
  double operator()(double x) const { return x * first * second; }
};

// How far rounding takes a coordinate: 2^-53 of the difference where that is not exact, twice over,
// and 2^-1000 for what may have underflowed.
double displaced(double given, double centre, double placed) {
  const double off = sum_error(given, -centre) == 0 ? 0 : std::fabs(placed) * 0x1p-52;
  const bool is_exact = given == centre || std::fabs(placed) >= std::numeric_limits<double>::min();
  return off + (is_exact ? 0 : 0x1p-1000);
}

}  // namespace

Frame frame_of(const Box& joint) {
  const glm::dvec3 middle = middle_of(joint), origin(0);
  const bool stays = extent_of(joint, origin) <= 4 * extent_of(joint, middle);
  const glm::dvec3 centre = stays ? origin : middle;
  const double extent = extent_of(joint, centre);
  int exponent = 0;
  std::frexp(extent, &exponent);
  return {.centre = centre, .exponent = extent == 0 ? 0 : -exponent};
}

PlacedVertices placed_vertices(const Frame& frame, const Mesh& mesh) {
  const Scale scale(frame.exponent);
  PlacedVertices out;
  out.at.reserve(mesh.vertices.size());
  double worst = 0;
  for (const DVec3& v : mesh.vertices) {
    const glm::dvec3 centre = frame.centre;
    const vec3 p(scale(v.x - centre.x), scale(v.y - centre.y), scale(v.z - centre.z));
    out.at.push_back(p);
    // The sum over the axes is no less than the length; two roundings of it are under 2^-50.
    worst = std::max(worst, displaced(v.x, centre.x, p.x) + displaced(v.y, centre.y, p.y) +
                                displaced(v.z, centre.z, p.z));
  }
  out.displacement = worst * (1 + 0x1p-50);
  if (mesh.delta == 0) return out;
  const double delta = frame.to_frame(mesh.delta);
  const bool is_normal = delta >= std::numeric_limits<double>::min();
  out.displacement = add_up(out.displacement, is_normal ? delta : 0x1p-1000);
  return out;
}

Problem::Problem(const Mesh& a_, const Mesh& b_)
    : a(a_),
      b(b_),
      box_a(bounding_box(a_)),
      joint(join(box_a, bounding_box(b_))),
      frame(frame_of(joint)),
      placed_a(placed_vertices(frame, a_)),
      placed_b(placed_vertices(frame, b_)),
      displacement(add_up(placed_a.displacement, placed_b.displacement)),
      tree(placed_b.at, b_.faces) {}

}  // namespace vkh::native
