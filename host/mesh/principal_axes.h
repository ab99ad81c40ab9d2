// A surface's area, centroid and principal axes: figures for notes, in ordinary double arithmetic.
#pragma once

#include <glm/mat3x3.hpp>
#include <optional>
#include <span>

#include "vkhausdorff/mesh.h"

namespace vkh {

/// The principal axes of a surface, all of whose points weigh the same. They depend on the surface
/// and not on its triangles, so that a scan of a part has the same axes as its CAD.
struct PrincipalAxes {
  double area = 0;
  DVec3 centroid{};  ///< of the surface
  /// The mean squared distances from the centroid along each axis, the least first; zeros where
  /// there is no area, or a figure is too large for a double.
  DVec3 variances{};
  glm::mat<3, 3, double, glm::packed_highp> axes{
      0};  ///< [i]: an axis, of length 1 and of either sign
};
/// The figures have the same bits for any number of threads.
PrincipalAxes principal_axes_of(const Mesh& mesh);
/// The axes of points of equal weight; their area is 0. Zeros where there is no point, or a figure
/// is too large for a double.
PrincipalAxes principal_axes_of(std::span<const DVec3> points);

/// By how much the variances of two surfaces differ at most, as a share of the largest of `b`; 1 or
/// more where one has no axes.
double difference_in_shape(const PrincipalAxes& a, const PrincipalAxes& b);

/// The angle in degrees by which the principal axes of `a` are turned against those of `b`, if it
/// means something: the variances agree so well that for equal shapes the angle is off by at most a
/// third of itself, and it is 0.25 degrees or more. An axis counts if its variance differs from the
/// others' by a twentieth of the largest. Axes have no sign, so half turns are not seen.
std::optional<double> turn_between(const PrincipalAxes& a, const PrincipalAxes& b);

}  // namespace vkh
