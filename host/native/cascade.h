// The cascade of upper bounds over the children of one candidate, or over a face of A: exact case,
// u1, u2, ha and u3 over every pair of known triangles (docs/method.md, section 3).
#pragma once

#include "host/native/candidate.h"

namespace vkh::native {

/// A child among the points of its family.
struct Child {
  Bary3 at;
  std::array<uint32_t, 3> corner;
};

struct Verdict {
  double upper;
  Close by;
  uint32_t centre;  ///< the triangle nearest to the child's centroid; kNone: not queried
};

/// Points of one face of A, the triangles of B that are known to be near them, and the distances
/// between them, which children share. Each distance is measured when it is first needed.
class Family {
 public:
  Family(const Problem& problem, const Face& face, uint32_t centre);

  void add_point(const uvec2& at, uint32_t nearest);

  /// Bounds a child until it is closed, and queries its centroid if the cheap bounds do not close
  /// it. `upper` is its parent's.
  Verdict bound(const Child& child, double upper, double threshold, Gain& gain);

  /// Whether the face, whose corners are the first three points, is a face of B.
  bool is_shared(const UVec3& face_of_a, Gain& gain) const;

 private:
  static constexpr size_t kPoints = 6;
  static constexpr size_t kKnown = 8;  ///< six points', the parent's centroid's, the child's own

  struct Known {
    uint32_t place;
    bool is_made = false;
    uint32_t measured = 0, inside = 0;  ///< bit i: point i
    Surface surface;
    std::array<double, kPoints> distance;
  };
  /// A child on its way through the cascade.
  struct Trial {
    const Child& child;
    Patch t;
    double threshold;
    vec3 own{1e30, 1e30, 1e30};  ///< its corners' distances, each from the nearest triangle so far
    double ha = 1e30;
    size_t best = 0;  ///< the number of the triangle that gave `ha`
  };

  size_t add_known(uint32_t place);
  Known& measure(size_t k, const Child& child);
  vec3 distances(size_t k, const Child& child);
  Patch patch(const Child& child) const;
  vec3 sides(size_t i, size_t j, const Child& child) const;
  bool is_beside(size_t i, size_t j, uint32_t point) const;
  uint32_t ask_centre(const Child& child, size_t best, Gain& gain) const;
  size_t put_own_first(const Child& child);
  void narrow(double bound, Close by, Verdict& v) const;
  void narrow_by(size_t n, Trial& trial, Verdict& v);
  void narrow_by_pair(size_t i, size_t j, const Trial& trial, Verdict& v);

  const Problem& problem_;
  const Face& face_;
  std::array<Two3, kPoints> point_;
  std::array<uint32_t, kPoints> known_of_;  ///< of its nearest triangle
  size_t points_ = 0, count_ = 0;
  std::array<Known, kKnown> known_;
  std::array<size_t, kKnown> order_;  ///< a child's own triangles first
};

}  // namespace vkh::native
