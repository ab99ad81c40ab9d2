#include "host/read/ply_header.h"

#include <algorithm>
#include <array>
#include <cctype>

#include "host/base/reject.h"
#include "vkhausdorff/note.h"

namespace vkh::ply {
namespace {

// The element of triangle strips, as Stanford's scans have them.
constexpr std::string_view kStrips = "tristrips";

Scalar read_type(TextScanner& scanner) {
  constexpr std::array<std::string_view, 16> kNames = {
      "char", "uchar", "short", "ushort", "int",   "uint",   "float",   "double",
      "int8", "uint8", "int16", "uint16", "int32", "uint32", "float32", "float64"};
  const std::string_view word = scanner.word();
  const auto* found = std::find(kNames.begin(), kNames.end(), word);
  if (found == kNames.end()) {
    scanner.fail(quoted(word) + " as a type", "char to uint, int8 to uint32, float or double");
  }
  return static_cast<Scalar>((found - kNames.begin()) % 8);
}

Property read_property(TextScanner& scanner) {
  Property property;
  TextScanner ahead = scanner;
  if (ahead.word() == "list") {
    scanner.word();
    property.list_count = read_type(scanner);
    if (!is_integer(*property.list_count)) scanner.fail("a list counted in floats", "an integer");
  }
  property.type = read_type(scanner);
  property.name = scanner.word();
  if (property.name.empty()) scanner.fail("a property without a name", "one");
  return property;
}

Element read_element(TextScanner& scanner) {
  Element element;
  element.name = scanner.word();
  const auto count = scanner.number<int64_t>("count of elements");
  if (count < 0) scanner.fail(std::to_string(count) + " elements", "a count of 0 or more");
  element.count = static_cast<uint64_t>(count);
  element.line = scanner.line_number();
  return element;
}

Encoding read_encoding(TextScanner& scanner) {
  constexpr std::array<std::string_view, 3> kNames = {"ascii", "binary_little_endian",
                                                      "binary_big_endian"};
  const std::string_view word = scanner.word();
  const auto* found = std::find(kNames.begin(), kNames.end(), word);
  if (found == kNames.end()) {
    scanner.fail(quoted(word) + " as format", "ascii, binary_little_endian or binary_big_endian");
  }
  if (const auto version = scanner.word(); version != "1.0") {
    scanner.fail((version.empty() ? "no" : quoted(version) + " as") + std::string(" version"),
                 "1.0, the only one");
  }
  return static_cast<Encoding>(found - kNames.begin());
}

// A word too many means a header that we do not understand.
void expect_line_end(TextScanner& scanner) {
  if (const auto word = scanner.word(); !word.empty()) {
    scanner.fail(quoted(word) + " after a header's line", "its end");
  }
}

// Recognises a keyword in other letters, or misspelt after its beginning, which is no remark.
bool is_like_keyword(std::string_view word) {
  std::string lower(word);
  for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  constexpr std::array<std::string_view, 4> kBegins = {"format", "element", "property", "end"};
  return std::any_of(kBegins.begin(), kBegins.end(),
                     [&](std::string_view begin) { return lower.starts_with(begin); });
}

// Reads one line after the first; false at end_header. Before the format, which announces all else,
// a line that begins with no keyword says who wrote the file.
bool parse_line(TextScanner& scanner, Header& header, bool& has_format) {
  const std::string_view word = scanner.word();
  if (word.empty() || word == "comment" || word == "obj_info") return true;
  if (!has_format && header.elements.empty() && !is_like_keyword(word)) {
    header.remarks.add(scanner.line_number());
    return true;
  }
  if (word == "format") {
    if (has_format) scanner.fail("a second format line", "one");
    header.encoding = read_encoding(scanner);
    has_format = true;
  } else if (word == "element") {
    header.elements.push_back(read_element(scanner));
  } else if (word == "property" && !header.elements.empty()) {
    header.elements.back().properties.push_back(read_property(scanner));
  } else if (word != "end_header") {
    scanner.fail(quoted(word), "format, comment, element, property or end_header");
  }
  expect_line_end(scanner);
  return word != "end_header";
}

Header parse_header(TextScanner& scanner) {
  scanner.next_line();
  if (const auto word = scanner.word(); word != "ply") scanner.fail(quoted(word), "ply");
  expect_line_end(scanner);
  Header header;
  bool has_format = false;
  while (scanner.next_line()) {
    if (parse_line(scanner, header, has_format)) continue;
    if (!has_format) scanner.fail("a header without a format line", "one");
    return header;
  }
  scanner.fail("the file ends inside the header", "end_header");
}

// The fewest bytes that one row of an element takes; a word and a separator in ASCII.
uint64_t least_row_bytes(const Element& element, Encoding encoding) {
  uint64_t bytes = 0;
  for (const Property& property : element.properties) {
    bytes +=
        encoding == Encoding::kAscii ? 2 : size_of(property.list_count.value_or(property.type));
  }
  return bytes;
}

// Checks before anything is allocated. Rows of no bytes would never end.
void check_sizes(const Header& header, const MeshSource& source, uint64_t body_bytes) {
  uint64_t room = body_bytes + (header.encoding == Encoding::kAscii ? 1 : 0);
  for (const Element& element : header.elements) {
    if (element.count == 0) continue;
    const uint64_t row_bytes = least_row_bytes(element, header.encoding);
    if (row_bytes == 0) {
      reject(source.name, element.place(), "element " + quoted(element.name) + " has no property",
             "at least one");
    }
    if (element.count > room / row_bytes) {
      reject(source.name, element.place(),
             std::to_string(element.count) + " elements " + quoted(element.name) +
                 " announced in a file with " + std::to_string(body_bytes) +
                 " bytes after its header",
             "a count that fits the file");
    }
    room -= element.count * row_bytes;
  }
}

bool is_corner_list(const Property& property) {
  return property.list_count &&
         std::find(kCornerLists.begin(), kCornerLists.end(), property.name) != kCornerLists.end();
}

// Polygons of other names, grids of them and the like: measuring only the faces beside them would
// certify a part of the model. Edges have corners, but no area; a range_grid (of Stanford's scans)
// says which vertex, if any, is at each place of a grid.
void check_no_other_faces(const Header& header, const MeshSource& source) {
  for (const Element& element : header.elements) {
    if (element.count == 0 || element.name == "face" || element.name == kStrips ||
        element.name == "edge" || element.name == "range_grid" ||
        std::none_of(element.properties.begin(), element.properties.end(), is_corner_list)) {
      continue;
    }
    reject(source.name, element.place(),
           "element " + quoted(element.name) + " lists corners, which are not read",
           "all faces in element 'face'");
  }
}

// The element of that name, or null; rejects several.
const Element* element_of(const Header& header, const MeshSource& source, std::string_view name) {
  const Element* only = nullptr;
  for (const Element& element : header.elements) {
    if (element.name != name) continue;
    if (only) reject(source.name, element.place(), "a second element " + vkh::quoted(name), "one");
    only = &element;
  }
  return only;
}

void check_has_faces(const Header& header, const MeshSource& source, uint64_t points) {
  const auto& elements = header.elements;
  const bool has = std::any_of(elements.begin(), elements.end(), [](const Element& element) {
    return element.name == "face" || (element.name == kStrips && element.count > 0);
  });
  if (!has)
    reject(source.name, header.end_place, counted(points, "point") + " and no element 'face'",
           kAMesh);
}

void check_has_no_faces(const Header& header, const MeshSource& source) {
  for (const Element& element : header.elements) {
    if ((element.name == "face" || element.name == kStrips) && element.count > 0)
      reject(source.name, element.place(),
             counted(element.count, element.name == "face" ? "face" : "strip") +
                 " in a file of points",
             kPointsAlone);
  }
}

// Returns the index of the only property that has one of the names. Rejects an element that has
// none or several of them, and a property of the wrong kind: with `list` it must be a list of
// integers, without it no list.
size_t only_property(const Element& element, const MeshSource& source,
                     std::span<const std::string_view> names, bool list) {
  std::optional<size_t> only;
  for (size_t i = 0; i < element.properties.size(); ++i) {
    const Property& property = element.properties[i];
    if (std::find(names.begin(), names.end(), property.name) == names.end()) continue;
    if (property.list_count.has_value() != list || (list && !is_integer(property.type)) || only) {
      reject(source.name, element.place(),
             "property " + quoted(property.name) + " of " + quoted(element.name) +
                 " is of the wrong kind",
             list ? "one list of integers" : "one scalar");
    }
    only = i;
  }
  if (!only) {
    reject(source.name, element.place(),
           "element " + quoted(element.name) + " has no such property", quoted(names.front()));
  }
  return *only;
}

}  // namespace

uint64_t size_of(Scalar type) {
  constexpr std::array<uint64_t, 8> kSizes = {1, 1, 2, 2, 4, 4, 4, 8};
  return kSizes[static_cast<size_t>(type)];
}

uint64_t least_row_of_three(const Element& element) {
  uint64_t bytes = 0;
  for (const Property& property : element.properties) {
    bytes += size_of(property.list_count.value_or(property.type));
    if (is_corner_list(property)) bytes += 3 * size_of(property.type);
  }
  return bytes;
}

Header read_header(TextScanner& scanner, const MeshSource& source) {
  Header header = parse_header(scanner);
  header.end_place = scanner.place();
  check_no_other_faces(header, source);
  check_sizes(header, source, source.size() - scanner.offset());
  return header;
}

Layout layout_of(const Header& header, const MeshSource& source) {
  Layout layout;
  layout.vertex = element_of(header, source, "vertex");
  if (layout.vertex == nullptr)
    reject(source.name, header.end_place, "a header without element 'vertex'", "one");
  if (source.limits.points) {
    check_has_no_faces(header, source);
  } else {
    check_has_faces(header, source, layout.vertex->count);
    layout.face = element_of(header, source, "face");
    layout.strips = element_of(header, source, kStrips);
  }
  const auto axis = [&](std::string_view name) {
    return only_property(*layout.vertex, source, {&name, 1}, false);
  };
  layout.axes = {axis("x"), axis("y"), axis("z")};
  if (layout.face != nullptr)
    layout.corners = only_property(*layout.face, source, kCornerLists, true);
  if (layout.strips != nullptr)
    layout.strip_corners = only_property(*layout.strips, source, kCornerLists, true);
  if (layout.vertex->count >= UINT32_MAX)
    reject(source.name, layout.vertex->place(), "too many vertices", "fewer than 2^32 - 1");
  return layout;
}

size_t face_scalar(const Layout& layout, const MeshSource& source, std::string_view name) {
  if (layout.face == nullptr)
    reject(source.name, layout.strips->place(), "strips, whose triangles have no properties",
           "all faces in element 'face'");
  return only_property(*layout.face, source, {&name, 1}, false);
}

std::string row_place(const Element& element, uint64_t row) {
  if (element.name == "vertex" || element.name == "face") {
    return std::string(element.name) + " " + std::to_string(row);
  }
  return "row " + std::to_string(row) + " of " + quoted(element.name);
}

// Blank bytes are padding, a few others litter; a rest with room for a triangle or a vertex may be
// one, from counts that differ from the rows.
void check_rest(std::string_view rest, uint64_t at, const Element* last, FileMeshBuilder& builder) {
  if (rest.find_first_not_of(std::string_view("\0 \t\r\n", 5)) == std::string_view::npos) return;
  if (last && rest.size() >= least_row_of_three(*last)) {
    reject(builder.name(), "byte " + std::to_string(at),
           counted(rest.size(), "byte") + " after the last element",
           "fewer than a row, or as many rows as the header says");
  }
  builder.notes.push_back(
      note_of(NoteCode::kUnread, counted(rest.size(), "byte") + " after the last element ignored"));
}

}  // namespace vkh::ply
