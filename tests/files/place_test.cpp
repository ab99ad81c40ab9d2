// place(): exact images in rationals beside the rounded ones, and the matrices that are read.
#include "vkhausdorff/place.h"

#include <doctest/doctest.h>
#include <gmpxx.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>

#include "vkhausdorff/error.h"
#include "vkhausdorff/length.h"

namespace {

using namespace vkh;
using Q = mpq_class;

std::string written(const std::string& text) {
  const auto path = std::filesystem::temp_directory_path() / "vkh_place_test_matrix.txt";
  std::ofstream(path) << text;
  return path.string();
}

std::string refusal(const std::string& text) {
  try {
    check_matrix("M", read_matrix(written(text)), false);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

Mesh mesh_of(const std::vector<DVec3>& points) {
  Mesh mesh;
  mesh.name = "A";
  mesh.vertices = points;
  mesh.faces = {{0, 0, 0}};
  return mesh;
}

/// The square of the distance from a rounded point to the exact image of x.
Q squared_error(const DVec3& rounded, const DVec3& x, const MeshTransform& by) {
  Q sum = 0;
  for (int i = 0; i < 3; ++i) {
    Q image = 0;
    const Q factor = Q(by.numerator) / Q(by.denominator);
    for (int k = 0; k < 3; ++k) {
      const double entry = by.matrix ? (*by.matrix)[size_t(i)][size_t(k)] : (i == k ? 1 : 0);
      image += Q(entry) * factor * Q(x[k]);
    }
    if (by.matrix) image += Q((*by.matrix)[size_t(i)][3]);
    const Q off = Q(rounded[i]) - image;
    sum += off * off;
  }
  return sum;
}

/// A rotation by a random quaternion, its entries rounded, and a shift.
MatrixRows random_matrix(std::mt19937_64& random, double shift) {
  std::normal_distribution<double> normal;
  double q[4], square = 0;
  for (double& part : q) {
    part = normal(random);
    square += part * part;
  }
  const auto [x, y, z, w] = std::array{q[0], q[1], q[2], q[3]};
  const double s = 2 / square;
  MatrixRows rows = {{{1 - s * (y * y + z * z), s * (x * y - z * w), s * (x * z + y * w), 0},
                      {s * (x * y + z * w), 1 - s * (x * x + z * z), s * (y * z - x * w), 0},
                      {s * (x * z - y * w), s * (y * z + x * w), 1 - s * (x * x + y * y), 0}}};
  for (auto& row : rows) row[3] = shift * normal(random);
  return rows;
}

}  // namespace

TEST_CASE("a matrix as programs write it") {
  const MatrixRows moved = {{{1, 0, 0, 1.5}, {0, 1, 0, -2}, {0, 0, 1, 3e-1}}};
  for (const char* text : {"1 0 0 1.5\n0 1 0 -2\n0 0 1 0.3\n0 0 0 1\n",
                           "[[1, 0, 0, 1.5],\n [0, 1, 0, -2.0],\n [0, 0, 1, 3e-1],\n [0, 0, 0, 1]]",
                           "# by rows\r\n1,0,0,1.5\r\n0,1,0,-2 # y\r\n0;0;1;+.3\t0 0 0 1"})
    CHECK(read_matrix(written(text)) == moved);
}

TEST_CASE("a matrix of all ways to write it") {
  const MatrixRows moved = {{{1, 0, 0, 1.5}, {0, 1, 0, -2}, {0, 0, 1, 0.3}}};
  size_t ways = 0;
  for (const char* mark :
       {"", "\xef\xbb\xbf", "# by rows\n", "\xef\xbb\xbf# by rows, \xc3\xa4\n\n"})
    for (const char* end : {"\n", "\r\n", "\n\n", " # y\n", ";\n", ",\n"})
      for (const char* between : {" ", "\t", ",", ", ", ";", " ; "})
        for (const char* zero : {"0", "0.0", "+0", "-0.000", "0e0"})
          for (const bool has_brackets : {false, true}) {
            std::string text = mark;
            const char* rows[4][4] = {{"1", zero, zero, "+1.5"},
                                      {zero, "1.", zero, "-2"},
                                      {zero, zero, "1e0", "3e-1"},
                                      {zero, zero, zero, "1"}};
            for (const auto& row : rows) {
              if (has_brackets) text += '[';
              for (size_t i = 0; i < 4; ++i) text += (i == 0 ? "" : between) + std::string(row[i]);
              if (has_brackets) text += ']';
              text += end;
            }
            ++ways;
            CAPTURE(text);
            CHECK(read_matrix(written(text)) == moved);
          }
  CHECK(ways == 1440);
  for (const char* mark : {"\xff\xfe", "\xfe\xff"})
    CHECK(refusal(mark + std::string("1\0 \0", 4)).find("UTF-16") != std::string::npos);
}

TEST_CASE("a determinant has the sign that it has exactly, or is refused for having none") {
  std::mt19937_64 random(12);
  size_t allowed = 0, mirrors = 0, flat = 0;
  for (int i = 0; i < 20000; ++i) {
    MatrixRows rows = random_matrix(random, 0);
    const auto factor = [&] { return std::ldexp(1.0, static_cast<int>(random() % 1800) - 900); };
    const std::array<double, 3> scale = {factor(), factor(), factor()};
    for (auto& row : rows) {
      for (size_t k = 0; k < 3; ++k) row[k] *= i % 3 == 0 ? scale[k] : scale[0];
    }
    // The last row is nearly, or exactly, a sum of the others; or it is turned round.
    const double by = i % 7 == 0 ? std::ldexp(1.0, -static_cast<int>(random() % 120)) : 1;
    for (size_t k = 0; k < 3; ++k) {
      if (i % 2 == 0) rows[2][k] = rows[0][k] + rows[1][k] + (i % 7 == 0 ? by * rows[2][k] : 0);
      if (i % 5 == 0) rows[1][k] = -rows[1][k];
    }
    Q exact = 0;
    for (size_t k = 0; k < 3; ++k)
      exact += Q(rows[0][k]) * (Q(rows[1][(k + 1) % 3]) * Q(rows[2][(k + 2) % 3]) -
                                Q(rows[1][(k + 2) % 3]) * Q(rows[2][(k + 1) % 3]));
    std::string refused;
    try {
      check_matrix("M", rows, true);
    } catch (const InputError& error) {
      refused = error.what();
    }
    if (refused.empty()) CHECK(exact > 0);
    if (refused.find("mirrors") != std::string::npos) CHECK(exact < 0);
    allowed += refused.empty();
    mirrors += refused.find("mirrors") != std::string::npos;
    flat += refused.find("flattens") != std::string::npos;
  }
  MESSAGE(allowed << " allowed, " << mirrors << " mirror, " << flat << " without a sign");
  CHECK(allowed > 1000);
  CHECK(mirrors > 1000);
  CHECK(flat > 100);
  for (const double large : {1e300, 1e-300, 0x1p1000}) {
    const MatrixRows one = {{{large, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};
    CHECK_NOTHROW(check_matrix("M", one, true));
    const MatrixRows all = {{{large, 0, 0, 0}, {0, large, 0, 0}, {0, 0, large, 0}}};
    CHECK_NOTHROW(check_matrix("M", all, true));
    Mesh mesh = mesh_of({{1, 2, 3}});
    place(mesh, {.matrix = all}, "mm", false);
    CHECK(mesh.polygons.ambiguity == 0);
    CHECK(mesh.vertices[0].y == 2 * large);
    CHECK(mesh.delta <= 1e-14 * large + 0x1p-1050);
  }
}

TEST_CASE("a matrix that is none, or not one for a shape, is refused by its reason") {
  CHECK(refusal("1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1").empty());
  CHECK(refusal("1 0 0 0 0 1 0 0 0 0 1 0").find("12 numbers; expected sixteen") !=
        std::string::npos);
  CHECK(refusal("1 0 0 0 0 1 0 0 0 0 1 0 5 6 7 1").find("written by columns") != std::string::npos);
  CHECK(refusal("1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 2").find("another last row") != std::string::npos);
  CHECK(refusal("1 0 0 0 0 1 0 0 0 0 1,5x 0 0 0 0 1").find("number 12: '5x'") != std::string::npos);
  CHECK(refusal("-1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1").find("mirrors") != std::string::npos);
  CHECK(refusal("1.1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1").find("--scale") != std::string::npos);
  CHECK(refusal("nan 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1").find("number 1") != std::string::npos);
  CHECK_THROWS_AS(read_matrix("/no/such/matrix.txt"), InputError);
  const MatrixRows flat = {{{1, 0, 0, 0}, {0, 1, 0, 0}, {1, 1, 0, 0}}};
  CHECK_THROWS_AS(check_matrix("M", flat, true), InputError);
  const MatrixRows scaled = {{{2, 0, 0, 0}, {0, 3, 0, 0}, {0, 0, 0.5, 0}}};
  CHECK_NOTHROW(check_matrix("M", scaled, true));
}

TEST_CASE("the stretch of a matrix encloses |R^T R - I|") {
  std::mt19937_64 random(7);
  for (int i = 0; i < 2000; ++i) {
    const MatrixRows rows = random_matrix(random, 0);
    Q most = 0;
    for (size_t a = 0; a < 3; ++a) {
      for (size_t b = 0; b < 3; ++b) {
        Q entry = a == b ? -1 : 0;
        for (const auto& row : rows) entry += Q(row[a]) * Q(row[b]);
        most = std::max(most, Q(abs(entry)));
      }
    }
    CHECK(Q(stretch_of(rows)) >= most);
    CHECK(stretch_of(rows) < 4e-15);
  }
}

TEST_CASE("units and matrices: every vertex is within delta of its exact image") {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> real(-1, 1);
  const char* units[] = {"um", "mm", "cm", "m", "in", "ft"};
  for (int i = 0; i < 4000; ++i) {
    MeshTransform by;
    const UnitRatio ratio = unit_ratio(units[random() % 6], units[random() % 6]);
    by.numerator = ratio.numerator;
    by.denominator = ratio.denominator;
    if (i % 2 == 1) by.matrix = random_matrix(random, std::exp2(real(random) * 40));
    const double size = std::exp2(real(random) * (i % 5 == 0 ? 990 : 60));
    std::vector<DVec3> points;
    for (int k = 0; k < 4; ++k)
      points.emplace_back(size * real(random), size * real(random), size * real(random));
    points.emplace_back(0, std::ldexp(real(random), -1070), size);
    Mesh mesh = mesh_of(points);
    mesh.delta = i % 3 == 0 ? size * 1e-9 : 0;
    const double before = mesh.delta;
    place(mesh, by, "mm", false);
    for (size_t k = 0; k < points.size(); ++k) {
      const Q room = Q(mesh.delta) - Q(mesh.placed->delta);
      REQUIRE(squared_error(mesh.vertices[k], points[k], by) <= room * room);
    }
    const double factor = by.numerator / by.denominator;
    CHECK(mesh.placed->delta >= before * factor);
    CHECK(mesh.delta - mesh.placed->delta <= 0x1p-47 * (factor * size + 0x1p41) + 0x1p-1000);
  }
}

TEST_CASE("what a unit converts exactly stays exact") {
  Mesh mesh = mesh_of({{1, -2.5, 4096}, {0.125, 0, 3}});
  place(mesh, {.numerator = 1000, .denominator = 1, .matrix = {}}, "mm", true);
  CHECK(mesh.delta == 0);
  CHECK(mesh.vertices[0] == DVec3(1000, -2500, 4096000));
  CHECK(mesh.unit == "mm");
  CHECK(mesh.placed->corners.size() == 64);
  Mesh large = mesh_of({{1e307, 0, 0}});
  CHECK_THROWS_AS(place(large, {.numerator = 1000, .denominator = 1, .matrix = {}}, "mm", false),
                  InputError);
}
