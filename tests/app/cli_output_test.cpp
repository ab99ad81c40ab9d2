// The targets of the program's outputs: never an input, whole or not at all, and never at the price
// of the answer. Runs the real program, $VKH_PROGRAM.
#include <doctest/doctest.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <iterator>
#include <nlohmann/json.hpp>
#include <thread>

#include "host/base/output_file.h"
#include "tests/support/program.h"
#include "vkhausdorff/error.h"

namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using namespace vkh::test;

std::string triangle(const std::string& name, const char* z) {
  return write_file(name,
                    std::string("v 0 0 ") + z + "\nv 1 0 " + z + "\nv 0 1 " + z + "\nf 1 2 3\n");
}
std::string mesh_a() { return triangle("out_a.obj", "0"); }
std::string mesh_b() { return triangle("out_b.obj", "0.25"); }

/// run(), but a hanging program is killed after five minutes.
Outcome run_soon(const Words& words) {
  const Running running = start(words);
  std::thread watchdog;
  std::atomic<bool> is_over = false;
  watchdog = std::thread([&] {
    for (int i = 0; i < 3000 && !is_over; ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    if (!is_over) kill(running.process, SIGKILL);
  });
  const Outcome outcome = finish(running);
  is_over = true;
  watchdog.join();
  CHECK_MESSAGE(outcome.signal == 0, "it did not end within 300 s");
  return outcome;
}

Words with_json(const std::string& file) {
  return {"distance", mesh_a(), mesh_b(), "--json=" + file};
}

void check_line(const Outcome& outcome, int exit_code, const std::string& mentions) {
  CAPTURE(outcome.err);
  CHECK(outcome.exit_code == exit_code);
  CHECK(outcome.err.find(mentions) != std::string::npos);
  CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
}

/// The refusal comes before the run: no answer is lost.
void check_refused(const Words& words, const std::string& mentions) {
  const Outcome outcome = run_soon(words);
  check_line(outcome, 2, mentions);
  CHECK(outcome.out.empty());
}

/// The same, with the requested object.
void check_refused_as_json(const Words& words, const std::string& mentions) {
  const Outcome outcome = run_soon(words);
  check_line(outcome, 2, mentions);
  REQUIRE(json::accept(outcome.out));
  CHECK(json::parse(outcome.out)["error"]["code"] == 2);
}

/// The table is there, and stderr names the missing output.
void check_not_written(const Outcome& outcome, const std::string& mentions) {
  check_line(outcome, 6, mentions);
  CHECK(outcome.out.find("interval") != std::string::npos);
}

void check_written(const std::string& file) {
  const Outcome outcome = run_soon(with_json(file));
  CHECK(outcome.exit_code == 0);
  CHECK(outcome.err == "");
  CHECK(outcome.out.find("interval") != std::string::npos);
  REQUIRE(json::accept(read_file(file)));
  CHECK(json::parse(read_file(file))["status"] == "closed");
}

size_t entries_of(const std::string& path) {
  return static_cast<size_t>(std::distance(fs::directory_iterator(path), fs::directory_iterator()));
}

TEST_CASE("a file name never follows --json after a space") {
  const std::string a = mesh_a(), b = mesh_b(), c = triangle("out_c.obj", "1");
  const std::string before = read_file(a), third = read_file(c);
  check_refused_as_json({"distance", "--json", a, b, c}, "--json=FILE");
  check_refused_as_json({"distance", a, b, "--json", c}, "--json=FILE");
  check_refused_as_json({"demo", "--json", c}, "--json=FILE");
  check_refused({"distance", a, b, "--json="}, "--json=answer.txt");
  CHECK(read_file(a) == before);
  CHECK(read_file(c) == third);
  // B may stand behind it: the object is on stdout.
  const Outcome outcome = run_soon({"distance", a, "--json", b});
  CHECK(outcome.exit_code == 0);
  CHECK(json::accept(outcome.out));
  CHECK(read_file(b) == read_file(mesh_b()));
}

TEST_CASE("an output is no input, under no name") {
  const std::string a = mesh_a(), b = mesh_b(), before = read_file(a);
  const std::string soft = folder() / "soft.json", hard = folder() / "hard.json",
                    twice = folder() / "twice.json";
  fs::create_symlink("out_a.obj", soft);
  fs::create_symlink("soft.json", twice);
  fs::create_hard_link(a, hard);
  for (const std::string& name : {a, soft, hard, twice, folder() / "./out_a.obj"})
    check_refused({"distance", b, a, "--json=" + name}, "would overwrite the input");
  check_refused({"distance", soft, b, "--json=" + a}, "would overwrite the input");
  CHECK(read_file(a) == before);
}

TEST_CASE("a file is replaced at once, by its links' target, with its permissions") {
  const std::string file = write_file("older.json", "older"), inside = folder() / "inside";
  fs::permissions(file, fs::perms::owner_read | fs::perms::owner_write | fs::perms::group_read);
  const int older = open(file.c_str(), O_RDONLY);
  check_written(file);
  char text[8] = {};
  CHECK(read(older, text, sizeof text) == 5);  // neither truncated nor written over
  CHECK(std::string(text) == "older");
  close(older);
  CHECK(fs::status(file).permissions() ==
        (fs::perms::owner_read | fs::perms::owner_write | fs::perms::group_read));
  fs::create_directory(inside);
  fs::create_symlink("inside/target.json", folder() / "to_be.json");
  check_refused(with_json(folder() / "to_be.json"), "a link that leads nowhere");
  write_file("inside/target.json", "older");
  check_written(folder() / "to_be.json");
  CHECK(fs::is_symlink(folder() / "to_be.json"));
  CHECK(fs::is_regular_file(fs::symlink_status(inside + "/target.json")));
  CHECK(entries_of(inside) == 1);  // nothing is left beside
}

TEST_CASE("a run that is refused says so in the file, too: no older answer stands for it") {
  const std::string kept = write_file("kept.json", "kept");
  for (const std::string& file : {kept, std::string(folder() / "new.json")}) {
    const Outcome outcome =
        run_soon({"distance", mesh_a(), folder() / "missing.obj", "--json=" + file});
    check_line(outcome, 4, "missing.obj");
    CHECK(json::parse(read_file(file))["error"]["code"] == 4);
  }
  // The same for a command line that makes no sense.
  check_line(run_soon({"distance", mesh_a(), mesh_b(), "--tol", "x", "--json=" + kept}), 2,
             "--tol");
  CHECK(json::parse(read_file(kept))["error"]["code"] == 2);
}

TEST_CASE("what cannot be written is refused before the run, where that can be told") {
  const std::string loop = folder() / "loop.json";
  fs::create_symlink("loop.json", loop);
  check_refused(with_json(folder() / "no/such/folder.json"), "cannot be written");
  check_refused(with_json(folder() / "no/"), "");
  check_refused(with_json(folder() / ""), "is a folder");
  check_refused(with_json(mesh_a() + "/file.json"), "cannot be written");
  check_refused(with_json(loop), "a link that leads nowhere");
  const std::string pipe = folder() / "pipe";
  REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
  check_refused(with_json(pipe), "without a reader");
  // No driver has this number: nothing could be overwritten. Only root may make it.
  const std::string disk = folder() / "disk";
  if (mknod(disk.c_str(), S_IFBLK | 0600, makedev(240, 0)) == 0)
    check_refused(with_json(disk), "is a disk");
}

TEST_CASE("the answer is printed whatever becomes of the file: exit code 6") {
  check_not_written(run_soon(with_json("/dev/full")), "'/dev/full': cannot be written: No space");
  CHECK(fs::is_character_file("/dev/full"));
  // The folder goes while the program runs.
  const std::string gone = folder() / "gone";
  fs::create_directory(gone);
  const vkh::OutputFile file("--json", gone + "/x.json", {});
  fs::remove_all(gone);
  CHECK_THROWS_WITH_AS(file.write("answer"),
                       doctest::Contains("x.json': cannot be written: No such"), vkh::OutputError);
}

TEST_CASE("pipes and standard output are written to, not replaced") {
  const std::string pipe = folder() / "read_pipe";
  REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
  std::string read;
  std::thread reader([&] { read = read_file(pipe); });
  Outcome outcome;
  for (int i = 0; i < 50; ++i) {  // until the reader has opened it
    outcome = run_soon(with_json(pipe));
    if (outcome.exit_code != 2) break;
  }
  CHECK(outcome.exit_code == 0);
  reader.join();
  CHECK(json::accept(read));
  CHECK(fs::is_fifo(pipe));

  const Outcome both = run_soon(with_json("/dev/stdout"));
  CHECK(both.exit_code == 0);
  const size_t line = both.out.find('\n');
  CHECK(json::accept(both.out.substr(0, line)));
  CHECK(both.out.find("interval", line) != std::string::npos);
}

TEST_CASE("a pipe whose reader goes away costs neither the answer nor the program") {
  const std::string pipe = folder() / "left_pipe";
  REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
  const int reader = open(pipe.c_str(), O_RDONLY | O_NONBLOCK);
  const vkh::OutputFile file("--json", pipe, {});
  close(reader);
  CHECK_THROWS_WITH_AS(file.write("answer"), doctest::Contains("Broken pipe"), vkh::OutputError);
}

TEST_CASE("standard output that takes nothing: exit code 6") {
  const Outcome outcome = run({"distance", mesh_a(), mesh_b()}, "/dev/full");
  check_line(outcome, 6, "cannot write the answer to standard output");
}

}  // namespace
