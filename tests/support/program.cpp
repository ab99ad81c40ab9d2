#include "tests/support/program.h"

#include <doctest/doctest.h>
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <sstream>

namespace vkh::test {
namespace {

namespace fs = std::filesystem;

void redirect(int target, const std::string& path) {
  const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  if (file < 0 || dup2(file, target) < 0) _exit(126);
}

bool is_progress(const std::string& line) {
  const std::string first = line.substr(0, line.find("  "));
  if (first.size() == line.size()) return false;
  for (const char* what : {"reading", "survey", "certificate", "h(A,B)", "h(B,A)"})
    if (first == what) return true;
  const bool is_share = first.ends_with(" %"), is_count = first.find('/') != std::string::npos;
  return (is_share || is_count) && first.find_first_not_of("0123456789/ %") == std::string::npos;
}

/// The text without the lines of a run's progress: one every ten seconds, so that a slow machine
/// has more of them (host/answer/progress_line.h).
std::string without_progress(const std::string& err) {
  std::istringstream lines(err);
  std::string kept;
  for (std::string line; std::getline(lines, line);) {
    const bool is_whole = !lines.eof();
    if (is_whole && is_progress(line)) continue;
    kept += line + (is_whole ? "\n" : "");
  }
  return kept;
}

}  // namespace

Running start(const Words& words, const std::string& out) {
  const char* program = std::getenv("VKH_PROGRAM");
  REQUIRE_MESSAGE(program != nullptr, "VKH_PROGRAM must name the program under test");
  REQUIRE_MESSAGE(access(program, X_OK) == 0, program << " is not built: ninja vkhausdorff");
  std::vector<char*> arguments{const_cast<char*>(program)};
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  std::array<int, 2> until_exec{};  // closed in the child when it becomes the program
  REQUIRE(pipe2(until_exec.data(), O_CLOEXEC) == 0);
  Running running{0, out.empty() ? folder() / "stdout" : out, folder() / "stderr"};
  running.process = fork();
  REQUIRE(running.process >= 0);
  if (running.process == 0) {
    redirect(STDOUT_FILENO, running.out);
    redirect(STDERR_FILENO, running.err);
    execv(program, arguments.data());
    _exit(127);
  }
  close(until_exec[1]);
  char none = 0;
  while (read(until_exec[0], &none, 1) < 0 && errno == EINTR) {
  }
  close(until_exec[0]);
  return running;
}

void wait_until_caught(const Running& running, int signal) {
  const std::string path = "/proc/" + std::to_string(running.process) + "/status";
  for (;;) {
    const std::string status = read_file(path);
    const size_t at = status.find("SigCgt:");
    REQUIRE(at != std::string::npos);
    const uint64_t caught = std::strtoull(status.c_str() + at + 7, nullptr, 16);
    if ((caught >> (signal - 1) & 1) != 0) return;
    REQUIRE_MESSAGE(status.find("State:\tZ") == std::string::npos, "it ended before");
    usleep(1000);
  }
}

double processor_seconds(const Running& running) {
  clockid_t clock{};
  timespec time{};
  REQUIRE(clock_getcpuclockid(running.process, &clock) == 0);
  REQUIRE(clock_gettime(clock, &time) == 0);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

double processor_seconds_of_ended() {
  rusage used{};
  REQUIRE(getrusage(RUSAGE_CHILDREN, &used) == 0);
  return static_cast<double>(used.ru_utime.tv_sec + used.ru_stime.tv_sec) +
         1e-6 * static_cast<double>(used.ru_utime.tv_usec + used.ru_stime.tv_usec);
}

Outcome finish(const Running& running) {
  int status = 0;
  REQUIRE(waitpid(running.process, &status, 0) == running.process);
  Outcome outcome;
  if (WIFEXITED(status)) outcome.exit_code = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) outcome.signal = WTERMSIG(status);
  if (fs::is_regular_file(running.out)) outcome.out = read_file(running.out);
  outcome.err = without_progress(read_file(running.err));
  return outcome;
}

Outcome run(const Words& words, const std::string& out) {
  Outcome outcome = finish(start(words, out));
  std::string line;
  for (const std::string& word : words) line += word + " ";
  INFO(line, outcome.err);
  CHECK(outcome.signal == 0);
  return outcome;
}

}  // namespace vkh::test
