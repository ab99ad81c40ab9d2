// How much of a question's work is done, over all of its steps: searches, surveys, certificates.
#pragma once

#include <array>
#include <cstddef>
#include <limits>

#include "vkhausdorff/answer.h"
#include "vkhausdorff/question.h"

namespace vkh {

/// The share of the work that is done, and the interval known so far.
struct WorkDone {
  double fraction = 0;  ///< in [0, 1]; it never falls, and is 1 once all work is done
  /// Enclose the whole answer's distance, in the files' units. They never widen.
  double lower = 0, upper = std::numeric_limits<double>::infinity();
};

/// The progress of a survey or a certificate of one mesh.
struct SideCount {
  bool back = false;  ///< of B
  size_t count = 0;   ///< cells bounded, or leaves made
  size_t faces = 0;   ///< of the mesh
  size_t effort = 0;  ///< cells that a survey may bound besides each face once
};

/// Adds up what an Observer hears. Each step counts the same, a step being the search in one
/// direction, the survey of one mesh or the certificate of one direction. A search has come as far
/// as its interval is narrow, in the logarithm; a survey as many cells as are bounded, in the
/// logarithm. How long a step takes is not known before it ends, so that the fraction is no clock.
/// One thread at a time.
class WorkMeter {
 public:
  /// `known` has its meshes: see begin_answer().
  WorkMeter(const Question& question, const Answer& known);

  void hear(const Progress& progress);
  void hear_cells(const SideCount& side);
  void hear_leaves(const SideCount& side);
  /// Takes the answer after the search, after the search for the worst point, and after surveys:
  /// each call of Observer::found.
  void take(const Answer& answer);
  /// Takes the final answer: all work is done.
  void end(const Answer& answer);

  const WorkDone& done() const { return done_; }

 private:
  struct Interval {
    double lower = 0, upper = std::numeric_limits<double>::infinity();
  };
  double part_of_search(const Progress& progress) const;
  void reach(double steps);
  void narrow(size_t direction, const Interval& interval);

  const size_t directions_, searches_, surveys_, proofs_;
  const bool is_by_face_;
  const uint32_t wave_limit_;
  const double farthest_, tolerance_;
  size_t rounds_ = 0;  ///< calls of take()
  std::array<Interval, 2> known_;
  WorkDone done_;
};

}  // namespace vkh
