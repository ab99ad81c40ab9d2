// The header of a PLY file: what its body holds, checked against the file's size.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "host/mesh_readers.h"
#include "host/text_scanner.h"

namespace vkh::ply {

enum class Encoding { kAscii, kLittle, kBig };
enum class Scalar : uint8_t { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat, kDouble };

struct Property {
  std::string name;
  Scalar type{};
  std::optional<Scalar> list_count;  ///< the type of a list's count; none for a scalar
};

struct Element {
  std::string name;
  uint64_t count = 0;
  std::vector<Property> properties;
  std::string place;  ///< its line in the header
};

struct Header {
  Encoding encoding{};
  std::vector<Element> elements;
  std::string end_place;  ///< the line of end_header
};

inline bool is_integer(Scalar type) { return type < Scalar::kFloat; }
uint64_t size_of(Scalar type);

/// Reads to the end of the end_header line. No element announces more rows than the file has bytes
/// for, and none has rows of no bytes.
Header read_header(TextScanner& scanner, const MeshSource& source);

/// The element of that name; rejects none and several.
const Element& only_element(const Header& header, const MeshSource& source,
                            const std::string& name);
/// The number of the property of one of those names; rejects none, several and, where `list`, any
/// that is not a list of integers, otherwise any list.
size_t only_property(const Element& element, const MeshSource& source,
                     std::initializer_list<std::string_view> names, bool list);

}  // namespace vkh::ply
