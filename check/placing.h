// Puts the corners of a mesh where the certificate says, exactly: as integers.
#pragma once

#include <limits>

#include "check/certificate.h"
#include "check/exact.h"
#include "vkhausdorff/mesh.h"

namespace vkh::check {

/// A mesh whose corners are x -> M (p / q x). With y = p M x + q t, in integers times a power of
/// two, the corner is y / q.
class PlacedMesh {
 public:
  PlacedMesh(const Mesh& mesh, const Placement& placement)
      : mesh_(mesh), by_(placement), matrix_exponent_(least_of(placement)) {
    for (size_t i = 0; i < 3 && by_.has_matrix; ++i) {
      for (size_t j = 0; j < 3; ++j) matrix_[i][j] = integer(by_.matrix[i][j], matrix_exponent_);
    }
    numerator_ = integer(by_.numerator, 0);
    denominator_ = integer(by_.denominator, 0);
  }

  const Mesh& mesh() const { return mesh_; }
  size_t faces() const { return mesh_.faces.size(); }
  /// q.
  const Z& denominator() const { return denominator_; }

  /// The largest e such that all coordinates of all y are integers times 2^e, or less than it.
  int exponent() const {
    int out = std::numeric_limits<int>::max();
    for (const glm::dvec3& v : mesh_.vertices)
      out = std::min({out, exponent_of(v.x), exponent_of(v.y), exponent_of(v.z)});
    if (out == std::numeric_limits<int>::max()) out = 0;
    if (!by_.has_matrix) return out;
    out += matrix_exponent_;
    for (const auto& row : by_.matrix) out = std::min(out, exponent_of(row[3]));
    return out;
  }

  /// `times` y / 2^unit for the corners of a face.
  std::array<Point, 3> corners(uint64_t face, int unit, const Z& times) const {
    const glm::uvec3 f = mesh_.faces[face];
    return {placed(mesh_.vertices[f.x], unit, times), placed(mesh_.vertices[f.y], unit, times),
            placed(mesh_.vertices[f.z], unit, times)};
  }

  /// The square of the Frobenius norm of p / q M, or of p / q without a matrix: no length grows by
  /// more than its root.
  Fraction squared_growth() const {
    Z sum = by_.has_matrix ? 0 : 1;
    for (size_t i = 0; i < 3 && by_.has_matrix; ++i) {
      for (size_t j = 0; j < 3; ++j) sum += matrix_[i][j] * matrix_[i][j];
    }
    return scaled({sum * numerator_ * numerator_, denominator_ * denominator_}, matrix_exponent_);
  }

 private:
  static int least_of(const Placement& by) {
    int out = std::numeric_limits<int>::max();
    if (!by.has_matrix) return 0;
    for (const auto& row : by.matrix) {
      for (size_t j = 0; j < 3; ++j) out = std::min(out, exponent_of(row[j]));
    }
    return out == std::numeric_limits<int>::max() ? 0 : out;
  }

  Point placed(const glm::dvec3& vertex, int unit, const Z& times) const {
    if (!by_.has_matrix) {
      const Z factor = numerator_ * times;
      const Point at = point(vertex, unit);
      return {at.x * factor, at.y * factor, at.z * factor};
    }
    const std::array<Z, 3> at = integers(vertex, unit - matrix_exponent_);
    std::array<Z, 3> out;
    for (size_t i = 0; i < 3; ++i) {
      const Z turned = matrix_[i][0] * at[0] + matrix_[i][1] * at[1] + matrix_[i][2] * at[2];
      out[i] = (numerator_ * turned + denominator_ * integer(by_.matrix[i][3], unit)) * times;
    }
    return {out[0], out[1], out[2]};
  }

  static std::array<Z, 3> integers(const glm::dvec3& v, int exponent) {
    return {integer(v.x, exponent), integer(v.y, exponent), integer(v.z, exponent)};
  }

  const Mesh& mesh_;
  const Placement& by_;
  int matrix_exponent_;  ///< of the entries but for the shift; 0 without a matrix
  std::array<std::array<Z, 3>, 3> matrix_;
  Z numerator_, denominator_;
};

}  // namespace vkh::check
