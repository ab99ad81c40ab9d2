// Searches for the fewest faces that pass: by error, then patch by patch.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "host/simplify/collapse.h"
#include "host/simplify/judge.h"

namespace vkh {

/// A search: it holds the best candidate so far, and judges others.
class Search {
 public:
  Search(Judge& judge, const Collapser& collapser, const SimplifyOptions& options)
      : judge_(judge), collapser_(collapser), options_(options) {}

  /// Tries A itself, which passes unless its coordinates were rounded.
  void try_whole();
  /// Tries sixteen errors in geometric steps, the largest first: a candidate of few faces costs
  /// little. Then narrows the bracket between the first that passes and the one before it. The
  /// candidates are made before, on several threads, except for the ones of the smallest errors.
  void scan_errors();
  /// Simplifies the best candidate further, except for the patches that this breaks: these, and the
  /// faces around them, are locked, and the rest is simplified again.
  void repair();

  bool goes_on() const { return judge_.goes_on(); }
  bool has_best() const { return !best_.empty(); }
  const Faces& best() const { return best_; }
  size_t tried() const { return tried_; }

 private:
  enum class Outcome { kPassed, kFailed, kUseless };

  Outcome attempt(Faces faces);
  bool is_large() const;
  void make_candidates();
  Faces candidate(size_t step);
  void bisect_error(double passes, double fails);
  bool repair_by(double error);
  bool add_locks(const Mesh& broken, const PreparedMesh& best, double share,
                 std::vector<uint32_t>& locked);
  std::vector<DVec3> broken_places(const Mesh& broken, double share);
  void lock_around(const PreparedMesh& best, std::span<const DVec3> places,
                   std::vector<char>& is_locked);

  Judge& judge_;
  const Collapser& collapser_;
  const SimplifyOptions& options_;
  std::vector<Faces> candidates_;  ///< of the larger errors, the largest first
  Faces best_;                     ///< passed; none: nothing did
  Faces failed_;                   ///< the last that failed
  Deviation why_;                  ///< of the last that failed
  double best_error_ = 0;          ///< the target at which the best was found by error
  double failed_error_ = 0;
  size_t tried_ = 0;
};

}  // namespace vkh
