// OBJ: vertices and faces. Materials, normals, textures and groups are no geometry and are skipped.
//
// This parser is our own: tinyobjloader (2.0.0rc10) reads on one thread and does not keep our
// contract. Its coordinates are off by ulps, nan and inf become 0, '1,5' and '1/3' become 1;
// indices go through atoi, which wraps 2^32+3 to 3; continued lines and '2/2/' are refused.
#include <algorithm>
#include <array>

#include "host/base/parse_number.h"
#include "host/base/reject.h"
#include "host/read/readers.h"
#include "host/read/text_blocks.h"
#include "vkhausdorff/note.h"

namespace vkh {
namespace {

constexpr const char* kIndexForms = "a vertex index such as 7, 7/1, 7//1 or 7/1/1";

// Every keyword of the format, so that no face is lost in silence. v and f are read, and fo, the
// first versions' f, which the format reads as f. A line that
// moves no point of a surface is skipped: names, groups, display, materials, texture coordinates,
// normals, tinyobj's bone weights and tags (vw, t), materials that were pasted in and colours
// (newmtl to vc), and the words that only describe a curve or a free-form surface. A line that is
// no triangle mesh is noted: points, lines and curves; free-form surfaces, which we do not read;
// files and commands that are called; lines that begin with $ or //, as programs write remarks that
// OBJ has no sign for. Any other word is refused: F, V, a keyword misspelt or glued to something,
// text.
enum class Line { kVertex, kFace, kSkipped, kElement, kSurface, kCall, kRemark, kUnknown };

// Recognises a line of a material library (MTL), which some exporters paste into the mesh: lines
// that name a picture, by any word that begins with map_.
bool is_map(std::string_view keyword) {
  static constexpr std::array<std::string_view, 6> kMaps = {"bump", "Bump",  "disp",
                                                            "refl", "decal", "norm"};
  return keyword.starts_with("map_") || keyword.starts_with("Map_") ||
         std::find(kMaps.begin(), kMaps.end(), keyword) != kMaps.end();
}

Line kind_of(std::string_view keyword) {
  static constexpr std::array<std::string_view, 54> kSkipped = {
      "",          "vn",    "vt",     "g",     "s",      "o",        "usemtl",   "mtllib",
      "vp",        "vw",    "t",      "mg",    "usemap", "maplib",   "lod",      "shadow_obj",
      "trace_obj", "end",   "cstype", "deg",   "bmat",   "c_interp", "d_interp", "sp",
      "step",      "parm",  "trim",   "hole",  "scrv",   "con",      "ctech",    "stech",
      "res",       "bevel", "newmtl", "illum", "Ka",     "Kd",       "Ks",       "Ke",
      "Ns",        "Ni",    "d",      "Tr",    "Tf",     "vc",       "Km",       "sharpness",
      "Pr",        "Pm",    "Ps",     "Pc",    "Pcr",    "aniso"};
  static constexpr std::array<std::string_view, 6> kElements = {"p",     "l",   "curv",
                                                                "curv2", "cdc", "cdp"};
  static constexpr std::array<std::string_view, 3> kSurfaces = {"surf", "bsp", "bzp"};
  const auto is_in = [&](const auto& words) {
    return std::find(words.begin(), words.end(), keyword) != words.end();
  };
  if (keyword == "v") return Line::kVertex;
  if (keyword == "f" || keyword == "fo") return Line::kFace;
  if (is_in(kSkipped)) return Line::kSkipped;
  if (is_in(kElements)) return Line::kElement;
  if (is_in(kSurfaces)) return Line::kSurface;
  if (keyword == "call" || keyword == "csh") return Line::kCall;
  if (keyword.starts_with('$') || keyword.starts_with("//")) return Line::kRemark;
  return is_map(keyword) ? Line::kSkipped : Line::kUnknown;
}

/// The vertices that a block's faces refer to.
struct Range {
  int64_t least = 0;     ///< the least relative one, from the block's first vertex
  int64_t greatest = 0;  ///< counted from 1; a face may stand before its vertices
};

/// Lines that hold something other than a triangle mesh.
struct Ignored {
  uint64_t elements = 0;  ///< points, lines and curves
  uint64_t surfaces = 0;
  uint64_t calls = 0;
  uint64_t remarks = 0;
  std::string first_remark = {};  ///< its beginning, quoted

  void add(const Ignored& more) {
    elements += more.elements;
    surfaces += more.surfaces;
    calls += more.calls;
    if (remarks == 0) first_remark = more.first_remark;
    remarks += more.remarks;
  }
};

class ObjReader {
 public:
  ObjReader(const MeshSource& source, const TextBlock& block, FileMeshBuilder& builder)
      : source_(source),
        block_(block),
        builder_(builder),
        scanner_(block.scanner(source.name, '#')) {}

  void read() {
    if (const size_t zero = block_.text.find('\0'); zero != std::string_view::npos) {
      reject(source_.name, "byte " + std::to_string(zero), "a zero byte", "text, as OBJ is");
    }
    while (scanner_.next_line()) read_line();
  }

  const Ignored& ignored() const { return ignored_; }

  const Range& range() const { return range_; }
  /// Corners of faces, by number, that count from the block's first vertex, modulo 2^32, since they
  /// may be before it.
  const std::vector<uint32_t>& relative() const { return relative_; }

  void check_greatest() const {
    if (range_.greatest > static_cast<int64_t>(builder_.vertices().size()))
      fail_index(range_.greatest, greatest_place_);
  }
  std::string place() const { return scanner_.place(); }

 private:
  /// Says how the next line may continue a skipped line that ends in a backslash: not at all, by
  /// numbers (as long curves do) or by names (as group lists do).
  enum class Continued { kNot, kByNumbers, kByNames };

  void read_line() {
    const std::string_view keyword = scanner_.word();
    const Line line = kind_of(keyword);
    if (line != Line::kVertex && line != Line::kFace) return skip(line, keyword);
    continued_ = Continued::kNot;
    scanner_.join_continued_lines();
    if (line == Line::kVertex) {
      read_vertex();
    } else {
      read_face();
    }
  }

  // A name may end in a backslash: 'usemtl C:\red\' does not swallow a face.
  static Continued continued_by(std::string_view keyword) {
    static constexpr std::array<std::string_view, 10> kNames = {
        "",       "usemtl", "mtllib",     "usemap",    "maplib",
        "newmtl", "o",      "shadow_obj", "trace_obj", "lod"};
    if (std::find(kNames.begin(), kNames.end(), keyword) != kNames.end() || is_map(keyword))
      return Continued::kNot;
    return keyword == "g" ? Continued::kByNames : Continued::kByNumbers;
  }

  void skip(Line line, std::string_view keyword) {
    if (line == Line::kUnknown && !is_skipped_too(keyword)) {
      scanner_.fail(quoted(keyword) + " begins the line",
                    "a keyword of OBJ, such as v, f, vn or usemtl");
    }
    ignored_.elements += line == Line::kElement ? 1 : 0;
    ignored_.surfaces += line == Line::kSurface ? 1 : 0;
    ignored_.calls += line == Line::kCall ? 1 : 0;
    if (line == Line::kRemark) {
      if (ignored_.remarks++ == 0) ignored_.first_remark = quoted(keyword);
      continued_ = Continued::kNot;
    } else if (!scanner_.is_continued()) {
      continued_ = Continued::kNot;
    } else if (line != Line::kUnknown) {
      continued_ = continued_by(keyword);
    }  // otherwise as the line that this one continues
  }

  // Handles lines that begin with no keyword. Skips lines that continue a skipped line, as long
  // curves (numbers) and group lists (names) have them, unless they may be a face. Also skips the
  // Ctrl-Z by which DOS programs end a text. A line with a keyword is never taken for a
  // continuation.
  bool is_skipped_too(std::string_view keyword) {
    if (continued_ == Continued::kByNumbers) {
      return keyword.find_first_not_of("+-.0123456789eE/\\") == std::string_view::npos;
    }
    if (continued_ == Continued::kByNames) return !may_be_geometry(keyword);
    return keyword == "\x1a" && scanner_.word().empty() && scanner_.bytes_left() == 0 &&
           block_.is_last;
  }

  // Recognises 'FACE 1 2 4' and 'f<no-break space>1 2 4', but not a group's name such as 'front'.
  bool may_be_geometry(std::string_view keyword) {
    if (std::string_view("fFvV").find(keyword.front()) == std::string_view::npos) return false;
    const std::string_view next = scanner_.word();
    return keyword.size() == 1 ||
           (!next.empty() && next.find_first_not_of("+-.0123456789/") == std::string_view::npos);
  }

  // Reads x y z, then perhaps a weight or a colour: checked to be numbers, not used.
  void read_vertex() {
    glm::dvec3 p{};
    for (int axis = 0; axis < 3; ++axis) p[axis] = scanner_.coordinate();
    double unused = 0;
    size_t behind = 0;
    std::string_view nan;
    for (auto word = scanner_.word(); !word.empty(); word = scanner_.word(), ++behind) {
      if (parse_number(word, unused)) continue;
      if (!is_printed_nan(word)) scanner_.fail(quoted(word) + " in a vertex", "a number");
      nan = word;
    }
    // A colour has three components, and is not used; a weight is one.
    if (!nan.empty() && behind < 3) scanner_.fail(quoted(nan) + " in a vertex", "a number");
    builder_.add_vertex(p);
  }

  void read_face() {
    indices_.clear();
    for (auto word = scanner_.word(); !word.empty(); word = scanner_.word())
      indices_.push_back(checked_corner(word));
    corners_.clear();
    for (const int32_t index : indices_) corners_.push_back(resolve(index));
    if (!block_.is_first) note_relative();
    builder_.add_face(corners_);
  }

  // Reads the position index of i, i/j, i//k or i/j/k, where j and k may be missing.
  int32_t checked_corner(std::string_view word) {
    int64_t position = 0;
    std::string_view rest = word;
    for (int part = 0; part < 3 && !rest.empty(); ++part) {
      const std::string_view number = rest.substr(0, rest.find('/'));
      rest.remove_prefix(std::min(rest.size(), number.size() + 1));
      int64_t value = 0;
      if ((part == 0 || !number.empty()) && !parse_number(number, value)) fail_corner(word);
      if (part > 0) continue;
      position = value;
      if (value != static_cast<int32_t>(value)) {
        scanner_.fail("index " + quoted(number), "one of 32 bits");
      }
    }
    if (!rest.empty()) fail_corner(word);
    return static_cast<int32_t>(position);
  }

  [[noreturn]] void fail_corner(std::string_view word) {
    scanner_.fail(quoted(word) + " in a face", kIndexForms);
  }

  // Resolves an index. In a block that is not the first, a relative one is known when the blocks
  // before it are.
  uint32_t resolve(int64_t index) {
    const auto count = static_cast<int64_t>(builder_.vertices().size());
    if (index == 0 || (block_.is_first && index < -count)) fail_index(index, scanner_.place());
    if (index < 0) {
      range_.least = std::min(range_.least, count + index);
      return static_cast<uint32_t>(count + index);
    }
    if (index > count && index > range_.greatest) {
      range_.greatest = index;
      greatest_place_ = scanner_.place();
    }
    return static_cast<uint32_t>(index - 1);
  }

  // Records which corners of the face's triangles had negative indices: they are shifted once the
  // number of vertices in the blocks before is known.
  void note_relative() {
    if (std::none_of(indices_.begin(), indices_.end(), [](int32_t i) { return i < 0; })) return;
    size_t number = 3 * builder_.face_count();
    for (size_t i = 2; i < indices_.size(); ++i, number += 3) {
      const std::array<size_t, 3> corners = {0, i - 1, i};
      for (size_t k = 0; k < 3; ++k) {
        if (indices_[corners[k]] < 0) relative_.push_back(static_cast<uint32_t>(number + k));
      }
    }
  }

  [[noreturn]] void fail_index(int64_t index, const std::string& place) const {
    const size_t vertex_count = builder_.vertices().size();
    const std::string count = std::to_string(vertex_count);
    reject(source_.name, place, "index " + std::to_string(index) + " of " + count + " vertices",
           vertex_count == 0 ? "vertices before relative indices"
                             : "1 to " + count + " or -" + count + " to -1");
  }

  const MeshSource& source_;
  const TextBlock block_;
  FileMeshBuilder& builder_;
  TextScanner scanner_;
  Ignored ignored_;
  std::vector<int32_t> indices_;
  std::vector<uint32_t> corners_, relative_;
  Continued continued_ = Continued::kNot;  ///< the way in which the skipped line before may go on
  Range range_;
  std::string greatest_place_;
};

void note_ignored(const Ignored& lines, std::vector<Note>& notes) {
  if (lines.elements > 0) {
    notes.push_back(note_of(NoteCode::kElements, counted(lines.elements, "line") +
                                                     " with points, polylines or curves ignored"));
  }
  if (lines.surfaces > 0) {
    notes.push_back(note_of(NoteCode::kSurfaces, counted(lines.surfaces, "free-form surface") +
                                                     " not read: only the faces are measured"));
  }
  if (lines.calls > 0) {
    notes.push_back(note_of(NoteCode::kCalls, counted(lines.calls, "call") +
                                                  " of other files or commands not followed"));
  }
  if (lines.remarks > 0) {
    notes.push_back(
        note_of(NoteCode::kUnread, counted(lines.remarks, "line") +
                                       " taken for remarks and ignored, the first begins with " +
                                       lines.first_remark));
  }
}

ReadMesh read_obj_whole(const MeshSource& source) {
  FileMeshBuilder builder(source);
  ObjReader reader(source, whole_text(source), builder);
  reader.read();
  reader.check_greatest();
  note_ignored(reader.ignored(), builder.notes);
  return std::move(builder).finish(reader.place());
}

/// The results of a block, beside its builder.
struct ObjBlock {
  Ignored ignored;
  Range range;
  std::vector<uint32_t> relative;
};

void place_relative(const ObjBlock& block, size_t vertices_before, FileMeshBuilder& builder) {
  if (static_cast<int64_t>(vertices_before) + block.range.least < 0)
    reject(builder.name(), "byte 0", "an index before the first vertex", "none");
  for (const uint32_t number : block.relative)
    builder.corner(number) += static_cast<uint32_t>(vertices_before);
}

ReadMesh read_obj_by_blocks(const MeshSource& source) {
  const ThreadPool pool = pool_of(source);
  TextBlocks blocks(source, 0, Cut::kUncontinued);
  std::vector<FileMeshBuilder> builders = blocks.builders();
  std::vector<ObjBlock> read(blocks.count());
  blocks.for_each(pool, [&](size_t i, const TextBlock& block) {
    ObjReader reader(blocks.source(), block, builders[i]);
    reader.read();
    read[i] = {reader.ignored(), reader.range(), reader.relative()};
  });
  std::vector<size_t> starts;
  starts.reserve(builders.size());
  for (const FileMeshBuilder& builder : builders) starts.push_back(builder.vertices().size());
  const size_t vertex_count = starts_of(starts);
  pool.for_each(read.size(), [&](size_t i) { place_relative(read[i], starts[i], builders[i]); });
  FileMeshBuilder all = FileMeshBuilder::joined(source, std::move(builders));
  Ignored ignored;
  for (const ObjBlock& block : read) {
    ignored.add(block.ignored);
    if (block.range.greatest > static_cast<int64_t>(vertex_count))
      reject(source.name, "byte 0", "an index after the last vertex", "none");
  }
  note_ignored(ignored, all.notes);
  return std::move(all).finish("byte 0");
}

}  // namespace

ReadMesh parse_obj(const MeshSource& source) {
  return by_blocks_or_whole(source, read_obj_by_blocks, read_obj_whole);
}

}  // namespace vkh
