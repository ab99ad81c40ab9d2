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
#include "host/survey/cell_corners.h"

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

  // An estimate from the bounds alone.
  static CellEstimate of_bounds(const gpu::CellBounds& b) {
    MeasuredCell unmeasured;
    unmeasured.middle = std::numeric_limits<double>::infinity();
    unmeasured.corners.fill(unmeasured.middle);
    return of(unmeasured, b);
  }

  // Weights of 1/12 for each corner and 3/4 for the centroid make the mean of a quadratic function
  // over a triangle.
  static CellEstimate of(const MeasuredCell& cell, const gpu::CellBounds& b) {
    const auto highest = static_cast<double>(b.highest);
    const std::array<float, 3> lower{b.lower_a, b.lower_b, b.lower_c};
    const std::array<float, 3> upper{b.upper_a, b.upper_b, b.upper_c};
    CellEstimate found;
    double mean = 0, square = 0;
    for (size_t i = 0; i < cell.corners.size(); ++i) {
      const double d = between_bounds(cell.corners[i], static_cast<double>(lower[i]),
                                      std::min(static_cast<double>(upper[i]), highest));
      found.corners[i] = static_cast<float>(d);
      mean += d / 12;
      square += d * d / 12;
    }
    const double least = mean_lower(b), most = static_cast<double>(b.mean_upper);
    const double middle = between_bounds(cell.middle, least, std::min(sum_of(upper) / 3, highest));
    found.middle = static_cast<float>(middle);
    found.mean = static_cast<float>(between_bounds(mean + 0.75 * middle, least, most));
    found.square = static_cast<float>(
        between_bounds(square + 0.75 * middle * middle, least * least,
                       std::min(static_cast<double>(b.square_upper), highest * most)));
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

// Estimates all cells, those that do not matter from their bounds, and the others from the faces
// that the bounds name. Returns those that may not name the closest faces.
template <class Matters>
std::vector<size_t> estimate_by_named(const CellEstimator& estimator, const CellStore& cells,
                                      const Matters& matters, std::vector<CellEstimate>& found) {
  std::vector<std::vector<size_t>> coarse(block_count(cells.count()));
  for_each_block(cells.count(), [&](size_t block, size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      const gpu::CellBounds& bounds = cells.bounds(i);
      if (!matters(i)) {
        found[i] = CellEstimator::of_bounds(bounds);
        continue;
      }
      const MeasuredCell cell = estimator.measured(cells.cell(i), estimator.named_by(bounds));
      found[i] = CellEstimator::of(cell, bounds);
      if (estimator.may_miss_faces(cell, bounds)) coarse[block].push_back(i);
    }
  });
  std::vector<size_t> all;
  for (const std::vector<size_t>& block : coarse) all.insert(all.end(), block.begin(), block.end());
  return all;
}

// Adds up what `add(sums, cell)` adds for each cell: in blocks, and then block by block, so that
// the bits are the same on any number of threads.
template <class Add>
std::vector<double> sums_over(size_t cells, size_t count, const Add& add) {
  std::vector<std::vector<double>> blocks(block_count(cells));
  for_each_block(cells, [&](size_t block, size_t begin, size_t end) {
    std::vector<double> sums(count, 0.0);
    for (size_t i = begin; i < end; ++i) add(sums, i);
    blocks[block] = std::move(sums);
  });
  std::vector<double> all(count, 0.0);
  for (const std::vector<double>& sums : blocks) {
    for (size_t k = 0; k < count; ++k) all[k] += sums[k];
  }
  return all;
}

// Adds a part of a cell to the sums of areas within distances: those that cut it get what is
// within; the first one that it is all within, at its place behind them, all of it.
void within_part(const std::array<float, 3>& corners, double area,
                 std::span<const double> ascending, std::vector<double>& sums) {
  const auto [least, most] = std::minmax({corners[0], corners[1], corners[2]});
  const size_t count = ascending.size();
  auto k = static_cast<size_t>(
      std::lower_bound(ascending.begin(), ascending.end(), static_cast<double>(least)) -
      ascending.begin());
  for (; k < count && ascending[k] < static_cast<double>(most); ++k)
    sums[k] += area * share_within(corners[0], corners[1], corners[2], ascending[k]);
  sums[count + k] += area;
}

}  // namespace

Estimates::Estimates(const SurveyedPair& pair, const CellStore& cells, const Areas& areas,
                     std::vector<Threshold> served, const GoesOn& goes_on)
    : cells_(cells), areas_(areas), served_(std::move(served)), of_cell_(cells.count()) {
  const CellEstimator estimator(pair);
  const auto matter = [this](size_t i) { return matters(i); };
  const std::vector<size_t> coarse = estimate_by_named(estimator, cells, matter, of_cell_);
  if (coarse.empty()) return;
  const AllFaces faces = estimator.all_faces();
  each_while(coarse.size(), goes_on, [&](size_t k) {
    const size_t i = coarse[k];
    of_cell_[i] = CellEstimator::of(estimator.measured(cells.cell(i), faces), cells.bounds(i));
  });
}

bool Estimates::matters(size_t cell) const {
  return serve_all() || std::any_of(served_.begin(), served_.end(), [&](const Threshold& at) {
           const Enclosure share = share_within(cells_, cell, at);
           return share.lower < share.upper;
         });
}

double Estimates::area_of(size_t cell) const {
  return cells_.share(cell) * areas_.of_face[cells_.face(cell)];
}

double Estimates::mean() const {
  const std::vector<double> sum =
      sums_over(of_cell_.size(), 1, [&](std::vector<double>& sums, size_t i) {
        sums[0] += area_of(i) * static_cast<double>(of_cell_[i].mean);
      });
  return sum[0] / areas_.whole;
}

double Estimates::rms() const {
  const std::vector<double> sum =
      sums_over(of_cell_.size(), 1, [&](std::vector<double>& sums, size_t i) {
        sums[0] += area_of(i) * static_cast<double>(of_cell_[i].square);
      });
  return std::sqrt(sum[0] / areas_.whole);
}

std::vector<double> Estimates::shares_within(std::span<const double> ascending) const {
  const size_t count = ascending.size();
  std::vector<double> sums =
      sums_over(of_cell_.size(), 2 * count + 1, [&](std::vector<double>& add, size_t i) {
        const CellEstimate& e = of_cell_[i];
        for (size_t corner = 0; corner < e.corners.size(); ++corner)
          within_part({e.corners[corner], e.corners[(corner + 1) % 3], e.middle}, area_of(i) / 3,
                      ascending, add);
      });
  double whole = 0;
  for (size_t k = 0; k < count; ++k) {
    whole += sums[count + k];
    sums[k] = std::clamp((sums[k] + whole) / areas_.whole, 0.0, 1.0);
  }
  sums.resize(count);
  return sums;
}

std::vector<double> Estimates::percentiles(std::span<const double> shares,
                                           std::span<const Enclosure> known) const {
  constexpr size_t kCuts = 63;
  constexpr int kPasses = 3;  // 18 bits of an enclosure
  std::vector<Enclosure> at(known.begin(), known.end());
  for (int pass = 0; pass < kPasses; ++pass) {
    std::vector<double> cuts;
    for (const Enclosure& e : at) {
      for (size_t k = 1; k <= kCuts; ++k)
        cuts.push_back(e.lower + (e.upper - e.lower) * static_cast<double>(k) / (kCuts + 1));
    }
    std::sort(cuts.begin(), cuts.end());
    const std::vector<double> within = shares_within(cuts);
    for (size_t p = 0; p < at.size(); ++p) {
      Enclosure& e = at[p];
      const auto first = std::lower_bound(within.begin(), within.end(), shares[p]);
      const auto k = first - within.begin();
      if (k < std::ssize(cuts))
        e.upper = std::clamp(cuts[static_cast<size_t>(k)], e.lower, e.upper);
      if (k > 0) e.lower = std::clamp(cuts[static_cast<size_t>(k - 1)], e.lower, e.upper);
    }
  }
  std::vector<double> found;
  found.reserve(at.size());
  for (const Enclosure& e : at) found.push_back((e.lower + e.upper) / 2);
  return found;
}

namespace {

void put(double estimate, Enclosure& e) {
  if (std::isfinite(estimate)) e.estimate = std::clamp(estimate, e.lower, e.upper);
}

double length_in_files(const SurveyedPair& pair, double length) {
  return (pair.frame.length_down(length) + pair.frame.length_up(length)) / 2;
}

void put_shares(const Estimates& estimates, const SurveyedPair& pair,
                std::vector<AreaWithin>& shares) {
  std::vector<size_t> order(shares.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::sort(order.begin(), order.end(),
            [&](size_t x, size_t y) { return shares[x].distance < shares[y].distance; });
  std::vector<double> ascending;
  ascending.reserve(order.size());
  for (const size_t i : order) ascending.push_back(pair.frame.to_frame(shares[i].distance));
  const std::vector<double> within = estimates.shares_within(ascending);
  for (size_t k = 0; k < order.size(); ++k) put(within[k], shares[order[k]].share);
}

}  // namespace

void add_estimates(const Estimates& estimates, const SurveyedPair& pair,
                   std::span<const Enclosure> percentiles, Statistics& s) {
  put_shares(estimates, pair, s.bands);
  if (!estimates.serve_all()) return;
  put_shares(estimates, pair, s.curve);
  put(length_in_files(pair, estimates.mean()), s.mean);
  put(length_in_files(pair, estimates.rms()), s.rms);
  std::vector<double> shares;
  for (const Percentile& p : s.percentiles) shares.push_back(p.share);
  const std::vector<double> at = estimates.percentiles(shares, percentiles);
  for (size_t i = 0; i < at.size(); ++i)
    put(length_in_files(pair, at[i]), s.percentiles[i].distance);
}

}  // namespace vkh
