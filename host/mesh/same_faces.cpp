#include "host/mesh/same_faces.h"

#include <algorithm>
#include <array>
#include <tuple>

namespace vkh {
namespace {

// A face's three positions, the first in order first; -0 is 0.
using FacePositions = std::array<glm::dvec3, 3>;

bool precedes(const glm::dvec3& p, const glm::dvec3& q) {
  return std::tie(p.x, p.y, p.z) < std::tie(q.x, q.y, q.z);
}

bool is_before(const FacePositions& f, const FacePositions& g) {
  return std::lexicographical_compare(f.begin(), f.end(), g.begin(), g.end(), precedes);
}

// Each once, in order.
std::vector<FacePositions> sorted_faces(const Mesh& mesh) {
  std::vector<FacePositions> faces;
  faces.reserve(mesh.faces.size());
  for (const glm::uvec3& f : mesh.faces) {
    faces.push_back({mesh.vertices[f.x], mesh.vertices[f.y], mesh.vertices[f.z]});
    std::sort(faces.back().begin(), faces.back().end(), precedes);
  }
  std::sort(faces.begin(), faces.end(), is_before);
  faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
  return faces;
}

}  // namespace

bool has_faces_of(const Mesh& whole, const Mesh& part) {
  if (part.faces == whole.faces && part.vertices == whole.vertices) return true;
  const std::vector<FacePositions> known = sorted_faces(whole), asked = sorted_faces(part);
  return std::includes(known.begin(), known.end(), asked.begin(), asked.end(), is_before);
}

}  // namespace vkh
