// The proof of an upper bound over a part of a face of A: one triangle of B, or two with a cut
// between (docs/certificate-file.md). Distances are taken in double, and rounded up by more than
// they can be off.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "vkhausdorff/mesh.h"

namespace vkh {

/// hi + lo, off by 2^-98 of hi for each step that led there.
struct Point2 {
  glm::dvec3 hi{}, lo{};
};
/// x + t (y - x), for t in [0, 1] of sixteen bits.
Point2 between(const Point2& x, const Point2& y, double t);

/// The corners of a part.
using Part = std::array<Point2, 3>;

/// A mesh's vertices, scaled by a power of two so that they are of order 1.
class ScaledMesh {
 public:
  ScaledMesh(const Mesh& mesh, int exponent);
  size_t face_count() const { return mesh_.faces.size(); }
  std::array<glm::dvec3, 3> corners(uint32_t face) const;
  Part part(uint32_t face) const;

 private:
  const Mesh& mesh_;
  std::vector<glm::dvec3> vertices_;
};

/// A distance slightly above d(p, t), or equal.
double distance_up(const Point2& p, const std::array<glm::dvec3, 3>& t);

struct Leaf {
  static constexpr uint8_t kUncut = 3;  ///< the whole part is within reach of `first`
  uint8_t alone = kUncut;               ///< otherwise: the corner on the side of `first`
  uint32_t first = 0, second = 0;       ///< faces of B
  /// The cuts on the edges from that corner, in units of 2^-16.
  uint16_t cut_next = 0, cut_last = 0;
};

/// Faces of B that may be near a part.
constexpr size_t kMostHints = 8;
struct Hints {
  std::array<uint32_t, kMostHints> face{};
  size_t count = 0;
  /// Adds a face if it is not there already, and there is room.
  void add(uint32_t one);
};

/// The same as distance_up, from the part's middle.
double middle_distance_up(const Part& part, const std::array<glm::dvec3, 3>& t);

/// The faces nearest to the part's middle, the nearest first; the part is small.
Hints nearest_faces(const Part& part, const ScaledMesh& b);

/// Returns a leaf that proves, by one or two of the hints, that the part is within `upper` of B;
/// nothing if none does.
std::optional<Leaf> proof_of(const Part& part, const ScaledMesh& b, const Hints& hints,
                             double upper);

/// The best single face, and how far the part is from it at most.
struct Nearest {
  Leaf leaf;
  double upper = 0;
};
Nearest nearest_of(const Part& part, const ScaledMesh& b, const Hints& hints);

}  // namespace vkh
