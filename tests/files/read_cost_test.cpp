// The cost of reading a file: memory within a fixed multiple of the larger of file and mesh, time
// in proportion, for any file. Every allocation of this program is counted.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <new>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "host/base/hash_index.h"
#include "host/read/readers.h"
#include "tests/files/worst_scenes.h"
#include "vkhausdorff/error.h"

namespace {

std::atomic<size_t> g_in_use = 0, g_peak = 0;

// The size stands before the block, as far away as the block has to be aligned.
constexpr size_t kBefore = alignof(std::max_align_t);

void* counted_new(size_t size) {
  auto* at = static_cast<char*>(std::malloc(size + kBefore));
  if (at == nullptr) throw std::bad_alloc();
  *reinterpret_cast<size_t*>(at) = size;
  const size_t now = g_in_use += size;
  size_t peak = g_peak;
  while (now > peak && !g_peak.compare_exchange_weak(peak, now)) {
  }
  return at + kBefore;
}

void counted_delete(void* block) {
  if (block == nullptr) return;
  char* at = static_cast<char*>(block) - kBefore;
  g_in_use -= *reinterpret_cast<size_t*>(at);
  std::free(at);
}

}  // namespace

void* operator new(size_t size) { return counted_new(size); }
void* operator new[](size_t size) { return counted_new(size); }
void* operator new(size_t size, const std::nothrow_t&) noexcept { return counted_new(size); }
void* operator new[](size_t size, const std::nothrow_t&) noexcept { return counted_new(size); }
void operator delete(void* block) noexcept { counted_delete(block); }
void operator delete[](void* block) noexcept { counted_delete(block); }
void operator delete(void* block, size_t) noexcept { counted_delete(block); }
void operator delete[](void* block, size_t) noexcept { counted_delete(block); }

namespace {

using namespace vkh;

struct File {
  std::string name, bytes;
};

std::string repeated(const std::string& text, size_t count) {
  std::string all;
  all.reserve(text.size() * count);
  for (; count > 0; --count) all += text;
  return all;
}

template <class T>
std::string bytes_of(const T& value) {
  return {reinterpret_cast<const char*>(&value), sizeof(value)};
}

std::string ply_header(const std::string& format, const std::string& vertex, size_t vertices,
                       const std::string& corners, size_t faces) {
  std::string text =
      "ply\nformat " + format + " 1.0\nelement vertex " + std::to_string(vertices) + "\n";
  for (const char* axis : {" x\n", " y\n", " z\n"}) text += "property " + vertex + axis;
  return text + "element face " + std::to_string(faces) + "\nproperty list " + corners +
         " vertex_indices\nend_header\n";
}

const std::string kLittle = "binary_little_endian";

std::string with_header_lines(const std::string& lines, size_t size) {
  const std::string good = ply_header("ascii", "int", 3, "int int", 1), end = "end_header\n";
  return good.substr(0, good.size() - end.size()) + "element a 0\n" +
         repeated(lines, size / lines.size()) + end + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
}

// About `size` bytes each, all of one kind, so that nothing else hides its cost.
std::vector<File> ply_files(size_t size) {
  const auto count = static_cast<uint32_t>(size);
  std::string mixed;
  for (size_t i = 0; i < size; ++i) mixed += static_cast<char>(i % 3);
  const std::string three(9, '\1');
  return {{"polygon.ply",
           ply_header(kLittle, "uchar", 3, "uint uchar", 1) + three + bytes_of(count) + mixed},
          {"triangles.ply", ply_header(kLittle, "uchar", 3, "uchar uchar", size / 4) + three +
                                repeated(std::string("\3\0\1\2", 4), size / 4)},
          {"points.ply", ply_header(kLittle, "uchar", size / 3, "uchar uchar", 1) +
                             repeated("\1\2\3", size / 3) + std::string("\3\0\1\2", 4)},
          {"short_faces.ply", ply_header(kLittle, "uchar", 3, "uchar uchar", size / 2) + three +
                                  repeated(std::string("\1\0", 2), size / 2 - 2) +
                                  std::string("\3\0\1\2", 4)},
          {"alternating.ply", ply_header(kLittle, "uchar", 3, "uchar uchar", size / 6 * 2) + three +
                                  repeated(std::string("\1\0\3\0\1\2", 6), size / 6)},
          {"text_polygon.ply", ply_header("ascii", "float", 3, "uint int", 1) +
                                   "0 0 0\n1 0 0\n0 1 0\n" + std::to_string(3 * (size / 6)) +
                                   repeated(" 0 1 2", size / 6) + "\n"},
          {"text_points.ply", ply_header("ascii", "float", size / 6, "uint int", 1) +
                                  repeated("0 1 2\n", size / 6) + "3 0 1 2\n"},
          {"elements.ply", with_header_lines("element a 0\n", size)},
          {"properties.ply", with_header_lines("property int x\n", size)},
          {"both.ply", with_header_lines("element a 0\nproperty int x\n", size)},
          {"comments.ply", "ply\n" + repeated("comment\n", size / 8)},
          {"long_word.ply", "ply\nformat " + std::string(size, 'a') + "\n"}};
}

std::vector<File> off_files(size_t size) {
  const std::string three = "0 0 0\n1 0 0\n0 1 0\n";
  const auto counts = [](size_t vertices, size_t faces) {
    return "OFF\n" + std::to_string(vertices) + " " + std::to_string(faces) + " 0\n";
  };
  return {
      {"polygon.off",
       counts(3, 1) + three + std::to_string(3 * (size / 6)) + repeated(" 0 1 2", size / 6) + "\n"},
      {"triangles.off", counts(3, size / 8) + three + repeated("3 0 1 2\n", size / 8)},
      {"points.off", counts(size / 6, 1) + repeated("0 1 2\n", size / 6) + "3 0 1 2\n"},
      {"none.off", counts(3, size / 2) + three + repeated("0\n", size / 2)},
      {"digits.off", counts(3, 1) + "0." + std::string(size, '7') + " 0 0\n1 0 0\n0 1 0\n3 0 1 2"},
      {"blank.off", "OFF\n" + std::string(size, '\n')}};
}

std::vector<File> obj_files(size_t size) {
  const std::string three = "v 0 0 0\nv 1 0 0\nv 0 1 0\n", face = "f 1 2 3\n";
  return {{"polygon.obj", three + "f" + repeated(" 1 2 3", size / 6) + "\n"},
          {"continued.obj", three + "f" + repeated(" 1 2 3\\\n", size / 8) + " 1\n"},
          {"triangles.obj", three + repeated(face, size / face.size())},
          {"points.obj", repeated("v 0 1 2\n", size / 8) + face},
          {"alternating.obj", three + repeated("f\n" + face, size / 10)},
          {"none.obj", three + repeated("f\n", size / 2) + face},
          {"groups.obj", three + "g" + repeated(" a\\\n", size / 4) + " b\n" + face},
          {"parameters.obj", three + "parm" + repeated(" 1 \\\n2", size / 5) + "\n" + face},
          {"long_word.obj", "o " + std::string(size, 'a') + "\n" + three + face},
          {"unknown.obj", std::string(size, 'a')},
          {"comment.obj", three + face + "#" + repeated("#\\", size / 2)},
          {"digits.obj", "v 1e" + std::string(size, '0') + " 0 0\n" + three + face}};
}

std::string stl(size_t triangles, const std::function<float(size_t)>& coordinate) {
  std::string bytes = std::string(80, '\0') + bytes_of(static_cast<uint32_t>(triangles));
  for (size_t t = 0; t < triangles; ++t) {
    bytes.append(12, '\0');
    for (size_t i = 0; i < 9; ++i) bytes += bytes_of(coordinate(9 * t + i));
    bytes.append(2, '\0');
  }
  return bytes;
}

std::vector<File> stl_files(size_t size) {
  std::mt19937 random(1);
  const std::string facet =
      "facet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\n"
      "endfacet\n";
  const size_t count = size / 50;
  return {
      {"apart.stl", stl(count, [&](size_t) { return static_cast<float>(random()); })},
      {"one_point.stl", stl(count, [](size_t) { return 1.0f; })},
      {"litter.stl",
       stl(2, [](size_t i) { return static_cast<float>(i); }) + std::string(size, '\x7f')},
      {"facets.stl", "solid\n" + repeated(facet, size / facet.size()) + "endsolid\n"},
      {"solids.stl", "solid\n" + facet + "endsolid\n" + repeated("solid\nendsolid\n", size / 15)},
      {"name.stl", "solid" + repeated(" a", size / 2) + "\n" + facet + "endsolid\n"}};
}

std::vector<File> scene_files(size_t size) {
  std::vector<File> files;
  for (const test::SceneFiles& scenes : {test::worst_gltf(size), test::worst_3mf(size)}) {
    for (const auto& [name, bytes] : scenes) files.push_back({name, bytes});
  }
  return files;
}

std::vector<File> worst_files(size_t size) {
  std::vector<File> all;
  for (auto* part : {ply_files, off_files, obj_files, stl_files, scene_files}) {
    std::vector<File> some = part(size);
    std::move(some.begin(), some.end(), std::back_inserter(all));
  }
  return all;
}

struct Cost {
  size_t file = 0, mesh = 0, peak = 0;
  double seconds = 0;
};

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

// A mesh of a refused file counts as the largest that a file of its size can have: 12 bytes for
// each of a polygon's corners of one byte.
Cost cost_of(const File& file, bool points = false) {
  Cost cost{.file = file.bytes.size(), .mesh = 12 * file.bytes.size()};
  const size_t before = g_in_use;
  g_peak = before;
  const double start = cpu_seconds();
  try {
    const Mesh mesh =
        parse_mesh({.name = file.name, .bytes = file.bytes, .limits = {.points = points}});
    cost.mesh = mesh_bytes(mesh.counts.vertices + mesh.counts.unreferenced, mesh.counts.faces) +
                mesh.file_faces.runs().size() * sizeof(FileFaces::Run);
  } catch (const InputError&) {
  }
  cost.seconds = cpu_seconds() - start;
  cost.peak = g_peak - before + file.bytes.size();  // which read_mesh holds, too
  return cost;
}

Cost least_cost_of(const File& file) {
  Cost least = cost_of(file);
  for (int again = 0; again < 2; ++again)
    least.seconds = std::min(least.seconds, cost_of(file).seconds);
  return least;
}

// Bytes that do not grow with the file: a stream and its locale, an error's text, a container's
// first allocation.
constexpr size_t kConstant = 64 << 10;

void check_memory(const Cost& cost) {
  CAPTURE(cost.file);
  CAPTURE(cost.mesh);
  CHECK(cost.peak <= 6 * std::max(cost.file, cost.mesh) + kConstant);
}

// The hash that this library had in version 0.1.0: without a secret, and each step of it can be
// undone.
constexpr uint64_t kFactor = 0x9e3779b97f4a7c15u;

uint64_t fixed_mix(uint64_t hash, uint64_t word) {
  hash = (hash ^ word) * kFactor;
  return hash ^ (hash >> 29);
}

uint64_t fixed_hash(const glm::dvec3& p) {
  return fixed_mix(fixed_mix(fixed_mix(0, position_bits(p.x)), position_bits(p.y)),
                   position_bits(p.z));
}

// The word after `hash` that makes it `wanted`.
uint64_t unmix(uint64_t hash, uint64_t wanted) {
  uint64_t inverse = kFactor;  // Newton: each step doubles the bits that are right
  for (int step = 0; step < 6; ++step) inverse *= 2 - kFactor * inverse;
  uint64_t product = wanted;
  for (int step = 0; step < 3; ++step) product = wanted ^ (product >> 29);
  return (product * inverse) ^ hash;
}

std::vector<glm::dvec3> colliding_positions(size_t count) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> unit;
  std::vector<glm::dvec3> found;
  while (found.size() < count) {
    const double x = unit(random), y = unit(random);
    const uint64_t before = fixed_mix(fixed_mix(0, position_bits(x)), position_bits(y));
    const auto z = std::bit_cast<double>(unmix(before, 0x1234567));
    if (std::abs(z) < 1e150 && std::abs(z) > 1e-150) found.emplace_back(x, y, z);
  }
  return found;
}

File points_file(const std::vector<glm::dvec3>& points) {
  const auto count = static_cast<uint32_t>(points.size());
  std::string bytes = ply_header(kLittle, "double", count, "uint uint", 1);
  for (const glm::dvec3& p : points) bytes += bytes_of(p);
  bytes += bytes_of(count);
  for (uint32_t i = 0; i < count; ++i) bytes += bytes_of(i);
  return {"points.ply", bytes};
}

}  // namespace

TEST_CASE("memory stays within six times the larger of file and mesh, time in proportion") {
#ifdef VKH_SANITIZED
  constexpr size_t kLarge = 4'100;
#else
  constexpr size_t kLarge = 65'540;  // just above a power of two, where tables are emptiest
#endif
  for (const size_t size : {size_t{100}, kLarge}) {
    const std::vector<File> small = worst_files(size), large = worst_files(4 * size);
    for (size_t i = 0; i < small.size(); ++i) {
      CAPTURE(small[i].name);
      CAPTURE(size);
      // Proportional growth is 4 times; quadratic growth is 16. On a busy machine one of the
      // two may have waited.
      bool in_proportion = false;
      for (int attempt = 0; attempt < 5 && !in_proportion; ++attempt) {
        const Cost of_small = least_cost_of(small[i]), of_large = least_cost_of(large[i]);
        check_memory(of_small);
        check_memory(of_large);
        in_proportion = of_large.seconds <= 10 * of_small.seconds + 0.01;
      }
      CHECK(in_proportion);
    }
  }
}

TEST_CASE("memory stays within that bound on every malformed file") {
  const char* folder = std::getenv("VKH_MALFORMED");
  REQUIRE(folder);
  size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    std::ifstream in(entry.path(), std::ios::binary);
    const File file = {entry.path().filename().string(),
                       std::string(std::istreambuf_iterator<char>(in), {})};
    CAPTURE(file.name);
    check_memory(cost_of(file));
    check_memory(cost_of(file, true));
    ++files;
  }
  CHECK(files > 600);
}

TEST_CASE("positions that were chosen to collide cost no more than any others") {
  const std::vector<glm::dvec3> chosen = colliding_positions(20'000);
  for (const glm::dvec3& p : chosen) REQUIRE(fixed_hash(p) == fixed_hash(chosen[0]));
  std::vector<glm::dvec3> others = chosen;
  for (glm::dvec3& p : others) p.z = -0.7 * p.z;
  const Cost of_chosen = least_cost_of(points_file(chosen));
  const Cost of_others = least_cost_of(points_file(others));
  CHECK(of_chosen.seconds <= 4 * of_others.seconds + 0.01);
}

// Python's hash of the bytes 0 to 23, and of eight zeros, with PYTHONHASHSEED=0: SipHash-1-3. For
// 15 and more bytes the authors' SipHash-2-4, with their key, 0 to 15.
TEST_CASE("the hash is SipHash") {
  const auto bytes_from_0 = [](size_t word) {
    return 0x0706050403020100u + word * 0x0808080808080808u;
  };
  const std::array<uint64_t, 3> counting = {bytes_from_0(0), bytes_from_0(1), bytes_from_0(2)};
  CHECK(keyed_hash<1, 3>({0, 0}, counting) == 0x31185a47af932f3au);
  CHECK(keyed_hash<1, 3>({0, 0}, std::array{uint64_t{0}}) == 0xbd60acb658c79e45u);
  const HashSecret authors = {bytes_from_0(0), bytes_from_0(1)};
  CHECK(keyed_hash<2, 4>(authors, std::array{bytes_from_0(0)}) == 0x93f5f5799a932462u);
  CHECK(keyed_hash<2, 4>(authors, std::array{bytes_from_0(0), bytes_from_0(1)}) ==
        0x3f2acc7f57c29bdbu);
  CHECK(keyed_hash<2, 4>({1, 0}, counting) != keyed_hash<2, 4>({2, 0}, counting));
}
