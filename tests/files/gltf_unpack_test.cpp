// EXT_ and KHR_meshopt_compression: data that meshoptimizer packed comes out unchanged, and no more
// than the packed bytes can hold is allocated. Without meshoptimizer: a refusal that names its
// package.
#include "host/read/gltf_unpack.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <tuple>

#include "tests/files/gltf_document.h"
#include "tests/shapes/shapes.h"
#include "vkhausdorff/error.h"

#ifdef VKH_HAS_MESHOPTIMIZER
#include <meshoptimizer.h>
#endif

using namespace vkh;
using namespace vkh::test;

namespace {

/// A document of the icosphere in float, 16 bytes per vertex, so that its views can be packed and
/// plain.
struct Sphere {
  std::vector<float> vertices;
  std::vector<uint32_t> indices;
};

Sphere sphere() {
  const Mesh mesh = icosphere(1, 3);
  Sphere out;
  for (const glm::dvec3& v : mesh.vertices)
    for (const double x : {v.x, v.y, v.z, 0.0}) out.vertices.push_back(static_cast<float>(x));
  for (const glm::uvec3& f : mesh.faces)
    for (int c = 0; c < 3; ++c) out.indices.push_back(f[c]);
  return out;
}

/// The document with these bytes for its two views.
Document document_of(const Sphere& from, const std::string& vertices, const std::string& indices) {
  Document document;
  const size_t positions = document.add_accessor({{"bufferView", document.add_view(vertices, 16)},
                                                  {"componentType", kFloatType},
                                                  {"count", from.vertices.size() / 4},
                                                  {"type", "VEC3"}});
  const size_t corners = document.add_accessor({{"bufferView", document.add_view(indices)},
                                                {"componentType", kUintType},
                                                {"count", from.indices.size()},
                                                {"type", "SCALAR"}});
  document.add_mesh(positions, {{"indices", corners}});
  return document;
}

/// The views are packed, and fall back on a buffer without data.
Document packed_document(const Sphere& from, const std::string& vertices,
                         const std::string& indices) {
  Document document = document_of(from, vertices, indices);
  Json& views = document.json["bufferViews"];
  const size_t sizes[] = {from.vertices.size() * 4, from.indices.size() * 4};
  for (size_t i = 0; i < 2; ++i) {
    views[i]["extensions"]["EXT_meshopt_compression"] = {
        {"buffer", 0},
        {"byteOffset", views[i]["byteOffset"]},
        {"byteLength", views[i]["byteLength"]},
        {"byteStride", i == 0 ? 16 : 4},
        {"count", i == 0 ? from.vertices.size() / 4 : from.indices.size()},
        {"mode", i == 0 ? "ATTRIBUTES" : "TRIANGLES"}};
    views[i]["buffer"] = 1;
    views[i]["byteOffset"] = 0;
    views[i]["byteLength"] = sizes[i];
  }
  document.json["extensionsRequired"] = {"EXT_meshopt_compression"};
  return document;
}

}  // namespace

#ifdef VKH_HAS_MESHOPTIMIZER
namespace {

std::string packed_vertices(const std::vector<float>& rows) {
  const size_t count = rows.size() / 4;
  std::string out(meshopt_encodeVertexBufferBound(count, 16), '\0');
  out.resize(meshopt_encodeVertexBuffer(reinterpret_cast<unsigned char*>(out.data()), out.size(),
                                        rows.data(), count, 16));
  return out;
}

std::string packed_indices(const std::vector<uint32_t>& indices, size_t vertices) {
  std::string out(meshopt_encodeIndexBufferBound(indices.size(), vertices), '\0');
  out.resize(meshopt_encodeIndexBuffer(reinterpret_cast<unsigned char*>(out.data()), out.size(),
                                       indices.data(), indices.size()));
  return out;
}

void check_refused(const Document& document, const std::string& says) {
  CHECK_THROWS_WITH_AS(parse(document), doctest::Contains(says.c_str()), InputError);
}

Json& extension(Document& document, size_t view) {
  return document.json["bufferViews"][view]["extensions"]["EXT_meshopt_compression"];
}

/// Faces may begin at another corner.
std::vector<glm::dvec3> sorted_corners(const Mesh& mesh, size_t face) {
  std::vector<glm::dvec3> corners;
  for (int c = 0; c < 3; ++c) corners.push_back(mesh.vertices[mesh.faces[face][c]]);
  std::sort(corners.begin(), corners.end(), [](const glm::dvec3& p, const glm::dvec3& q) {
    return std::tie(p.x, p.y, p.z) < std::tie(q.x, q.y, q.z);
  });
  return corners;
}

}  // namespace

TEST_CASE("packed views are read as what was packed") {
  const Sphere from = sphere();
  const ReadMesh plain = parse(document_of(from, raw(from.vertices), raw(from.indices)));
  const Document document = packed_document(from, packed_vertices(from.vertices),
                                            packed_indices(from.indices, from.vertices.size() / 4));
  const ReadMesh mesh = parse(document);
  REQUIRE(mesh.faces.size() == plain.faces.size());
  for (size_t f = 0; f < mesh.faces.size(); ++f)
    CHECK(sorted_corners(mesh, f) == sorted_corners(plain, f));
  CHECK(mesh.delta == 0);
}

TEST_CASE("the extension as Khronos ratified it is read, too; unknown codecs are refused") {
  const Sphere from = sphere();
  const std::string vertices = packed_vertices(from.vertices);
  const Document ext =
      packed_document(from, vertices, packed_indices(from.indices, from.vertices.size() / 4));
  Document khr = ext;
  for (Json& view : khr.json["bufferViews"])
    view["extensions"] = {
        {"KHR_meshopt_compression", view["extensions"]["EXT_meshopt_compression"]}};
  khr.json["extensionsRequired"] = {"KHR_meshopt_compression"};
  CHECK(parse(khr).vertices == parse(ext).vertices);
  CHECK(parse(khr).faces == parse(ext).faces);
  // The first byte has the codec's version in its lower half; the highest version is unused.
  Document later = khr;
  later.binary[0] = static_cast<char>(0xaf);
  check_refused(later, "its meshopt compression cannot be undone");
}

TEST_CASE("indices in sequence, and the exponential filter") {
  const Sphere from = sphere();
  std::string sequence(meshopt_encodeIndexSequenceBound(from.indices.size(), 1000), '\0');
  sequence.resize(meshopt_encodeIndexSequence(reinterpret_cast<unsigned char*>(sequence.data()),
                                              sequence.size(), from.indices.data(),
                                              from.indices.size()));
  std::vector<float> filtered(from.vertices.size());
  meshopt_encodeFilterExp(filtered.data(), filtered.size() / 4, 16, 15, from.vertices.data());
  Document document = packed_document(from, packed_vertices(filtered), sequence);
  extension(document, 0)["filter"] = "EXPONENTIAL";
  extension(document, 1)["mode"] = "INDICES";
  const ReadMesh mesh = parse(document);
  const ReadMesh plain = parse(document_of(from, raw(from.vertices), raw(from.indices)));
  CHECK(mesh.faces == plain.faces);  // a sequence keeps every corner where it was
  for (size_t v = 0; v < mesh.vertices.size(); ++v)
    CHECK(glm::distance(mesh.vertices[v], plain.vertices[v]) < 1e-3);  // 15 bits
}

TEST_CASE("packed views that cannot be are refused before they are allocated") {
  const Sphere from = sphere();
  const std::string vertices = packed_vertices(from.vertices),
                    indices = packed_indices(from.indices, from.vertices.size() / 4);
  const auto refused = [&](size_t view, const char* key, const Json& value, const char* says) {
    Document document = packed_document(from, vertices, indices);
    extension(document, view)[key] = value;
    check_refused(document, says);
  };
  refused(0, "count", 10, "differ from byteLength");
  refused(0, "byteStride", 10, "do not go together");
  refused(0, "byteStride", 260, "do not go together");
  refused(0, "mode", "HOPES", "do not go together");
  refused(0, "filter", "OCTAHEDRAL", "do not go together");
  refused(1, "byteStride", 3, "do not go together");
  refused(1, "filter", "EXPONENTIAL", "do not go together");
  refused(0, "count", 4'000'000'000u, "more elements than its bytes can hold");
  refused(0, "byteLength", vertices.size() - 1, "cannot be undone");
  refused(0, "byteLength", 1u << 30, "1073741824 bytes from 0 of ");
  refused(0, "buffer", 1, "buffers[1]: there is none");
  Document cut = packed_document(from, std::string(vertices.size(), '\x7f'), indices);
  check_refused(cut, "cannot be undone");
}

TEST_CASE("what is unpacked is held against the limit") {
  const std::vector<float> zeros(4 * 100'000);
  Sphere from{zeros, {0, 1, 2}};
  Document document = packed_document(from, packed_vertices(zeros), packed_indices({0, 1, 2}, 3));
  const std::string text = document.text();
  REQUIRE(text.size() < 100'000);
  CHECK(parse(text).faces.size() == 1);
  CHECK_THROWS_WITH_AS(parse(text, {.max_input_bytes = 1'000'000}),
                       doctest::Contains("it takes 1600000 bytes, beyond the limit"), InputError);
}
#else
TEST_CASE("without meshoptimizer a packed view is refused by name") {
  const Sphere from = sphere();
  CHECK_THROWS_WITH_AS(parse(packed_document(from, "x", "x")),
                       doctest::Contains("libmeshoptimizer-dev"), InputError);
}
#endif
