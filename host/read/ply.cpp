// PLY, ASCII and binary of both byte orders: any scalar types, any further properties, lists and
// elements, in any order. ASCII coordinates are correctly rounded doubles for every float type of
// their column, so that they equal the same text in any other format; binary floats are widened. A
// value that is read from an integer column has to be of its type. Columns that are not read are
// not checked.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>

#include "host/base/reject.h"
#include "host/read/ply_header.h"
#include "host/read/readers.h"
#include "host/read/text_blocks.h"
#include "vkhausdorff/note.h"

namespace vkh {
namespace {

using namespace ply;

/// The content of a row, which decides what may follow it in a text.
enum class Row { kVertex, kFace, kOther };

void note_lines(const Lines& lines, const char* text, FileMeshBuilder& builder) {
  if (lines.count == 0) return;
  builder.notes.push_back(note_of(
      NoteCode::kUnread,
      counted(lines.count, "line") + text + ", the first is line " + std::to_string(lines.first)));
}

// The two bodies give one row's values after another. In ASCII, a row is a line, and a line that
// begins with 'comment' is none.
class AsciiBody {
 public:
  AsciiBody(TextScanner& scanner, const MeshSource&) : scanner_(scanner) {}

  void begin_row(const Element& element, uint64_t row) {
    while (scanner_.next_full_line()) {
      if (!is_comment()) return;
      comments_.add(scanner_.line_number());
    }
    scanner_.fail("the file ends at " + row_place(element, row),
                  std::to_string(element.count) + " of them");
  }
  // Words behind a face's corners change nothing: rows are lines, and each list has its own length.
  // Every vertex must have the same number of words behind its properties; otherwise a row may be a
  // face that wrong counts make a vertex. A row of another element may be a face, too.
  void end_row(Row row) {
    if (row == Row::kVertex) return end_vertex();
    const auto word = scanner_.word();
    if (word.empty()) return;
    if (row == Row::kOther)
      scanner_.fail(quoted(word) + " after the line's last property", "the end of the line");
    longer_.add(scanner_.line_number());
  }
  int64_t integer(Scalar type) {
    const auto value = scanner_.number<int64_t>("integer");
    const auto [least, greatest] = range_of(type);
    if (value < least || value > greatest) {
      fail(std::to_string(value) + " does not fit its column's type",
           std::to_string(least) + " to " + std::to_string(greatest));
    }
    return value;
  }
  // A float column is kept as written. A value that its type cannot hold at all contradicts the
  // header.
  double real(Scalar type, const char* what) {
    if (is_integer(type)) return static_cast<double>(integer(type));
    const auto value = scanner_.number<double>(what);
    if (type == Scalar::kFloat) check_float(value, what);
    return value;
  }
  double coordinate(Scalar type) {
    if (type != Scalar::kDouble && type != Scalar::kFloat) return real(type, "coordinate");
    const double value = scanner_.coordinate();
    if (type == Scalar::kFloat) check_float(value, "coordinate");
    return value;
  }
  void skip(Scalar, uint64_t count) {
    for (; count > 0; --count) {
      if (scanner_.word().empty()) fail("the line ends", "as many values as the header says");
    }
  }
  // A count too large runs into the end of its line, value by value.
  uint64_t room(Scalar) const { return std::numeric_limits<uint64_t>::max(); }
  [[noreturn]] void fail(const std::string& what, const std::string& expected) const {
    scanner_.fail(what, expected);
  }
  std::string place() const { return scanner_.place(); }
  void read_rest(FileMeshBuilder& builder) {
    note_lines(comments_, " of comment in the body ignored", builder);
    note_lines(longer_, " with words behind a face's properties, which were ignored", builder);
    note_lines(longer_vertices_, " with words behind a vertex's properties, which were ignored",
               builder);
    note_rest(scanner_, builder.notes);
  }
  bool has_notes() const { return comments_.count + longer_.count + longer_vertices_.count > 0; }
  bool has_longer_vertices() const { return longer_vertices_.count > 0; }

  static constexpr bool kRowsAreLines = true;

 private:
  bool is_comment() const {
    if (const char first = scanner_.peek(); first != 'c' && first != 'o') return false;
    TextScanner ahead = scanner_;
    const std::string_view word = ahead.word();
    return word == "comment" || word == "obj_info";
  }

  void end_vertex() {
    uint64_t words = 0;
    while (!scanner_.word().empty()) ++words;
    if (!words_behind_) words_behind_ = words;
    if (words != *words_behind_) {
      scanner_.fail(counted(words, "word") + " behind the vertex's last property",
                    std::to_string(*words_behind_) + ", as in the first");
    }
    if (words > 0) longer_vertices_.add(scanner_.line_number());
  }

  void check_float(double value, const char* what) const {
    constexpr double kBeyondFloat = 0x1.ffffffp127;  // rounds to infinity
    if (!(std::abs(value) >= kBeyondFloat) || std::isinf(value)) return;
    fail(std::string("a ") + what + " beyond its column's type, float",
         "less than 3.5e38, or type double");
  }

  TextScanner& scanner_;
  Lines comments_, longer_, longer_vertices_;
  std::optional<uint64_t> words_behind_;  ///< the number for every vertex so far
};

template <std::endian kOrder>
class BinaryBody {
 public:
  BinaryBody(TextScanner& scanner, const MeshSource& source)
      : source_(source), at_(scanner.offset()) {}

  void begin_row(const Element& element, uint64_t row) {
    element_ = &element;
    row_ = row;
  }
  void end_row(Row) const {}
  int64_t integer(Scalar type) { return value<int64_t>(type); }
  double real(Scalar type, const char*) { return value<double>(type); }
  double coordinate(Scalar type) { return value<double>(type); }
  void skip(Scalar type, uint64_t count) {
    if (count > room(type)) fail_end();
    at_ += count * size_of(type);
  }
  uint64_t room(Scalar type) const { return (source_.bytes.size() - at_) / size_of(type); }
  [[noreturn]] void fail(const std::string& what, const std::string& expected) const {
    reject(source_.name, row_place(*element_, row_) + ", " + place(), what, expected);
  }
  std::string place() const { return "byte " + std::to_string(at_); }
  void read_rest(FileMeshBuilder& builder) const {
    check_rest(source_.bytes.substr(at_), at_, element_, builder);
  }

  static constexpr bool kRowsAreLines = false;

 private:
  template <class Result>
  Result value(Scalar type) {
    switch (type) {
      case Scalar::kInt8:
        return take<Result, int8_t>();
      case Scalar::kUint8:
        return take<Result, uint8_t>();
      case Scalar::kInt16:
        return take<Result, int16_t>();
      case Scalar::kUint16:
        return take<Result, uint16_t>();
      case Scalar::kInt32:
        return take<Result, int32_t>();
      case Scalar::kUint32:
        return take<Result, uint32_t>();
      case Scalar::kFloat:
        return take<Result, float>();
      case Scalar::kDouble:
        return take<Result, double>();
    }
    fail("a type of no known size", "none");
  }

  // Floats are never read as integers: counts and indices of float type were refused before.
  template <class Result, class Stored>
  Result take() {
    if (sizeof(Stored) > source_.bytes.size() - at_) fail_end();
    const auto stored = load<Stored, kOrder>(source_.bytes.data() + at_);
    at_ += sizeof(Stored);
    return static_cast<Result>(stored);
  }

  [[noreturn]] void fail_end() const {
    fail("the file ends", std::to_string(element_->count) + " of them");
  }

  const MeshSource& source_;
  size_t at_;
  const Element* element_ = nullptr;
  uint64_t row_ = 0;
};

template <class Body>
uint64_t read_list_count(Body& body, const Property& list) {
  const int64_t count = body.integer(*list.list_count);
  if (count < 0) body.fail("a list of " + std::to_string(count) + " values", "0 or more");
  if (static_cast<uint64_t>(count) > body.room(list.type)) {
    body.fail("a list of " + std::to_string(count) + " values",
              "at most " + std::to_string(body.room(list.type)) + ", for which there are bytes");
  }
  return static_cast<uint64_t>(count);
}

template <class Body>
void skip_property(Body& body, const Property& property) {
  body.skip(property.type, property.list_count ? read_list_count(body, property) : 1);
}

template <class Body>
class BodyReader {
 public:
  BodyReader(const Header& header, const Layout& layout, Body body, FileMeshBuilder& builder)
      : header_(header), layout_(layout), body_(body), builder_(builder) {}

  /// Rows of all elements are counted as one.
  void read(uint64_t begin, uint64_t end) {
    uint64_t before = 0;
    for (const Element& element : header_.elements) {
      const uint64_t stop = std::min(before + element.count, end);
      for (uint64_t row = std::max(begin, before); row < stop; ++row) {
        body_.begin_row(element, row - before);
        read_row(element);
        body_.end_row(row_of(element));
      }
      before += element.count;
    }
  }

  Body& body() { return body_; }
  /// Triangles of strips that were left out.
  uint64_t stitches() const { return stitches_; }

 private:
  Row row_of(const Element& element) const {
    if (&element == layout_.vertex) return Row::kVertex;
    const bool has_corners = &element == layout_.face || &element == layout_.strips;
    return has_corners && corners_.size() > 2 ? Row::kFace : Row::kOther;
  }

  void read_row(const Element& element) {
    if (&element == layout_.vertex) {
      read_vertex();
    } else if (&element == layout_.face) {
      read_face();
    } else if (&element == layout_.strips) {
      read_strips();
    } else {
      for (const Property& property : element.properties) skip_property(body_, property);
    }
  }

  void read_vertex() {
    glm::dvec3 p{};
    const std::vector<Property>& properties = layout_.vertex->properties;
    for (size_t i = 0; i < properties.size(); ++i) {
      const auto& axes = layout_.axes;
      const auto axis = std::find(axes.begin(), axes.end(), i) - axes.begin();
      if (axis < 3) {
        p[static_cast<int>(axis)] = body_.coordinate(properties[i].type);
      } else {
        skip_property(body_, properties[i]);
      }
    }
    builder_.add_vertex(p);
  }

  void read_face() {
    read_corners(*layout_.face, layout_.corners, false);
    builder_.add_face(corners_);
  }

  // Reads the corners of one row, which stand in one of its properties.
  void read_corners(const Element& element, size_t corners, bool may_break) {
    for (size_t i = 0; i < element.properties.size(); ++i) {
      if (i == corners) {
        read_list(element.properties[i], may_break);
      } else {
        skip_property(body_, element.properties[i]);
      }
    }
  }

  void read_list(const Property& list, bool may_break) {
    corners_.clear();
    const uint64_t count = read_list_count(body_, list);
    // If one vertex too many or too few is announced, the zeros of an index are read as a count.
    if (count == 0 && !Body::kRowsAreLines) {
      body_.fail("a face of no corners", "at least one, or other counts in the header");
    }
    for (uint64_t left = count; left > 0; --left) {
      const int64_t index = body_.integer(list.type);
      if (index >= 0 && static_cast<uint64_t>(index) < layout_.vertex->count) {
        corners_.push_back(static_cast<uint32_t>(index));
      } else if (may_break && (index == -1 || is_unsigned_break(list.type, index))) {
        corners_.push_back(kBreak);
      } else {
        body_.fail("index " + std::to_string(index) + " of " +
                       std::to_string(layout_.vertex->count) + " vertices",
                   "0 or more and below that count");
      }
    }
  }

  // -1 as a column of unsigned integers holds it.
  static bool is_unsigned_break(Scalar type, int64_t index) {
    const auto [least, greatest] = range_of(type);
    return least == 0 && index == greatest;
  }

  // Strips follow each other in a row, parted by -1. Every other triangle of a strip is turned
  // round.
  void read_strips() {
    read_corners(*layout_.strips, layout_.strip_corners, true);
    size_t begin = 0;
    for (size_t i = 0; i < corners_.size(); ++i) {
      if (corners_[i] == kBreak) begin = i + 1;
      if (i < begin + 2) continue;
      const bool is_turned = (i - begin) % 2 != 0;
      add_of_strip(
          {corners_[i - (is_turned ? 1 : 2)], corners_[i - (is_turned ? 2 : 1)], corners_[i]});
    }
  }

  // A corner twice in a row leads from one part of a strip to another, and is no surface.
  void add_of_strip(const glm::uvec3& face) {
    if (face.x == face.y || face.y == face.z || face.z == face.x) {
      ++stitches_;
    } else {
      builder_.add_triangle(face);
    }
  }

  static constexpr uint32_t kBreak = UINT32_MAX;  ///< no vertex has this number

  const Header& header_;
  const Layout& layout_;
  Body body_;
  FileMeshBuilder& builder_;
  std::vector<uint32_t> corners_;
  uint64_t stitches_ = 0;
};

/// Reads a scalar of each face; everything else is skipped.
template <class Body>
std::vector<double> read_scalar(const Header& header, const Layout& layout, size_t scalar,
                                Body body) {
  std::vector<double> values;
  values.reserve(layout.face->count);
  for (const Element& element : header.elements) {
    const bool is_face = &element == layout.face;
    for (uint64_t row = 0; row < element.count; ++row) {
      body.begin_row(element, row);
      for (size_t i = 0; i < element.properties.size(); ++i) {
        if (is_face && i == scalar) {
          values.push_back(body.real(element.properties[i].type, "number"));
        } else {
          skip_property(body, element.properties[i]);
        }
      }
      body.end_row(&element == layout.vertex ? Row::kVertex : is_face ? Row::kFace : Row::kOther);
    }
    if (is_face) break;
  }
  return values;
}

// Words behind the vertices may be the last coordinate, of rows that begin with their number.
void check_not_numbered(const Layout& layout, const FileMeshBuilder& builder) {
  const std::vector<glm::dvec3>& vertices = builder.vertices();
  if (layout.axes[0] != 0 || vertices.size() < 3) return;
  const double first = vertices[0].x;
  for (size_t i = 0; i < vertices.size(); ++i) {
    if (vertices[i].x != first + static_cast<double>(i)) return;
  }
  reject(builder.name(), layout.vertex->place(),
         "rows that begin with their number, which no property says",
         "a property for it before x, or rows without it");
}

template <class Body>
ReadMesh read_body(const Header& header, const MeshSource& source, TextScanner& scanner) {
  const Layout layout = layout_of(header, source);
  FileMeshBuilder builder(source);
  builder.reserve(layout.vertex->count, layout.face_count());
  std::optional<BodyReader<Body>> reader;
  reader.emplace(header, layout, Body(scanner, source), builder);
  reader->read(0, UINT64_MAX);
  Body body = reader->body();
  const uint64_t stitches = reader->stitches();
  reader.reset();  // its memory is free before more is taken
  const std::string place = body.place();
  note_lines(header.remarks, " before the format ignored", builder);
  if (stitches > 0) {
    builder.notes.push_back(
        note_of(NoteCode::kUnread,
                counted(stitches, "triangle") + " of strips with a corner twice ignored"));
  }
  if constexpr (Body::kRowsAreLines) {
    if (body.has_longer_vertices()) check_not_numbered(layout, builder);
  }
  body.read_rest(builder);
  return std::move(builder).finish(place);
}

ReadMesh read_ply_whole(const MeshSource& source) {
  TextScanner scanner(source.bytes, source.name);
  const Header header = read_header(scanner, source);
  switch (header.encoding) {
    case Encoding::kAscii:
      return read_body<AsciiBody>(header, source, scanner);
    case Encoding::kBig:
      return read_body<BinaryBody<std::endian::big>>(header, source, scanner);
    default:
      return read_body<BinaryBody<std::endian::little>>(header, source, scanner);
  }
}

ReadMesh read_ascii_by_blocks(const Header& header, const MeshSource& source, uint64_t body_begin) {
  const Layout layout = layout_of(header, source);
  FileMeshBuilder(source).check_room(layout.vertex->count, layout.face_count());
  uint64_t row_count = 0;
  for (const Element& element : header.elements) row_count += element.count;
  RowBlocks blocks(source, body_begin, '\0');
  std::vector<FileMeshBuilder> builders = blocks.builders();
  blocks.for_each(row_count, [&](size_t i, const Rows& rows) {
    BodyReader reader(header, layout, AsciiBody(rows.scanner, source), builders[i]);
    reader.read(rows.begin, rows.end);
    if (reader.body().has_notes() || reader.stitches() > 0)  // they are of the whole file
      reject(source.name, "byte 0", "lines beside the rows", "none");
  });
  return FileMeshBuilder::joined(source, std::move(builders)).finish("byte 0");
}

ReadMesh read_ply_by_blocks(const MeshSource& source) {
  Windows windows(source);
  Windows::Window window(windows);
  const auto head = window.read(0, std::min(kTextHeader, source.size()));
  TextScanner scanner(head, source.name);
  const Header header = read_header(scanner, source);
  check_header_ends(scanner, source);
  if (header.remarks.count > 0) reject(source.name, "byte 0", "remarks in the header", "none");
  if (header.encoding == Encoding::kAscii)
    return read_ascii_by_blocks(header, source, scanner.offset());
  return read_binary_by_blocks(header, source, scanner.offset());
}

}  // namespace

ReadMesh parse_ply(const MeshSource& source) {
  return by_blocks_or_whole(source, read_ply_by_blocks, read_ply_whole);
}

std::vector<double> parse_face_property(const MeshSource& source, std::string_view name) {
  return in_memory(source, [&](const MeshSource& whole) {
    TextScanner scanner(whole.bytes, whole.name);
    const Header header = read_header(scanner, whole);
    const Layout layout = layout_of(header, whole);
    const auto read = [&](auto body) {
      return read_scalar(header, layout, face_scalar(layout, whole, name), body);
    };
    if (header.encoding == Encoding::kAscii) return read(AsciiBody(scanner, whole));
    if (header.encoding == Encoding::kBig)
      return read(BinaryBody<std::endian::big>(scanner, whole));
    return read(BinaryBody<std::endian::little>(scanner, whole));
  });
}

}  // namespace vkh
