// Blocks of any size on any number of threads give what one block on one thread gives: the same
// mesh to the bit, or the same error line. Over every file that the tests have, good and bad, and
// over mutants of them.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "host/read/readers.h"
#include "tests/shapes/mesh_files.h"
#include "vkhausdorff/error.h"
#include "vkhausdorff/mesh_io.h"

namespace {

using namespace vkh;
using test::File;

std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// All facts about a mesh, or the error.
std::string outcome_of(const MeshSource& source) {
  try {
    const ReadMesh mesh = parse_mesh(source);
    const auto bytes = [](const auto& values) {
      return std::string(reinterpret_cast<const char*>(values.data()),
                         values.size() * sizeof(values[0]));
    };
    const MeshCounts& c = mesh.counts;
    const std::array counts = {c.vertices,   c.faces,     c.unreferenced,
                               c.degenerate, c.duplicate, c.polygons};
    std::string all = "mesh " + bytes(mesh.vertices) + bytes(mesh.faces) + bytes(counts) +
                      bytes(mesh.file_faces.runs());
    for (const std::string& note : lines_of(mesh.notes)) all += "\n" + note;
    return all;
  } catch (const InputError& error) {
    return error.what();
  }
}

std::string outcome_of(const File& file, const ReadLimits& limits, bool* by_blocks = nullptr) {
  return outcome_of(
      {.name = file.name, .bytes = file.bytes, .limits = limits, .by_blocks = by_blocks});
}

ReadLimits whole(uint64_t most = UINT64_MAX, bool points = false) {
  return {.max_input_bytes = most,
          .odd_polygons = OddPolygons::kFanned,
          .points = points,
          .threads = 1,
          .block_bytes = SIZE_MAX};
}

std::vector<File> corpus() {
  const char* malformed = std::getenv("VKH_MALFORMED");
  REQUIRE(malformed);
  std::vector<std::filesystem::path> folders = {malformed};
  const std::filesystem::path found =
      std::string(VKH_SOURCE_DIR) + "/tests/verification/fuzz/found";
  for (const auto& entry : std::filesystem::directory_iterator(found))
    if (entry.is_directory()) folders.push_back(entry.path());
  std::vector<File> files;
  for (const auto& folder : folders) {
    for (const auto& entry : std::filesystem::directory_iterator(folder))
      files.push_back({entry.path().filename().string(), bytes_of(entry.path())});
  }
  return files;
}

/// One change: difficult text, anywhere, or removed bytes.
std::string mutant(std::string bytes, std::mt19937& random) {
  static const std::vector<std::string> kPieces = {"\n",
                                                   "\r",
                                                   "\\\n",
                                                   " ",
                                                   "0",
                                                   "-1",
                                                   "f 1 2 3\n",
                                                   "v 1 2 nan\n",
                                                   "\xff",
                                                   "3",
                                                   "endsolid\n",
                                                   "facet\n",
                                                   std::string(1, '\0'),
                                                   "#",
                                                   "f -1 -2 -3\n",
                                                   "solid a\n",
                                                   "l 1 2\n",
                                                   "comment x\n",
                                                   "// x\n",
                                                   "1e999"};
  const size_t at = random() % (bytes.size() + 1);
  switch (random() % 3) {
    case 0:
      return bytes.insert(at, kPieces[random() % kPieces.size()]);
    case 1:
      return bytes.erase(at, random() % 8);
    default:
      if (at < bytes.size()) bytes[at] = static_cast<char>(random());
      return bytes;
  }
}

struct Case {
  size_t block_bytes, threads;
};
constexpr std::array<Case, 5> kCases = {{{1, 1}, {7, 4}, {16, 1}, {50, 3}, {211, 2}}};

void check(const File& file, const Case& how, uint64_t most = UINT64_MAX, bool points = false) {
  CAPTURE(file.name);
  CAPTURE(how.block_bytes);
  CAPTURE(how.threads);
  const ReadLimits limits{.max_input_bytes = most,
                          .odd_polygons = OddPolygons::kFanned,
                          .points = points,
                          .threads = how.threads,
                          .block_bytes = how.block_bytes};
  CHECK(outcome_of(file, limits) == outcome_of(file, whole(most, points)));
}

using Rows = std::vector<std::vector<uint32_t>>;

/// Corners of a file's faces: runs of triangles, quads and others, and some of fewer than three.
Rows mixed_faces(uint32_t vertex_count) {
  std::mt19937 random(31);
  Rows faces;
  for (int run = 0; run < 60; ++run) {
    const size_t corners = 1 + random() % 6;
    for (size_t i = random() % 9; i > 0; --i) {
      faces.emplace_back();
      for (size_t k = 0; k < corners; ++k)
        faces.back().push_back(static_cast<uint32_t>(random()) % vertex_count);
    }
  }
  return faces;
}

std::string text_rows(const Rows& faces) {
  std::string rows;
  for (const auto& face : faces) {
    rows += std::to_string(face.size());
    for (const uint32_t corner : face) rows += " " + std::to_string(corner);
    rows += "\n";
  }
  return rows;
}

std::string obj_rows(const Rows& faces) {
  std::string rows;
  for (const auto& face : faces) {
    rows += "f";
    for (const uint32_t corner : face) rows += " " + std::to_string(corner + 1);
    rows += "\n";
  }
  return rows;
}

template <class T>
void add_bytes(std::string& out, T value, bool is_big) {
  std::array<char, sizeof(T)> bytes;
  std::memcpy(bytes.data(), &value, sizeof(T));
  if (is_big) std::reverse(bytes.begin(), bytes.end());
  out.append(bytes.data(), bytes.size());
}

File binary_ply(const std::vector<std::array<float, 3>>& vertices, const Rows& faces,
                const std::string& head, bool is_big) {
  File file{is_big ? "big.ply" : "little.ply", head};
  for (const auto& vertex : vertices)
    for (const float x : vertex) add_bytes(file.bytes, x, is_big);
  for (const auto& face : faces) {
    file.bytes += static_cast<char>(face.size());
    for (const uint32_t corner : face) add_bytes(file.bytes, corner, is_big);
  }
  return file;
}

/// The same faces in every format that has others than triangles.
std::vector<File> files_of(const Rows& faces, uint32_t vertex_count) {
  std::vector<std::array<float, 3>> vertices;
  std::string points, obj;
  for (uint32_t v = 0; v < vertex_count; ++v) {
    vertices.push_back({static_cast<float>(v), static_cast<float>(v * v % 17), 1});
    const std::string point = std::to_string(v) + " " + std::to_string(v * v % 17) + " 1\n";
    points += point;
    obj += "v " + point;
  }
  const std::string count = std::to_string(vertex_count);
  const std::string face_count = std::to_string(faces.size());
  const auto head = [&](const std::string& encoding) {
    return "ply\nformat " + encoding + " 1.0\nelement vertex " + count +
           "\nproperty float x\nproperty float y\nproperty float z\nelement face " + face_count +
           "\nproperty list uchar uint vertex_indices\nend_header\n";
  };
  const std::string rows = points + text_rows(faces);
  return {{"a.obj", obj + obj_rows(faces)},
          {"a.off", "OFF\n" + count + " " + face_count + " 0\n" + rows},
          {"ascii.ply", head("ascii") + rows},
          binary_ply(vertices, faces, head("binary_little_endian"), false),
          binary_ply(vertices, faces, head("binary_big_endian"), true)};
}

struct TemporaryFile {
  std::filesystem::path path;

  explicit TemporaryFile(const File& file) {
    path = std::filesystem::temp_directory_path() /
           (std::to_string(reinterpret_cast<uintptr_t>(this)) + "_" + file.name);
    std::ofstream(path, std::ios::binary) << file.bytes;
  }
  ~TemporaryFile() { std::filesystem::remove(path); }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
};

}  // namespace

TEST_CASE("good files of every format are read by blocks, and as in one") {
  for (const File& file : test::all_good_files()) {
    const std::string expected = outcome_of(file, whole());
    CAPTURE(file.name);
    CHECK(expected.starts_with("mesh "));
    for (const Case& how : kCases) {
      CAPTURE(how.block_bytes);
      CAPTURE(how.threads);
      bool by_blocks = false;
      const ReadLimits limits{.odd_polygons = OddPolygons::kFanned,
                              .threads = how.threads,
                              .block_bytes = how.block_bytes};
      CHECK(outcome_of(file, limits, &by_blocks) == expected);
      CHECK(by_blocks);
    }
  }
}

TEST_CASE("points of every format are read by blocks, and as in one") {
  size_t read = 0;
  for (const File& file : corpus()) {
    if (file.bytes.size() > 10'000) continue;
    for (const Case& how : kCases) check(file, how, UINT64_MAX, true);
    read += outcome_of(file, whole(UINT64_MAX, true)).starts_with("mesh ") ? 1 : 0;
  }
  CHECK(read > 50);
}

TEST_CASE("each triangle has the number that its face has in the file") {
  const Rows faces = mixed_faces(20);
  std::vector<uint32_t> numbers;
  for (uint32_t face = 0; face < faces.size(); ++face)
    for (size_t k = 2; k < faces[face].size(); ++k) numbers.push_back(face);
  for (const File& file : files_of(faces, 20)) {
    CAPTURE(file.name);
    for (const Case& how : kCases) {
      const ReadLimits limits{.odd_polygons = OddPolygons::kFanned,
                              .threads = how.threads,
                              .block_bytes = how.block_bytes};
      bool by_blocks = false;
      const ReadMesh mesh = parse_mesh(
          {.name = file.name, .bytes = file.bytes, .limits = limits, .by_blocks = &by_blocks});
      CHECK(by_blocks);
      CHECK(mesh.file_faces.of_all(mesh.faces.size()) == numbers);
      CHECK(mesh.file_faces.count(mesh.faces.size()) == faces.size());
    }
  }
}

TEST_CASE("triangles alone take no map") {
  const Rows faces(40, {0, 1, 2});
  for (const File& file : files_of(faces, 3)) {
    CAPTURE(file.name);
    for (const size_t block : {size_t{50}, SIZE_MAX}) {
      const ReadLimits limits{
          .odd_polygons = OddPolygons::kFanned, .threads = 2, .block_bytes = block};
      const ReadMesh mesh = parse_mesh({.name = file.name, .bytes = file.bytes, .limits = limits});
      CHECK(mesh.file_faces.are_triangles());
    }
  }
}

TEST_CASE("files are read by blocks as memory is") {
  for (const File& file : test::all_good_files()) {
    const TemporaryFile on_disk(file);
    const InputFile input(on_disk.path);
    REQUIRE(input.is_open());
    MeshSource source{
        .name = file.name,
        .bytes = {},
        .limits = {.odd_polygons = OddPolygons::kFanned, .threads = 3, .block_bytes = 300},
        .file = &input};
    CAPTURE(file.name);
    CHECK(outcome_of(source) == outcome_of(file, whole()));
    source.limits = whole();
    CHECK(outcome_of(source) == outcome_of(file, whole()));
  }
}

TEST_CASE("vertices have the same numbers whichever thread meets them first") {
  const File file = test::mirrored_stl(100'000);
  const std::string expected = outcome_of(file, whole());
  for (int again = 0; again < 5; ++again)
    CHECK(outcome_of(file, {.threads = 4, .block_bytes = 10'000}) == expected);
}

TEST_CASE("a zero byte that stands far behind makes an STL binary") {
  File file = test::good_files(10).back();
  REQUIRE(file.bytes.size() > 8192);
  file.bytes.insert(file.bytes.size() - 1, std::string(" \0", 2));
  CHECK(!outcome_of(file, whole()).starts_with("mesh "));
  check(file, {1000, 2});
}

TEST_CASE("a byte-order mark is skipped in files, too") {
  File file = test::good_files(10)[0];
  const std::string expected = outcome_of(file, whole());
  file.bytes = "\xef\xbb\xbf" + file.bytes;
  const TemporaryFile on_disk(file);
  const InputFile input(on_disk.path);
  const MeshSource source{
      .name = file.name, .bytes = {}, .limits = {.block_bytes = 64}, .file = &input};
  CHECK(outcome_of(source) == expected);
}

TEST_CASE("a file that is cut short while it is open is refused in one line") {
  for (const File& file : test::all_good_files()) {
    const TemporaryFile on_disk(file);
    const InputFile input(on_disk.path);
    std::filesystem::resize_file(on_disk.path, file.bytes.size() / 2);
    CAPTURE(file.name);
    for (const size_t block : {size_t{128}, SIZE_MAX}) {
      const MeshSource source{
          .name = file.name, .bytes = {}, .limits = {.block_bytes = block}, .file = &input};
      CHECK(outcome_of(source).find("the file ends or cannot be read, and had " +
                                    std::to_string(file.bytes.size()) + " bytes") !=
            std::string::npos);
    }
  }
}

TEST_CASE("every known file gives the same mesh or the same error by blocks") {
  const std::vector<File> files = corpus();
  CHECK(files.size() > 600);
  size_t good = 0, by_blocks = 0, i = 0;
  for (const File& file : files) {
    const Case& how = kCases[i++ % kCases.size()];
    check(file, how);
    bool blocks = false;
    if (outcome_of(file, {.threads = 1, .block_bytes = 16}, &blocks).starts_with("mesh "))
      by_blocks += blocks && ++good > 0 ? 1 : 0;
  }
  CHECK(by_blocks > 100);
}

TEST_CASE("mutants give the same mesh or the same error by blocks") {
#ifdef VKH_SANITIZED
  constexpr int kMutants = 2;
#else
  constexpr int kMutants = 30;
#endif
  std::mt19937 random(18);
  std::vector<File> files = corpus();
  for (const File& file : test::good_files(6)) files.insert(files.end(), 8, file);
  for (const File& file : files) {
    if (file.bytes.size() > 20'000) continue;
    for (int i = 0; i < kMutants; ++i) {
      const File changed{file.name, mutant(mutant(file.bytes, random), random)};
      check(changed, kCases[random() % kCases.size()]);
    }
  }
}

TEST_CASE("limits are to the byte, whatever the blocks") {
  for (const File& file : test::all_good_files()) {
    const ReadMesh mesh = parse_mesh({.name = file.name, .bytes = file.bytes, .limits = whole()});
    const uint64_t bytes =
        mesh_bytes(mesh.counts.vertices + mesh.counts.unreferenced, mesh.counts.faces);
    for (const int64_t more : {-100, -13, -12, -1, 0, 1, 11, 12, 13}) {
      CAPTURE(more);
      check(file, {300, 2}, bytes + static_cast<uint64_t>(more));
    }
  }
}

TEST_CASE("one thread at a time is asked whether to go on, and none after it said no") {
  for (const File& file : test::all_good_files()) {
    CAPTURE(file.name);
    std::atomic<int> inside = 0, asked = 0, together = 0;
    const ReadLimits limits{.keep_going =
                                [&] {
                                  if (++inside > 1) ++together;
                                  const bool go = ++asked < 5;
                                  --inside;
                                  return go;
                                },
                            .threads = 4,
                            .block_bytes = 500};
    CHECK_THROWS_AS(parse_mesh({.name = file.name, .bytes = file.bytes, .limits = limits}),
                    Interrupted);
    CHECK(asked == 5);
    CHECK(together == 0);
  }
}
