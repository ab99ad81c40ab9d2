// The frame in which the device works: coordinates of order 1, float32, and what storing them so
// displaced.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "host/mesh.h"

namespace vkh {

struct Box {
  glm::dvec3 lo, hi;
};
Box bounding_box(const Mesh& mesh);
double diagonal(const Box& box);  ///< rounded to nearest

/// Distances in the files' units, rounded outward.
struct FileInterval {
  double lower, upper;
};

/// frame = (given - centre) * 2^exponent, as a sum of two float32, high and low; |frame coordinate|
/// <= 1.
struct Frame {
  glm::dvec3 centre{};
  int exponent = 0;
  struct Stored {
    std::vector<float> high, low;  ///< three per vertex
  };
  Stored a, b;
  bool has_low = false;  ///< some low part is not 0
  /// Largest distance of a stored vertex from the exact one, in frame units, rounded up. h is
  /// 1-Lipschitz in both.
  double displacement_a = 0, displacement_b = 0;

  double displacement() const { return displacement_a + displacement_b; }
  double to_frame(double length) const;
  /// A length of the frame in the files' units. Exact unless it underflows; then 0 or the smallest
  /// double.
  double length_down(double frame_length) const;
  double length_up(double frame_length) const;
  /// What the device certifies of the stored coordinates, for those given: widened by the
  /// displacement. `joint_diagonal`, rounded to nearest, bounds any distance, also before the first
  /// bounds exist.
  FileInterval to_files(double lower, double upper, double joint_diagonal) const;
};

/// Prefers centre 0 where that keeps every coordinate in its high part: float32 files near the
/// origin; else the middle of the joint box.
Frame make_frame(const Mesh& a, const Mesh& b);

}  // namespace vkh
