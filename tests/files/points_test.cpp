// Files of points: what the readers give, what they refuse, and how exact LAS is.
#include <doctest/doctest.h>
#include <gmpxx.h>

#include <array>
#include <cstring>
#include <random>
#include <string>
#include <vector>

#include "host/read/readers.h"
#include "vkhausdorff/error.h"

namespace {

using vkh::Mesh;
using vkh::ReadMesh;

std::string error_of(const std::string& bytes, const std::string& name, bool points) {
  try {
    vkh::parse_mesh({.name = name, .bytes = bytes, .limits = {.points = points}});
  } catch (const vkh::InputError& error) {
    return error.what();
  }
  return "accepted";
}

/// A LAS 1.2 file of points of format 0, whose parts a test can set.
class Las {
 public:
  Las() : bytes_(227, '\0') {
    bytes_.replace(0, 4, "LASF");
    bytes_[24] = 1;
    bytes_[25] = 2;
    put(94, uint16_t{227});
    put(96, uint32_t{227});
    put(105, uint16_t{20});
  }
  template <class T>
  void put(size_t at, T value) {
    std::memcpy(&bytes_[at], &value, sizeof value);
  }
  void put_points(const std::vector<std::array<int32_t, 3>>& numbers) {
    put(107, static_cast<uint32_t>(numbers.size()));
    bytes_.resize(227 + 20 * numbers.size());
    for (size_t p = 0; p < numbers.size(); ++p) put(227 + 20 * p, numbers[p]);
  }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

mpq_class square(const mpq_class& x) { return x * x; }

}  // namespace

TEST_CASE("formats of points are named, with the option that reads them") {
  const std::string las = Las().bytes(), xyz = "0 0 0\n1 0 0\n";
  for (const auto& [name, bytes, what] : {std::array<std::string, 3>{"a.las", las, "a LAS file"},
                                          {"a.xyz", xyz, "a text"},
                                          {"a.pts", xyz, "a text"}}) {
    const std::string line = error_of(bytes, name, false);
    CHECK(line.starts_with(name + ": byte 0: " + what + " (points, no faces); expected a mesh"));
    CHECK(line.find("--points a measures points, b those of the second file") != std::string::npos);
  }
  CHECK(error_of(xyz, "a.xyz", true) == "accepted");
  CHECK(error_of(xyz, "pipe", true) == "accepted");
  CHECK(error_of("a b c", "pipe", true).find("expected points as PLY") != std::string::npos);
}

TEST_CASE("a LAS point is its numbers times the scale plus the offset, within delta") {
  std::mt19937 random(40);
  const auto any = [&](double size) { return size * (static_cast<double>(random()) / 0x1p31 - 1); };
  for (int file = 0; file < 200; ++file) {
    const std::array<double, 3> scale = {any(1), any(1e-3), any(0x1p-60)};
    const std::array<double, 3> offset = {any(1e7), any(1e-9), 0};
    std::vector<std::array<int32_t, 3>> numbers(40);
    for (auto& number : numbers) {
      for (int32_t& n : number) n = static_cast<int32_t>(random());
    }
    Las las;
    las.put(131, scale);
    las.put(155, offset);
    las.put_points(numbers);
    const ReadMesh mesh = vkh::parse_las({.name = "a.las", .bytes = las.bytes()});
    REQUIRE(mesh.vertices.size() == numbers.size());
    REQUIRE(mesh.are_points);
    for (size_t p = 0; p < numbers.size(); ++p) {
      mpq_class off = 0;
      for (size_t i = 0; i < 3; ++i)
        off += square(mpq_class(numbers[p][i]) * scale[i] + offset[i] -
                      mesh.vertices[p][static_cast<int>(i)]);
      CHECK(off <= square(mesh.delta));
    }
    // It is no wider than a few roundings of the largest coordinates.
    CHECK(mesh.delta <= 0x1p-51 * (std::abs(scale[0]) * 0x1p31 + std::abs(offset[0]) + 1));
  }
}

TEST_CASE("withheld LAS points keep their numbers for those behind them") {
  Las las;
  las.put(131, std::array{1.0, 1.0, 1.0});
  las.put_points({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}});
  las.put(227 + 20 + 15, uint8_t{0x80});
  const ReadMesh mesh = vkh::parse_las({.name = "a.las", .bytes = las.bytes()});
  REQUIRE(mesh.faces.size() == 3);
  CHECK(mesh.vertices[1].x == 2);
  CHECK(mesh.file_faces.of(0) == 0);
  CHECK(mesh.file_faces.of(1) == 2);
  CHECK(mesh.file_faces.of(2) == 3);
  const ReadMesh all = vkh::parse_las(
      {.name = "a.las", .bytes = las.bytes(), .limits = {.bodies = vkh::Bodies::kAll}});
  CHECK(all.faces.size() == 4);
  CHECK(line_of(all.notes[0]) == "bodies: included, though withheld: 1 point");
}

TEST_CASE("blocks of a LAS file leave no gap where points are withheld") {
  std::mt19937 random(9);
  for (int round = 0; round < 40; ++round) {
    Las las;
    las.put(131, std::array{1.0, 1.0, 1.0});
    std::vector<std::array<int32_t, 3>> numbers;
    for (int32_t i = 0; i < 60; ++i) numbers.push_back({i, -i, 7});
    las.put_points(numbers);
    std::vector<int32_t> kept;
    for (int32_t i = 0; i < 60; ++i) {
      const bool is_withheld = random() % 4 == 0 || (round % 2 == 0 && i / 10 == 2);
      if (is_withheld) las.put(227 + 20 * static_cast<size_t>(i) + 15, uint8_t{0x80});
      if (!is_withheld) kept.push_back(i);
    }
    for (const size_t block : {size_t{1}, size_t{20}, size_t{130}, size_t{1000}, size_t{100000}}) {
      const Mesh mesh =
          vkh::parse_las({.name = "a.las", .bytes = las.bytes(), .limits = {.block_bytes = block}});
      REQUIRE(mesh.vertices.size() == kept.size());
      for (size_t i = 0; i < kept.size(); ++i) {
        CHECK(mesh.vertices[i] == vkh::DVec3(kept[i], -kept[i], 7));
        CHECK(mesh.file_faces.of(i) == static_cast<size_t>(kept[i]));
      }
    }
  }
}

TEST_CASE("points are a mesh whose faces are its vertices, and check_mesh keeps it so") {
  Mesh mesh = vkh::make_points("p", {{0, 0, 0}, {1, 2, 3}, {0, 0, 0}});
  CHECK(mesh.counts.faces == 3);
  CHECK(mesh.counts.degenerate == 3);
  check_mesh(mesh);
  mesh.faces[1].z = 2;
  CHECK_THROWS_WITH_AS(check_mesh(mesh), doctest::Contains("face 1: are_points"), vkh::InputError);
  mesh.faces[1].z = 1;
  mesh.vertices.emplace_back(4, 5, 6);
  CHECK_THROWS_AS(check_mesh(mesh), vkh::InputError);
  CHECK_THROWS_WITH_AS(vkh::make_points("p", {{0, 0, 0}, {0, 1 / 0.0, 0}}),
                       doctest::Contains("p: vertex 1: (0, inf, 0) is not finite"),
                       vkh::InputError);
  CHECK_THROWS_AS(vkh::make_points("p", {}), vkh::InputError);
}
