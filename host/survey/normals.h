// Prepares the search for how A's normals agree with those of B's closest faces, cell by cell;
// docs/certificate.md has the argument.
#pragma once

#include <vector>

#include "host/mesh/triangle_tree.h"
#include "host/solve/cells.h"
#include "vkhausdorff/field.h"

namespace vkh {

/// A face's unit normal to within `off`, in length; a face without area has none: `off` is 1.
struct UnitNormal {
  glm::dvec3 along{};
  double off = 1;
};
UnitNormal unit_normal(const Corners3& face);

/// Encloses the cosine of an angle from 0 to 90 degrees.
Enclosure cosine_of_degrees(double degrees);

/// The normals of two surfaces, and the cosine from which on normals agree.
class Normals {
 public:
  Normals(const SurveyedPair& pair, double degrees);

  /// Returns the input of the search; valid as long as this lives.
  NormalSearch search() const;

 private:
  std::vector<gpu::FaceNormal> normals_;
  const Enclosure limit_;
  const float moved_;
};

}  // namespace vkh
