// Judges candidates: whether each is within the limit of A.
#pragma once

#include <chrono>
#include <vector>

#include "vkhausdorff/simplify.h"

namespace vkh {

/// The time of a call, from its construction on.
class Deadline {
 public:
  explicit Deadline(double seconds) : seconds_(seconds) {}
  double left_s() const {
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start_;
    return seconds_ - taken.count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  double seconds_;
};

/// Keeps A on the device for many candidates.
class Judge {
 public:
  /// Throws UsageError for a limit that is not positive and finite. All that is given must outlive
  /// it.
  Judge(Solver& solver, const Mesh& a, const SimplifyOptions& options, const Deadline& deadline);

  /// Decides whether b is within the limit, less a margin so that another run decides it, too. Ends
  /// as soon as either direction is beyond: `a_to_b` is then wide where it was not sought.
  Deviation decide(const Mesh& b);
  /// Encloses the deviation to a thousandth of the limit, and not above what `decided`, of the same
  /// mesh, has proven.
  Deviation measure(const Mesh& b, const Deviation& decided);

  /// The points of the list that may be farther from `to` than this share of the limit.
  std::vector<DVec3> beyond(const PreparedMesh& to, std::span<const DVec3> points, double share);

  Solver& solver() { return solver_; }
  const PreparedMesh& a() const { return prepared_; }
  bool goes_on() const {
    return deadline_.left_s() > 0 && !is_called_off_ && (!options_.goes_on || options_.goes_on());
  }
  void call_off() { is_called_off_ = true; }

 private:
  SolveOptions run_options() const;
  void conclude(Deviation& deviation) const;

  Solver& solver_;
  const SimplifyOptions& options_;
  const Deadline& deadline_;
  PreparedMesh prepared_;
  double within_ = 0;  ///< the limit less the margin
  bool is_called_off_ = false;
};

}  // namespace vkh
