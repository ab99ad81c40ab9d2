// The places of an answer: standard output, and the files that the user asked for.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "host/app/arguments.h"
#include "host/base/output_file.h"
#include "vkhausdorff/answer.h"
#include "vkhausdorff/error.h"

namespace vkh {

/// Destinations that are checked before the run and written after it.
class Destinations {
 public:
  /// Throws UsageError if a file cannot be written, or is one of `inputs`. `name`: of the test
  /// case. `is_verbose`: of the table.
  Destinations(const Outputs& outputs, const std::vector<std::string>& inputs, std::string name,
               bool is_verbose = false);

  /// Prints the answer first, whatever becomes of a file: a reader of standard output may close it
  /// early, and that ends the program. Returns what could not be written, and why; empty if
  /// nothing.
  std::string write(const Answer& answer);
  /// Writes the error instead, as JSON if JSON was asked for. An output that cannot be written is
  /// lost: the line on stderr has the error.
  void write(const Failure& failure) { write(failure, to_json(failure)); }
  /// Does the same with the error's JSON, which another command may have in another schema.
  void write(const Failure& failure, const std::string& json);

 private:
  Outputs outputs_;
  std::string name_;
  bool is_verbose_;
  std::optional<OutputFile> json_, junit_, transform_;
};

/// Appends text that GitHub shows on the run's page; earlier steps have written to it. Throws
/// OutputError.
void append_github_summary(const std::string& text);

/// Reports a usage error in the formats that the command line asks for: JSON or JUnit (commands
/// with one answer), or an annotation (batch). If an output file is also named by another word,
/// writes neither JSON nor JUnit.
void report_misuse(const Words& words, const UsageError& error);

}  // namespace vkh
