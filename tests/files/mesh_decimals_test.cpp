// Decimals as files write them: correctly rounded doubles in every format, and none too small.
#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

#include "host/read/readers.h"
#include "vkhausdorff/error.h"

namespace {

using vkh::InputError;
using vkh::ReadMesh;

ReadMesh parse(const std::string& bytes) {
  return vkh::parse_mesh({.name = "a.obj", .bytes = bytes});
}

}  // namespace

TEST_CASE("the same text is the same doubles in every format, whatever a PLY's float type") {
  const std::string rows[] = {"0.1 1e-400 -1e-400", "16777217 1e-60 -0.3",
                              "3.4028235e38 5e-324 2e-324"};
  const std::vector<glm::dvec3> expected = {
      {0.1, 0, -0.0}, {16777217, 1e-60, -0.3}, {3.4028235e38, 5e-324, 0}};
  std::string table, as_obj, as_stl = "solid\nfacet normal 0 0 0\nouter loop\n";
  for (const std::string& row : rows) {
    table += row + "\n";
    as_obj += "v " + row + "\n";
    as_stl += "vertex " + row + "\n";
  }
  const auto as_ply = [&](const std::string& type) {
    return "ply\nformat ascii 1.0\nelement vertex 3\nproperty " + type + " x\nproperty " + type +
           " y\nproperty " + type +
           " z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n" + table +
           "3 0 1 2\n";
  };
  for (const std::string& text :
       {as_ply("float"), as_ply("float32"), as_ply("double"), "OFF\n3 1 0\n" + table + "3 0 1 2\n",
        as_obj + "f 1 2 3\n", as_stl + "endloop\nendfacet\nendsolid\n"}) {
    CAPTURE(text);
    const ReadMesh mesh = parse(text);
    CHECK(mesh.vertices == expected);
    CHECK(std::signbit(mesh.vertices[0].z));
    CHECK_FALSE(std::signbit(mesh.vertices[0].y));
  }
}

TEST_CASE("decimals around the least and the largest double") {
  const auto first_of = [](const std::string& word) {
    return parse("v " + word + " 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").vertices[0].x;
  };
  const double least = 5e-324;
  CHECK(first_of("2.4703282292062328e-324") == least);  // above the half of it
  CHECK(first_of("2.4703282292062327e-324") == 0);      // below
  CHECK(first_of("1e-99999999999999999999") == 0);
  CHECK(first_of("1" + std::string(400, '0') + "e-99999999999999999999") == 0);
  CHECK(first_of("1" + std::string(400, '0') + "e-800") == 0);
  CHECK(first_of("0." + std::string(400, '0') + "1") == 0);
  CHECK(first_of("0." + std::string(800, '0') + "1e400") == 0);
  CHECK(first_of("0." + std::string(400, '0') + "1e401") == 1);
  CHECK(first_of("1" + std::string(400, '0') + "e-400") == 1);
  CHECK(first_of("1.7976931348623158e308") == 1.7976931348623157e308);
  for (const std::string word : {"1.7976931348623159e308", "1e309", "0.0000000001e319",
                                 "1e99999999999999999999", "-1e+400"}) {
    CAPTURE(word);
    CHECK_THROWS_AS(first_of(word), InputError);
  }
  CHECK_THROWS_AS(first_of("1" + std::string(400, '0')), InputError);
  CHECK_THROWS_AS(first_of("1" + std::string(800, '0') + "e-400"), InputError);
}
