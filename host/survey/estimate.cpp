#include "host/survey/estimate.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>
#include <utility>

#include "host/base/parallel.h"
#include "host/mesh/closest.h"
#include "host/mesh/triangle_tree.h"
#include "host/solve/cell_corners.h"

namespace vkh {
namespace {

// A mesh's vertices in the frame, in double.
class FramedCorners {
 public:
  FramedCorners(const Mesh& mesh, const Frame& frame)
      : mesh_(mesh),
        centre_(frame.centre),
        first_(std::ldexp(1.0, frame.exponent / 2)),
        second_(std::ldexp(1.0, frame.exponent - frame.exponent / 2)) {}

  size_t face_count() const { return mesh_.faces.size(); }
  std::array<glm::dvec3, 3> of(uint32_t face) const {
    const glm::uvec3 f = mesh_.faces[face];
    return {at(f.x), at(f.y), at(f.z)};
  }

 private:
  glm::dvec3 at(uint32_t vertex) const {
    return (glm::dvec3(mesh_.vertices[vertex]) - centre_) * first_ * second_;
  }

  const Mesh& mesh_;
  const glm::dvec3 centre_;
  const double first_, second_;
};

double distance_of(const glm::dvec3& p, const Corners3& face) {
  return glm::distance(p, closest_point(p, face[0], face[1], face[2]).point);
}

// The faces of B that a cell's bounds name, each once.
struct NamedFaces {
  std::array<std::array<glm::dvec3, 3>, 4> corners;
  size_t count = 0;

  NamedFaces(const gpu::CellBounds& b, const FramedCorners& mesh) {
    std::array<uint32_t, 4> names{b.face, b.face_a, b.face_b, b.face_c};
    for (size_t i = 0; i < names.size(); ++i) {
      const auto end = names.begin() + static_cast<std::ptrdiff_t>(i);
      if (names[i] >= mesh.face_count() || std::find(names.begin(), end, names[i]) != end) continue;
      corners[count++] = mesh.of(names[i]);
    }
  }

  double distance(const glm::dvec3& p) const {
    double nearest = std::numeric_limits<double>::infinity();
    for (size_t i = 0; i < count; ++i) nearest = std::min(nearest, distance_of(p, corners[i]));
    return nearest;
  }
};

// All faces of B, for the few cells that are too coarse to name those that are closest.
class AllFaces {
 public:
  explicit AllFaces(const FramedCorners& mesh) : corners_(corners_of_all(mesh)), tree_(corners_) {}

  double distance(const glm::dvec3& p) const {
    double nearest = std::numeric_limits<double>::infinity(), squared = nearest;
    size_t seen = 0;
    tree_.nearest_first(p, squared, [&](uint32_t face) {
      nearest = std::min(nearest, distance_of(p, corners_[face]));
      squared = ++seen < kMostFaces ? nearest * nearest : -1;  // no box is so near
    });
    return nearest;
  }

 private:
  // The boxes of needles all hold the point: to look at all of them took three quarters of a
  // survey's time. The nearest boxes come first, and an estimate proves nothing.
  static constexpr size_t kMostFaces = 1024;

  static std::vector<Corners3> corners_of_all(const FramedCorners& mesh) {
    std::vector<Corners3> all(mesh.face_count());
    for (uint32_t f = 0; f < all.size(); ++f) all[f] = mesh.of(f);
    return all;
  }

  std::vector<Corners3> corners_;
  TriangleTree tree_;
};

// Whether a cell has one lower bound at two corners or more, as cells have that have more faces of
// B about them than a device examines.
bool has_one_lower_bound(const gpu::CellBounds& b) {
  return b.lower_a == b.lower_b || b.lower_b == b.lower_c || b.lower_c == b.lower_a;
}

// The distance, put between two bounds; their middle if there is none.
double between_bounds(double distance, double lower, double upper) {
  const double least = std::max(lower, 0.0), most = std::max(upper, least);
  return std::isfinite(distance) ? std::clamp(distance, least, most) : (least + most) / 2;
}

double sum_of(const std::array<float, 3>& values) {
  double sum = 0;
  for (const float value : values) sum += static_cast<double>(value);
  return sum;
}

// The corners of a cell and its middle, in the frame, and their distances from some faces of B.
struct MeasuredCell {
  std::array<glm::dvec3, 3> at{};
  glm::dvec3 middle_at{};
  std::array<double, 3> corners{};
  double middle = 0;
};

class CellEstimator {
 public:
  explicit CellEstimator(const SurveyedPair& pair)
      : a_(pair.a, pair.frame), b_(pair.b, pair.frame), are_points_(pair.a.are_points) {}

  AllFaces all_faces() const { return AllFaces(b_); }
  NamedFaces named_by(const gpu::CellBounds& b) const { return NamedFaces(b, b_); }

  // Measures a point once, which is all corners of its cell and its middle.
  template <class Faces>
  MeasuredCell measured(const gpu::Cell& cell, const Faces& faces) const {
    MeasuredCell found;
    found.at = corners_in_frame(cell);
    found.middle_at = are_points_ ? found.at[0] : (found.at[0] + found.at[1] + found.at[2]) / 3.0;
    found.middle = faces.distance(found.middle_at);
    for (size_t i = 0; i < found.at.size(); ++i)
      found.corners[i] = are_points_ ? found.middle : faces.distance(found.at[i]);
    return found;
  }

  // Whether the faces that the bounds name may not be those that are closest at the corners: they
  // are not where they are farther than any distance over the cell, or than the middle's and the
  // way from there. A point has one lower bound at its three corners, and its bounds are narrow.
  bool may_miss_faces(const MeasuredCell& cell, const gpu::CellBounds& b) const {
    constexpr double kRounding = 1e-5;
    for (size_t i = 0; i < cell.at.size(); ++i) {
      const double most = std::min(static_cast<double>(b.highest),
                                   cell.middle + glm::distance(cell.at[i], cell.middle_at));
      if (cell.corners[i] > most * (1 + kRounding)) return true;
      if (!are_points_ && has_one_lower_bound(b) &&
          cell.corners[i] > static_cast<double>(lowest(b)))
        return true;
    }
    return false;
  }

  // Weights of 1/12 for each corner and 3/4 for the centroid make the mean of a quadratic function
  // over a triangle.
  static CellEstimate of(const MeasuredCell& cell, const gpu::CellBounds& b) {
    const auto highest = static_cast<double>(b.highest);
    const std::array<float, 3> lower{b.lower_a, b.lower_b, b.lower_c};
    const std::array<float, 3> upper{b.upper_a, b.upper_b, b.upper_c};
    CellEstimate found;
    double mean = 0;
    for (size_t i = 0; i < cell.corners.size(); ++i) {
      const double d = between_bounds(cell.corners[i], static_cast<double>(lower[i]),
                                      std::min(static_cast<double>(upper[i]), highest));
      found.corners[i] = static_cast<float>(d);
      mean += d / 12;
    }
    const double least = mean_lower(b), most = static_cast<double>(b.mean_upper);
    const double middle = between_bounds(cell.middle, least, std::min(sum_of(upper) / 3, highest));
    found.middle = static_cast<float>(middle);
    found.mean = static_cast<float>(between_bounds(mean + 0.75 * middle, least, most));
    return found;
  }

 private:
  std::array<glm::dvec3, 3> corners_in_frame(const gpu::Cell& cell) const {
    const std::array<glm::dvec3, 3> face = a_.of(cell.face);
    const lib::Bary3 t = corners_of(cell);
    std::array<glm::dvec3, 3> at;
    const std::array<glm::uvec2, 3> corners{t.a, t.b, t.c};
    for (size_t i = 0; i < at.size(); ++i) {
      const glm::dvec2 w = glm::dvec2(corners[i]) / static_cast<double>(gpu::kBaryOne);
      at[i] = face[0] + w.x * (face[1] - face[0]) + w.y * (face[2] - face[0]);
    }
    return at;
  }

  const FramedCorners a_, b_;
  const bool are_points_;
};

// Estimates all cells from the faces that their bounds name. Returns those that may not name the
// closest faces.
std::vector<size_t> estimate_by_named(const CellEstimator& estimator, const CellStore& cells,
                                      std::vector<CellEstimate>& found) {
  std::vector<std::vector<size_t>> coarse(block_count(cells.count()));
  for_each_block(cells.count(), [&](size_t block, size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      const gpu::CellBounds& bounds = cells.bounds(i);
      const MeasuredCell cell = estimator.measured(cells.cell(i), estimator.named_by(bounds));
      found[i] = CellEstimator::of(cell, bounds);
      if (estimator.may_miss_faces(cell, bounds)) coarse[block].push_back(i);
    }
  });
  std::vector<size_t> all;
  for (const std::vector<size_t>& block : coarse) all.insert(all.end(), block.begin(), block.end());
  return all;
}

}  // namespace

Estimates::Estimates(const SurveyedPair& pair, const CellStore& cells, const GoesOn& goes_on)
    : of_cell_(cells.count()) {
  const CellEstimator estimator(pair);
  const std::vector<size_t> coarse = estimate_by_named(estimator, cells, of_cell_);
  if (coarse.empty()) return;
  const AllFaces faces = estimator.all_faces();
  each_while(coarse.size(), goes_on, [&](size_t k) {
    const size_t i = coarse[k];
    of_cell_[i] = CellEstimator::of(estimator.measured(cells.cell(i), faces), cells.bounds(i));
  });
}

}  // namespace vkh
