// STL, binary and ASCII. It stores three positions a triangle and no vertices: positions of equal
// bits (after -0 became +0) are made one vertex.
#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <glm/common.hpp>

#include "host/base/hash_index.h"
#include "host/base/reject.h"
#include "host/read/merge_blocks.h"
#include "host/read/readers.h"
#include "host/read/text_blocks.h"
#include "vkhausdorff/note.h"

namespace vkh {
namespace {

constexpr size_t kHeaderBytes = 84;    // 80 free ones and the triangle count
constexpr size_t kTriangleBytes = 50;  // normal, three corners, 16-bit attribute

uint64_t announced_triangles(std::string_view head) {
  return load<uint32_t>(head.data() + kHeaderBytes - 4);
}

class VertexMerger {
 public:
  VertexMerger(FileMeshBuilder& builder, size_t triangle_count)
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

  FileMeshBuilder& builder_;
  HashIndex<Hash, Same> index_;
};

std::string byte_place(uint64_t byte) { return "byte " + std::to_string(byte); }

glm::vec3 load_position(const char* at) {
  return {load<float>(at), load<float>(at + 4), load<float>(at + 8)};
}

// The count in the header, which the file's size has to allow.
uint64_t checked_count(const MeshSource& source) {
  const uint64_t size = source.size();
  if (size < kHeaderBytes) {
    reject(source.name, byte_place(size), "the file ends inside a binary STL's header",
           "84 bytes of header, or ASCII STL that begins with 'solid'");
  }
  const uint64_t count = announced_triangles(head_of(source, kHeaderBytes));
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

bool is_printable(std::string_view text) {
  return std::all_of(text.begin(), text.end(),
                     [](char c) { return (c >= ' ' && c <= '~') || (c >= '\t' && c <= '\r'); });
}

// Whether text holds a word of a facet, in any case of letters.
bool has_facets(std::string_view text) {
  const auto has = [&](std::string_view word) {
    return std::search(text.begin(), text.end(), word.begin(), word.end(), [](char a, char b) {
             return std::tolower(static_cast<unsigned char>(a)) == b;
           }) != text.end();
  };
  return has("facet") || has("vertex");
}

// Another solid would be a part of the model, as another binary file or as text.
void refuse_another_solid(std::string_view rest, uint64_t begin, const std::string& name) {
  constexpr const char* kOne = "one solid a file, or all of them as text";
  if (has_facets(rest))
    reject(name, byte_place(begin), "a text solid after the last binary triangle", kOne);
  const bool is_binary = rest.size() >= kHeaderBytes && announced_triangles(rest) > 0 &&
                         announced_triangles(rest) <= (rest.size() - kHeaderBytes) / kTriangleBytes;
  if (is_binary)
    reject(name, byte_place(begin), "a second binary STL after the last triangle of the first",
           kOne);
}

// Checks for three different corners, none of them a million times farther out than the mesh;
// padding hardly ever looks so.
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

// Exporters leave litter behind the last triangle. If it holds another triangle, with or without
// stray bytes before it, then the count is wrong: measuring only the counted ones would certify a
// part of the model.
void check_rest(std::string_view rest, uint64_t begin, FileMeshBuilder& builder) {
  if (rest.empty()) return;
  refuse_another_solid(rest, begin, builder.name());
  double mesh_size = 0;
  for (const glm::dvec3& v : builder.vertices()) {
    const glm::dvec3 p = glm::abs(v);
    mesh_size = std::max({mesh_size, p.x, p.y, p.z});
  }
  // Exporters add a date, a name or a version, and digits look like floats.
  const bool may_be_binary = !is_printable(rest);
  for (size_t at = 0; may_be_binary && at + kTriangleBytes <= rest.size(); ++at) {
    if (!looks_like_triangle(rest.data() + at, mesh_size)) continue;
    reject(builder.name(), byte_place(begin + at), "a triangle after the last one announced",
           "as many triangles as byte 80 says");
  }
  builder.notes.push_back(note_of(
      NoteCode::kUnread, counted(rest.size(), "byte") + " after the last triangle ignored"));
}

bool is_finite(const glm::dvec3& p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

uint64_t attribute_of(std::string_view bytes, uint64_t triangle_begin) {
  return load<uint16_t>(bytes.data() + triangle_begin + kTriangleBytes - 2);
}

// A triangle's last two bytes are the count of attribute bytes that follow it. Nearly all writers
// have 0 or a colour there and nothing behind it, so the counts are believed if they, and only
// they, make the file's size.
bool has_attribute_bytes(std::string_view bytes) {
  if (bytes.size() < kHeaderBytes || is_exact_binary_stl(bytes, bytes.size())) return false;
  const uint64_t count = announced_triangles(bytes);
  uint64_t at = kHeaderBytes;
  for (uint64_t t = 0; t < count; ++t) {
    if (at + kTriangleBytes > bytes.size()) return false;
    at += kTriangleBytes + attribute_of(bytes, at);
  }
  return at == bytes.size() && count <= UINT32_MAX / 3;
}

ReadMesh read_binary(const MeshSource& source) {
  FileMeshBuilder builder(source);
  const bool has_attributes = has_attribute_bytes(source.bytes);
  const uint64_t count = has_attributes ? announced_triangles(source.bytes) : checked_count(source);
  builder.reserve(0, count);
  VertexMerger merger(builder, count);
  uint64_t end = kHeaderBytes;
  for (uint64_t t = 0; t < count; ++t) {
    glm::uvec3 face{};
    for (int i = 0; i < 3; ++i) {
      const size_t corner = end + 12 + 12 * static_cast<size_t>(i);
      const glm::dvec3 p(load_position(source.bytes.data() + corner));
      if (!is_finite(p)) {
        reject(source.name, "triangle " + std::to_string(t) + ", " + byte_place(corner),
               "a coordinate is nan or infinite", "finite coordinates");
      }
      face[i] = merger.insert(p);
    }
    builder.add_triangle(face);
    end += kTriangleBytes + (has_attributes ? attribute_of(source.bytes, end) : 0);
  }
  if (has_attributes) {
    builder.notes.push_back(note_of(
        NoteCode::kUnread, counted(end - kHeaderBytes - count * kTriangleBytes, "attribute byte") +
                               " behind triangles ignored"));
  }
  check_rest(source.bytes.substr(end), end, builder);
  return std::move(builder).finish(byte_place(kHeaderBytes));
}

// Refuses merged corners that break the limit as a reader of one corner after the other does, which
// counts a corner before it finds it to be a repeat.
template <class Corner>
FileMeshBuilder merged(const MeshSource& source, const ThreadPool& pool, Array<Corner> corners) {
  constexpr uint64_t kSpare = 12;
  MergedCorners mesh = CornerMerger(pool, corners).merge();
  const uint64_t bytes = mesh_bytes(mesh.vertices.size(), mesh.faces.size());
  if (bytes + kSpare > source.limits.max_input_bytes)
    reject(source.name, "byte 0", counted(bytes, "byte"), "fewer");
  return {source, std::move(mesh.vertices), std::move(mesh.faces)};
}

ReadMesh read_binary_by_blocks(const MeshSource& source) {
  constexpr uint64_t kMostRest = uint64_t{1} << 20;
  const uint64_t count = checked_count(source), end = kHeaderBytes + count * kTriangleBytes;
  const uint64_t per_block = std::max<uint64_t>(1, block_bytes_of(source) / kTriangleBytes);
  FileMeshBuilder(source).check_room(0, count);
  if (source.size() - end > kMostRest)
    reject(source.name, byte_place(end), "more than is looked at", "less");
  const ThreadPool pool = pool_of(source);
  Windows windows(source);
  Array<glm::vec3> corners(3 * count);
  pool.for_each((count + per_block - 1) / per_block, [&](size_t i) {
    const uint64_t begin = i * per_block, stop = std::min(count, begin + per_block);
    Windows::Window window(windows);
    const std::string_view bytes =
        window.read(kHeaderBytes + begin * kTriangleBytes, kHeaderBytes + stop * kTriangleBytes);
    for (uint64_t c = 0; c < 3 * (stop - begin); ++c) {
      const char* const at = bytes.data() + c / 3 * kTriangleBytes + 12 + c % 3 * 12;
      corners[3 * begin + c] = load_position(at);
      if (!is_finite(corners[3 * begin + c]))
        reject(source.name, byte_place(0), "a coordinate is nan or infinite", "finite coordinates");
    }
    // The first count that is not 0 stands where it does in a file without attribute bytes.
    for (uint64_t t = 0; end != source.size() && t < stop - begin; ++t) {
      if (attribute_of(bytes, t * kTriangleBytes) != 0)
        reject(source.name, byte_place(0), "attribute bytes, perhaps", "none");
    }
    count_read(source, bytes.size());
  });
  FileMeshBuilder builder = merged(source, pool, std::move(corners));
  check_rest(Windows::Window(windows).read(end, source.size()), end, builder);
  return std::move(builder).finish(byte_place(kHeaderBytes), Positions::kDiffer);
}

bool is_word(std::string_view word, std::string_view lower) {
  return std::equal(word.begin(), word.end(), lower.begin(), lower.end(), [](char a, char b) {
    return std::tolower(static_cast<unsigned char>(a)) == b;
  });
}

// STL has no sign for remarks; these are the signs of other formats.
bool is_remark(std::string_view word) {
  return word.starts_with('#') || word.starts_with("//") || word.starts_with(';') ||
         word.starts_with('!');
}

/// Text beside the facets, for notes.
struct Beside {
  uint64_t remarks = 0;
  size_t first_remark = 0;   ///< its line
  bool lacks_solid = false;  ///< the text begins with a facet

  bool is_any() const { return remarks > 0 || lacks_solid; }
};

// `Use` receives each corner and the end of each facet.
template <class Use>
class AsciiReader {
 public:
  AsciiReader(const MeshSource& source, const TextBlock& block, Use& use)
      : block_(block), scanner_(block.scanner(source.name)), use_(use) {}

  // A block that is not the first begins inside a solid, at a facet; a block that is not the last
  // ends there. The solid then goes on in the next block.
  void read() {
    if (block_.is_first) open_first();
    while (read_solid()) {
      skip_name();
      if (!another_solid()) return;
      skip_name();
    }
  }

  std::string place() const { return scanner_.place(); }
  const Beside& beside() const { return beside_; }

 private:
  static constexpr const char* kFacetOrEnd = "'facet' or 'endsolid'";

  // Skips to the end of the line. A name is any words, but a file without line ends would hide in
  // it.
  void skip_name() {
    for (auto word = scanner_.word(); !word.empty(); word = scanner_.word()) {
      if (is_word(word, "endfacet")) fail_word(word, "a facet to begin on a line of its own");
    }
  }

  // Reads to the first solid's name, or its first facet.
  void open_first() {
    const std::string_view word = next_word();
    if (is_word(word, "solid")) return skip_name();
    if (!is_word(word, "facet")) fail_word(word, "'solid', as text STL begins, or a binary STL");
    beside_.lacks_solid = true;
    read_facet();
  }

  // The next word, across lines and remarks.
  std::string_view next_word() {
    std::string_view word = scanner_.word_across_lines();
    for (; is_remark(word); word = scanner_.word_across_lines()) {
      if (beside_.remarks++ == 0) beside_.first_remark = scanner_.line_number();
      scanner_.skip_line();
    }
    return word;
  }

  // "endsolid", to which a name may be glued, or "end solid".
  bool is_end_of_solid(std::string_view word) {
    if (!is_word(word, "end")) return is_word(word.substr(0, 8), "endsolid");
    expect({"solid"});
    return true;
  }

  /// Returns false if the block ends inside it.
  bool read_solid() {
    for (;;) {
      const std::string_view word = next_word();
      if (is_end_of_solid(word)) return true;
      if (word.empty() && (!block_.is_last || beside_.lacks_solid)) return false;
      if (is_word(word, "color") || is_word(word, "solid")) {  // a line twice is one
        skip_name();
        continue;
      }
      if (!is_word(word, "facet")) fail_word(word, kFacetOrEnd);
      read_facet();
    }
  }

  // The normal is skipped, not read: exporters write nan there for degenerate triangles.
  void read_facet() {
    expect({"normal"});
    for (int i = 0; i < 3; ++i) scanner_.word_across_lines();
    expect({"outer", "loop"});
    for (int i = 0; i < 3; ++i) {
      expect({"vertex"});
      glm::dvec3 p{};
      for (int axis = 0; axis < 3; ++axis) p[axis] = scanner_.number<double>("coordinate");
      use_.corner(p);
    }
    expect_end("loop");
    expect_end("facet");
    use_.end_facet();
  }

  // Expects "endloop", or "end loop".
  void expect_end(const std::string& what) {
    const std::string_view word = scanner_.word_across_lines();
    if (is_word(word, "end")) return expect({what.c_str()});
    if (!is_word(word, "end" + what)) fail_word(word, vkh::quoted("end" + what));
  }

  bool another_solid() {
    std::string_view word = next_word();
    while (is_end_of_solid(word)) {  // its line twice, as that of "solid"
      skip_name();
      word = next_word();
    }
    if (word.empty() && block_.is_last) return false;
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

  const TextBlock block_;
  TextScanner scanner_;
  Use& use_;
  Beside beside_;
};

class MergingUse {
 public:
  MergingUse(FileMeshBuilder& builder, size_t triangle_count)
      : builder_(builder), merger_(builder, triangle_count) {}

  void corner(const glm::dvec3& p) { face_[corners_++] = merger_.insert(p); }
  void end_facet() {
    builder_.add_triangle(face_);
    corners_ = 0;
  }

 private:
  FileMeshBuilder& builder_;
  VertexMerger merger_;
  glm::uvec3 face_{};
  int corners_ = 0;
};

void note_beside(const Beside& beside, std::vector<Note>& notes) {
  if (beside.lacks_solid)
    notes.push_back(
        note_of(NoteCode::kUnread,
                "no line 'solid': the text begins with a facet, and is read to its end"));
  if (beside.remarks > 0)
    notes.push_back(note_of(NoteCode::kUnread, counted(beside.remarks, "line") +
                                                   " taken for remarks and ignored, the first is "
                                                   "line " +
                                                   std::to_string(beside.first_remark)));
}

ReadMesh read_ascii(const MeshSource& source) {
  FileMeshBuilder builder(source);
  std::string place;
  {
    MergingUse use(builder, source.bytes.size() / 200);
    AsciiReader reader(source, whole_text(source), use);
    reader.read();
    place = reader.place();
    note_beside(reader.beside(), builder.notes);
  }  // its memory is free before more is taken
  return std::move(builder).finish(place);
}

// Whether text begins like STL, perhaps after remarks: with a solid, or with a facet without one.
bool begins_as_stl(std::string_view text) {
  TextScanner scanner(text, "", '\0', MixedLineEnds::kIgnored);
  std::string_view word = scanner.word_across_lines();
  while (is_remark(word)) {
    scanner.skip_line();
    word = scanner.word_across_lines();
  }
  const std::string_view begin = word.substr(0, 5);
  return is_word(begin, "solid") || is_word(begin, "facet");
}

// Whether the file is as long as a binary STL's header announces, or longer.
bool has_room_for_binary(const MeshSource& source, std::string_view head) {
  return head.size() >= kHeaderBytes &&
         announced_triangles(head) <= (source.size() - kHeaderBytes) / kTriangleBytes;
}

// Whether text stands where a binary STL would have its count, so that it announces more triangles
// than the file has room for.
bool has_text_for_count(const MeshSource& source, std::string_view bytes) {
  return is_printable(bytes.substr(std::min(bytes.size(), kHeaderBytes - 4), 4)) &&
         !has_room_for_binary(source, bytes);
}

// Binary headers often begin with "solid" too, but binary files hold zero bytes, at least in the
// attributes. For text that begins otherwise the error says so, instead of counting the triangles
// that its bytes announce.
bool is_ascii(const MeshSource& source, std::string_view bytes) {
  const size_t zero = bytes.find('\0');
  if (zero == std::string_view::npos) {
    return begins_as_stl(bytes) || (!bytes.empty() && has_text_for_count(source, bytes) &&
                                    is_printable(bytes.substr(0, kHeaderBytes)));
  }
  if (has_text_for_count(source, bytes) && has_facets(bytes.substr(0, zero))) {
    reject(source.name, byte_place(zero), "a zero byte in text",
           "text alone; a binary STL behind it is a file of its own");
  }
  return false;
}

/// Keeps the corners of a block, three for each facet.
struct KeepingUse {
  std::vector<glm::dvec3> corners;

  void corner(const glm::dvec3& p) { corners.push_back(p); }
  void end_facet() {}
};

/// Joins one block's corners after the other's, each freed as it is copied.
Array<glm::dvec3> joined(const ThreadPool& pool, std::vector<KeepingUse> blocks) {
  std::vector<size_t> starts;
  starts.reserve(blocks.size());
  for (const KeepingUse& block : blocks) starts.push_back(block.corners.size());
  const size_t count = starts_of(starts);
  if (count >= UINT32_MAX) throw InputError("more corners than are read by blocks");
  Array<glm::dvec3> all(count);
  pool.for_each(blocks.size(), [&](size_t i) {
    std::vector<glm::dvec3>& corners = blocks[i].corners;
    std::copy(corners.begin(), corners.end(), all.begin() + starts[i]);
    corners = {};
  });
  return all;
}

ReadMesh read_ascii_by_blocks(const MeshSource& source) {
  const ThreadPool pool = pool_of(source);
  TextBlocks blocks(source, 0, Cut::kFacet);
  std::vector<KeepingUse> read(blocks.count());
  blocks.for_each(pool, [&](size_t i, const TextBlock& block) {
    if (block.text.find('\0') != std::string_view::npos)
      reject(source.name, byte_place(0), "a zero byte", "text");
    AsciiReader reader(source, block, read[i]);
    reader.read();
    if (reader.beside().is_any())  // notes are of the whole file
      reject(source.name, byte_place(0), "text beside the facets", "none");
  });
  return merged(source, pool, joined(pool, std::move(read))).finish("byte 0", Positions::kDiffer);
}

// Some writers end text as C or DOS did: with zero bytes, or with Ctrl-Z.
std::string_view without_end_marks(std::string_view text) {
  while (!text.empty() && (text.back() == '\0' || text.back() == '\x1a')) text.remove_suffix(1);
  return text;
}

ReadMesh read_stl_whole(const MeshSource& source) {
  MeshSource text = source;
  text.bytes = without_end_marks(source.bytes);
  if (!is_exact_binary_stl(source.bytes, source.size()) && is_ascii(source, text.bytes))
    return read_ascii(text);
  return read_binary(source);
}

ReadMesh read_stl_by_blocks(const MeshSource& source) {
  const std::string head = head_of(source, 4096);
  if (is_exact_binary_stl(head, source.size()) || !begins_as_stl(head))
    return read_binary_by_blocks(source);
  // Zero bytes may be a binary header's, or end marks behind text: the whole file decides.
  if (head.find('\0') != std::string::npos)
    reject(source.name, byte_place(0), "text with zero bytes, perhaps", "text");
  return read_ascii_by_blocks(source);
}

}  // namespace

bool is_exact_binary_stl(std::string_view head, uint64_t size) {
  return head.size() >= kHeaderBytes &&
         size == kHeaderBytes + announced_triangles(head) * kTriangleBytes;
}

ReadMesh parse_stl(const MeshSource& source) {
  return by_blocks_or_whole(source, read_stl_by_blocks, read_stl_whole);
}

}  // namespace vkh
