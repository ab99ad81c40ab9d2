// The worst places of a mesh: regions of neighbouring faces about a peak of their deviation.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "host/answer/answer.h"
#include "host/mesh/mesh.h"
#include "host/survey/field.h"

namespace vkh {

struct WorstPlace {
  uint64_t face = 0;       ///< the peak: its index in Mesh::faces
  uint64_t file_face = 0;  ///< the peak's number in the file
  Enclosure distance;      ///< encloses the largest distance over the peak
  glm::dvec3 point{};      ///< the point itself if it is known; otherwise the middle of the peak
  glm::dvec3 normal{};     ///< the peak's normal, of unit length; 0 for a degenerate face
  uint64_t faces = 0;      ///< faces of the region
};

/// A point that a search found, and what encloses its distance.
struct FoundPoint {
  uint64_t face = 0;
  glm::dvec3 point{};
  Enclosure distance;
};

struct PlaceOptions {
  size_t most = 5;                       ///< places at most
  double apart = 0;                      ///< the least distance between two peaks
  std::optional<FoundPoint> found = {};  ///< the peak of its face's region, if it is that far
};

/// The options for a direction of an answer: peaks a twentieth of the diagonal apart, and the
/// farthest point that its search found.
PlaceOptions place_options(const Answer& answer, const Report& report);

/// Returns the regions of the largest lower bounds, the worst first: a bound that is proven, so
/// that no place is a phantom. Faces that share a vertex are neighbours. Two regions that meet are
/// one where the lower peak's bound falls by less than half in between. Faces with a bound of 0 are
/// in no region.
std::vector<WorstPlace> worst_places(const Mesh& mesh, const Field& field,
                                     const PlaceOptions& options);

}  // namespace vkh
