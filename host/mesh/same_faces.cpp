#include "host/mesh/same_faces.h"

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>

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

FacePositions positions_of(const Mesh& mesh, const glm::uvec3& f) {
  FacePositions face = {mesh.vertices[f.x], mesh.vertices[f.y], mesh.vertices[f.z]};
  std::sort(face.begin(), face.end(), precedes);
  return face;
}

// Returns each face once, in order.
std::vector<FacePositions> sorted_faces(const Mesh& mesh) {
  std::vector<FacePositions> faces;
  faces.reserve(mesh.faces.size());
  for (const glm::uvec3& f : mesh.faces) faces.push_back(positions_of(mesh, f));
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

std::vector<uint32_t> same_faces(const Mesh& whole, const Mesh& part) {
  std::vector<std::pair<FacePositions, uint32_t>> known;
  known.reserve(whole.faces.size());
  for (uint32_t f = 0; f < whole.faces.size(); ++f)
    known.emplace_back(positions_of(whole, whole.faces[f]), f);
  const auto first = [](const auto& x, const FacePositions& y) { return is_before(x.first, y); };
  std::sort(known.begin(), known.end(),
            [](const auto& x, const auto& y) { return is_before(x.first, y.first); });
  std::vector<uint32_t> found;
  found.reserve(part.faces.size());
  for (const glm::uvec3& f : part.faces) {
    const FacePositions asked = positions_of(part, f);
    const auto at = std::lower_bound(known.begin(), known.end(), asked, first);
    found.push_back(at != known.end() && at->first == asked ? at->second : kNoFace);
  }
  return found;
}

}  // namespace vkh
