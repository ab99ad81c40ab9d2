// OBJ through tinyobjloader's callback interface, fed line by line by ObjSource.
//
// tinyobjloader alone does not keep our contract (measured with 2.0.0rc10): in both of its modes
// coordinates are off by ulps, nan and inf become 0, '1,5' and '1/3' become 1; indices go through
// atoi, which wraps 2^32+3 to 3; continued lines and '2/2/' are refused. So ObjSource checks each v
// and f line and reads the coordinates itself, and hands on a plain v or f line; tinyobjloader
// parses the faces and says what it saw. Materials, normals, textures and groups are no geometry
// and are not handed on.
#include <algorithm>
#include <array>
#include <istream>
#include <streambuf>

#include "host/base/text_scanner.h"
#include "host/read/readers.h"

#define TINYOBJLOADER_IMPLEMENTATION
#include <tiny_obj_loader.h>

namespace vkh {
namespace {

constexpr const char* kIndexForms = "a vertex index such as 7, 7/1, 7//1 or 7/1/1";

// Every keyword of the format, so that no face is lost in silence. v and f are read. What moves no
// point of a surface is skipped: names, groups, display, materials, texture coordinates, normals,
// tinyobj's bone weights and tags (vw, t), materials that were pasted in and colours (newmtl to
// vc), and the words that only describe a curve or a free-form surface. What is no triangle mesh is
// noted: points, lines and curves; free-form surfaces, which we do not read; files and commands
// that are called. Any other word is refused: F, fo (the first versions' f), V, a keyword misspelt
// or glued to something, text.
enum class Line { kVertex, kFace, kSkipped, kElement, kSurface, kCall, kUnknown };

Line kind_of(std::string_view keyword) {
  static constexpr std::array<std::string_view, 46> kSkipped = {
      "",          "vn",    "vt",     "g",     "s",      "o",        "usemtl",   "mtllib",
      "vp",        "vw",    "t",      "mg",    "usemap", "maplib",   "lod",      "shadow_obj",
      "trace_obj", "end",   "cstype", "deg",   "bmat",   "c_interp", "d_interp", "sp",
      "step",      "parm",  "trim",   "hole",  "scrv",   "con",      "ctech",    "stech",
      "res",       "bevel", "newmtl", "illum", "Ka",     "Kd",       "Ks",       "Ke",
      "Ns",        "Ni",    "d",      "Tr",    "Tf",     "vc"};
  static constexpr std::array<std::string_view, 6> kElements = {"p",     "l",   "curv",
                                                                "curv2", "cdc", "cdp"};
  static constexpr std::array<std::string_view, 3> kSurfaces = {"surf", "bsp", "bzp"};
  const auto is_in = [&](const auto& words) {
    return std::find(words.begin(), words.end(), keyword) != words.end();
  };
  if (keyword == "v") return Line::kVertex;
  if (keyword == "f") return Line::kFace;
  if (is_in(kSkipped)) return Line::kSkipped;
  if (is_in(kElements)) return Line::kElement;
  if (is_in(kSurfaces)) return Line::kSurface;
  return keyword == "call" || keyword == "csh" ? Line::kCall : Line::kUnknown;
}

class ObjSource : public std::streambuf {
 public:
  ObjSource(const MeshSource& source, MeshBuilder& builder)
      : builder_(builder), scanner_(source.bytes, source.name, '#') {}

  uint64_t ignored_elements = 0;  ///< points, lines and curves
  uint64_t ignored_surfaces = 0;
  uint64_t ignored_calls = 0;
  uint64_t empty_faces = 0;  ///< f without corners, about which tinyobjloader is silent

  const TextScanner& scanner() const { return scanner_; }

 protected:
  // The buffer holds one line at a time: when tinyobjloader calls back, the scanner still stands at
  // that line and can name it.
  int_type underflow() override {
    while (scanner_.next_line()) {
      const std::string_view keyword = scanner_.word();
      const Line line = kind_of(keyword);
      if (line == Line::kVertex) {
        read_vertex();
      } else if (line == Line::kFace) {
        check_face();
      } else {
        skip(line, keyword);
        continue;
      }
      continued_ = Continued::kNot;
      setg(line_.data(), line_.data(), line_.data() + line_.size());
      return traits_type::to_int_type(line_[0]);
    }
    return traits_type::eof();
  }

 private:
  /// What a line may be continued by on the next one.
  enum class Continued { kNot, kByNumbers, kByNames };

  // A name may end in a backslash: 'usemtl C:\red\' does not swallow a face.
  static Continued continued_by(std::string_view keyword) {
    static constexpr std::array<std::string_view, 10> kNames = {
        "",       "usemtl", "mtllib",     "usemap",    "maplib",
        "newmtl", "o",      "shadow_obj", "trace_obj", "lod"};
    if (std::find(kNames.begin(), kNames.end(), keyword) != kNames.end()) return Continued::kNot;
    return keyword == "g" ? Continued::kByNames : Continued::kByNumbers;
  }

  void skip(Line line, std::string_view keyword) {
    if (line == Line::kUnknown && !is_skipped_too(keyword)) {
      scanner_.fail(quoted(keyword) + " begins the line",
                    "a keyword of OBJ, such as v, f, vn or usemtl");
    }
    ignored_elements += line == Line::kElement ? 1 : 0;
    ignored_surfaces += line == Line::kSurface ? 1 : 0;
    ignored_calls += line == Line::kCall ? 1 : 0;
    if (!scanner_.is_continued()) {
      continued_ = Continued::kNot;
    } else if (line != Line::kUnknown) {
      continued_ = continued_by(keyword);
    }  // else as the line that this one continues
  }

  // Of the lines that begin with no keyword: what continues a skipped line, as those of long curves
  // (numbers) and group lists (names) do, but not what may be a face; and the Ctrl-Z by which DOS
  // programs end a text. A line with a keyword is never taken for a continuation.
  bool is_skipped_too(std::string_view keyword) {
    if (continued_ == Continued::kByNumbers) {
      return keyword.find_first_not_of("+-.0123456789eE/\\") == std::string_view::npos;
    }
    if (continued_ == Continued::kByNames) return !may_be_geometry(keyword);
    return keyword == "\x1a" && scanner_.word().empty() && scanner_.bytes_left() == 0;
  }

  // 'FACE 1 2 4' and 'f<no-break space>1 2 4', but not a group's name such as 'front'.
  bool may_be_geometry(std::string_view keyword) {
    if (std::string_view("fFvV").find(keyword.front()) == std::string_view::npos) return false;
    const std::string_view next = scanner_.word();
    return keyword.size() == 1 ||
           (!next.empty() && next.find_first_not_of("+-.0123456789/") == std::string_view::npos);
  }

  // x y z, then perhaps a weight or a colour: checked to be numbers, not used.
  void read_vertex() {
    scanner_.join_continued_lines();
    glm::dvec3 p{};
    for (int axis = 0; axis < 3; ++axis) p[axis] = scanner_.number<double>("coordinate");
    double unused = 0;
    for (auto word = scanner_.word(); !word.empty(); word = scanner_.word()) {
      if (!parse_number(word, unused)) scanner_.fail(quoted(word) + " in a vertex", "a number");
    }
    builder_.add_vertex(p);
    line_ = "v 0 0 0\n";
  }

  void check_face() {
    scanner_.join_continued_lines();
    line_ = "f";
    for (auto word = scanner_.word(); !word.empty(); word = scanner_.word()) {
      line_.append(" ").append(checked_corner(word));
    }
    line_ += '\n';
    if (line_ == "f\n") ++empty_faces;
  }

  // The position index of i, i/j, i//k or i/j/k, where j and k may be missing.
  std::string_view checked_corner(std::string_view word) {
    std::string_view position;
    std::string_view rest = word;
    for (int part = 0; part < 3 && !rest.empty(); ++part) {
      const std::string_view number = rest.substr(0, rest.find('/'));
      rest.remove_prefix(std::min(rest.size(), number.size() + 1));
      int64_t value = 0;
      if ((part == 0 || !number.empty()) && !parse_number(number, value)) fail_corner(word);
      if (part == 0) {
        position = number;
        if (value != static_cast<int32_t>(value)) {
          scanner_.fail("index " + quoted(number), "one of 32 bits");
        }
      }
    }
    if (!rest.empty() || position.empty()) fail_corner(word);
    return position;
  }

  [[noreturn]] void fail_corner(std::string_view word) {
    scanner_.fail(quoted(word) + " in a face", kIndexForms);
  }

  MeshBuilder& builder_;
  TextScanner scanner_;
  std::string line_;
  Continued continued_ = Continued::kNot;  ///< by what the skipped line before may go on
};

// What tinyobjloader calls back.
class FaceReader {
 public:
  FaceReader(ObjSource& source, MeshBuilder& builder) : source_(source), builder_(builder) {}

  static tinyobj::callback_t callbacks() {
    tinyobj::callback_t callbacks;
    callbacks.vertex_cb = [](void* self, tinyobj::real_t, tinyobj::real_t, tinyobj::real_t,
                             tinyobj::real_t) { ++static_cast<FaceReader*>(self)->vertex_count_; };
    callbacks.index_cb = [](void* self, tinyobj::index_t* indices, int count) {
      static_cast<FaceReader*>(self)->add({indices, static_cast<size_t>(count)});
    };
    return callbacks;
  }

  // A face may stand before its vertices, so indices above the count are judged at the end.
  void check_end() const {
    if (vertex_count_ != builder_.vertices().size()) {
      source_.scanner().fail("tinyobjloader saw " + std::to_string(vertex_count_) + " vertices",
                             std::to_string(builder_.vertices().size()));
    }
    if (greatest_ > vertex_count_) fail_index(greatest_, greatest_place_);
  }

 private:
  void add(std::span<const tinyobj::index_t> indices) {
    corners_.clear();
    for (const tinyobj::index_t& index : indices) corners_.push_back(resolve(index.vertex_index));
    builder_.add_face(corners_);
  }

  uint32_t resolve(int64_t index) {
    const auto count = static_cast<int64_t>(vertex_count_);
    if (index == 0 || index < -count) fail_index(index, source_.scanner().place());
    if (index < 0) return static_cast<uint32_t>(count + index);
    if (index > count && static_cast<uint64_t>(index) > greatest_) {
      greatest_ = static_cast<uint64_t>(index);
      greatest_place_ = source_.scanner().place();
    }
    return static_cast<uint32_t>(index - 1);
  }

  template <class Index>
  [[noreturn]] void fail_index(Index index, const std::string& place) const {
    const std::string count = std::to_string(vertex_count_);
    reject(builder_.name(), place, "index " + std::to_string(index) + " of " + count + " vertices",
           vertex_count_ == 0 ? "vertices before relative indices"
                              : "1 to " + count + " or -" + count + " to -1");
  }

  ObjSource& source_;
  MeshBuilder& builder_;
  std::vector<uint32_t> corners_;
  uint64_t vertex_count_ = 0;
  uint64_t greatest_ = 0;  ///< of the forward references
  std::string greatest_place_;
};

void note_ignored(const ObjSource& lines, std::vector<std::string>& notes) {
  if (lines.ignored_elements > 0) {
    notes.push_back(counted(lines.ignored_elements, "line") +
                    " with points, polylines or curves ignored");
  }
  if (lines.ignored_surfaces > 0) {
    notes.push_back(counted(lines.ignored_surfaces, "free-form surface") +
                    " not read: only the faces are measured");
  }
  if (lines.ignored_calls > 0) {
    notes.push_back(counted(lines.ignored_calls, "call") +
                    " of other files or commands not followed");
  }
}

}  // namespace

Mesh parse_obj(const MeshSource& source) {
  if (const size_t zero = source.bytes.find('\0'); zero != std::string_view::npos) {
    reject(source.name, "byte " + std::to_string(zero), "a zero byte", "text, as OBJ is");
  }
  MeshBuilder builder(source);
  ObjSource lines(source, builder);
  FaceReader reader(lines, builder);
  std::istream stream(&lines);
  stream.exceptions(std::ios::badbit);  // what ObjSource throws passes through
  std::string warnings, errors;
  const bool read = tinyobj::LoadObjWithCallback(stream, FaceReader::callbacks(), &reader, nullptr,
                                                 &warnings, &errors);
  if (!read || !warnings.empty() || !errors.empty()) {
    lines.scanner().fail("tinyobjloader says " + quoted(errors + warnings), "a plain OBJ file");
  }
  reader.check_end();
  builder.add_short_faces(lines.empty_faces);
  note_ignored(lines, builder.notes);
  return std::move(builder).finish(lines.scanner().place());
}

}  // namespace vkh
