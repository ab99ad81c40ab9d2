// The keyword `certificate`: what a call found is proven after its runs, and written to a file.
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
  /// Looks at the place before anything is run. The time that the call may take begins.
  Certificate(const Arguments& given, const SolveOptions& options);

  bool is_asked() const { return file_.has_value(); }
  /// Within Session::use, after the runs: proves what they found, and writes the file. Arrays are
  /// in no file, so its hashes are those of their corners alone. `b_to_a`: null in a directed run.
  void make(Solver& solver, const PairView& pair, const Report& a_to_b, const Report* b_to_a);
  /// With the GIL: what was proven stands in the answer's stats. Warns where that is less.
  void tell(Answer& answer) const;

 private:
  std::optional<Proof> proof_of(Solver& solver, const PairView& pair, const Report& report) const;

  SolveOptions options_;
  std::optional<OutputFile> file_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::optional<Proof> there_, back_;
  size_t bytes_ = 0;
  bool is_less_ = false;  ///< than what the runs found
};

}  // namespace vkh::python
