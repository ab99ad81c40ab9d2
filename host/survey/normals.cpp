#include "host/survey/normals.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <numeric>
#include <tuple>

#include "host/mesh/round_to_float.h"
#include "host/survey/measured.h"

namespace vkh {

// The product is off by E = 16 kRound |e| |f| (statistics.cpp), and by what underflows. With n the
// exact one and m the computed one, n / |n| and m / |m| differ by E / |m| twice: by the vector, and
// by its length. Quotients and the length round by 4 kRound more.
UnitNormal unit_normal(const Corners3& face) {
  constexpr double kLeast = 1e-140;
  const glm::dvec3 e = face[1] - face[0], f = face[2] - face[0];
  const glm::dvec3 product = glm::cross(e, f);
  const double length = glm::length(product);
  const double error = 1.01 * 16 * kRound * glm::length(e) * glm::length(f) + kUnderflow;
  if (!(length > std::max(4 * error, kLeast))) return {};
  return {product / length, 1.01 * 2 * error / length + 4 * kRound};
}

// pi and the product round by 3 kRound of less than 1.6, the cosine by an ulp: 2^-50 is more.
// Normals of any angle agree to 90 degrees, and to 0 only equal ones may.
Enclosure cosine_of_degrees(double degrees) {
  if (degrees >= 90) return {0, 0};
  const double cosine = std::cos(degrees * (std::numbers::pi / 180));
  return {std::max(cosine - 0x1p-50, 0.0), std::min(cosine + 0x1p-50, 1.0)};
}

namespace {

// The number of the first vertex at each one's place, as the file gives it: 0 and -0 are one.
std::vector<uint32_t> first_at_places(const Mesh& mesh) {
  std::vector<uint32_t> order(mesh.vertices.size()), first(order.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto place = [&](uint32_t v) {
    const DVec3& p = mesh.vertices[v];
    return std::tuple(p.x, p.y, p.z);
  };
  std::stable_sort(order.begin(), order.end(),
                   [&](uint32_t v, uint32_t w) { return place(v) < place(w); });
  for (size_t i = 0; i < order.size(); ++i) {
    const bool is_first = i == 0 || place(order[i - 1]) != place(order[i]);
    first[order[i]] = is_first ? order[i] : first[order[i - 1]];
  }
  return first;
}

// Components are under 2, and their rounding to floats under 2^-24: all three together under 2^-23.
gpu::FaceNormal rounded(const UnitNormal& n, const gpu::uvec3& corners) {
  const bool has_any = n.off < 1;
  return {.along = {nearest_float(n.along.x), nearest_float(n.along.y), nearest_float(n.along.z)},
          .off = has_any ? float_up(n.off + 0x1p-23) : 1,
          .corners = corners};
}

void add_normals(const Mesh& mesh, const Frame& frame, std::vector<gpu::FaceNormal>& normals) {
  bool is_exact = true;
  const std::vector<glm::dvec3> vertices = scaled(mesh, frame, is_exact);
  const std::vector<uint32_t> first = first_at_places(mesh);
  for (const UVec3& f : mesh.faces) {
    const UnitNormal n = unit_normal({vertices[f.x], vertices[f.y], vertices[f.z]});
    normals.push_back(rounded(n, {first[f.x], first[f.y], first[f.z]}));
  }
}

}  // namespace

Normals::Normals(const SurveyedPair& pair, double degrees)
    : limit_(cosine_of_degrees(degrees)), moved_(float_up(pair.displacement)) {
  normals_.reserve(pair.a.faces.size() + pair.b.faces.size());
  add_normals(pair.a, pair.frame, normals_);
  add_normals(pair.b, pair.frame, normals_);
}

NormalSearch Normals::search() const {
  return {normals_, moved_, float_down(limit_.lower), float_up(limit_.upper)};
}

}  // namespace vkh
