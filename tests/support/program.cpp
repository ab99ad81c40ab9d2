#include "tests/support/program.h"

#include <doctest/doctest.h>
#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <iterator>

namespace vkh::test {
namespace {

namespace fs = std::filesystem;

void redirect(int target, const std::string& path) {
  const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  if (file < 0 || dup2(file, target) < 0) _exit(126);
}

}  // namespace

TempFolder::TempFolder()
    : path_(fs::temp_directory_path() / ("vkh_cli_" + std::to_string(getpid()))) {
  fs::create_directories(path_);
}

TempFolder::~TempFolder() {
  std::error_code none;
  fs::remove_all(path_, none);
}

const TempFolder& folder() {
  static const TempFolder instance;
  return instance;
}

std::string read_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::string write_file(const std::string& name, const std::string& text) {
  std::ofstream(folder() / name, std::ios::binary) << text;
  return folder() / name;
}

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
