#include "tests/support/program.h"

#include <doctest/doctest.h>
#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>

namespace vkh::test {
namespace {

namespace fs = std::filesystem;

void redirect(int target, const std::string& path) {
  const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  if (file < 0 || dup2(file, target) < 0) _exit(126);
}

}  // namespace

Running start(const Words& words, const std::string& out) {
  const char* program = std::getenv("VKH_PROGRAM");
  REQUIRE_MESSAGE(program != nullptr, "VKH_PROGRAM must name the program under test");
  std::vector<char*> arguments{const_cast<char*>(program)};
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  Running running{0, out.empty() ? folder() / "stdout" : out, folder() / "stderr"};
  running.process = fork();
  REQUIRE(running.process >= 0);
  if (running.process == 0) {
    redirect(STDOUT_FILENO, running.out);
    redirect(STDERR_FILENO, running.err);
    execv(program, arguments.data());
    _exit(127);
  }
  return running;
}

Outcome finish(const Running& running) {
  int status = 0;
  REQUIRE(waitpid(running.process, &status, 0) == running.process);
  Outcome outcome;
  if (WIFEXITED(status)) outcome.exit_code = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) outcome.signal = WTERMSIG(status);
  if (fs::is_regular_file(running.out)) outcome.out = read_file(running.out);
  outcome.err = read_file(running.err);
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
