// glTF 2.0 and GLB: the mesh is the specification's, vertex by vertex.
#include <doctest/doctest.h>

#include <cmath>
#include <filesystem>

#include "tests/files/gltf_document.h"
#include "tests/shapes/shapes.h"
#include "tests/support/program.h"
#include "tests/verification/oracle/exact.h"
#include "vkhausdorff/error.h"
#include "vkhausdorff/mesh_io.h"

using namespace vkh;
using namespace vkh::test;

namespace {

using Faces = std::vector<glm::uvec3>;

/// Five points on a line of steps, so that a vertex's x is its number in the file.
Document numbered(int mode, const std::vector<uint32_t>& indices) {
  Document document;
  const size_t positions = document.add_positions({0, 0, 0, 1, 0, 1, 2, 1, 0, 3, 0, 2, 4, 3, 0});
  Json more = {{"mode", mode}};
  if (!indices.empty()) more["indices"] = document.add_indices(indices);
  document.add_mesh(positions, more);
  return document;
}

/// The faces by the numbers in the file.
Faces faces_in_file(const Mesh& mesh) {
  Faces faces = mesh.faces;
  for (glm::uvec3& f : faces) {
    for (int c = 0; c < 3; ++c) f[c] = static_cast<uint32_t>(mesh.vertices[f[c]].x);
  }
  return faces;
}

std::string refusal(const std::string& bytes) {
  try {
    parse(bytes);
  } catch (const InputError& error) {
    return error.what();
  }
  return "it was read";
}
std::string refusal(const Document& document) { return refusal(document.text()); }

void check_refused(const Document& document, const std::string& says) {
  const std::string said = refusal(document);
  CAPTURE(said);
  CHECK(said.find(says) != std::string::npos);
}

bool has_note(const ReadMesh& mesh, const std::string& says) {
  for (const std::string& note : lines_of(mesh.notes)) {
    if (note.find(says) != std::string::npos) return true;
  }
  return false;
}

}  // namespace

TEST_CASE("triangles, strips and fans, with indices of every size and without") {
  CHECK(faces_in_file(parse(numbered(4, {0, 1, 2, 2, 1, 4}))) == Faces{{0, 1, 2}, {2, 1, 4}});
  CHECK(faces_in_file(parse(numbered(5, {0, 1, 2, 3, 4}))) ==
        Faces{{0, 1, 2}, {2, 1, 3}, {2, 3, 4}});
  CHECK(faces_in_file(parse(numbered(5, {}))) == Faces{{0, 1, 2}, {2, 1, 3}, {2, 3, 4}});
  CHECK(faces_in_file(parse(numbered(6, {4, 1, 2, 3}))) == Faces{{4, 1, 2}, {4, 2, 3}});
  CHECK(faces_in_file(parse(numbered(6, {}))) == Faces{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}});
  Document document = numbered(4, {});
  const Faces expected = {{3, 1, 2}};
  const size_t bytes = document.add_indices<uint8_t>({3, 1, 2}),
               shorts = document.add_indices<uint16_t>({3, 1, 2});
  for (const size_t indices : {bytes, shorts}) {
    document.json["meshes"][0]["primitives"][0]["indices"] = indices;
    CHECK(faces_in_file(parse(document)) == expected);
  }
  check_refused(numbered(4, {0, 1, 2, 3}), "meshes[0]: 4 corners are no whole triangles");
  check_refused(numbered(5, {0, 1}), "2 corners");
  check_refused(numbered(7, {0, 1, 2}), "unknown mode");
  check_refused(numbered(4, {0, 1, 5}), "accessors[0]: index 5 of 5 positions");
}

TEST_CASE("points and lines are noted, and no mesh is made of them alone") {
  for (int mode = 0; mode < 4; ++mode)
    check_refused(numbered(mode, {}), "the file ends without a face");
  Document document = numbered(4, {0, 1, 2});
  document.json["meshes"][0]["primitives"].push_back(
      {{"attributes", {{"POSITION", 0}}}, {"mode", 1}});
  document.json["meshes"][0]["primitives"].push_back({{"attributes", {{"NORMAL", 0}}}});
  const ReadMesh mesh = parse(document);
  CHECK(mesh.faces.size() == 1);
  CHECK(has_note(mesh, "1 primitive of points or lines ignored"));
  CHECK(has_note(mesh, "1 primitive without positions ignored"));
}

TEST_CASE("a document, one with its buffer embedded, beside it, and a GLB are one mesh") {
  Document document = numbered(4, {0, 1, 2, 2, 1, 4});
  const ReadMesh embedded = parse(document);
  const ReadMesh glb = parse(document.glb());
  std::filesystem::create_directories(folder() / "in side");
  write_file("in side/a b.bin", document.binary + "more");
  Json json = document.json;
  json["buffers"] = {{{"byteLength", document.binary.size()}, {"uri", "in%20side/a b.bin"}}};
  const ReadMesh beside = read_mesh(write_file("beside.gltf", json.dump()));
  for (const Mesh* mesh : {&glb, &beside}) {
    CHECK(mesh->vertices == embedded.vertices);
    CHECK(mesh->faces == embedded.faces);
  }
  CHECK(embedded.unit == "m");
  CHECK(embedded.delta == 0);
  // Some writers escape every slash.
  std::string escaped = document.text();
  for (size_t at = 0; (at = escaped.find('/', at)) != std::string::npos; at += 2)
    escaped.insert(at, "\\");
  CHECK(parse(escaped).vertices == embedded.vertices);
  CHECK(parse("\xef\xbb\xbf \n" + document.text()).vertices == embedded.vertices);
}

TEST_CASE("escapes of JSON are resolved in data and in names") {
  const Document document = numbered(4, {0, 1, 2, 2, 1, 4});
  const ReadMesh plain = parse(document);
  std::string escaped;
  bool is_value = false;  // from the data's mark to the end of its string
  const std::string text = document.text();
  for (size_t i = 0; i < text.size(); ++i) {
    is_value = is_value ? text[i] != '"' : i >= 5 && text.substr(i - 5, 5) == "data:";
    char code[8];
    std::snprintf(code, sizeof code, i % 2 == 0 ? "\\u%04x" : "\\u%04X", text[i]);
    escaped += is_value ? std::string(code) : std::string(1, text[i]);
  }
  CHECK(parse(escaped).vertices == plain.vertices);
  CHECK(parse(escaped).faces == plain.faces);
  std::string broken = escaped;
  broken.replace(broken.find("\\u"), 6, "\\ud83d");
  CHECK(refusal(broken) != "it was read");
  for (const auto& name :
       std::vector<std::pair<std::string, std::string>>{{"Geh\\u00e4use.bin", "Geh\u00e4use.bin"},
                                                        {"\\ud83d\\ude00.bin", "\U0001f600.bin"},
                                                        {"in\\/x.bin", "in/x.bin"},
                                                        {"part 10%.bin", "part 10%.bin"},
                                                        {"a%20b.bin", "a%20b.bin"},
                                                        {"c%20d.bin", "c d.bin"}}) {
    const std::string& uri = name.first;
    CAPTURE(uri);
    std::filesystem::create_directories(folder() / "in");
    write_file(name.second, document.binary);
    Json json = document.json;
    json["buffers"] = {{{"byteLength", document.binary.size()}, {"uri", "URI"}}};
    std::string whole = json.dump();
    whole.replace(whole.find("URI"), 3, uri);
    CHECK(read_mesh(write_file("escaped.gltf", whole)).vertices == plain.vertices);
  }
}

TEST_CASE("of two files that a URI may name, the one with percents resolved is read") {
  const Document document = triangle_document();
  write_file("two%20names.bin", std::string(document.binary.size(), '\0'));
  write_file("two names.bin", document.binary);
  Json json = document.json;
  json["buffers"] = {{{"byteLength", document.binary.size()}, {"uri", "two%20names.bin"}}};
  CHECK(read_mesh(write_file("two.gltf", json.dump())).vertices == parse(document).vertices);
}

TEST_CASE("hidden nodes are left out with what is below them, and counted") {
  Document document = triangle_document();
  const Json hidden = {{"KHR_node_visibility", {{"visible", false}}}};
  document.json["nodes"] = {{{"mesh", 0}},
                            {{"children", {2}}, {"extensions", hidden}},
                            {{"mesh", 0}, {"translation", {9, 0, 0}}},
                            {{"mesh", 0},
                             {"translation", {0, 0, 1}},
                             {"extensions", {{"KHR_node_visibility", {{"visible", true}}}}}}};
  document.json["scenes"] = {{{"nodes", {0, 1, 3}}}};
  document.json["extensionsRequired"] = {"KHR_node_visibility"};
  const ReadMesh mesh = parse(document);
  CHECK(mesh.faces.size() == 2);
  CHECK(has_note(mesh, "bodies: left out: 1 hidden node and what is below"));
  const ReadMesh all = parse(document.text(), {.bodies = Bodies::kAll});
  REQUIRE(all.faces.size() == 3);
  CHECK(all.vertices[3] == glm::dvec3(9, 0, 0));
  CHECK(has_note(all, "bodies: included, though not shown: 1 hidden node and what is below"));
}

TEST_CASE("extensions that leave a shape alone may be required") {
  Document document = triangle_document();
  document.json["extensionsRequired"] = {"KHR_animation_pointer", "EXT_lights_image_based"};
  CHECK(parse(document).faces.size() == 1);
}

TEST_CASE("nothing outside the file's folder is opened") {
  const Document document = triangle_document();
  std::filesystem::create_directories(folder() / "jail");
  const std::string outside = write_file("outside.bin", document.binary);
  std::filesystem::create_symlink(outside, folder() / "jail/link.bin");
  std::filesystem::create_symlink(folder() / "", folder() / "jail/up");
  for (const std::string uri :
       {"../outside.bin", "%2e%2e/outside.bin", "..%2Foutside.bin", "a/../../outside.bin",
        "link.bin", "up/outside.bin", "http://localhost/outside.bin", "file:///etc/passwd",
        "/etc/passwd", "..\\\\outside.bin", "missing.bin", "", "."}) {
    CAPTURE(uri);
    Json json = document.json;
    json["buffers"] = {{{"byteLength", document.binary.size()}, {"uri", uri}}};
    const std::string path = write_file("jail/file.gltf", json.dump());
    CHECK_THROWS_WITH_AS(read_mesh(path), doctest::Contains("buffers[0]: "), InputError);
    CHECK_THROWS_AS(parse(json.dump()), InputError);  // bytes without a folder
  }
}

TEST_CASE("the files beneath a document are those that reading opens") {
  Document document = triangle_document();
  const size_t size = document.binary.size();
  std::filesystem::create_directories(folder() / "beneath/in");
  const std::string outside = write_file("beyond.bin", document.binary);
  std::filesystem::create_symlink(outside, folder() / "beneath/link.bin");
  for (const char* name : {"beneath/a b.bin", "beneath/in/x.bin", "beneath/unused.bin"})
    write_file(name, document.binary);
  const auto beneath = [&](const Json& buffers, const std::string& bytes) {
    std::string text = document.json.dump();
    if (!buffers.is_null()) {
      Json json = document.json;
      json["buffers"] = buffers;
      text = json.dump();
    }
    if (!bytes.empty()) text = bytes;
    std::vector<std::pair<std::string, bool>> files;
    for (const FileBeneath& file : files_beneath(write_file("beneath/file.gltf", text)))
      files.emplace_back(file.name, !file.path.empty());
    return files;
  };
  using Files = std::vector<std::pair<std::string, bool>>;
  const auto named = [&](const std::string& uri) {
    return Json{{"byteLength", size}, {"uri", uri}};
  };
  const Json both = {named("a%20b.bin"), named("unused.bin")};
  CHECK(beneath(both, "") == Files{{"a b.bin", true}});  // no accessor is of the second buffer
  CHECK(read_mesh(folder() / "beneath/file.gltf").faces.size() == 1);
  CHECK(beneath(Json::array({named("gone.bin")}), "") == Files{{"gone.bin", false}});
  CHECK(beneath(Json::array({named("link.bin")}), "") ==
        Files{{"link.bin", false}});  // is not opened
  CHECK(beneath(Json::array({named("../beyond.bin")}), "").empty());
  CHECK(beneath({}, document.text()).empty());  // embedded
  CHECK(beneath({}, document.glb()).empty());
  CHECK(beneath({}, "\xef\xbb\xbf" + Json(document.json).dump()).empty());  // without buffers
  CHECK(beneath({}, "{").empty());
  CHECK(files_beneath(write_file("plain.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")).empty());
  CHECK(files_beneath(folder() / "no such file").empty());

  // Sparse values, indices, and a compressed view's own buffer are read, too, each file once.
  document.json["accessors"][0]["sparse"] = {
      {"count", 1},
      {"indices", {{"bufferView", 1}, {"componentType", kUbyteType}}},
      {"values", {{"bufferView", 2}}}};
  document.json["bufferViews"].push_back({{"buffer", 1}, {"byteLength", 1}});
  document.json["bufferViews"].push_back({{"buffer", 2}, {"byteLength", 12}});
  const Json three = {named("in/x.bin"), named("unused.bin"), named("in/x.bin")};
  CHECK(beneath(three, "") == Files{{"in/x.bin", true}, {"unused.bin", true}});
  document.json["bufferViews"][0]["extensions"]["EXT_meshopt_compression"] = {
      {"buffer", 1}, {"byteLength", 9}, {"byteStride", 12}, {"count", 3}, {"mode", "ATTRIBUTES"}};
  document.json["accessors"][0].erase("sparse");
  CHECK(beneath(three, "") == Files{{"unused.bin", true}});

  // Meshes that no node shows are not read.
  document.json["nodes"][0]["extensions"]["KHR_node_visibility"] = {{"visible", false}};
  CHECK(beneath(three, "").empty());
  CHECK(files_beneath(folder() / "beneath/file.gltf", {.bodies = Bodies::kAll}).size() == 1);
}

TEST_CASE("a GLB may name files, too") {
  const Document document = triangle_document();
  Document outer = document;
  write_file("of a glb.bin", document.binary);
  outer.json["buffers"] = {{{"byteLength", document.binary.size()}, {"uri", "of%20a%20glb.bin"}}};
  const std::string text =
      outer.json.dump() + std::string(3 - (outer.json.dump().size() + 3) % 4, ' ');
  const auto word = [](size_t x) { return raw<uint32_t>({static_cast<uint32_t>(x)}); };
  const std::string glb =
      "glTF" + word(2) + word(20 + text.size()) + word(text.size()) + "JSON" + text;
  const std::string path = write_file("names.glb", glb);
  CHECK(read_mesh(path).vertices == parse(document).vertices);
  const std::vector<FileBeneath> files = files_beneath(path);
  REQUIRE(files.size() == 1);
  CHECK(files[0].name == "of a glb.bin");
  for (const size_t size : {3u, 4u, 19u, 20u, 40u})  // cut short
    CHECK(files_beneath(write_file("short.glb", glb.substr(0, size))).empty());
}

TEST_CASE("strided, offset and sparse accessors") {
  Document document;
  std::vector<float> rows = {9, 9};
  for (int i = 0; i < 4; ++i) {
    for (const float x : {static_cast<float>(i), 1.0f, static_cast<float>(i % 2), 7.0f, 8.0f})
      rows.push_back(x);
  }
  const size_t view = document.add_view(raw(rows), 20);
  const Json strided = {{"bufferView", view},
                        {"byteOffset", 8},
                        {"componentType", kFloatType},
                        {"count", 4},
                        {"type", "VEC3"}};
  const size_t plain = document.add_accessor(strided);
  document.add_mesh(plain, {{"mode", 5}});
  const ReadMesh mesh = parse(document);
  CHECK(mesh.vertices == std::vector<glm::dvec3>{{0, 1, 0}, {1, 1, 1}, {2, 1, 0}, {3, 1, 1}});
  Json sparse = strided;
  sparse["sparse"] = {
      {"count", 2},
      {"indices",
       {{"bufferView", document.add_view(raw<uint16_t>({1, 3}))}, {"componentType", kUshortType}}},
      {"values", {{"bufferView", document.add_view(raw<float>({5, 6, 7, 8, 9, 10}))}}}};
  document.json["accessors"][plain] = sparse;
  CHECK(parse(document).vertices ==
        std::vector<glm::dvec3>{{0, 1, 0}, {5, 6, 7}, {2, 1, 0}, {8, 9, 10}});
  document.json["accessors"][plain].erase("bufferView");  // zeros
  document.json["accessors"][plain].erase("byteOffset");
  CHECK(parse(document).vertices ==
        std::vector<glm::dvec3>{{0, 0, 0}, {5, 6, 7}, {0, 0, 0}, {8, 9, 10}});
  document.json["accessors"][plain]["count"] = 4'000'000;
  check_refused(document, "4000000 elements of zeros");
  document.json["accessors"][plain]["count"] = 3;
  check_refused(document, "sparse index 3 is out of order or of range");
  document.json["accessors"][plain] = strided;
  document.json["accessors"][plain]["byteOffset"] = 12;
  CHECK(parse(document).faces.size() == 2);
  document.json["accessors"][plain]["byteOffset"] = 20;
  check_refused(document, "accessors[0]: 4 elements leave their buffer view");
  document.json["accessors"][plain]["byteOffset"] = uint64_t{1} << 52;
  check_refused(document, "leave their buffer view");
}

TEST_CASE("integers are exact, and normalised ones within the delta that is said") {
  const std::vector<int16_t> given = {0, 1, -32768, 0, 32767, -32767, 0, 12345, -1, 0, 3, 0};
  Document document;
  const size_t accessor = document.add_accessor({{"bufferView", document.add_view(raw(given), 8)},
                                                 {"componentType", kShortType},
                                                 {"count", 3},
                                                 {"type", "VEC3"}});
  document.add_mesh(accessor);
  document.json["extensionsRequired"] = {"KHR_mesh_quantization"};
  const ReadMesh exact = parse(document);
  CHECK(exact.vertices == std::vector<glm::dvec3>{{0, 1, -32768}, {32767, -32767, 0}, {-1, 0, 3}});
  CHECK(exact.delta == 0);
  document.json["accessors"][accessor]["normalized"] = true;
  const ReadMesh mesh = parse(document);
  CHECK(mesh.vertices[0].z == -1);  // the least, too
  CHECK(mesh.delta > 0);
  CHECK(mesh.delta < 0x1p-50);
  for (size_t v = 0; v < 3; ++v) {
    Rational squared = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double integer = exact.vertices[v][axis];
      const Rational truth = integer == -32768 ? Rational(-1) : Rational(integer) / 32767;
      const Rational off = Rational(mesh.vertices[v][axis]) - truth;
      squared += off * off;
    }
    CHECK(squared <= Rational(mesh.delta) * Rational(mesh.delta));
  }
}

TEST_CASE("nodes place their meshes, parents before children, and the delta bounds how well") {
  Document document;
  const std::vector<float> xyz = {0.1f, 0.2f, 0.3f, 1.5f, -0.7f, 0.4f, 0.3f, 2.5f, -1.25f};
  document.add_mesh(document.add_positions(xyz));
  document.json["nodes"] = {
      {{"children", {1, 2}}, {"translation", {0.1, 0.2, 0.3}}, {"scale", {2, 3, 0.7}}},
      {{"mesh", 0}, {"matrix", {0, 0.3, 0, 0, -0.1, 0, 0, 0, 0, 0, 1, 0, 5, 6, 7, 1}}},
      {{"mesh", 0}}};
  const ReadMesh mesh = parse(document);
  REQUIRE(mesh.faces == Faces{{0, 1, 2}, {3, 4, 5}});
  CHECK(mesh.delta > 0);
  CHECK(mesh.delta < 1e-13);
  const Rational scale[] = {2, 3, Rational(0.7)},
                 move[] = {Rational(0.1), Rational(0.2), Rational(0.3)};
  for (size_t v = 0; v < 6; ++v) {
    const size_t p = v % 3 * 3;
    const Rational x = Rational(static_cast<double>(xyz[p])),
                   y = Rational(static_cast<double>(xyz[p + 1])),
                   z = Rational(static_cast<double>(xyz[p + 2]));
    Rational image[] = {x, y, z};
    if (v < 3) {
      image[0] = Rational(-0.1) * y + 5;
      image[1] = Rational(0.3) * x + 6;
      image[2] = z + 7;
    }
    Rational squared = 0;
    for (int i = 0; i < 3; ++i) {
      const Rational off = scale[i] * image[i] + move[i] - Rational(mesh.vertices[v][i]);
      squared += off * off;
    }
    CHECK(squared <= Rational(mesh.delta) * Rational(mesh.delta));
  }
}

/// A node's part of the chain, and the sign of its determinant.
int sign_of_node(Json& node, Random& random) {
  const auto number = [&] { return static_cast<double>(random.below(5)) - 2.0; };
  if (random.below(3) == 0) {
    const double a[3][3] = {{number(), number(), number()},
                            {number(), number(), number()},
                            {number(), number(), number()}};
    const double of = a[0][0] * (a[1][1] * a[2][2] - a[1][2] * a[2][1]) +
                      a[0][1] * (a[1][2] * a[2][0] - a[1][0] * a[2][2]) +
                      a[0][2] * (a[1][0] * a[2][1] - a[1][1] * a[2][0]);
    node["matrix"] = {a[0][0], a[1][0], a[2][0], 0, a[0][1], a[1][1], a[2][1], 0,
                      a[0][2], a[1][2], a[2][2], 0, 5,       6,       7,       1};
    return of > 0 ? 1 : of < 0 ? -1 : 0;
  }
  int sign = 1;
  Json scale = Json::array();
  for (int axis = 0; axis < 3; ++axis) {
    const double s = random.below(12) == 0 ? 0 : random.below(2) == 0 ? -1.5 : 0.25;
    sign *= s > 0 ? 1 : s < 0 ? -1 : 0;
    scale.push_back(s);
  }
  if (random.below(4) != 0) {
    node["scale"] = scale;
  } else {
    sign = 1;
  }
  node["rotation"] = {0.5, -0.5, 0.5, 0.5};
  return sign;
}

TEST_CASE("mirrors of nodes and of their parents turn faces round, in lists, strips and fans") {
  Random random(55);
  int mirrored = 0, flat = 0;
  for (int i = 0; i < 2000; ++i) {
    const int mode = 4 + static_cast<int>(random.below(3));
    Document document = numbered(mode, {0, 1, 2, 3, 4, 0});
    Document plain = document;
    const uint32_t levels = 1 + random.below(4);
    document.json["nodes"] = Json::array();
    int sign = 1;
    for (uint32_t level = 0; level < levels; ++level) {
      Json node = Json::object();
      sign *= sign_of_node(node, random);
      if (level + 1 == levels) {
        node["mesh"] = 0;
      } else {
        node["children"] = {level + 1};
      }
      document.json["nodes"].push_back(node);
    }
    Faces expected = parse(plain).faces;
    for (glm::uvec3& face : expected)
      if (sign < 0) std::swap(face.y, face.z);
    mirrored += sign < 0 ? 1 : 0;
    flat += sign == 0 ? 1 : 0;
    CHECK(parse(document).faces == expected);
  }
  CHECK(mirrored > 400);
  CHECK(flat > 100);
}

TEST_CASE("a node's weights override those of its mesh") {
  Document document = triangle_document();
  document.json["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", 0}}};
  document.json["meshes"][0]["weights"] = {1};
  document.json["nodes"][0]["weights"] = {0};
  CHECK(has_note(parse(document), "morph targets at weight 0: the base shape"));
  document.json["nodes"][0]["weights"] = {1};
  check_refused(document, "morph targets at weights other than 0");
  document.json["meshes"][0]["weights"] = {0};
  check_refused(document, "morph targets at weights other than 0");
}

TEST_CASE("a mesh is at every node that names it, and no node twice") {
  Document document = triangle_document();
  document.json["nodes"] = {{{"children", {1, 2}}},
                            {{"mesh", 0}, {"rotation", {0, 0, 0.70710678, 0.70710678}}},
                            {{"mesh", 0}, {"translation", {0, 0, 1}}},
                            {{"mesh", 0}}};  // in no scene
  const ReadMesh mesh = parse(document);
  REQUIRE(mesh.faces.size() == 2);
  CHECK(glm::dvec3(0, 1, 0) == mesh.vertices[1]);  // a quarter turn, exactly
  CHECK(mesh.vertices[4] == glm::dvec3(1, 0, 1));
  document.json["nodes"][1]["children"] = {0};
  check_refused(document, "nodes[0]: it has two parents, or is its own ancestor");
  document.json["nodes"][1]["children"] = {2};
  check_refused(document, "nodes[2]: it has two parents");
  document.json["nodes"][1]["children"] = {4};
  check_refused(document, "nodes[4]: there is none");
  document.json["nodes"][1] = {{"mesh", 0}, {"rotation", {0, 0, 0, 0}}};
  check_refused(document, "nodes[1]: a rotation of length 0");
  document.json["nodes"][1] = {{"mesh", 0}, {"rotation", {0, 0, 2, 2}}};
  CHECK(parse(document).vertices[1] == glm::dvec3(0, 1, 0));
  CHECK(has_note(parse(document), "1 rotation of a length other than 1"));
  document.json["nodes"][1] = {{"mesh", 0},
                               {"matrix", {1, 0, 0, 0.5, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}};
  check_refused(document, "nodes[1]: a matrix that is not affine");
}

TEST_CASE("the default scene is read, and said where there are others") {
  Document document = triangle_document();
  document.json["nodes"] = {{{"mesh", 0}}, {{"mesh", 0}, {"translation", {0, 0, 5}}}};
  document.json["scenes"] = {{{"nodes", {0}}}, {{"nodes", {1}}}, Json::object()};
  document.json["scene"] = 1;
  CHECK(parse(document).vertices[0].z == 5);
  CHECK(has_note(parse(document), "scene 1 of 3 read: the default"));
  document.json.erase("scene");
  CHECK(parse(document).vertices[0].z == 0);
  CHECK(has_note(parse(document), "scene 0 of 3 read: none is the default"));
  document.json["scene"] = 2;
  check_refused(document, "the file ends without a face");
  document.json["scene"] = 3;
  check_refused(document, "scene 3: there is none");
}

TEST_CASE("what would make a part of the whole is refused by name") {
  const auto refused = [](const std::string& says, const auto& change) {
    Document document = triangle_document();
    change(document.json);
    check_refused(document, says);
  };
  const auto primitive = [](Json& json) -> Json& { return json["meshes"][0]["primitives"][0]; };
  refused("'KHR_draco_mesh_compression' is required", [](Json& json) {
    json["extensionsRequired"] = {"KHR_materials_unlit", "KHR_draco_mesh_compression"};
  });
  refused("'VENDOR_unheard_of' is required",
          [](Json& json) { json["extensionsRequired"] = {"VENDOR_unheard_of"}; });
  refused("meshes[0]: KHR_draco_mesh_compression", [&](Json& json) {
    primitive(json)["extensions"] = {{"KHR_draco_mesh_compression", {{"bufferView", 0}}}};
    json["accessors"][0].erase("bufferView");
  });
  refused("nodes[0]: a skin", [](Json& json) { json["nodes"][0]["skin"] = 0; });
  refused("nodes[0]: EXT_mesh_gpu_instancing", [](Json& json) {
    json["nodes"][0]["extensions"] = {{"EXT_mesh_gpu_instancing", Json::object()}};
  });
  for (const char* at : {"nodes", "meshes"}) {
    refused("nodes[0]: morph targets at weights other than 0", [&](Json& json) {
      primitive(json)["targets"] = {{{"POSITION", 0}}};
      json[at][0]["weights"] = {0, 0.5};
    });
  }
  Document document = triangle_document();
  primitive(document.json)["targets"] = {{{"POSITION", 0}}};
  document.json["animations"] = {{{"name", "wave"}}};
  CHECK(has_note(parse(document), "morph targets at weight 0: the base shape"));
  CHECK(has_note(parse(document), "animations ignored"));
  // It can be read with its fallback buffer.
  primitive(document.json)["extensions"] = {{"KHR_draco_mesh_compression", {{"bufferView", 0}}}};
  CHECK(parse(document).faces.size() == 1);
}

TEST_CASE("documents that are none, or say a thing twice, are refused") {
  const std::string good = triangle_document().text();
  CHECK(refusal("{}").find("no asset") != std::string::npos);
  CHECK(refusal("{\"asset\":{\"version\":\"1.0\"}}").find("'1.0'") != std::string::npos);
  CHECK(refusal(good + "}").find("this is no JSON") != std::string::npos);
  CHECK(refusal(good.substr(0, good.size() - 1)).find("this is no JSON") != std::string::npos);
  const std::string twice = "{\"nodes\":[]," + good.substr(1);
  CHECK(refusal(twice).find("'nodes' a second time") != std::string::npos);
  CHECK(refusal("{\"scene\":1e400}").find("this is no JSON") != std::string::npos);
  CHECK(refusal("{\"scene\":-1}").find("'scene' is no number") != std::string::npos);
  CHECK(refusal("{\"scene\":0.5}").find("'scene' is no number") != std::string::npos);
  CHECK(refusal("{\"nodes\":{}}").find("'nodes' is an object, as in glTF 1.0") !=
        std::string::npos);
  CHECK(refusal("{\"nodes\":7}").find("'nodes' of another type") != std::string::npos);
  const std::string digits(5000, '0');
  CHECK(refusal("{\"scene\":1" + digits + "}").find("too many digits") != std::string::npos);
  const std::string glb = triangle_document().glb();
  CHECK(refusal(glb.substr(0, glb.size() - 4)).find("byte 8: ") != std::string::npos);
}

TEST_CASE("what does not matter may be anything: deep, long, of any type") {
  Document document = triangle_document();
  document.json["nodes"][0]["name"] = std::string(10'000, 'x');
  document.json["materials"] = {1, "a", {{"b", nullptr}}, true, {{{"c", 1.5}}}};
  CHECK(parse(document).faces.size() == 1);
  const std::string text = document.text(), deep(200'000, '['), end(200'000, ']');
  CHECK(parse("{\"extras\":" + deep + end + "," + text.substr(1)).faces.size() == 1);
  // Deeper than any scene.
  Json nodes = Json::array();
  for (int i = 0; i < 300; ++i) nodes.push_back({{"children", {i + 1}}});
  nodes.push_back({{"mesh", 0}});
  document.json["nodes"] = nodes;
  check_refused(document, "levels deep");
}

TEST_CASE("what a buffer takes is held against the limit") {
  Document document = numbered(4, {0, 1, 2});
  write_file("large.bin", document.binary + std::string(100'000, '\0'));
  Json json = document.json;
  json["buffers"] = {{{"byteLength", 100'000}, {"uri", "large.bin"}}};
  const std::string path = write_file("large.gltf", json.dump());
  CHECK(read_mesh(path).faces.size() == 1);
  CHECK_THROWS_WITH_AS(read_mesh(path, {.max_input_bytes = 100'000}),
                       doctest::Contains("buffers[0]: it takes 100000 bytes, beyond the limit"),
                       InputError);
}

TEST_CASE("the answer carries delta and unit" * doctest::test_suite("program")) {
  Document document = triangle_document();
  const std::string a = write_file("a.glb", document.glb());
  document.json["nodes"][0]["translation"] = {0.1, 0.1, 0.1};
  const std::string b = write_file("b.gltf", document.text());
  const Outcome outcome = run({"distance", a, b, "--json"});
  REQUIRE(outcome.exit_code == 0);
  const Json r = Json::parse(outcome.out);
  CHECK(r["inputs"][0]["delta"] == 0);
  CHECK(r["inputs"][0]["unit"] == "m");
  CHECK(r["inputs"][1]["delta"].get<double>() > 0);
  CHECK(r["inputs"][1]["delta"].get<double>() < 1e-14);
  CHECK(run({"distance", a, b}).out.find(": the interval is wider by it") != std::string::npos);
}
