// glTF documents for tests: a list of parts of a binary buffer, and JSON around it.
#pragma once

#include <cstring>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "host/read/readers.h"

namespace vkh::test {

using Json = nlohmann::json;

template <class T>
std::string raw(const std::vector<T>& values) {
  std::string bytes(values.size() * sizeof(T), '\0');
  if (!values.empty()) std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}

inline std::string base64(const std::string& bytes) {
  static constexpr char kDigits[] =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (size_t i = 0; i < bytes.size(); i += 3) {
    uint32_t three = 0;
    for (size_t k = 0; k < 3; ++k)
      three = three << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (int k = 0; k < 4; ++k)
      text += i + static_cast<size_t>(k) > bytes.size() ? '=' : kDigits[three >> (18 - 6 * k) & 63];
  }
  return text;
}

/// Component types.
enum { kByteType = 5120, kUbyteType, kShortType, kUshortType, kUintType = 5125, kFloatType };

/// A document under construction; its one buffer grows with the views.
struct Document {
  Json json = {{"asset", {{"version", "2.0"}}}, {"scene", 0},
               {"scenes", {{{"nodes", {0}}}}},  {"nodes", {{{"mesh", 0}}}},
               {"meshes", Json::array()},       {"accessors", Json::array()},
               {"bufferViews", Json::array()}};
  std::string binary;

  size_t add_view(const std::string& bytes, size_t stride = 0) {
    Json view = {{"buffer", 0}, {"byteOffset", binary.size()}, {"byteLength", bytes.size()}};
    if (stride != 0) view["byteStride"] = stride;
    binary += bytes;
    json["bufferViews"].push_back(view);
    return json["bufferViews"].size() - 1;
  }
  size_t add_accessor(Json accessor) {
    json["accessors"].push_back(std::move(accessor));
    return json["accessors"].size() - 1;
  }
  size_t add_positions(const std::vector<float>& xyz) {
    return add_accessor({{"bufferView", add_view(raw(xyz))},
                         {"componentType", kFloatType},
                         {"count", xyz.size() / 3},
                         {"type", "VEC3"}});
  }
  template <class T>
  size_t add_indices(const std::vector<T>& indices) {
    const int type = sizeof(T) == 1 ? kUbyteType : sizeof(T) == 2 ? kUshortType : kUintType;
    return add_accessor({{"bufferView", add_view(raw(indices))},
                         {"componentType", type},
                         {"count", indices.size()},
                         {"type", "SCALAR"}});
  }
  /// Adds a primitive in a mesh of its own.
  Json& add_mesh(size_t positions, const Json& more = Json::object()) {
    Json primitive = {{"attributes", {{"POSITION", positions}}}};
    primitive.update(more);
    json["meshes"].push_back({{"primitives", {primitive}}});
    return json["meshes"].back();
  }

  /// Embedded.
  std::string text() const {
    Json whole = json;
    if (!binary.empty()) {
      whole["buffers"] = {{{"byteLength", binary.size()},
                           {"uri", "data:application/octet-stream;base64," + base64(binary)}}};
    }
    return whole.dump();
  }
  std::string glb() const {
    Json whole = json;
    whole["buffers"] = {{{"byteLength", binary.size()}}};
    std::string text = whole.dump(), data = binary;
    while (text.size() % 4 != 0) text += ' ';
    while (data.size() % 4 != 0) data += '\0';
    const auto word = [](size_t x) { return raw<uint32_t>({static_cast<uint32_t>(x)}); };
    return "glTF" + word(2) + word(12 + 8 + text.size() + 8 + data.size()) + word(text.size()) +
           "JSON" + text + word(data.size()) + std::string("BIN\0", 4) + data;
  }
};

/// One triangle of a document's own.
inline Document triangle_document() {
  Document document;
  document.add_mesh(document.add_positions({0, 0, 0, 1, 0, 0, 0, 1, 0}));
  return document;
}

inline ReadMesh parse(const std::string& bytes, const ReadLimits& limits = {}) {
  return parse_mesh({.name = "test.gltf", .bytes = bytes, .limits = limits});
}
inline ReadMesh parse(const Document& document) { return parse(document.text()); }

}  // namespace vkh::test
