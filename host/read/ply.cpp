// PLY, ASCII and binary of both byte orders: any scalar types, any further properties, lists and
// elements, in any order. ASCII coordinates are correctly rounded doubles whatever their column's
// float type, so that they equal the same text in any other format; binary floats are widened. What
// is read of an integer column has to be of its type. Columns that are not read are not checked.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "host/base/text_scanner.h"
#include "host/read/ply_header.h"
#include "host/read/readers.h"

namespace vkh {
namespace {

using namespace ply;

/// A row's place for errors, such as "face 11", or "row 11 of 'camera'".
std::string row_place(const Element& element, uint64_t row) {
  if (element.name == "vertex" || element.name == "face") {
    return std::string(element.name) + " " + std::to_string(row);
  }
  return "row " + std::to_string(row) + " of " + quoted(element.name);
}

// The two bodies give one row's values after another. In ASCII, a row is a line.
class AsciiBody {
 public:
  AsciiBody(TextScanner& scanner, const MeshSource&) : scanner_(scanner) {}

  void begin_row(const Element& element, uint64_t row) {
    if (scanner_.next_full_line()) return;
    scanner_.fail("the file ends at " + row_place(element, row),
                  std::to_string(element.count) + " of them");
  }
  void end_row() {
    if (const auto word = scanner_.word(); !word.empty()) {
      scanner_.fail(quoted(word) + " after the line's last property", "the end of the line");
    }
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
  // A float column is kept as written. What its type cannot hold at all contradicts the header.
  double real(Scalar type) {
    constexpr double kBeyondFloat = 0x1.ffffffp127;  // rounds to infinity
    if (is_integer(type)) return static_cast<double>(integer(type));
    const auto value = scanner_.number<double>("coordinate");
    if (type == Scalar::kFloat && std::abs(value) >= kBeyondFloat) {
      fail("a coordinate beyond its column's type, float", "less than 3.5e38, or type double");
    }
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
  void read_rest(std::vector<std::string>& notes) { note_rest(scanner_, notes); }

  static constexpr bool kRowsAreLines = true;

 private:
  TextScanner& scanner_;
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
  void end_row() const {}
  int64_t integer(Scalar type) { return value<int64_t>(type); }
  double real(Scalar type) { return value<double>(type); }
  void skip(Scalar type, uint64_t count) {
    if (count > room(type)) fail_end();
    at_ += count * size_of(type);
  }
  uint64_t room(Scalar type) const { return (source_.bytes.size() - at_) / size_of(type); }
  [[noreturn]] void fail(const std::string& what, const std::string& expected) const {
    reject(source_.name, row_place(*element_, row_) + ", " + place(), what, expected);
  }
  std::string place() const { return "byte " + std::to_string(at_); }
  // Blank bytes are padding, a few others litter; what has room for a triangle or a vertex may be
  // one, from counts that differ from the rows.
  void read_rest(std::vector<std::string>& notes) const {
    const uint64_t rest = source_.bytes.size() - at_;
    if (source_.bytes.find_first_not_of(std::string_view("\0 \t\r\n", 5), at_) ==
        std::string_view::npos) {
      return;
    }
    if (element_ && rest >= least_row_of_three(*element_)) {
      reject(source_.name, place(), counted(rest, "byte") + " after the last element",
             "fewer than a row, or as many rows as the header says");
    }
    notes.push_back(counted(rest, "byte") + " after the last element ignored");
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
  BodyReader(const Header& header, const MeshSource& source, TextScanner& scanner)
      : header_(header), source_(source), body_(scanner, source), builder_(source) {
    vertex_ = &only_element(header, source, "vertex");
    face_ = &only_element(header, source, "face");
    const auto axis = [&](std::string_view name) {
      return only_property(*vertex_, source, {&name, 1}, false);
    };
    axes_ = {axis("x"), axis("y"), axis("z")};
    corners_property_ = only_property(*face_, source, kCornerLists, true);
    if (vertex_->count >= UINT32_MAX) {
      reject(source.name, vertex_->place(), "too many vertices", "fewer than 2^32 - 1");
    }
    builder_.reserve(vertex_->count, face_->count);
  }

  Mesh read() && {
    for (const Element& element : header_.elements) {
      for (uint64_t row = 0; row < element.count; ++row) {
        body_.begin_row(element, row);
        read_row(element);
        body_.end_row();
      }
    }
    corners_ = std::vector<uint32_t>();  // before more is allocated
    const std::string place = body_.place();
    body_.read_rest(builder_.notes);
    return std::move(builder_).finish(place);
  }

 private:
  void read_row(const Element& element) {
    if (&element == vertex_) {
      read_vertex();
    } else if (&element == face_) {
      read_face();
    } else {
      for (const Property& property : element.properties) skip_property(body_, property);
    }
  }

  void read_vertex() {
    glm::dvec3 p{};
    for (size_t i = 0; i < vertex_->properties.size(); ++i) {
      const auto axis = std::find(axes_.begin(), axes_.end(), i) - axes_.begin();
      if (axis < 3) {
        p[static_cast<int>(axis)] = body_.real(vertex_->properties[i].type);
      } else {
        skip_property(body_, vertex_->properties[i]);
      }
    }
    builder_.add_vertex(p);
  }

  void read_face() {
    for (size_t i = 0; i < face_->properties.size(); ++i) {
      if (i == corners_property_) {
        read_corners(face_->properties[i]);
      } else {
        skip_property(body_, face_->properties[i]);
      }
    }
    builder_.add_face(corners_);
  }

  void read_corners(const Property& list) {
    corners_.clear();
    const uint64_t count = read_list_count(body_, list);
    // One vertex too many or too few announced, and the zeros of an index are read as a count.
    if (count == 0 && !Body::kRowsAreLines) {
      body_.fail("a face of no corners", "at least one, or other counts in the header");
    }
    for (uint64_t left = count; left > 0; --left) {
      const int64_t index = body_.integer(list.type);
      if (index < 0 || static_cast<uint64_t>(index) >= vertex_->count) {
        body_.fail("index " + std::to_string(index) + " of " + std::to_string(vertex_->count) +
                       " vertices",
                   "0 or more and below that count");
      }
      corners_.push_back(static_cast<uint32_t>(index));
    }
  }

  const Header& header_;
  const MeshSource& source_;
  Body body_;
  MeshBuilder builder_;
  const Element* vertex_ = nullptr;
  const Element* face_ = nullptr;
  std::array<size_t, 3> axes_{};
  size_t corners_property_ = 0;
  std::vector<uint32_t> corners_;
};

}  // namespace

Mesh parse_ply(const MeshSource& source) {
  TextScanner scanner(source.bytes, source.name);
  const Header header = read_header(scanner, source);
  switch (header.encoding) {
    case Encoding::kAscii:
      return BodyReader<AsciiBody>(header, source, scanner).read();
    case Encoding::kBig:
      return BodyReader<BinaryBody<std::endian::big>>(header, source, scanner).read();
    default:
      return BodyReader<BinaryBody<std::endian::little>>(header, source, scanner).read();
  }
}

}  // namespace vkh
