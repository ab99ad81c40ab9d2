// Where an answer goes: standard output, and files that were asked for.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "host/app/arguments.h"
#include "host/base/output_file.h"

namespace vkh {

/// Looked at before the run, written after it.
class Destinations {
 public:
  /// Throws UsageError where one cannot be written, or is one of `inputs`.
  Destinations(const Outputs& outputs, const std::vector<std::string>& inputs);

  /// The answer is printed whatever becomes of a file, and after it: whoever reads standard output
  /// may close it early, and that ends the program. Returns what could not be written, and why;
  /// empty if nothing.
  std::string write(const Answer& answer);
  /// What went wrong instead, as JSON where JSON was asked for. What cannot be written is lost: the
  /// line on stderr says what went wrong.
  void write(const Failure& failure);

 private:
  Outputs outputs_;
  std::optional<OutputFile> json_, junit_;
};

/// Of words that are not understood, or cannot be done: what is wrong, where they ask for JSON,
/// JUnit's XML or an annotation. No file that another word names is written to.
void tell_misuse(const Words& words, const std::string& message);

/// Of an error's one line, which begins with its file.
Failure failure_of(const std::string& message, int code, const PairJob& job);

}  // namespace vkh
