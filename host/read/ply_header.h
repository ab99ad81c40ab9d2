// The header of a PLY file: what its body holds, checked against the file's size.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host/read/readers.h"
#include "host/read/text_scanner.h"

namespace vkh::ply {

enum class Encoding { kAscii, kLittle, kBig };
enum class Scalar : uint8_t { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat, kDouble };

// Names are the file's bytes, and elements lie in a deque: a header of many lines takes five times
// its size in memory at most.
struct Property {
  std::string_view name;
  Scalar type{};
  std::optional<Scalar> list_count;  ///< the type of a list's count; none for a scalar
};

struct Element {
  std::string_view name;
  uint64_t count = 0;
  std::vector<Property> properties;
  size_t line = 0;  ///< line of the file

  std::string place() const { return "line " + std::to_string(line); }
};

/// The number of lines, and the first of them.
struct Lines {
  uint64_t count = 0;
  size_t first = 0;

  void add(size_t line) {
    if (count++ == 0) first = line;
  }
};

struct Header {
  Encoding encoding{};
  Lines remarks;  ///< between the magic and the format: a program's name, a date
  std::deque<Element> elements;
  std::string end_place;  ///< the line of end_header
};

/// The names that writers give the list of a face's corners.
inline constexpr std::array<std::string_view, 2> kCornerLists = {"vertex_indices", "vertex_index"};

inline bool is_integer(Scalar type) { return type < Scalar::kFloat; }
uint64_t size_of(Scalar type);
/// The least and greatest value of an integer type.
inline std::array<int64_t, 2> range_of(Scalar type) {
  static constexpr std::array<std::array<int64_t, 2>, 6> kRanges = {{{INT8_MIN, INT8_MAX},
                                                                     {0, UINT8_MAX},
                                                                     {INT16_MIN, INT16_MAX},
                                                                     {0, UINT16_MAX},
                                                                     {INT32_MIN, INT32_MAX},
                                                                     {0, UINT32_MAX}}};
  return kRanges[static_cast<size_t>(type)];
}
/// The fewest bytes of one row in a binary body; a list of corners has three, others are empty.
uint64_t least_row_of_three(const Element& element);

/// Reads to the end of the end_header line. No element announces more rows than the file has bytes
/// for, none has rows of no bytes, and none but 'face' holds faces.
Header read_header(TextScanner& scanner, const MeshSource& source);

/// The parts of a body that are read.
struct Layout {
  const Element* vertex = nullptr;
  const Element* face = nullptr;    ///< null for points, and where strips stand alone
  const Element* strips = nullptr;  ///< null where there are none

  uint64_t face_count() const { return face != nullptr ? face->count : 0; }
  std::array<size_t, 3> axes{};  ///< properties in `vertex`
  size_t corners = 0;            ///< the property in `face`
  size_t strip_corners = 0;      ///< that in `strips`
};

/// Rejects a header that lacks vertices, or both faces and strips, or has one of them of the wrong
/// kind; when points are read, also one that has faces.
Layout layout_of(const Header& header, const MeshSource& source);

/// The property of `layout.face` of that name; rejects none, several and a list.
size_t face_scalar(const Layout& layout, const MeshSource& source, std::string_view name);

/// A row's place for errors, such as "face 11", or "row 11 of 'camera'".
std::string row_place(const Element& element, uint64_t row);

/// Notes or rejects what follows a binary body that ends at `at`. `last`: the element of the last
/// row.
void check_rest(std::string_view rest, uint64_t at, const Element* last, FileMeshBuilder& builder);

/// Reads a binary body on several threads. Throws InputError if anything is wrong, and if vertices
/// have lists.
ReadMesh read_binary_by_blocks(const Header& header, const MeshSource& source, uint64_t body_begin);

}  // namespace vkh::ply
