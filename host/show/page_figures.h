// The figures of a page: the tolerances that it can be set to, how much of a surface is within
// each, and the worst places.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "host/mesh/mesh.h"
#include "host/survey/field.h"

namespace vkh {

/// A tolerance that people can read: few digits, or the limit that was asked about.
struct Step {
  double value = 0;
  Limit limit;
  std::string label;       ///< without the unit
  bool is_linear = false;  ///< one of the steps that are evenly apart
  bool is_log = false;     ///< one of the steps with even ratios
};

/// Returns steps that ascend from 0 to at least `top`, the largest distance to be shown.
std::vector<Step> tolerance_steps(double top, const std::optional<Limit>& asked);

/// The steps between which a face stands: from step `within` on it is proven within it, before step
/// `beyond` it is proven beyond it. So a byte or two give the proven verdict of a face at every
/// step.
struct FaceSteps {
  uint32_t within = 0;  ///< as many as there are steps: within none of them
  uint32_t beyond = 0;
};
FaceSteps steps_of(const Enclosure& face, const std::vector<Step>& steps);

/// Counts over all faces of a mesh, at each step.
struct Tally {
  std::vector<uint64_t> within, beyond;          ///< faces
  std::vector<double> within_area, beyond_area;  ///< shares of the area; 0 where there is none
  uint64_t faces = 0;
  double area = 0;  ///< rounded to nearest, as are the shares
};
Tally tally(const Mesh& mesh, const Field& field, const std::vector<Step>& steps);

struct WorstPlace {
  uint64_t face = 0;       ///< index in Mesh::faces
  uint64_t file_face = 0;  ///< its number in the file
  Enclosure distance;      ///< the face's bounds
  glm::dvec3 centre{};     ///< the mean of its corners
  glm::dvec3 normal{};     ///< of unit length; 0 for a degenerate face
};

/// Returns faces by the largest upper first, each at least `apart` from those before it. Faces of
/// equal upper are by their lower, then by their number. Faces that lie on B are left out.
std::vector<WorstPlace> worst_places(const Mesh& mesh, const Field& field, size_t most,
                                     double apart);

}  // namespace vkh
