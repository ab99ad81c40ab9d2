// Runs the program under test, $VKH_PROGRAM.
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

#include "tests/support/files.h"

namespace vkh::test {

using Words = std::vector<std::string>;
inline Words operator+(Words words, const Words& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

struct Outcome {
  int exit_code = -1;
  int signal = 0;  ///< that killed it
  std::string out;
  std::string err;  ///< without lines of progress
};

/// A running program, its stdout and stderr going to files.
struct Running {
  pid_t process = 0;
  std::string out, err;
};
/// Returns when the process runs the program, none of this one's code. `out`: the target of stdout;
/// empty: a file of the folder, to be read by finish().
Running start(const Words& words, const std::string& out = "");
Outcome finish(const Running& running);

/// Returns when the process has a handler for `signal`.
void wait_until_caught(const Running& running, int signal);
/// Processor time so far, of all its threads.
double processor_seconds(const Running& running);
/// Sums over all programs that finish() has waited for.
double processor_seconds_of_ended();

/// start and finish; a death by signal fails the test.
Outcome run(const Words& words, const std::string& out = "");

}  // namespace vkh::test
