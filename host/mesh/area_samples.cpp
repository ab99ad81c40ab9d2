#include "host/mesh/area_samples.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <random>

namespace vkh {
namespace {

/// Numbers in [0, 1) from a fixed start. The standard fixes the generator's bits, and not those of
/// its distributions.
class Uniform {
 public:
  double operator()() { return static_cast<double>(generator_() >> 11) * 0x1p-53; }

 private:
  std::mt19937_64 generator_;
};

double area_of(const Mesh& mesh, const UVec3& face) {
  const glm::dvec3 a = mesh.vertices[face.x], b = mesh.vertices[face.y], c = mesh.vertices[face.z];
  return 0.5 * glm::length(glm::cross(b - a, c - a));
}

double sum_of_areas(const Mesh& mesh) {
  double sum = 0;
  for (const UVec3& face : mesh.faces) sum += area_of(mesh, face);
  return sum;
}

/// A point of the face, from two numbers in [0, 1), uniform over its area.
DVec3 point_on(const Mesh& mesh, const UVec3& face, double u, double v) {
  const double root = std::sqrt(u);
  const glm::dvec3 a = mesh.vertices[face.x], b = mesh.vertices[face.y], c = mesh.vertices[face.z];
  return a + root * (b - a) + root * v * (c - b);
}

}  // namespace

std::vector<DVec3> area_samples(const Mesh& mesh, size_t count) {
  const double sum = sum_of_areas(mesh);
  const bool has_areas = sum > 0 && std::isfinite(sum);
  const double all = has_areas ? sum : static_cast<double>(mesh.faces.size());
  Uniform uniform;
  std::vector<DVec3> points;
  points.reserve(count);
  const auto next_at = [&] {
    return (static_cast<double>(points.size()) + uniform()) / static_cast<double>(count) * all;
  };
  double passed = 0, at = next_at();
  for (const UVec3& face : mesh.faces) {
    passed += has_areas ? area_of(mesh, face) : 1;
    while (at < passed && points.size() < count) {
      const double u = uniform(), v = uniform();
      points.push_back(point_on(mesh, face, u, v));
      at = next_at();
    }
  }
  // By rounding, the last stretch may be beyond the sum.
  while (points.size() < count) points.push_back(point_on(mesh, mesh.faces.back(), 0.5, 0.5));
  return points;
}

}  // namespace vkh
