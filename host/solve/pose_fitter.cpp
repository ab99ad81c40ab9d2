#include "host/solve/pose_fitter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "vkhausdorff/error.h"

namespace vkh {
namespace {

constexpr double kNearestShare = 0.8;
constexpr double kDeviations = 3;
// The deviation of a normal distribution over the median of its absolute values.
constexpr double kDeviationOfMedian = 1.4826;
constexpr double kCap = 0.05;        // of the size
constexpr double kMostTurn = 0.5;    // radians in one step
constexpr double kDamping = 1e-7;    // of the mean square
constexpr double kNoMove = 0x1p-46;  // of the size: roundings move a pose as far

/// The least squares of one step: six unknowns, a turn times the size and a shift.
class Equations {
 public:
  /// A pair whose distance changes by dot(turn, arm) + dot(shift, normal).
  void add(const glm::dvec3& arm, const glm::dvec3& normal, double distance) {
    const std::array<double, 6> row{arm.x, arm.y, arm.z, normal.x, normal.y, normal.z};
    for (size_t i = 0; i < 6; ++i) {
      for (size_t j = 0; j <= i; ++j) square_[i][j] += row[i] * row[j];
      right_[i] -= row[i] * distance;
    }
  }

  /// Solves them, damped: directions that change no distance, such as a turn of a ball, stay.
  std::array<double, 6> solve() {
    double trace = 0;
    for (size_t i = 0; i < 6; ++i) trace += square_[i][i];
    std::array<double, 6> x{};
    if (!(trace > 0) || !std::isfinite(trace)) return x;
    for (size_t i = 0; i < 6; ++i) square_[i][i] += kDamping * trace / 6;
    factorize();
    for (size_t i = 0; i < 6; ++i) {
      x[i] = right_[i];
      for (size_t j = 0; j < i; ++j) x[i] -= square_[i][j] * x[j];
      x[i] /= square_[i][i];
    }
    for (size_t i = 6; i-- > 0;) {
      for (size_t j = i + 1; j < 6; ++j) x[i] -= square_[j][i] * x[j];
      x[i] /= square_[i][i];
    }
    return x;
  }

 private:
  /// Cholesky's factor, in place.
  void factorize() {
    for (size_t i = 0; i < 6; ++i) {
      for (size_t j = 0; j <= i; ++j) {
        double sum = square_[i][j];
        for (size_t k = 0; k < j; ++k) sum -= square_[i][k] * square_[j][k];
        square_[i][j] = i == j ? std::sqrt(sum) : sum / square_[j][j];
      }
    }
  }

  std::array<std::array<double, 6>, 6> square_{};  // the lower half
  std::array<double, 6> right_{};
};

/// The largest of the nearest `share` of the distances, at least one of them.
double quantile(std::vector<double> distances, double share) {
  const auto count = static_cast<double>(distances.size());
  const auto rank = static_cast<size_t>(std::max(1.0, std::ceil(share * count))) - 1;
  const auto at = distances.begin() + static_cast<std::ptrdiff_t>(rank);
  std::nth_element(distances.begin(), at, distances.end());
  return *at;
}

double rms_within(std::span<const double> distances, double most, size_t& count) {
  double sum = 0;
  count = 0;
  for (const double d : distances) {
    if (d > most) continue;
    sum += d * d;
    ++count;
  }
  return count == 0 ? 0 : std::sqrt(sum / static_cast<double>(count));
}

double capped_rms(std::span<const double> distances, double cap) {
  double sum = 0;
  for (const double d : distances) sum += std::min(d, cap) * std::min(d, cap);
  return std::sqrt(sum / static_cast<double>(distances.size()));
}

glm::dvec3 normal_of(const Mesh& mesh, uint32_t number) {
  const UVec3& face = mesh.faces[number];
  const glm::dvec3 a = mesh.vertices[face.x], b = mesh.vertices[face.y], c = mesh.vertices[face.z];
  const glm::dvec3 normal = glm::cross(b - a, c - a);
  const double length = glm::length(normal);
  return length > 0 && std::isfinite(length) ? normal / length : glm::dvec3(0);
}

glm::dquat turn_by(const glm::dvec3& vector) {
  const double angle = glm::length(vector);
  if (!(angle > 0)) return {1, 0, 0, 0};
  const glm::dvec3 part = std::sin(angle / 2) / angle * vector;
  return {std::cos(angle / 2), part.x, part.y, part.z};
}

}  // namespace

/// Samples at a pose, with the points of B that are closest to them.
struct PoseFitter::Pairs {
  std::vector<glm::dvec3> points;   ///< from B's centre
  std::vector<glm::dvec3> normals;  ///< along which the distance grows; 0 where that is unknown
  std::vector<double> distances;    ///< along those
  double counts_to = 0;             ///< pairs farther apart do not count

  std::vector<double> lengths() const {
    std::vector<double> all(distances.size());
    std::transform(distances.begin(), distances.end(), all.begin(),
                   [](double d) { return std::abs(d); });
    return all;
  }
};

ClosestPoints PoseFitter::closest(std::span<Candidate* const> moving,
                                  std::span<const DVec3> samples, std::vector<DVec3>& points) {
  points.clear();
  points.reserve(moving.size() * samples.size());
  for (const Candidate* one : moving) {
    for (const DVec3& sample : samples)
      points.push_back(frame_.centre_b + one->pose(glm::dvec3(sample) - frame_.centre_a));
  }
  if (goes_on_ && !goes_on_(found_)) throw Interrupted("the fit was called off");
  found_ += points.size();
  return solver_.closest(b_, points, goes_on_);
}

// The gradient of a point's distance is the direction from its closest point, on a face, an edge or
// a corner. Where both coincide it is the face's normal.
PoseFitter::Pairs PoseFitter::pairs_of(std::span<const DVec3> points, const ClosestPoints& found,
                                       size_t begin) const {
  Pairs pairs;
  for (size_t i = 0; i < points.size(); ++i) {
    const glm::dvec3 off = glm::dvec3(points[i]) - glm::dvec3(found.points[begin + i]);
    const double distance = glm::length(off);
    const bool is_apart = distance > frame_.nearby;
    const glm::dvec3 normal =
        is_apart ? off / distance : normal_of(b_.mesh(), found.faces[begin + i]);
    pairs.points.push_back(glm::dvec3(points[i]) - frame_.centre_b);
    pairs.normals.push_back(normal);
    pairs.distances.push_back(is_apart ? distance : glm::dot(off, normal));
  }
  return pairs;
}

namespace {

/// Fills in the figures, and returns up to where pairs count.
double score(Candidate& candidate, const std::vector<double>& lengths, Counting counting,
             double cap) {
  const double nearest = quantile(lengths, kNearestShare);
  const double noise = kDeviations * kDeviationOfMedian * quantile(lengths, 0.5);
  const double counts_to = counting == Counting::kNearest ? nearest : noise;
  size_t count = 0;
  candidate.trimmed = rms_within(lengths, nearest, count);
  candidate.used = rms_within(lengths, counts_to, count);
  candidate.share = static_cast<double>(count) / static_cast<double>(lengths.size());
  candidate.capped = capped_rms(lengths, cap);
  return counts_to;
}

}  // namespace

// Linearised about the pose, as Low (2004) has it for points and planes. Returns how far it moved.
double PoseFitter::move(Candidate& candidate, const Pairs& pairs) const {
  Equations equations;
  for (size_t i = 0; i < pairs.points.size(); ++i) {
    const double distance = pairs.distances[i];
    if (std::abs(distance) > pairs.counts_to) continue;
    equations.add(glm::cross(pairs.points[i], pairs.normals[i]) / frame_.size, pairs.normals[i],
                  distance);
  }
  const std::array<double, 6> x = equations.solve();
  const glm::dvec3 turn = glm::dvec3(x[0], x[1], x[2]) / frame_.size;
  const glm::dvec3 shift(x[3], x[4], x[5]);
  const double moved = glm::length(turn) * frame_.size + glm::length(shift);
  if (!std::isfinite(moved) || moved <= kNoMove * frame_.size) return 0;
  const double part = std::min({1.0, kMostTurn / std::max(glm::length(turn), kMostTurn),
                                frame_.size / std::max(glm::length(shift), frame_.size)});
  const glm::dquat by = turn_by(part * turn);
  candidate.pose.turn = glm::normalize(by * candidate.pose.turn);
  candidate.pose.shift = by * candidate.pose.shift + part * shift;
  return part * moved;
}

void PoseFitter::refine(std::vector<Candidate>& candidates, std::span<const DVec3> samples,
                        const FitStage& stage) {
  for (Candidate& one : candidates) one.is_settled = false;
  std::vector<DVec3> points;
  for (size_t step = 0; step < stage.steps; ++step) {
    std::vector<Candidate*> moving;
    for (Candidate& one : candidates) {
      if (!one.is_settled) moving.push_back(&one);
    }
    if (moving.empty()) return;
    const ClosestPoints found = closest(moving, samples, points);
    for (size_t i = 0; i < moving.size(); ++i) {
      const size_t begin = i * samples.size();
      Pairs pairs = pairs_of(std::span(points).subspan(begin, samples.size()), found, begin);
      pairs.counts_to = score(*moving[i], pairs.lengths(), stage.counting, kCap * frame_.size);
      const double moved = move(*moving[i], pairs);
      moving[i]->is_settled = moved <= stage.least_move * moving[i]->used;
    }
  }
}

void PoseFitter::measure(Candidate& candidate, std::span<const DVec3> samples, Counting counting) {
  std::vector<DVec3> points;
  Candidate* const one = &candidate;
  const ClosestPoints found = closest({&one, 1}, samples, points);
  score(candidate, pairs_of(points, found, 0).lengths(), counting, kCap * frame_.size);
}

}  // namespace vkh
