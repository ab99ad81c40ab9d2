// Files of points: what the readers give, what they refuse, and how exact LAS is.
#include <doctest/doctest.h>
#include <gmpxx.h>

#include <array>
#include <random>
#include <string>
#include <vector>

#include "host/read/readers.h"
#include "tests/files/las_file.h"
#include "vkhausdorff/error.h"

namespace {

using vkh::Mesh;
using vkh::ReadMesh;
using vkh::test::Las;

std::string error_of(const std::string& bytes, const std::string& name, bool points) {
  try {
    vkh::parse_mesh({.name = name, .bytes = bytes, .limits = {.points = points}});
  } catch (const vkh::InputError& error) {
    return error.what();
  }
  return "accepted";
}

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

namespace {

/// What stands behind the records of a LAS file.
enum class Behind { kNothing, kLitter, kRecord, kWaveforms, kExtended };
/// The header's count, compared with the number of records.
enum class Counts { kRight, kFewer, kMore, kNone };

/// One way to write four points.
struct LasWay {
  uint8_t minor, format;
  uint16_t more_bytes;  ///< in each record
  uint32_t gap;         ///< between header and points
  Counts counts;
  Behind behind;
  bool has_old_count;

  bool counts_in_64_bits() const { return minor >= 4; }
  uint16_t header_bytes() const {
    constexpr std::array<uint16_t, 6> kBytes = {227, 227, 227, 235, 375, 393};
    return kBytes[minor];
  }
  uint16_t record_bytes() const {
    constexpr std::array<uint16_t, 11> kBytes = {20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67};
    return static_cast<uint16_t>(kBytes[format] + more_bytes);
  }
  uint64_t announced() const {
    if (counts == Counts::kNone) return 0;
    return counts == Counts::kFewer ? 3 : counts == Counts::kMore ? 5 : 4;
  }
  /// Words of the refusal; nothing where the points are read.
  std::string refusal() const {
    if (counts == Counts::kMore) return "5 points announced, ";
    if (counts == Counts::kFewer) return "3 points announced, ";
    if (counts == Counts::kNone) return "0 points announced, ";
    const bool is_known = behind == Behind::kWaveforms  ? minor >= 3
                          : behind == Behind::kExtended ? minor >= 4
                                                        : behind != Behind::kRecord;
    if (counts == Counts::kRight && !is_known) return "4 points announced, ";
    return "";
  }
};

template <class T>
void put_at(std::string& bytes, size_t at, T value) {
  std::memcpy(&bytes[at], &value, sizeof value);
}

std::string las_of(const LasWay& way) {
  const uint32_t begin = way.header_bytes() + way.gap;
  std::string bytes(begin, '\0');
  bytes.replace(0, 4, "LASF");
  put_at(bytes, 24, uint8_t{1});
  put_at(bytes, 25, way.minor);
  put_at(bytes, 94, way.header_bytes());
  put_at(bytes, 96, begin);
  put_at(bytes, 104, way.format);
  put_at(bytes, 105, way.record_bytes());
  const bool is_old = !way.counts_in_64_bits() || way.has_old_count;
  put_at(bytes, 107, static_cast<uint32_t>(is_old ? way.announced() : 0));
  for (size_t i = 0; i < 3; ++i) put_at(bytes, 131 + 8 * i, 1.0);
  for (int32_t point = 0; point < 4; ++point) {
    std::string record(way.record_bytes(), '\0');
    put_at(record, 0, std::array{point + 1, -point, 7});
    bytes += record;
  }
  const uint64_t end = bytes.size();
  if (way.counts_in_64_bits()) put_at(bytes, 247, way.announced());
  if (way.behind == Behind::kWaveforms && way.minor >= 3) put_at(bytes, 227, end);
  if (way.behind == Behind::kExtended && way.minor >= 4) {
    put_at(bytes, 235, end);
    put_at(bytes, 243, uint32_t{1});
  }
  if (way.behind == Behind::kLitter) return bytes + std::string(way.record_bytes() - 1u, 'w');
  return way.behind == Behind::kNothing ? bytes : bytes + std::string(200, 'w');
}

}  // namespace

TEST_CASE("LAS of every version, format and count is read whole or refused") {
  size_t read_right = 0, refused = 0;
  LasWay way{};
  const auto check = [&] {
    const std::string bytes = las_of(way), refusal = way.refusal();
    CAPTURE(int{way.minor});
    CAPTURE(int{way.format});
    CAPTURE(static_cast<int>(way.counts));
    CAPTURE(static_cast<int>(way.behind));
    CAPTURE(refusal);
    if (!refusal.empty()) {
      ++refused;
      CHECK(error_of(bytes, "a.las", true).find(refusal) != std::string::npos);
      return;
    }
    ++read_right;
    for (const size_t block : {size_t{0}, size_t{1}, size_t{100}}) {
      const Mesh mesh =
          vkh::parse_las({.name = "a.las", .bytes = bytes, .limits = {.block_bytes = block}});
      REQUIRE(mesh.vertices.size() == 4);
      for (int point = 0; point < 4; ++point)
        CHECK(mesh.vertices[static_cast<size_t>(point)] == vkh::DVec3(point + 1, -point, 7));
    }
  };
  for (way.minor = 0; way.minor < 6; ++way.minor)
    for (way.format = 0; way.format < 11; ++way.format)
      for (const int more : {0, 1, 27})
        for (const uint32_t gap : {0, 54, 1000})
          for (int counts = 0; counts < 4; ++counts)
            for (int behind = 0; behind < 5; ++behind)
              for (const bool has_old : {false, true}) {
                way.more_bytes = static_cast<uint16_t>(more);
                way.gap = gap;
                way.counts = static_cast<Counts>(counts);
                way.behind = static_cast<Behind>(behind);
                way.has_old_count = has_old;
                check();
              }
  MESSAGE(read_right << " read, " << refused << " refused");
  CHECK(read_right > 2000);
  CHECK(refused > 5000);
}

TEST_CASE("LAS 1.0 has no flag of withheld points, and perhaps a signature before them") {
  Las las;
  las.put(131, std::array{1.0, 1.0, 1.0});
  las.put_points({{1, 0, 0}, {2, 0, 0}});
  las.put(227 + 15, uint8_t{0x80});
  CHECK(vkh::parse_las({.name = "a.las", .bytes = las.bytes()}).vertices.size() == 1);
  las.put(25, uint8_t{0});
  CHECK(vkh::parse_las({.name = "a.las", .bytes = las.bytes()}).vertices.size() == 2);
  std::string signed_bytes = las.bytes();
  signed_bytes.insert(227, "\xdd\xcc");
  for (const uint32_t begin : {227, 229}) {
    put_at(signed_bytes, 96, begin);
    const Mesh mesh = vkh::parse_las({.name = "a.las", .bytes = signed_bytes});
    REQUIRE(mesh.vertices.size() == 2);
    CHECK(mesh.vertices[1] == vkh::DVec3(2, 0, 0));
  }
}
