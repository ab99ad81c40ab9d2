#include "host/write/mesh_file.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "host/base/decimal.h"
#include "host/base/hypot3.h"
#include "host/mesh/round_to_float.h"
#include "host/write/bytes.h"
#include "vkhausdorff/error.h"

namespace vkh {
namespace {

bool is_float(double x) { return round_to_float(x) == x; }

bool has_floats(const Mesh& mesh) {
  return std::all_of(mesh.vertices.begin(), mesh.vertices.end(), [](const DVec3& v) {
    return is_float(v.x) && is_float(v.y) && is_float(v.z);
  });
}

std::string mesh_as_ply(const Mesh& mesh) {
  const bool in_floats = has_floats(mesh);
  const std::string type = in_floats ? "float" : "double";
  Bytes out;
  out.text = "ply\nformat binary_little_endian 1.0\nelement vertex " +
             std::to_string(mesh.vertices.size()) + "\nproperty " + type + " x\nproperty " + type +
             " y\nproperty " + type + " z\nelement face " + std::to_string(mesh.faces.size()) +
             "\nproperty list uchar uint vertex_indices\nend_header\n";
  for (const DVec3& v : mesh.vertices) {
    for (const double x : {v.x, v.y, v.z}) {
      if (in_floats) {
        out.add(nearest_float(x));
      } else {
        out.add(x);
      }
    }
  }
  for (const UVec3& face : mesh.faces) {
    out.add(uint8_t{3});
    for (const uint32_t v : {face.x, face.y, face.z}) out.add(v);
  }
  return std::move(out.text);
}

/// The face's unit normal by its corners' order; 0 for a face without one.
DVec3 normal_of(const DVec3& a, const DVec3& b, const DVec3& c) {
  const DVec3 p = b - a, q = c - a;
  const DVec3 n(p.y * q.z - p.z * q.y, p.z * q.x - p.x * q.z, p.x * q.y - p.y * q.x);
  const double length = hypot3(n.x, n.y, n.z);
  return length > 0 && std::isfinite(length) ? n * (1 / length) : DVec3(0);
}

std::string mesh_as_stl(const Mesh& mesh) {
  Bytes out;
  out.text = "VkHausdorff: a binary STL";
  out.text.resize(80, ' ');
  out.add(static_cast<uint32_t>(mesh.faces.size()));
  for (const UVec3& face : mesh.faces) {
    const DVec3 &a = mesh.vertices[face.x], &b = mesh.vertices[face.y], &c = mesh.vertices[face.z];
    for (const DVec3& v : {normal_of(a, b, c), a, b, c})
      for (const double x : {v.x, v.y, v.z}) out.add(nearest_float(x));
    out.add(uint16_t{0});
  }
  return std::move(out.text);
}

std::string mesh_as_obj(const Mesh& mesh) {
  std::string text = "# VkHausdorff\n";
  for (const DVec3& v : mesh.vertices)
    text += "v " + shortest_decimal(v.x) + " " + shortest_decimal(v.y) + " " +
            shortest_decimal(v.z) + "\n";
  for (const UVec3& face : mesh.faces)
    text += "f " + std::to_string(face.x + 1) + " " + std::to_string(face.y + 1) + " " +
            std::to_string(face.z + 1) + "\n";
  return text;
}

using GlbJson = nlohmann::ordered_json;

/// The smallest and the largest position, which glTF requires.
void add_extent(const Mesh& mesh, GlbJson& position) {
  DVec3 lo = mesh.vertices[0], hi = lo;
  for (const DVec3& v : mesh.vertices) {
    for (int axis = 0; axis < 3; ++axis) {
      lo[axis] = std::min(lo[axis], v[axis]);
      hi[axis] = std::max(hi[axis], v[axis]);
    }
  }
  position["min"] = {nearest_float(lo.x), nearest_float(lo.y), nearest_float(lo.z)};
  position["max"] = {nearest_float(hi.x), nearest_float(hi.y), nearest_float(hi.z)};
}

GlbJson document_of(const Mesh& mesh) {
  constexpr int kFloat32 = 5126, kUnsignedInt = 5125;  // glTF 2.0, section 3.6.2
  constexpr int kVertexBuffer = 34962, kIndexBuffer = 34963;
  const size_t positions = 12 * mesh.vertices.size(), indices = 12 * mesh.faces.size();
  GlbJson position = {{"bufferView", 0},
                      {"componentType", kFloat32},
                      {"count", mesh.vertices.size()},
                      {"type", "VEC3"}};
  add_extent(mesh, position);
  const GlbJson index = {{"bufferView", 1},
                         {"componentType", kUnsignedInt},
                         {"count", 3 * mesh.faces.size()},
                         {"type", "SCALAR"}};
  return {
      {"asset", {{"version", "2.0"}, {"generator", "VkHausdorff"}}},
      {"scene", 0},
      {"scenes", {{{"nodes", {0}}}}},
      {"nodes", {{{"mesh", 0}}}},
      {"meshes", {{{"primitives", {{{"attributes", {{"POSITION", 0}}}, {"indices", 1}}}}}}},
      {"buffers", {{{"byteLength", positions + indices}}}},
      {"bufferViews",
       {{{"buffer", 0}, {"byteOffset", 0}, {"byteLength", positions}, {"target", kVertexBuffer}},
        {{"buffer", 0},
         {"byteOffset", positions},
         {"byteLength", indices},
         {"target", kIndexBuffer}}}},
      {"accessors", {position, index}}};
}

std::string mesh_as_glb(const Mesh& mesh) {
  Bytes binary;
  for (const DVec3& v : mesh.vertices)
    for (const double x : {v.x, v.y, v.z}) binary.add(nearest_float(x));
  for (const UVec3& face : mesh.faces)
    for (const uint32_t v : {face.x, face.y, face.z}) binary.add(v);
  return glb_of(document_of(mesh).dump(), binary.text);
}

}  // namespace

std::optional<MeshFormat> mesh_format_of(const std::string& path) {
  std::string ending = path.substr(path.size() - std::min<size_t>(path.size(), 4));
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (ending == ".ply") return MeshFormat::kPly;
  if (ending == ".stl") return MeshFormat::kStl;
  if (ending == ".obj") return MeshFormat::kObj;
  if (ending == ".glb") return MeshFormat::kGlb;
  return std::nullopt;
}

const char* format_name(MeshFormat format) {
  switch (format) {
    case MeshFormat::kPly:
      return "PLY";
    case MeshFormat::kStl:
      return "STL";
    case MeshFormat::kObj:
      return "OBJ";
    case MeshFormat::kGlb:
      break;
  }
  return "GLB";
}

bool holds_doubles(MeshFormat format) {
  return format == MeshFormat::kPly || format == MeshFormat::kObj;
}

std::string to_mesh_file(const Mesh& mesh, MeshFormat format) {
  switch (format) {
    case MeshFormat::kPly:
      return mesh_as_ply(mesh);
    case MeshFormat::kStl:
      return mesh_as_stl(mesh);
    case MeshFormat::kObj:
      return mesh_as_obj(mesh);
    case MeshFormat::kGlb:
      break;
  }
  return mesh_as_glb(mesh);
}

}  // namespace vkh
