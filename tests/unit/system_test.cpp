// Names of files, the cache folder and the environment, as the system at hand has them.
#include "host/base/system.h"

#include <doctest/doctest.h>

#include <cstdlib>
#include <stdexcept>
#include <vector>

#include "host/base/begin_now.h"
#include "host/base/output_file.h"
#include "tests/support/files.h"
#include "vkhausdorff/error.h"
#include "vkhausdorff/mesh_io.h"

namespace fs = std::filesystem;
using namespace vkh;
using namespace vkh::test;

namespace {

/// Null removes the variable.
void set_variable(const char* name, const char* value) {
#ifdef _WIN32
  _putenv_s(name, value == nullptr ? "" : value);
#else
  if (value != nullptr) setenv(name, value, 1);
  if (value == nullptr) unsetenv(name);
#endif
}

const std::string kOdd =
    "Ma\xc3\x9f \xe6\xb8\xac\xf0\x9f\x93\x90";  // a German, a Chinese, a new one

const std::string kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

size_t entries_of(const fs::path& path) {
  return static_cast<size_t>(std::distance(fs::directory_iterator(path), fs::directory_iterator()));
}

}  // namespace

TEST_CASE("a name goes to a path and back") {
  for (const std::string& name : {std::string("a/b.obj"), kOdd + ".ply", std::string()})
    CHECK(name_of(path_of(name)) == name);
}

// A thread's work was lost on Windows where threads were detached that had just ended.
TEST_CASE("work that ends at once is done once, on every thread that is left") {
  std::vector<std::future<int>> results(500);
  for (int i = 0; i < 500; ++i) results[static_cast<size_t>(i)] = begin_now([i] { return i; });
  for (int i = 0; i < 500; ++i) CHECK(results[static_cast<size_t>(i)].get() == i);
}

TEST_CASE("a mesh of any name is read, and named by it") {
  const std::string file = write_file(kOdd + ".obj", kTriangle);
  const Mesh mesh = read_mesh(path_of(file));
  CHECK(mesh.name == file);
  CHECK(mesh.faces.size() == 1);
  CHECK_THROWS_AS(read_mesh(path_of(folder() / ("no" + kOdd))), InputError);
}

TEST_CASE("an output of any name is written, replaced, and never an input") {
  const fs::path inside = path_of(folder() / ("in" + kOdd));
  fs::create_directories(inside);
  const std::string file = name_of(inside / path_of(kOdd + ".json"));
  for (const std::string text : {"first\n", "the second, longer\n", ""}) {
    OutputFile("--json", file, {}).write(text);
    CHECK(read_file(file) == text);
    CHECK(entries_of(inside) == 1);
  }
  CHECK_THROWS_AS(OutputFile("--json", file, {file}), UsageError);
  CHECK_THROWS_AS(OutputFile("--json", name_of(inside / "." / path_of(kOdd + ".json")), {file}),
                  UsageError);
  CHECK_THROWS_AS(OutputFile("--json", name_of(inside), {}), UsageError);
  CHECK_THROWS_AS(OutputFile("--json", name_of(inside / "none" / "x.json"), {}), UsageError);
  CHECK(entries_of(inside) == 1);
}

TEST_CASE("a file that may not be written is refused before the run") {
  const std::string file = write_file("locked.json", "older");
  fs::permissions(path_of(file), fs::perms::owner_read, fs::perm_options::replace);
  bool refused = false;
  try {
    OutputFile("--json", file, {});
  } catch (const UsageError&) {
    refused = true;
  }
  const bool may_anyway = std::ofstream(path_of(file), std::ios::app).is_open();  // as root
  CHECK(refused != may_anyway);
  CHECK(read_file(file) == "older");
  fs::permissions(path_of(file), fs::perms::owner_all, fs::perm_options::replace);
}

TEST_CASE("a path of 400 characters") {
  fs::path deep = path_of(folder() / "long");
  while (deep.native().size() < 350) deep /= "a_folder_whose_name_has_forty_characters";
  std::error_code error;
  fs::create_directories(deep, error);
  if (error) {
    MESSAGE("the system does not make such folders: ", error.message());
    return;
  }
  const std::string mesh = name_of(deep / "a_mesh_with_a_long_name.obj");
  std::ofstream(path_of(mesh), std::ios::binary) << kTriangle;
  CHECK(read_mesh(path_of(mesh)).faces.size() == 1);
  const std::string file = name_of(deep / "an_answer_with_a_long_name.json");
  OutputFile("--json", file, {mesh}).write("text");
  CHECK(read_file(file) == "text");
}

TEST_CASE("pipelines are kept where the system has such files, or nowhere") {
#ifdef _WIN32
  set_variable("LOCALAPPDATA", "C:\\somewhere");
  CHECK(user_cache_folder() == "C:\\somewhere\\vkhausdorff");
  set_variable("LOCALAPPDATA", "not\\absolute");
  CHECK(user_cache_folder().empty());
  set_variable("LOCALAPPDATA", nullptr);
#else
  set_variable("XDG_CACHE_HOME", "/somewhere");
  CHECK(user_cache_folder() == "/somewhere/vkhausdorff");
  set_variable("XDG_CACHE_HOME", "not/absolute");
  set_variable("HOME", "/home/somebody");
  CHECK(user_cache_folder() == "/home/somebody/.cache/vkhausdorff");
  set_variable("XDG_CACHE_HOME", nullptr);
  set_variable("HOME", nullptr);
#endif
  CHECK(user_cache_folder().empty());
}

TEST_CASE("the command line is what follows the program's name") {
#ifndef _WIN32
  const char* words[] = {"vkhausdorff", "distance", kOdd.c_str()};
  CHECK(command_line(3, words) == std::vector<std::string>{"distance", kOdd});
  CHECK(command_line(1, words).empty());
  CHECK(command_line(0, words).empty());
#endif
}
