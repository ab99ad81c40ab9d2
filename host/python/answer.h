// What Python gets: one object for a directed or a symmetric distance, plain values in it.
#pragma once

#include <pybind11/pybind11.h>

#include <optional>

#include "host/solve/face_gate.h"
#include "host/solve/report.h"

namespace vkh::python {

/// Of a symmetric run, the witness is that of the direction with the larger lower bound, told in
/// terms of A and B all the same.
struct Answer {
  double lower = 0, upper = 0;
  Status status = Status::kClosed;
  std::optional<Verdict> verdict;  ///< where a limit was given
  SurfacePoint witness_a, witness_b;
  pybind11::dict stats;

  bool closed() const { return status == Status::kClosed; }
  /// "pass", "fail", "undecided"; null without a limit.
  const char* verdict_name() const;
};

Answer answer_of(const Report& report);
Answer answer_of(const SymmetricReport& both);
Answer answer_of(const FaceGate& gate);

}  // namespace vkh::python
