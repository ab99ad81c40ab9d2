#include "host/mesh/principal_axes.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "host/base/parallel.h"

namespace vkh {
namespace {

using Matrix = glm::dmat3;  // symmetric, or of axes: [i] is one

/// Sums of the area, and of the area times each coordinate and product of coordinates about a
/// point.
struct Sums {
  double area = 0;
  glm::dvec3 first{};
  Matrix second{0};

  /// The integral of x_i x_j over a triangle with corners c_k is area / 12 times
  /// sum_k c_ki c_kj + (sum_k c_ki) (sum_k c_kj).
  void add(const glm::dvec3 (&corner)[3]) {
    const double face = 0.5 * glm::length(glm::cross(corner[1] - corner[0], corner[2] - corner[0]));
    const glm::dvec3 sum = corner[0] + corner[1] + corner[2];
    area += face;
    first += face / 3 * sum;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j <= i; ++j) {
        double products = sum[i] * sum[j];
        for (const glm::dvec3& c : corner) products += c[i] * c[j];
        second[i][j] += face / 12 * products;
      }
    }
  }

  void add(const Sums& other) {
    area += other.area;
    first += other.first;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j <= i; ++j) second[i][j] += other.second[i][j];
    }
  }
};

Sums sums_of(const Mesh& mesh) {
  std::vector<Sums> parts(block_count(mesh.faces.size()));
  const glm::dvec3 origin = mesh.vertices[0];
  for_each_block(mesh.faces.size(), [&](size_t number, size_t begin, size_t end) {
    for (size_t f = begin; f < end; ++f) {
      glm::dvec3 corner[3];
      for (int k = 0; k < 3; ++k) corner[k] = glm::dvec3(mesh.vertices[mesh.faces[f][k]]) - origin;
      parts[number].add(corner);
    }
  });
  Sums all;
  for (const Sums& part : parts) all.add(part);
  return all;
}

/// Turns `m` and the axes in the plane of i and j so that m_ij becomes 0.
void rotate(Matrix& m, Matrix& axes, int i, int j) {
  if (m[i][j] == 0) return;
  const double angle = 0.5 * std::atan2(2 * m[i][j], m[j][j] - m[i][i]);
  const double c = std::cos(angle), s = std::sin(angle);
  const auto turn = [&](double& x, double& y) {
    const double was = x;
    x = c * was - s * y;
    y = s * was + c * y;
  };
  for (int k = 0; k < 3; ++k) turn(m[k][i], m[k][j]);
  for (int k = 0; k < 3; ++k) turn(m[i][k], m[j][k]);
  for (int k = 0; k < 3; ++k) turn(axes[i][k], axes[j][k]);
}

/// Finds the eigenvectors of a symmetric matrix by Jacobi's rotations: eight sweeps are more than
/// doubles of three by three need.
Matrix diagonalize(Matrix& m) {
  Matrix axes{1};
  for (int sweep = 0; sweep < 8; ++sweep) {
    rotate(m, axes, 0, 1);
    rotate(m, axes, 0, 2);
    rotate(m, axes, 1, 2);
  }
  return axes;
}

constexpr double kLeastAngle = 0.25;  // degrees
constexpr double kLeastGap = 0.05;    // of the largest variance
constexpr double kDegrees = 180 / std::numbers::pi;

/// Fills in the axes of a matrix of covariances, unless a figure is too large for a double.
void put_axes(Matrix m, PrincipalAxes& of) {
  if (!std::isfinite(m[0][0] + m[1][1] + m[2][2])) return;
  const Matrix axes = diagonalize(m);
  int order[3] = {0, 1, 2};
  std::sort(order, order + 3, [&](int x, int y) { return m[x][x] < m[y][y]; });
  for (int i = 0; i < 3; ++i) {
    of.variances[i] = m[order[i]][order[i]];
    of.axes[i] = axes[order[i]];
  }
}

double least_gap(const DVec3& variances, int axis) {
  double gap = variances[2];
  for (int other = 0; other < 3; ++other) {
    if (other != axis) gap = std::min(gap, std::abs(variances[axis] - variances[other]));
  }
  return gap;
}

}  // namespace

PrincipalAxes principal_axes_of(const Mesh& mesh) {
  const Sums sums = sums_of(mesh);
  PrincipalAxes of_mesh{.area = sums.area};
  if (!(sums.area > 0) || !std::isfinite(sums.area)) return of_mesh;
  const glm::dvec3 centre = sums.first / sums.area;
  of_mesh.centroid = glm::dvec3(mesh.vertices[0]) + centre;
  Matrix m{0};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j <= i; ++j)
      m[i][j] = m[j][i] = sums.second[i][j] / sums.area - centre[i] * centre[j];
  }
  put_axes(m, of_mesh);
  return of_mesh;
}

PrincipalAxes principal_axes_of(std::span<const DVec3> points) {
  PrincipalAxes of_points;
  if (points.empty()) return of_points;
  const auto count = static_cast<double>(points.size());
  const glm::dvec3 origin = points[0];
  glm::dvec3 sum{};
  for (const DVec3& point : points) sum += glm::dvec3(point) - origin;
  of_points.centroid = origin + sum / count;
  Matrix m{0};
  for (const DVec3& point : points) {
    const glm::dvec3 from_centre = glm::dvec3(point) - glm::dvec3(of_points.centroid);
    m += glm::outerProduct(from_centre, from_centre);
  }
  put_axes(m / count, of_points);
  return of_points;
}

double difference_in_shape(const PrincipalAxes& a, const PrincipalAxes& b) {
  const double largest = b.variances[2];
  if (!(largest > 0)) return 1;
  double off = 0;
  for (int i = 0; i < 3; ++i)
    off = std::max(off, std::abs(a.variances[i] - b.variances[i]) / largest);
  return off;
}

std::optional<double> turn_between(const PrincipalAxes& a, const PrincipalAxes& b) {
  const double largest = b.variances[2];
  if (!(largest > 0) || !(a.area > 0)) return std::nullopt;
  int counting = 0;
  double cosines = 0, least = 1;
  double gap = 1;
  for (int i = 0; i < 3; ++i) {
    const double cosine = std::min(1.0, std::abs(glm::dot(a.axes[i], b.axes[i])));
    cosines += cosine;
    const double own = least_gap(b.variances, i) / largest;
    if (!(own >= kLeastGap)) continue;
    ++counting;
    gap = std::min(gap, own);
    least = std::min(least, cosine);
  }
  if (counting == 0) return std::nullopt;
  // The trace of a rotation is 1 + 2 cos.
  const double angle =
      std::acos(counting == 3 ? std::clamp((cosines - 1) / 2, -1.0, 1.0) : least) * kDegrees;
  const double error = difference_in_shape(a, b) / gap * kDegrees;
  if (!(angle >= kLeastAngle) || !(angle >= 3 * error)) return std::nullopt;
  return angle;
}

}  // namespace vkh
