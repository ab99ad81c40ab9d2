// The mesh readers: the coordinates as given in every format, and errors that name their place.
#include "vkhausdorff/mesh_io.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <random>

#include "host/read/readers.h"
#include "tests/support/error_line.h"
#include "vkhausdorff/error.h"
#include "vkhausdorff/note.h"

namespace {

using vkh::InputError;
using vkh::Mesh;
using vkh::ReadMesh;
using vkh::test::check_error_line;
using Vertices = std::vector<glm::dvec3>;
using Faces = std::vector<glm::uvec3>;

ReadMesh parse(const std::string& bytes, const std::string& name) {
  return vkh::parse_mesh({.name = name, .bytes = bytes});
}

std::string error_of(const std::string& bytes, const std::string& name, bool points = false) {
  try {
    vkh::parse_mesh({.name = name, .bytes = bytes, .limits = {.points = points}});
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

bool has_note(const ReadMesh& mesh, const std::string& text) {
  return std::any_of(mesh.notes.begin(), mesh.notes.end(), [&](const vkh::Note& note) {
    return line_of(note).find(text) != std::string::npos;
  });
}

template <class T>
void append(std::string& bytes, T value, bool big = false) {
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  if (big) std::reverse(raw, raw + sizeof(T));
  bytes.append(raw, sizeof(T));
}

template <class Coordinate>
std::string binary_ply(const Vertices& vertices, const Faces& faces, bool big) {
  std::string bytes = std::string("ply\nformat binary_") + (big ? "big" : "little") +
                      "_endian 1.0\nelement vertex " + std::to_string(vertices.size()) + "\n";
  const char* type = sizeof(Coordinate) == 4 ? "float" : "double";
  for (const char* axis : {"x", "y", "z"}) {
    bytes += std::string("property ") + type + " " + axis + "\n";
  }
  bytes += "element face " + std::to_string(faces.size()) +
           "\nproperty list uchar int vertex_indices\nend_header\n";
  for (const glm::dvec3& p : vertices) {
    for (int i = 0; i < 3; ++i) append(bytes, static_cast<Coordinate>(p[i]), big);
  }
  for (const glm::uvec3& face : faces) {
    append<uint8_t>(bytes, 3);
    for (int i = 0; i < 3; ++i) append(bytes, face[i], big);
  }
  return bytes;
}

std::string binary_stl(const Vertices& vertices, const Faces& faces) {
  std::string bytes(80, ' ');
  append(bytes, static_cast<uint32_t>(faces.size()));
  for (const glm::uvec3& face : faces) {
    bytes.append(12, '\0');
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k < 3; ++k) append(bytes, static_cast<float>(vertices[face[i]][k]));
    }
    bytes.append(2, '\0');
  }
  return bytes;
}

std::string number(double x) {
  char text[40];
  std::snprintf(text, sizeof(text), "%.17g", x);
  return text;
}

std::string position(const glm::dvec3& p) {
  return number(p.x) + " " + number(p.y) + " " + number(p.z) + "\n";
}

std::string indices(const glm::uvec3& face, uint32_t base) {
  return std::to_string(face.x + base) + " " + std::to_string(face.y + base) + " " +
         std::to_string(face.z + base) + "\n";
}

std::string obj(const Vertices& vertices, const Faces& faces) {
  std::string text;
  for (const glm::dvec3& p : vertices) text += "v " + position(p);
  for (const glm::uvec3& face : faces) text += "f " + indices(face, 1);
  return text;
}

std::string off(const Vertices& vertices, const Faces& faces) {
  std::string text =
      "OFF\n" + std::to_string(vertices.size()) + " " + std::to_string(faces.size()) + " 0\n";
  for (const glm::dvec3& p : vertices) text += position(p);
  for (const glm::uvec3& face : faces) text += "3 " + indices(face, 0);
  return text;
}

std::string ascii_ply(const Vertices& vertices, const Faces& faces) {
  std::string text = "ply\nformat ascii 1.0\nelement vertex " + std::to_string(vertices.size()) +
                     "\nproperty double x\nproperty double y\nproperty double z\nelement face " +
                     std::to_string(faces.size()) +
                     "\nproperty list uchar int vertex_index\nend_header\n";
  for (const glm::dvec3& p : vertices) text += position(p);
  for (const glm::uvec3& face : faces) text += "3 " + indices(face, 0);
  return text;
}

std::string ascii_stl(const Vertices& vertices, const Faces& faces) {
  std::string text = "solid a b\n";
  for (const glm::uvec3& face : faces) {
    text += "facet normal nan nan nan\nouter loop\n";
    for (int i = 0; i < 3; ++i) text += "vertex " + position(vertices[face[i]]);
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid a b\n";
}

// Every vertex used, positions distinct, each first used in the order of the vertices: STL's
// merging must return this mesh.
struct Sample {
  Vertices vertices;
  Faces faces;
};

Sample random_strip(uint32_t seed, uint32_t count, bool as_float) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> mantissa(-1, 1);
  std::uniform_int_distribution<int> exponent(-30, 30);
  Sample sample;
  for (uint32_t v = 0; v < count; ++v) {
    glm::dvec3 p{};
    for (int i = 0; i < 3; ++i) p[i] = std::ldexp(mantissa(random), exponent(random));
    sample.vertices.push_back(as_float ? glm::dvec3(glm::vec3(p)) : p);
    if (v >= 2) sample.faces.emplace_back(v - 2, v - 1, v);
  }
  return sample;
}

void check_same(const Mesh& mesh, const Sample& sample) {
  CHECK(mesh.vertices == sample.vertices);
  CHECK(mesh.faces == sample.faces);
  CHECK(mesh.counts.unreferenced == 0);
}

}  // namespace

TEST_CASE("all formats give the coordinates and faces as written") {
  for (const bool as_float : {true, false}) {
    const Sample sample = random_strip(as_float ? 1 : 2, 500, as_float);
    check_same(parse(obj(sample.vertices, sample.faces), "a.obj"), sample);
    check_same(parse(off(sample.vertices, sample.faces), "a.off"), sample);
    check_same(parse(ascii_ply(sample.vertices, sample.faces), "a.ply"), sample);
    check_same(parse(ascii_stl(sample.vertices, sample.faces), "a.stl"), sample);
    for (const bool big : {false, true}) {
      check_same(parse(binary_ply<double>(sample.vertices, sample.faces, big), "a.ply"), sample);
    }
    if (!as_float) continue;
    check_same(parse(binary_stl(sample.vertices, sample.faces), "a.stl"), sample);
    for (const bool big : {false, true}) {
      check_same(parse(binary_ply<float>(sample.vertices, sample.faces, big), "a.ply"), sample);
    }
  }
}

TEST_CASE("a file on disk is read whole") {
  const Sample sample = random_strip(3, 20000, false);
  const auto path = std::filesystem::temp_directory_path() /
                    ("vkh_mesh_io_test_" + std::to_string(std::random_device{}()) + ".ply");
  std::ofstream(path, std::ios::binary) << binary_ply<double>(sample.vertices, sample.faces, false);
  const ReadMesh mesh = vkh::read_mesh(path);
  std::filesystem::remove(path);
  check_same(mesh, sample);
  CHECK(mesh.name == path.string());
  CHECK_THROWS_AS(vkh::read_mesh(path), InputError);
  CHECK_THROWS_AS(vkh::read_mesh(std::filesystem::temp_directory_path()), InputError);
}

TEST_CASE("every proper prefix of a binary file is refused") {
  const Sample sample = random_strip(4, 12, true);
  for (const std::string& bytes : {binary_ply<float>(sample.vertices, sample.faces, false),
                                   binary_stl(sample.vertices, sample.faces)}) {
    const std::string name = bytes.starts_with("ply") ? "a.ply" : "a.stl";
    CHECK_NOTHROW(parse(bytes, name));
    for (size_t size = 0; size < bytes.size(); ++size) {
      CAPTURE(size);
      check_error_line(error_of(bytes.substr(0, size), name), name);
    }
  }
}

TEST_CASE("OBJ: coordinates are correctly rounded doubles") {
  const std::string text =
      "v 0.1 1.7976931348623157e308 5e-324\n"
      "v 9007199254740993 +.5 2.\nv 1e+2 -7E-001 -0 1.0 # w\nf 1 2 3\n";
  const ReadMesh mesh = parse(text, "a.obj");
  CHECK(mesh.vertices == Vertices{{0.1, 1.7976931348623157e308, 5e-324},
                                  {9007199254740992.0, 0.5, 2},
                                  {100, -0.7, 0}});
  CHECK(std::signbit(mesh.vertices[2].z));
}

TEST_CASE("OBJ: tokens that are no number are named with file and line") {
  for (const std::string word : {"0x1p3", "1,5", "1/3", "1e400", "1e", "1.2.3", "--1", "+-1", "-",
                                 "+", ".", "1f", "1e+", "nano"}) {
    CAPTURE(word);
    const std::string good = "v 0 0 0\nv 1 0 0\nf 1 2 3\n";
    CHECK(error_of(good + "v 0 " + word + " 0\n", "a.obj") ==
          "a.obj: line 4: '" + word +
              "' as coordinate; expected a finite decimal number such as -1.5e-3");
    CHECK(error_of(good + "v 0 0 0 " + word + "\n", "a.obj").starts_with("a.obj: line 4: '"));
  }
  CHECK(error_of("v 0 0\n", "a.obj").starts_with("a.obj: line 1: no coordinate; expected "));
  // What is printed of a float that is not finite matters where a face uses it.
  for (const auto& [word, value] : {std::pair{"nan", "nan"},
                                    {"-inf", "-inf"},
                                    {"+nan", "nan"},
                                    {"infinity", "inf"},
                                    {"-1.#IND", "nan"},
                                    {"-nan(ind)", "nan"}}) {
    const std::string row = "v 0 " + std::string(word) + " 0\n";
    CHECK(error_of("v 0 0 0\nv 1 0 0\nf 1 2 3\n" + row, "a.obj") ==
          "a.obj: vertex 2: (0, " + std::string(value) +
              ", 0) is not finite; expected finite coordinates");
    CHECK(parse(row + "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 2 3 4\n", "a.obj").vertices.size() == 3);
  }
}

TEST_CASE("OBJ: face forms and indices") {
  const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
  const auto faces_of = [&](const std::string& rest) {
    return parse(square + rest, "a.obj").faces;
  };
  CHECK(faces_of("f 1 2 3 4\n") == Faces{{0, 1, 2}, {0, 2, 3}});
  CHECK(faces_of("f 1/ 2/7/ 3//9 4/5/6\n") == Faces{{0, 1, 2}, {0, 2, 3}});
  CHECK(faces_of("f -4 -3 -2\nf -4 -2 -1 # relative\n") == Faces{{0, 1, 2}, {0, 2, 3}});
  CHECK(faces_of("f 1 \\\n2 3\\\r\n 4") == Faces{{0, 1, 2}, {0, 2, 3}});
  CHECK(parse("f 3 2 1\n" + square, "a.obj").faces == Faces{{2, 1, 0}});
  CHECK(parse("# C:\\a\\\n" + square + "f 1 2 3\n", "a.obj").counts.unreferenced == 1);
  CHECK(parse("v 0 0 0\rv 1 0 0\rv 1 1 0\rf 1 2 3\r", "a.obj").faces.size() == 1);
  for (const std::string corner : {"5", "0", "-5", "4294967299", "99999999999999999999"}) {
    CAPTURE(corner);
    check_error_line(error_of(square + "f 1 2 " + corner + "\nf 1 2 3\n", "a.obj"), "a.obj");
    CHECK(
        error_of(square + "f 1 2 " + corner + "\nf 1 2 3\n", "a.obj").starts_with("a.obj: line 5"));
  }
  for (const std::string corner : {"x", "1.5", "/1", "1/x", "1/1/1/1", "1//x", "1-2"}) {
    CAPTURE(corner);
    CHECK(error_of(square + "f " + corner + " 2 3\n", "a.obj").starts_with("a.obj: line 5: '"));
  }
}

TEST_CASE("OBJ: what is no surface is noted") {
  const ReadMesh mesh = parse(
      "mtllib gone.mtl\nusemtl none\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nl 1 2\np 1\nf\nf 1 2\n"
      "f 1 2 3 4\n",
      "a.obj");
  CHECK(mesh.counts.polygons == 1);
  CHECK(has_note(mesh, "polygons: 1 face of more than three corners was triangulated"));
  CHECK(has_note(mesh, "short-faces: 2 faces of fewer than three corners"));
  CHECK(has_note(mesh, "elements: 2 lines with points, polylines or curves ignored"));
  CHECK(mesh.notes.size() == 3);
}

TEST_CASE("PLY: types, lists and elements in any order") {
  const ReadMesh mesh = parse(
      "ply\nformat ascii 1.0\ncomment c\nelement face 2\nproperty list uint8 float32 uv\n"
      "property list ushort uint16 vertex_index\nproperty int8 flag\nelement edge 1\n"
      "property int a\nelement vertex 4\nproperty list int int around\nproperty float z\n"
      "property short x\nproperty double y\nend_header\n"
      "1 nan 4 0 1 2 3 -1\n\n0 3 3 1 0 7\n9\n0 0.1 1 0.1\n2 5 6 1e-60 2 2\n0 0 3 3\n0 -1 4 4\n",
      "a.ply");
  CHECK(mesh.faces == Faces{{3, 0, 1}, {1, 2, 3}, {3, 1, 0}});
  CHECK(mesh.vertices == Vertices{{1, 0.1, 0.1}, {2, 2, 1e-60}, {3, 3, 0}, {4, 4, -1}});
  CHECK(mesh.counts.polygons == 1);
}

TEST_CASE("PLY: rows must hold what the header says") {
  const std::string head =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
      "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";
  const std::string good = head + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  CHECK(parse(good, "a.ply").notes.empty());
  CHECK(has_note(parse(good + "litter\n", "a.ply"), "ignored, from line 14"));
  const auto place = [&](const std::string& body) {
    return error_of(head + body, "a.ply").substr(0, 14);
  };
  CHECK(place("0 0\n0 1 0 0\n0 1 0\n3 0 1 2\n") == "a.ply: line 10");
  CHECK(place("0 0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n") == "a.ply: line 11");
  CHECK(place("0 0 0\n1 0 0\n0 1e39 0\n3 0 1 2\n") == "a.ply: line 12");
  CHECK(place("0 0 0\n1 0 0\n0 1 0\n4 0 1 2\n") == "a.ply: line 13");
  CHECK(place("0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n") == "a.ply: line 13");
  CHECK(place("0 0 0\n1 0 0\n0 1 0\n3 0 1 1.0\n") == "a.ply: line 13");
}

TEST_CASE("PLY: headers that announce nonsense are refused") {
  const auto refused = [](const std::string& element) {
    check_error_line(error_of("ply\nformat binary_little_endian 1.0\n" + element +
                                  "\nend_header\n" + std::string(400, '\0'),
                              "a.ply"),
                     "a.ply");
  };
  const std::string xyz = "\nproperty float x\nproperty float y\nproperty float z\n";
  const std::string face = "element face 1\nproperty list uchar int vertex_indices";
  refused("element vertex 3" + xyz + "element void 18446744073709551615\n" + face);
  refused("element vertex 3" + xyz + "element void 9000000000000000000\n" + face);
  refused("element vertex 3" + xyz + "element face 1\nproperty list float int vertex_indices");
  refused("element vertex 3" + xyz + "element face 1\nproperty list uchar float vertex_indices");
  refused("element vertex 3" + xyz + "element face 1\nproperty int vertex_indices");
  refused("element vertex 3" + xyz + face + "\n" + face);
  refused("element vertex 3\nproperty float x\nproperty float y\n" + face);
  refused("element vertex 3" + xyz + "property float x\n" + face);
  refused("element vertex 3\nproperty list uchar float x\n" + face);
  refused("element vertex 3\nproperty quad x\n" + face);
}

TEST_CASE("STL: equal positions are one vertex, also across signed zeros") {
  const Sample sample{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-0.0, 0, -0.0}, {0, -1, 0}},
                      {{0, 1, 2}, {1, 3, 4}}};
  const ReadMesh mesh = parse(binary_stl(sample.vertices, sample.faces), "solid.stl");
  CHECK(mesh.faces == Faces{{0, 1, 2}, {1, 0, 3}});
  CHECK(mesh.vertices.size() == 4);
}

TEST_CASE("STL: binary is told by its size, text by its words") {
  const Sample sample = random_strip(5, 5, true);
  std::string binary = binary_stl(sample.vertices, sample.faces);
  binary.replace(0, 5, "solid");
  check_same(parse(binary, "a.stl"), sample);
  check_same(parse(binary, "a.obj"), sample);
  CHECK(has_note(parse(binary + "litter", "a.stl"),
                 "unread: 6 bytes after the last triangle ignored"));
  check_error_line(error_of(binary + std::string(50, 'x'), "a.stl"), "a.stl");
  const std::string text = ascii_stl(sample.vertices, sample.faces);
  CHECK(parse(text + text, "a.stl").counts.duplicate == 3);
  CHECK(error_of(text.substr(0, text.find("endsolid")), "a.stl") ==
        "a.stl: line 22: the file ends; expected 'facet' or 'endsolid'");
  CHECK(error_of(text + "facet", "a.stl") ==
        "a.stl: line 24: 'facet'; expected 'solid' or the end of the file");
}

TEST_CASE("STL: text as writers vary it") {
  const Sample sample = random_strip(5, 5, true);
  const std::string text = ascii_stl(sample.vertices, sample.faces);
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string out = text;
    for (size_t at = 0; (at = out.find(from, at)) != std::string::npos; at += to.size())
      out.replace(at, from.size(), to);
    return out;
  };
  check_same(parse(with("endloop\nendfacet", "end loop\nEnd Facet"), "a.stl"), sample);
  check_same(parse(with("endsolid a b", "endsolida b"), "a.stl"), sample);
  check_same(parse(with("facet normal", "color 1 0.5 0\nfacet normal"), "a.stl"), sample);
  check_same(parse(with("endfacet\n", "endfacet color 1 0 0\n"), "a.stl"), sample);
  check_same(parse("solid\n" + text + "endsolid\n", "a.stl"), sample);
  check_same(parse(text + std::string(3, '\0'), "a.stl"), sample);
  check_same(parse(text + "\x1a", "a.stl"), sample);
  check_error_line(error_of(with("endloop", "end facet"), "a.stl"), "a.stl");
  check_error_line(error_of(text + std::string("\0x", 2), "a.stl"), "a.stl");
}

TEST_CASE("STL: attribute bytes that follow a triangle are skipped") {
  const Sample sample = random_strip(5, 5, true);
  const std::string plain = binary_stl(sample.vertices, sample.faces);
  std::string bytes = plain.substr(0, 84);
  size_t all = 0;
  for (size_t t = 0; t < sample.faces.size(); ++t) {
    const size_t more = 7 * t % 60;  // none, some, more than a triangle's
    bytes += plain.substr(84 + 50 * t, 48);
    append(bytes, static_cast<uint16_t>(more));
    bytes.append(more, 'x');
    all += more;
  }
  const ReadMesh mesh = parse(bytes, "a.stl");
  check_same(mesh, sample);
  CHECK(has_note(mesh, std::to_string(all) + " attribute bytes behind triangles ignored"));
  // If the counts do not make the file's size they are something else: a colour.
  std::string coloured = plain;
  coloured.replace(84 + 48, 2, "\x10\x42");
  check_same(parse(coloured, "a.stl"), sample);
  check_same(parse(coloured + "litter", "a.stl"), sample);
}

TEST_CASE("OFF: variants") {
  const std::string body = "3 1 0\n0 0 0 0 0 1\n1 0 0 9 9 9\n0 1 0 x y z\n3 0 1 2 0.5\n";
  for (const std::string word : {"OFF", "COFF", "NOFF", "STOFF", "CNOFF", "STCNOFF"}) {
    CHECK(parse(word + "\n" + body, "pipe").faces == Faces{{0, 1, 2}});
  }
  for (const std::string word : {"4OFF", "nOFF", "XOFF", "OFF BINARY"}) {
    check_error_line(error_of(word + "\n" + body, "a.off"), "a.off");
  }
  CHECK(has_note(parse("OFF " + body + "end\n", "a.off"), "ignored, from line 6"));
  CHECK(error_of("OFF " + body + "end\n3 2 1 0\n", "a.off")
            .starts_with("a.off: line 7: a row more than announced"));
  check_error_line(error_of("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n9 0 1 2\n", "a.off"), "a.off");
}

TEST_CASE("the format is told by content, then by name") {
  const Sample sample = random_strip(6, 9, true);
  check_same(parse(binary_ply<float>(sample.vertices, sample.faces, false), "a.stl"), sample);
  check_same(parse(off(sample.vertices, sample.faces), "a.obj"), sample);
  check_same(parse(ascii_stl(sample.vertices, sample.faces), "a.ply"), sample);
  check_same(parse(obj(sample.vertices, sample.faces), "/dev/fd/63"), sample);
  check_same(parse("# made\n" + obj(sample.vertices, sample.faces), "A.OBJ"), sample);
  check_same(parse("\xef\xbb\xbf" + off(sample.vertices, sample.faces), "pipe"), sample);
  check_same(parse("\xef\xbb\xbf" + obj(sample.vertices, sample.faces), "a.obj"), sample);
  check_error_line(error_of("hello\n", "a.txt"), "a.txt");
  CHECK(error_of("hello\n", "a.txt").find("neither content nor name") != std::string::npos);
}

TEST_CASE("formats that are not read are named, with what to do") {
  struct Known {
    const char* name;
    std::string bytes;
    const char* says;
  };
  const std::string rows = "0 0 0\n1 0 0\n0 1 0\n";
  const std::vector<Known> known = {
      {"a.step", "ISO-10303-21;\nHEADER;\n", "a STEP file (CAD geometry, no plain triangles)"},
      {"pipe", "ISO-10303-21;\nHEADER;\n", "a STEP file"},
      {"A.STP", "\nISO", "a STEP file"},
      {"a.iges", "x", "an IGES file"},
      {"a.x_t", "**PART1;", "a Parasolid file"},
      {"a.sldprt", "x", "a CAD program's file (CAD geometry, no plain triangles)"},
      {"pipe", "# vtk DataFile Version 3.0\n", "a VTK file, which is not read"},
      {"pipe", "$MeshFormat\n", "a Gmsh file, which is not read"},
      {"a.laz", "x", "a LAZ file of points, which is not read"},
      {"a.e57", "ASTM-E57", "an E57 file of points, which is not read"},
      {"a.ptx", rows, "a PTX file of points, which is not read"},
      {"a.pcd", "# .PCD v0.7\nVERSION 0.7\n", "a PCD file of points, which is not read"},
      {"a.dae", "<?xml version=\"1.0\"?>\n<COLLADA>", "a COLLADA file, which is not read"},
      {"a.obj", "<!DOCTYPE html><html>404</html>", "a web page"},
      {"a.FCStd", "PK\x03\x04" + std::string(40, '\0'), "a FreeCAD file"},
      {"a.fbx", "Kaydara FBX Binary  ", "an FBX file, which is not read"},
      {"a.nii", std::string(400, '\0'), "a NIfTI file (voxels, no faces)"},
  };
  for (const Known& file : known) {
    CAPTURE(file.name);
    const std::string line = error_of(file.bytes, file.name);
    check_error_line(line, file.name);
    CHECK(line.find(std::string(": ") + file.says) != std::string::npos);
    const bool are_points = std::string_view(file.says).find("of points") != std::string::npos;
    const size_t advice = line.find("--points", line.find("; expected"));
    CHECK((advice != std::string::npos) == are_points);
    CHECK(error_of(file.bytes, file.name, true).find(file.says) != std::string::npos);
  }
  // Content that reads as a mesh is one, under any file name.
  const Sample sample = random_strip(6, 9, true);
  check_same(parse(obj(sample.vertices, sample.faces), "a.asc"), sample);
  check_same(parse(binary_ply<float>(sample.vertices, sample.faces, false), "a.step"), sample);
}

TEST_CASE("points alone are named as such") {
  const std::string points = "v 0 0 0\nv 1 0 0\n";
  CHECK(error_of(points, "a.obj")
            .starts_with("a.obj: line 2: 2 points and no face; expected a mesh"));
  const std::string header =
      "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\n"
      "property float y\nproperty float z\n";
  CHECK(error_of(header + "end_header\n0 0 0\n1 0 0\n", "a.ply")
            .starts_with("a.ply: line 7: 2 points and no element 'face'; expected a mesh"));
}

TEST_CASE("a file that is not there is said to be so, without a place in it") {
  try {
    vkh::read_mesh("no such folder/a.obj");
    FAIL("read");
  } catch (const InputError& error) {
    CHECK(std::string(error.what()).starts_with("no such folder/a.obj: no such file; expected "));
  }
}

TEST_CASE("each note begins with its code") {
  const std::string tail = "f 1 2 3 4\nf 1 2\nl 1 2\nsurf 1\ncall x\n// x\n";
  const ReadMesh mesh = parse("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n" + tail, "a.obj");
  CHECK(mesh.notes.size() == 6);
  for (const std::string& note : lines_of(mesh.notes)) {
    CAPTURE(note);
    CHECK(vkh::code_named(note.substr(0, note.find(": "))).has_value());
    CHECK(note.find_first_of("0123456789") != std::string::npos);
  }
  CHECK(!vkh::code_named("left out"));
  CHECK(vkh::code_named("polygons") == vkh::NoteCode::kPolygons);
  CHECK(vkh::is_for_servers(vkh::NoteCode::kBodies));
  CHECK(!vkh::is_for_servers(vkh::NoteCode::kUnread));
}

TEST_CASE("error lines stay one printable line") {
  const std::string line = error_of("v 0 \x01\xff" + std::string(99, 'x') + " 0\n", "a\nb.obj");
  check_error_line(line, "a?b.obj");
  CHECK(line.find("'\\x01\\xffxxx") != std::string::npos);
  CHECK(line.size() < 200);
}
