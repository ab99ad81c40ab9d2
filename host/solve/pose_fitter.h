// Iterated closest points: poses of A go down the distance of A's samples from B, side by side.
#pragma once

#include <glm/ext/quaternion_double.hpp>
#include <limits>
#include <span>
#include <vector>

#include "vkhausdorff/solver.h"

namespace vkh {

/// Maps x, from A's centre, to turn x + shift, from B's centre.
struct Pose {
  glm::dquat turn{1, 0, 0, 0};
  glm::dvec3 shift{};
  glm::dvec3 operator()(const glm::dvec3& x) const { return turn * x + shift; }
};

/// The origins of a pose, and lengths to compare by.
struct FitFrame {
  glm::dvec3 centre_a{}, centre_b{};
  double size = 1;    ///< root mean square distance of B's points from their centre
  double nearby = 0;  ///< a distance so small that it is a rounding and has no direction
};

/// A pose, and how far A's samples are from B there.
struct Candidate {
  Pose pose;
  double trimmed = std::numeric_limits<double>::infinity();  ///< rms of the nearest 80 %
  double used = std::numeric_limits<double>::infinity();     ///< rms of the samples that count
  double share = 0;  ///< the share of the samples that count
  /// Rms of all, none farther than a twentieth of the size. Candidates are ranked by it: samples
  /// where a part lacks something, or has too much, are among the farthest.
  double capped = std::numeric_limits<double>::infinity();
  bool is_settled = false;
};

enum class Counting {
  kNearest,  ///< the nearest 80 % of the samples
  kNoise,    ///< the samples within three deviations, which are estimated by the median
};

struct FitStage {
  Counting counting = Counting::kNearest;
  size_t steps = 30;
  double least_move = 1e-2;  ///< as a share of the rms: a candidate that moves less has settled
};

class PoseFitter {
 public:
  /// All must outlive it.
  PoseFitter(Solver& solver, const PreparedMesh& b, const FitFrame& frame,
             const ClosestGoesOn& goes_on)
      : solver_(solver), b_(b), frame_(frame), goes_on_(goes_on) {}

  /// Moves each candidate until it settles. `samples` are in A's coordinates.
  void refine(std::vector<Candidate>& candidates, std::span<const DVec3> samples,
              const FitStage& stage);
  /// Fills in a candidate's figures where it stands.
  void measure(Candidate& candidate, std::span<const DVec3> samples, Counting counting);

 private:
  struct Pairs;
  ClosestPoints closest(std::span<Candidate* const> moving, std::span<const DVec3> samples,
                        std::vector<DVec3>& points);
  Pairs pairs_of(std::span<const DVec3> points, const ClosestPoints& found, size_t begin) const;
  double move(Candidate& candidate, const Pairs& pairs) const;

  Solver& solver_;
  const PreparedMesh& b_;
  const FitFrame& frame_;
  const ClosestGoesOn& goes_on_;
  size_t found_ = 0;
};

}  // namespace vkh
