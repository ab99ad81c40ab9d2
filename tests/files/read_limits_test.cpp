// Limits on what a file may cost: refused one byte above, in one line that names size, limit and
// remedy, and cancelled on request.
#include <doctest/doctest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include "host/read/readers.h"
#include "tests/support/error_line.h"
#include "tests/support/program.h"
#include "vkhausdorff/error.h"
#include "vkhausdorff/mesh_io.h"

namespace {

using namespace vkh;

// Four vertices, one of them used by no face, and two triangles: 4 * 24 + 2 * 12 bytes.
constexpr uint64_t kMeshBytes = 120;

struct File {
  std::string name, bytes;
};

std::vector<File> files() {
  const std::string rows = "0 0 0\n1 0 0\n0 1 0\n7 7 7\n", faces = "3 0 1 2\n3 2 1 0\n";
  return {{"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 7 7 7\nf 1 2 3\nf 3 2 1\n"},
          {"fan.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 7 7 7\nf 1 2 3 1\n"},
          {"a.off", "OFF\n4 2 0\n" + rows + faces},
          {"fan.off", "OFF\n4 1 0\n" + rows + "4 0 1 2 1\n"},
          {"a.ply",
           "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty "
           "float z\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n" +
               rows + faces}};
}

// A face that goes there and back is fanned.
ReadMesh parse(const File& file, ReadLimits limits) {
  limits.odd_polygons = OddPolygons::kFanned;
  return parse_mesh({.name = file.name, .bytes = file.bytes, .limits = limits});
}

std::string refusal(const File& file, uint64_t limit) {
  try {
    parse(file, {.max_input_bytes = limit});
  } catch (const InputError& error) {
    test::check_error_line(error.what(), file.name);
    return error.what();
  }
  return "";
}

std::string many_vertices(size_t count) {
  std::string text;
  for (; count > 0; --count) text += "v 0 0 0\n";
  return text + "v 1 0 0\nf 1 2 3\n";
}

struct TemporaryFile {
  std::filesystem::path path;

  explicit TemporaryFile(const std::string& bytes) {
    path = std::filesystem::temp_directory_path() /
           ("vkh_read_limits_" + std::to_string(reinterpret_cast<uintptr_t>(this)) + ".obj");
    std::ofstream(path, std::ios::binary) << bytes;
  }
  ~TemporaryFile() { std::filesystem::remove(path); }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
};

}  // namespace

TEST_CASE("a mesh at the limit is read, and one byte less refuses it by size, limit and remedy") {
  for (const File& file : files()) {
    CAPTURE(file.name);
    CHECK(parse(file, {.max_input_bytes = kMeshBytes}).faces.size() == 2);
    const std::string said = refusal(file, kMeshBytes - 1);
    CAPTURE(said);
    CHECK(said.find("a mesh of 4 vertices and 2 faces takes 120 bytes") != std::string::npos);
    CHECK(said.find("beyond the limit of 119 bytes") != std::string::npos);
    CHECK(said.find("--max-input") != std::string::npos);
  }
}

TEST_CASE("STL counts its merged vertices") {
  std::string bytes(84, '\0');
  bytes[80] = 2;
  for (int t = 0; t < 2; ++t) bytes.append(12, '\0').append("\0\0\x80\x3f", 4).append(34, '\0');
  const File file{"a.stl", bytes};  // twice the points (1, 0, 0), 0 and 0
  CHECK(parse(file, {.max_input_bytes = 2 * 24 + 2 * 12 + 24}).vertices.size() == 2);
  CHECK(!refusal(file, 2 * 24 + 2 * 12 - 1).empty());
}

TEST_CASE("what a header announces is refused before anything is allocated") {
  const std::string rows(400, '0');
  const File ply{"a.ply",
                 "ply\nformat binary_little_endian 1.0\nelement vertex 100\nproperty uchar x\n"
                 "property uchar y\nproperty uchar z\nelement face 50\n"
                 "property list uchar uchar vertex_indices\nend_header\n" +
                     rows};
  CHECK(refusal(ply, 2999).find("a mesh of 100 vertices and 50 faces takes 3000 bytes") !=
        std::string::npos);
}

TEST_CASE("a file at the limit is read, and one byte less refuses it before it is read") {
  const TemporaryFile file(files()[0].bytes + std::string(200, '\n'));
  const uint64_t size = std::filesystem::file_size(file.path);
  CHECK(read_mesh(file.path, {.max_input_bytes = size}).faces.size() == 2);
  std::string said;
  try {
    read_mesh(file.path, {.max_input_bytes = size - 1});
  } catch (const InputError& error) {
    said = error.what();
  }
  CHECK(said.find(std::to_string(size) + " bytes, beyond the limit of " + std::to_string(size - 1) +
                  " bytes") != std::string::npos);
  CHECK(said.find("--max-input") != std::string::npos);
}

TEST_CASE("a pipe is read to the limit and no further") {
  const TemporaryFile pipe("");
  std::filesystem::remove(pipe.path);
  REQUIRE(mkfifo(pipe.path.c_str(), 0600) == 0);
  std::thread writer([&] { std::ofstream(pipe.path, std::ios::binary) << many_vertices(3000); });
  CHECK_THROWS_AS(read_mesh(pipe.path, {.max_input_bytes = 1000}), InputError);
  writer.join();
}

TEST_CASE("reading is called off before the file, and in the midst of it") {
  const std::string bytes = many_vertices(50'000);
  const TemporaryFile file(bytes);
  CHECK_THROWS_AS(read_mesh(file.path, {.keep_going = [] { return false; }}), Interrupted);
  int asked = 0;
  const ReadLimits limits{.keep_going = [&] { return ++asked < 2; }};
  CHECK_THROWS_AS(parse({"a.obj", bytes}, limits), Interrupted);
  CHECK(asked == 2);
}

TEST_CASE("the program takes --max-input" * doctest::test_suite("program")) {
  const TemporaryFile file(files()[0].bytes);
  const auto refused =
      test::run({"distance", file.path.string(), file.path.string(), "--max-input", "32"});
  CHECK(refused.exit_code == 4);
  CHECK(
      refused.err.find("beyond the limit of 32 bytes; expected a smaller file, or a greater limit "
                       "(--max-input)") != std::string::npos);
  for (const char* wrong : {"0", "-1", "1.5.5", "many", "1Q", "1e30"}) {
    const auto usage =
        test::run({"distance", file.path.string(), file.path.string(), "--max-input", wrong});
    CAPTURE(wrong);
    CHECK(usage.exit_code == 2);
    CHECK(usage.err.find("--max-input '") != std::string::npos);
  }
  const auto read =
      test::run({"distance", file.path.string(), file.path.string(), "--max-input", "1k"});
  CHECK(read.exit_code == 0);
}
