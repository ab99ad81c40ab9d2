// STL, binary and ASCII. It stores three positions a triangle and no vertices: those of equal bits
// (after -0 became +0) are made one vertex.
#include <cctype>
#include <cmath>

#include "host/hash_index.h"
#include "host/mesh_readers.h"
#include "host/text_scanner.h"

namespace vkh {
namespace {

constexpr size_t kHeaderBytes = 84;    // 80 free ones and the triangle count
constexpr size_t kTriangleBytes = 50;  // normal, three corners, 16-bit attribute

uint64_t announced_triangles(std::string_view bytes) {
  return load<uint32_t>(bytes.data() + kHeaderBytes - 4);
}

class VertexMerger {
 public:
  VertexMerger(std::vector<glm::dvec3>& vertices, size_t triangle_count)
      : vertices_(vertices), index_(triangle_count / 2, Hash{&vertices}, Same{&vertices}) {}

  uint32_t insert(const glm::dvec3& position) {
    const auto number = static_cast<uint32_t>(vertices_.size());
    vertices_.push_back(position);
    const uint32_t found = index_.insert(number);
    if (found != number) vertices_.pop_back();
    return found;
  }

 private:
  struct Hash {
    const std::vector<glm::dvec3>* vertices;
    uint64_t operator()(uint32_t v) const { return hash_position((*vertices)[v]); }
  };
  struct Same {
    const std::vector<glm::dvec3>* vertices;
    bool operator()(uint32_t v, uint32_t w) const {
      return same_position((*vertices)[v], (*vertices)[w]);
    }
  };

  std::vector<glm::dvec3>& vertices_;
  HashIndex<Hash, Same> index_;
};

std::string byte_place(uint64_t byte) { return "byte " + std::to_string(byte); }

// A file that holds whole triangles beyond its count contradicts itself: measuring only those
// counted would certify a part of the model. Other trailing bytes are exporters' litter.
void check_size(const MeshSource& source, MeshBuilder& builder) {
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
  const uint64_t extra = size - kHeaderBytes - count * kTriangleBytes;
  if (extra > 0) {
    builder.notes.push_back(counted(extra, "byte") + " after the last triangle ignored");
  }
}

glm::dvec3 load_position(const char* at) {
  return {load<float>(at), load<float>(at + 4), load<float>(at + 8)};
}

Mesh parse_binary(const MeshSource& source) {
  MeshBuilder builder(source);
  check_size(source, builder);
  const uint64_t count = announced_triangles(source.bytes);
  if (count > UINT32_MAX / 3) {
    reject(source.name, byte_place(80), std::to_string(count) + " triangles announced",
           "at most 1431655765");
  }
  VertexMerger merger(builder.vertices, count);
  builder.faces.reserve(count);
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
    builder.faces.push_back(face);
  }
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
        merger_(builder_.vertices, source.bytes.size() / 200) {}

  Mesh read() && {
    expect({"solid"});
    do {
      scanner_.skip_line();  // the solid's name
      read_solid();
      scanner_.skip_line();  // its name again
    } while (another_solid());
    return std::move(builder_).finish(scanner_.place());
  }

 private:
  static constexpr const char* kFacetOrEnd = "'facet' or 'endsolid'";

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
    builder_.faces.push_back(face);
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
