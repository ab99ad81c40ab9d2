// The keyword `certificate`: the bound that a call found is proven after its runs, and written to a
// file.
#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "host/base/output_file.h"
#include "host/python/answer.h"
#include "host/python/arguments.h"
#include "host/survey/prover.h"

namespace vkh::python {

class Certificate {
 public:
  /// Checks the place before anything is run. The time that the call may take begins.
  Certificate(const Arguments& given, const SolveOptions& options);

  bool is_asked() const { return file_.has_value(); }
  /// Called within Session::use, after the runs: proves their bounds, and writes the file. Arrays
  /// are in no file, so its hashes are those of their corners alone. `b_to_a`: null in a directed
  /// run.
  void make(Solver& solver, const PairView& pair, const Report& a_to_b, const Report* b_to_a);
  /// Writes the proven bound into the answer's stats, with the GIL. Warns if it is less.
  void tell(Answer& answer) const;

 private:
  std::optional<Proof> proof_of(Solver& solver, const PairView& pair, const Report& report) const;

  SolveOptions options_;
  std::optional<OutputFile> file_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::optional<Proof> there_, back_;
  size_t bytes_ = 0;
  bool is_less_ = false;  ///< less than the runs found
};

}  // namespace vkh::python
