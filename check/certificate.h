// The bytes of a certificate file, docs/certificate-file.md: whether they are well formed, and the
// place of each part. Nothing is read beyond their end, nor believed before it is checked.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace vkh::check {

constexpr unsigned kDeepest = 100;  ///< halvings of a part

/// The file is no certificate, or no mesh.
struct Broken : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Triangles of a polygon that are not the fan of a convex one.
struct Triangulation {
  static constexpr unsigned kOnlyFan = 3;  ///< the fan, whatever that covers

  uint64_t face, corners;
  unsigned axis;  ///< kOnlyFan, or the axis along which the triangles tile the outline: 0, 1, 2
  std::vector<std::array<uint32_t, 3>> triangles;  ///< corners by their place
};

/// Where a mesh was put: x at matrix (numerator / denominator x).
struct Placement {
  double numerator = 1, denominator = 1;  ///< whole numbers, at least 1
  bool has_matrix = false;
  std::array<std::array<double, 4>, 3> matrix{};  ///< rows
};

/// The way from the file's contents to corners.
struct Description {
  bool are_points = false;      ///< every face is a point: the file has no surface
  bool has_all_bodies = false;  ///< of a scene every shape, whether it is printed or not
  double ambiguity = 0;         ///< error of another triangulation: stated, not proven
  uint64_t ambiguous_face = 0;
  Placement placement;
  std::vector<Triangulation> polygons;  ///< in the order of their faces
};

struct Direction {
  unsigned cut_bits;  ///< of a point on an edge
  double lower, upper;
  uint32_t witness, e;
  uint64_t j, k;
  struct Block {
    uint64_t first_face, faces, begin, end;  ///< bytes of the file, the last of each not included
  };
  std::vector<Block> blocks;
  uint64_t leaves = 0, cut = 0;
};

struct Certificate {
  std::array<uint64_t, 2> faces;
  std::array<double, 2> delta;
  std::array<std::string, 2> file, corners;  ///< SHA-256; a file without one has an empty hash
  unsigned version = 0;
  std::array<Description, 2> read;  ///< empty in version 1
  std::vector<Direction> directions;
};

/// Corner o of a part, and the points on its edges, in units of 2^-bits.
struct Cut {
  size_t o;
  unsigned s, t, bits;
};

class Bytes {
 public:
  Bytes(const std::vector<unsigned char>& bytes, uint64_t at, uint64_t end)
      : bytes_(bytes), at_(at), end_(end) {}

  uint64_t at() const { return at_; }
  uint64_t left() const { return end_ - at_; }
  void expect(bool is_so, const char* otherwise) const {
    if (!is_so) throw Broken("byte " + std::to_string(at_) + ": " + otherwise);
  }

  /// A little-endian number of `count` bytes.
  uint64_t take(unsigned count) {
    expect(count <= left(), "ends too early");
    uint64_t out = 0;
    for (unsigned i = 0; i < count; ++i) out |= uint64_t{bytes_[at_ + i]} << (8 * i);
    at_ += count;
    return out;
  }
  void skip(uint64_t count) { at_ += count; }
  uint32_t word() { return static_cast<uint32_t>(take(4)); }
  double signed_real() {
    const auto value = std::bit_cast<double>(take(8));
    expect(std::isfinite(value) && (value != 0 || !std::signbit(value)), "not a number, or -0");
    return value;
  }
  double real() {
    const double value = signed_real();
    expect(!std::signbit(value), "a negative number");
    return value;
  }
  std::string hash() {
    std::string out;
    for (int i = 0; i < 32; ++i) {
      const uint64_t byte = take(1);
      out += {"0123456789abcdef"[byte >> 4], "0123456789abcdef"[byte & 15]};
    }
    return out;
  }
  /// A number in groups of seven bits, the lowest first.
  uint64_t count() {
    uint64_t code = 0, group = 128;
    for (unsigned i = 0; group >= 128; ++i) {
      expect(i < 5, "a number of more than five bytes");
      group = take(1);
      code |= (group & 127) << (7 * i);
      expect(i == 0 || group != 0, "a number that is longer than it needs to be");
    }
    return code;
  }
  /// A triangle's number, coded as its difference from `before`.
  uint32_t triangle(uint32_t before, uint64_t triangles) {
    const uint64_t code = count();
    const auto half = static_cast<int64_t>(code >> 1);
    const int64_t number = before + (code % 2 == 0 ? half : -half - 1);
    expect(number >= 0 && number < static_cast<int64_t>(triangles), "a triangle that is not there");
    return static_cast<uint32_t>(number);
  }

 private:
  const std::vector<unsigned char>& bytes_;
  uint64_t at_, end_;
};

/// Calls `visitor` for each item of a block: face(f), halve(corner), leaf(S), cut(S, R, Cut). The
/// current part is the last that was added; a halving leaves two in its place, first on top.
template <class Visitor>
void walk(Bytes bytes, const Direction::Block& block, uint64_t triangles, unsigned cut_bits,
          Visitor& visitor) {
  std::array<unsigned, kDeepest + 1> waiting;  // depths of the parts that are still to come
  uint32_t number = 0;
  for (uint64_t f = 0; f < block.faces; ++f) {
    visitor.face(block.first_face + f);
    size_t count = 1;
    waiting[0] = 0;
    while (count > 0) {
      const unsigned depth = waiting[--count];
      const uint64_t kind = bytes.take(1);
      bytes.expect(kind <= 6, "a part of no kind");
      if (kind <= 2) {
        bytes.expect(depth < kDeepest, "halved more than 100 times");
        waiting[count] = waiting[count + 1] = depth + 1;
        count += 2;
        visitor.halve(kind);
        continue;
      }
      const uint32_t s = number = bytes.triangle(number, triangles);
      if (kind == 3) {
        visitor.leaf(s);
        continue;
      }
      const uint32_t r = number = bytes.triangle(number, triangles);
      const auto p = static_cast<unsigned>(bytes.take(cut_bits / 8));
      const auto q = static_cast<unsigned>(bytes.take(cut_bits / 8));
      visitor.cut(s, r, Cut{kind - 4, p, q, cut_bits});
    }
  }
  bytes.expect(bytes.left() == 0, "a block with more bytes than its faces have");
}

/// Counts the parts that are there.
struct Count {
  uint64_t leaves = 0, cuts = 0;
  void face(uint64_t) {}
  void halve(size_t) {}
  void leaf(uint32_t) { ++leaves; }
  void cut(uint32_t, uint32_t, const Cut&) { ++leaves, ++cuts; }
};

inline Direction read_direction(const std::vector<unsigned char>& file, Bytes& bytes,
                                uint64_t faces, uint64_t triangles, unsigned cut_bits) {
  Direction out{};
  out.cut_bits = cut_bits;
  out.lower = bytes.real();
  out.upper = bytes.real();
  bytes.expect(out.lower <= out.upper, "lower is more than upper");
  out.witness = bytes.word();
  out.e = bytes.word();
  bytes.expect(out.witness < faces && out.e <= 62, "a witness that is not there");
  out.j = bytes.take(8);
  out.k = bytes.take(8);
  const uint64_t one = uint64_t{1} << out.e;
  bytes.expect(out.j <= one && out.k <= one - out.j, "a witness that is not on its face");
  bytes.expect(out.lower > 0 || (out.witness | out.e | out.j | out.k) == 0,
               "a witness where lower is 0");
  Count count;
  for (uint64_t done = 0; done < faces; done += out.blocks.back().faces) {
    const uint32_t in_block = bytes.word(), size = bytes.word();
    bytes.expect(in_block >= 1 && in_block <= faces - done, "a block of no, or too many, faces");
    bytes.expect(size <= bytes.left(), "a block that is longer than the file");
    out.blocks.push_back({done, in_block, bytes.at(), bytes.at() + size});
    walk(Bytes(file, bytes.at(), bytes.at() + size), out.blocks.back(), triangles, cut_bits, count);
    bytes.skip(size);
  }
  out.leaves = count.leaves;
  out.cut = count.cuts;
  return out;
}

/// Reads the next polygon, whose face is at least `next`.
inline Triangulation read_triangulation(Bytes& bytes, uint64_t next) {
  Triangulation out{};
  out.face = next + bytes.count();
  out.corners = bytes.count();
  bytes.expect(out.corners >= 4 && out.corners <= UINT32_MAX,
               "a polygon of other than four corners or more");
  out.axis = static_cast<unsigned>(std::min<uint64_t>(bytes.count(), 4));
  bytes.expect(out.axis <= Triangulation::kOnlyFan, "a triangulation of no kind");
  if (out.axis == Triangulation::kOnlyFan) return out;
  bytes.expect(3 * (out.corners - 2) <= bytes.left(),
               "a triangulation that is longer than the file");
  for (uint64_t i = 2; i < out.corners; ++i) {
    std::array<uint32_t, 3>& triangle = out.triangles.emplace_back();
    for (uint32_t& corner : triangle) {
      const uint64_t place = bytes.count();
      bytes.expect(place < out.corners, "a corner that is not there");
      corner = static_cast<uint32_t>(place);
    }
  }
  return out;
}

inline Placement read_placement(Bytes& bytes) {
  Placement out;
  for (double* number : {&out.numerator, &out.denominator}) {
    *number = bytes.real();
    bytes.expect(*number >= 1 && *number <= 0x1p53 && *number == std::floor(*number),
                 "a unit that is no quotient of whole numbers");
  }
  const uint64_t matrices = bytes.take(8);
  bytes.expect(matrices <= 1, "a matrix of no kind");
  out.has_matrix = matrices == 1;
  if (!out.has_matrix) return out;
  for (auto& row : out.matrix) {
    for (double& entry : row) entry = bytes.signed_real();
  }
  return out;
}

inline Description read_description(Bytes& bytes) {
  Description out;
  const uint32_t points = bytes.word();
  bytes.expect(points <= 1, "neither a surface nor points");
  out.are_points = points == 1;
  const uint32_t bodies = bytes.word();
  bytes.expect(bodies <= 1, "bodies of no kind");
  out.has_all_bodies = bodies == 1;
  out.ambiguity = bytes.real();
  out.ambiguous_face = bytes.take(8);
  bytes.expect(out.ambiguity > 0 || out.ambiguous_face == 0, "a face of no ambiguity");
  out.placement = read_placement(bytes);
  const uint64_t count = bytes.take(8);
  bytes.expect(count <= bytes.left(), "more polygons than bytes");
  for (uint64_t i = 0, next = 0; i < count; ++i) {
    out.polygons.push_back(read_triangulation(bytes, next));
    next = out.polygons.back().face + 1;
  }
  return out;
}

/// 1 or 2.
inline unsigned read_version(Bytes& bytes) {
  constexpr uint64_t kMagic = 0x3030'5452'4543'4856;  // "VHCERT00"
  const uint64_t version = bytes.left() >= 8 ? bytes.take(8) - kMagic : 0;
  bytes.expect(version == uint64_t{1} << 56 || version == uint64_t{2} << 56,
               "no certificate of version 01 or 02");
  return static_cast<unsigned>(version >> 56);
}

/// Throws Broken at the first byte that breaks the format.
inline Certificate read_certificate(const std::vector<unsigned char>& file) {
  Bytes bytes(file, 0, file.size());
  Certificate out;
  out.version = read_version(bytes);
  const uint32_t directions = bytes.word();
  bytes.expect(directions == 1 || directions == 2, "neither one direction nor two");
  bytes.expect(bytes.word() == 0, "not 0");
  for (uint64_t& faces : out.faces) {
    faces = bytes.take(8);
    bytes.expect(faces >= 1 && faces <= uint64_t{1} << 28, "no face, or too many");
  }
  for (double& delta : out.delta) delta = bytes.real();
  for (std::string& hash : out.file) {
    hash = bytes.hash();
    if (hash == std::string(64, '0')) hash.clear();
  }
  for (std::string& hash : out.corners) hash = bytes.hash();
  if (out.version > 1) {
    for (Description& description : out.read) description = read_description(bytes);
  }
  for (size_t x = 0; x < directions; ++x) {
    out.directions.push_back(
        read_direction(file, bytes, out.faces[x], out.faces[1 - x], out.version > 1 ? 16 : 8));
  }
  bytes.expect(bytes.left() == 0, "more bytes after the last block");
  return out;
}

}  // namespace vkh::check
