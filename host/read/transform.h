// Affine maps of a scene's nodes, in double, and how far each of their numbers may be off.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <optional>

namespace vkh::scene {

/// Maps x -> m (x, 1). An exact entry of the map lies within `off` of the stored one. `sign` is
/// that of the exact map's determinant: -1 where it mirrors, 0 where it flattens.
struct Affine {
  using Rows = std::array<std::array<double, 4>, 3>;
  Rows m = {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};
  Rows off = {};
  int sign = 1;
};

bool is_identity(const Affine& map);

/// A map of these entries, as a file has them.
Affine affine_of(const Affine::Rows& rows);

/// Translation, rotation and scale as a scene gives them: x -> t + R(q) (s x), where s scales each
/// axis. The quaternion q is stored as x, y, z, w; R(q) takes its direction and ignores its length.
struct Placing {
  std::array<double, 3> translation = {0, 0, 0}, scale = {1, 1, 1};
  std::array<double, 4> rotation = {0, 0, 0, 1};
};
/// Returns nothing for a quaternion of length 0.
std::optional<Affine> affine_of(const Placing& placing);
/// |q|^2, which shows whether q is off a unit quaternion by more than rounding.
double squared_length(const std::array<double, 4>& rotation);

/// Multiplies each coordinate by the quotient of two positive whole numbers.
Affine scaling(double numerator, double denominator);

/// Applies outer after inner. Each entry is rounded once, from Float128. The error of that is known
/// exactly, and so is the sign, since determinants multiply.
Affine compose(const Affine& outer, const Affine& inner);

/// Applies a map to points, and bounds how far each lies from its exact image.
class Mover {
 public:
  /// A point's coordinates are themselves off by `relative` of their size at most.
  Mover(const Affine& map, double relative);

  /// Adds to `delta` if this point needs more than all before.
  glm::dvec3 operator()(const glm::dvec3& point, double& delta) const;

 private:
  Affine map_;
  /// A fraction of the sum of a row's terms, by size: what rounding it, and the point, takes at
  /// most.
  std::array<double, 3> relative_{};
  bool is_still_ = false;  ///< nothing is moved, nothing is off
};

}  // namespace vkh::scene
