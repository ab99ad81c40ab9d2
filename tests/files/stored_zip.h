// Zip archives of parts that are stored as they are, and 3MF packages in them.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace vkh::test {

inline uint32_t crc32_of(const std::string& bytes) {
  uint32_t crc = UINT32_MAX;
  for (const char c : bytes) {
    crc ^= static_cast<unsigned char>(c);
    for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ (0xedb88320u & -(crc & 1));
  }
  return ~crc;
}

/// Little-endian, of `bytes` bytes.
inline std::string little(uint64_t x, int bytes) {
  std::string out;
  for (int i = 0; i < bytes; ++i) out += static_cast<char>(x >> (8 * i) & 0xff);
  return out;
}

using Parts = std::vector<std::pair<std::string, std::string>>;

inline std::string stored_zip(const Parts& parts) {
  std::string out, list;
  for (const auto& [name, bytes] : parts) {
    const std::string both = little(10, 2) + little(0, 2) + little(0, 2) + little(0, 2) +
                             little(33, 2) + little(crc32_of(bytes), 4) + little(bytes.size(), 4) +
                             little(bytes.size(), 4) + little(name.size(), 2) + little(0, 2);
    list += "PK\x01\x02" + little(10, 2) + both + little(0, 2) + little(0, 2) + little(0, 2) +
            little(0, 4) + little(out.size(), 4) + name;
    out += "PK\x03\x04" + both + name + bytes;
  }
  const size_t begin = out.size();
  return out + list + "PK\x05\x06" + little(0, 4) + little(parts.size(), 2) +
         little(parts.size(), 2) + little(list.size(), 4) + little(begin, 4) + little(0, 2);
}

inline const std::string kRelations =
    "<Relationships xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\">"
    "<Relationship Target=\"/3D/3dmodel.model\" Id=\"a\" "
    "Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/></Relationships>";

/// A package of a root model, and of other parts.
inline std::string package_of(const std::string& model, const Parts& others = {}) {
  Parts parts = {{"_rels/.rels", kRelations}, {"3D/3dmodel.model", model}};
  parts.insert(parts.end(), others.begin(), others.end());
  return stored_zip(parts);
}

inline std::string model_of(const std::string& resources, const std::string& build,
                            const std::string& attributes = "unit=\"millimeter\"") {
  return "<model " + attributes +
         " xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\"><resources>" +
         resources + "</resources><build>" + build + "</build></model>";
}

inline std::string object_of(const std::string& id, const std::string& inside,
                             const std::string& attributes = "") {
  return "<object id=\"" + id + "\" " + attributes + ">" + inside + "</object>";
}

inline std::string mesh_of(const std::string& vertices, const std::string& triangles) {
  return "<mesh><vertices>" + vertices + "</vertices><triangles>" + triangles +
         "</triangles></mesh>";
}

/// Its coordinates have no exact double.
inline const std::string kTriangleMesh = mesh_of(
    "<vertex x=\"0.1\" y=\"0\" z=\"0\"/><vertex x=\"1\" y=\"0\" z=\"0\"/>"
    "<vertex x=\"0\" y=\"1\" z=\"0\"/>",
    "<triangle v1=\"0\" v2=\"1\" v3=\"2\"/>");

}  // namespace vkh::test
