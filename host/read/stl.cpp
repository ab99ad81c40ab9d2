// STL, binary and ASCII. It stores three positions a triangle and no vertices: those of equal bits
// (after -0 became +0) are made one vertex.
#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <glm/common.hpp>

#include "host/base/hash_index.h"
#include "host/base/text_scanner.h"
#include "host/read/readers.h"

namespace vkh {
namespace {

constexpr size_t kHeaderBytes = 84;    // 80 free ones and the triangle count
constexpr size_t kTriangleBytes = 50;  // normal, three corners, 16-bit attribute

uint64_t announced_triangles(std::string_view bytes) {
  return load<uint32_t>(bytes.data() + kHeaderBytes - 4);
}

class VertexMerger {
 public:
  VertexMerger(MeshBuilder& builder, size_t triangle_count)
      : builder_(builder),
        index_(triangle_count / 2, Hash{.vertices = &builder.vertices()},
               Same{&builder.vertices()}) {}

  uint32_t insert(const glm::dvec3& position) {
    const auto number = static_cast<uint32_t>(builder_.vertices().size());
    builder_.add_vertex(position);
    const uint32_t found = index_.insert(number);
    if (found != number) builder_.drop_vertex();
    return found;
  }

 private:
  struct Hash {
    const std::vector<glm::dvec3>* vertices;
    HashSecret secret = hash_secret();
    uint64_t operator()(uint32_t v) const { return hash_position(secret, (*vertices)[v]); }
  };
  struct Same {
    const std::vector<glm::dvec3>* vertices;
    bool operator()(uint32_t v, uint32_t w) const {
      return same_position((*vertices)[v], (*vertices)[w]);
    }
  };

  MeshBuilder& builder_;
  HashIndex<Hash, Same> index_;
};

std::string byte_place(uint64_t byte) { return "byte " + std::to_string(byte); }

glm::dvec3 load_position(const char* at) {
  return {load<float>(at), load<float>(at + 4), load<float>(at + 8)};
}

// The count of the header, which the file's size has to allow.
uint64_t checked_count(const MeshSource& source) {
  const size_t size = source.bytes.size();
  if (size < kHeaderBytes) {
    reject(source.name, byte_place(size), "the file ends inside a binary STL's header",
           "84 bytes of header, or ASCII STL that begins with 'solid'");
  }
  const uint64_t count = announced_triangles(source.bytes);
  const uint64_t room = (size - kHeaderBytes) / kTriangleBytes;
  const uint64_t litter = (size - kHeaderBytes) % kTriangleBytes;
  if (count > room || (count < room && litter == 0)) {
    reject(source.name, byte_place(80),
           std::to_string(count) + " triangles announced, " + std::to_string(room) + " present",
           std::to_string(kHeaderBytes + count * kTriangleBytes) + " bytes, not " +
               std::to_string(size));
  }
  if (count > UINT32_MAX / 3) {
    reject(source.name, byte_place(80), std::to_string(count) + " triangles announced",
           "at most 1431655765");
  }
  return count;
}

// A date, a name, a version: what exporters sign with. It is no triangle, but digits make floats.
bool is_signature(std::string_view rest) {
  const auto printable = [](char c) { return (c >= ' ' && c <= '~') || (c >= '\t' && c <= '\r'); };
  return std::all_of(rest.begin(), rest.end(), printable) &&
         rest.find("vertex") == std::string_view::npos;
}

// Three different corners, none of them a million times farther out than the mesh; padding hardly
// ever looks so.
bool looks_like_triangle(const char* at, double mesh_size) {
  constexpr double kFar = 0x1p20;
  std::array<glm::dvec3, 3> corners{};
  for (size_t i = 0; i < 3; ++i) {
    corners[i] = load_position(at + 12 * (i + 1));
    const glm::dvec3 p = glm::abs(corners[i]);
    if (!(std::max({p.x, p.y, p.z}) <= kFar * mesh_size)) return false;
  }
  return corners[0] != corners[1] && corners[1] != corners[2] && corners[2] != corners[0];
}

// Exporters leave litter behind the last triangle. If it holds another one, with or without stray
// bytes before it, then the count is wrong: measuring only those counted would certify a part of
// the model.
void check_rest(const MeshSource& source, MeshBuilder& builder, uint64_t end) {
  const uint64_t rest = source.bytes.size() - end;
  if (rest == 0) return;
  double mesh_size = 0;
  for (const glm::dvec3& v : builder.vertices()) {
    const glm::dvec3 p = glm::abs(v);
    mesh_size = std::max({mesh_size, p.x, p.y, p.z});
  }
  const bool may_be_binary = !is_signature(source.bytes.substr(end));
  for (uint64_t at = end; may_be_binary && at + kTriangleBytes <= source.bytes.size(); ++at) {
    if (!looks_like_triangle(source.bytes.data() + at, mesh_size)) continue;
    reject(source.name, byte_place(at), "a triangle after the last one announced",
           "as many triangles as byte 80 says");
  }
  builder.notes.push_back(counted(rest, "byte") + " after the last triangle ignored");
}

Mesh parse_binary(const MeshSource& source) {
  MeshBuilder builder(source);
  const uint64_t count = checked_count(source);
  builder.reserve(0, count);
  VertexMerger merger(builder, count);
  for (uint64_t t = 0; t < count; ++t) {
    const size_t at = kHeaderBytes + t * kTriangleBytes + 12;
    glm::uvec3 face{};
    for (int i = 0; i < 3; ++i) {
      const size_t corner = at + 12 * static_cast<size_t>(i);
      const glm::dvec3 p = load_position(source.bytes.data() + corner);
      if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
        reject(source.name, "triangle " + std::to_string(t) + ", " + byte_place(corner),
               "a coordinate is nan or infinite", "finite coordinates");
      }
      face[i] = merger.insert(p);
    }
    builder.add_triangle(face);
  }
  check_rest(source, builder, kHeaderBytes + count * kTriangleBytes);
  return std::move(builder).finish(byte_place(kHeaderBytes));
}

bool is_word(std::string_view word, std::string_view lower) {
  return std::equal(word.begin(), word.end(), lower.begin(), lower.end(), [](char a, char b) {
    return std::tolower(static_cast<unsigned char>(a)) == b;
  });
}

class AsciiReader {
 public:
  explicit AsciiReader(const MeshSource& source)
      : scanner_(source.bytes, source.name),
        builder_(source),
        merger_(builder_, source.bytes.size() / 200) {}

  Mesh read() && {
    expect({"solid"});
    do {
      skip_name();
      read_solid();
      skip_name();
    } while (another_solid());
    return std::move(builder_).finish(scanner_.place());
  }

 private:
  static constexpr const char* kFacetOrEnd = "'facet' or 'endsolid'";

  // To the end of the line. A name is any words, but a file without line ends would hide in it.
  void skip_name() {
    for (auto word = scanner_.word(); !word.empty(); word = scanner_.word()) {
      if (is_word(word, "endfacet")) fail_word(word, "a facet to begin on a line of its own");
    }
  }

  void read_solid() {
    for (;;) {
      const std::string_view word = scanner_.word_across_lines();
      if (is_word(word, "endsolid")) return;
      if (!is_word(word, "facet")) fail_word(word, kFacetOrEnd);
      read_facet();
    }
  }

  // The normal is skipped, not read: exporters write nan there for degenerate triangles.
  void read_facet() {
    expect({"normal"});
    for (int i = 0; i < 3; ++i) scanner_.word_across_lines();
    expect({"outer", "loop"});
    glm::uvec3 face{};
    for (int i = 0; i < 3; ++i) {
      expect({"vertex"});
      glm::dvec3 p{};
      for (int axis = 0; axis < 3; ++axis) p[axis] = scanner_.number<double>("coordinate");
      face[i] = merger_.insert(p);
    }
    expect({"endloop", "endfacet"});
    builder_.add_triangle(face);
  }

  bool another_solid() {
    const std::string_view word = scanner_.word_across_lines();
    if (word.empty()) return false;
    if (!is_word(word, "solid")) fail_word(word, "'solid' or the end of the file");
    return true;
  }

  void expect(std::initializer_list<const char*> words) {
    for (const char* expected : words) {
      const std::string_view word = scanner_.word_across_lines();
      if (!is_word(word, expected)) fail_word(word, quoted(expected));
    }
  }

  [[noreturn]] void fail_word(std::string_view word, const std::string& expected) {
    scanner_.fail(word.empty() ? "the file ends" : quoted(word), expected);
  }

  TextScanner scanner_;
  MeshBuilder builder_;
  VertexMerger merger_;
};

// Binary headers often begin with "solid" too, but hold zero bytes: in the attributes if nowhere
// else.
bool is_ascii(std::string_view bytes) {
  const size_t begin = bytes.find_first_not_of(" \t\r\n");
  return begin != std::string_view::npos && bytes.size() - begin >= 5 &&
         is_word(bytes.substr(begin, 5), "solid") && bytes.find('\0') == std::string_view::npos;
}

}  // namespace

bool is_exact_binary_stl(std::string_view bytes) {
  return bytes.size() >= kHeaderBytes &&
         bytes.size() == kHeaderBytes + announced_triangles(bytes) * kTriangleBytes;
}

Mesh parse_stl(const MeshSource& source) {
  if (!is_exact_binary_stl(source.bytes) && is_ascii(source.bytes)) {
    return AsciiReader(source).read();
  }
  return parse_binary(source);
}

}  // namespace vkh
