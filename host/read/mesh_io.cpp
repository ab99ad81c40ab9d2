#include "vkhausdorff/mesh_io.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>

#include "host/base/byte_order_mark.h"
#include "host/base/float_environment.h"
#include "host/base/parse_number.h"
#include "host/base/reject.h"
#include "host/base/system.h"
#include "host/read/readers.h"
#include "host/read/strangers.h"
#include "host/read/text_scanner.h"
#include "vkhausdorff/note.h"

namespace vkh {
namespace {

constexpr const char* kExpectedFormats = "an OBJ, STL, PLY, OFF, glTF or 3MF file";
constexpr const char* kExpectedPoints = "points as PLY, OBJ, OFF, XYZ, PTS or LAS";

void refuse_stranger(const std::string& name, const Stranger& stranger) {
  if (!stranger.what.empty()) reject(name, "byte 0", stranger.what, stranger.expected);
}

// Rejects formats that people pass by mistake, with a better message than a missing keyword.
void reject_known_strangers(const MeshSource& source, std::string_view head) {
  struct Wrapped {
    std::string_view magic;
    const char* what;
    const char* expected;
  };
  constexpr std::array<Wrapped, 4> kWrapped = {{
      {"\x1f\x8b", "gzip-compressed data", "the file unpacked (gunzip)"},
      {"version https://git-lfs", "a Git LFS pointer", "the file itself (git lfs pull)"},
      {"\xfe\xff", "UTF-16 text", "ASCII or UTF-8"},
      {"\xff\xfe", "UTF-16 text", "ASCII or UTF-8"},
  }};
  if (head.empty())
    reject(source.name, "byte 0", "the file is empty",
           source.limits.points ? kExpectedPoints : kExpectedFormats);
  if (is_exact_binary_stl(head, source.size())) return;
  for (const Wrapped& wrapped : kWrapped) {
    if (head.starts_with(wrapped.magic))
      reject(source.name, "byte 0", wrapped.what, wrapped.expected);
  }
  if (source.limits.points && head.starts_with(kLasMagic)) return;
  refuse_stranger(source.name, stranger_by_content(head));
}

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return lower;
}

std::string extension_of(const std::string& name) {
  return lower_case(name_of(path_of(name).extension()));
}

using Parse = ReadMesh (*)(const MeshSource&);

Parse parser_by_extension(const std::string& extension) {
  if (extension == ".obj") return parse_obj;
  if (extension == ".stl") return parse_stl;
  if (extension == ".ply") return parse_ply;
  if (extension == ".off") return parse_off;
  if (extension == ".gltf" || extension == ".glb") return parse_gltf;
  if (extension == ".3mf") return parse_3mf;
  return nullptr;
}

// Recognises STOFF, 4nOFF and the like, perhaps with a count glued to it.
bool is_off_keyword(std::string_view word) {
  constexpr size_t kMostPrefix = 5;
  const size_t at = word.find("OFF");
  return at <= kMostPrefix &&
         word.find_first_not_of("0123456789", at + 3) == std::string_view::npos;
}

Parse parser_by_content(std::string_view head, uint64_t size) {
  if (is_exact_binary_stl(head, size)) return parse_stl;
  if (head.starts_with("glTF")) return parse_gltf;
  if (head.starts_with("PK\x03\x04")) return parse_3mf;
  TextScanner scanner(head, "", '#', MixedLineEnds::kIgnored);
  scanner.next_full_line();
  const std::string_view word = scanner.word();
  if (word == "ply") return parse_ply;
  if (is_off_keyword(word)) return parse_off;
  if (lower_case(word) == "solid" || lower_case(word) == "facet") return parse_stl;
  if (word.starts_with('{')) return parse_gltf;
  return nullptr;
}

// Serves pipes and files without a telling name: OBJ has no magic, only keywords.
bool looks_like_obj(std::string_view head) {
  constexpr std::array<std::string_view, 10> kKeywords = {"v", "vt", "vn",     "f",      "o",
                                                          "g", "s",  "mtllib", "usemtl", "l"};
  TextScanner scanner(head, "", '#', MixedLineEnds::kIgnored);
  scanner.next_full_line();
  return std::find(kKeywords.begin(), kKeywords.end(), scanner.word()) != kKeywords.end();
}

// The formats that hold points: point formats, and mesh formats that may have no faces.
Parse parser_of_points(const std::string& extension, std::string_view head) {
  if (head.starts_with(kLasMagic)) return parse_las;
  if (extension == ".xyz" || extension == ".pts" || extension == ".asc") return parse_xyz;
  return nullptr;
}

// STL, glTF and 3MF hold only faces, as far as they are read.
void refuse_without_points(Parse parse, const std::string& name) {
  for (const auto& [other, what] : {std::pair{&parse_stl, "an STL file"},
                                    {&parse_gltf, "a glTF file"},
                                    {&parse_3mf, "a 3MF file"}}) {
    if (parse == other)
      reject(name, "byte 0", std::string(what) + ", of which points are not read", kExpectedPoints);
  }
}

MeshSource without_byte_order_mark(const MeshSource& given, std::string_view head) {
  MeshSource source = given;
  if (!head.starts_with(kByteOrderMark)) return source;
  if (source.file != nullptr) {
    source.begin += kByteOrderMark.size();
  } else {
    source.bytes.remove_prefix(kByteOrderMark.size());
  }
  return source;
}

[[noreturn]] void refuse_bytes(const std::string& name, const std::string& what,
                               const ReadLimits& limits) {
  reject(name, "byte " + std::to_string(limits.max_input_bytes),
         what + ", beyond the limit of " + counted(limits.max_input_bytes, "byte"), kLessInput);
}

// Reads a file that InputFile does not open: a pipe is read until it ends, anything else is
// refused.
std::string read_pipe(const std::filesystem::path& path, const std::string& name,
                      const ReadLimits& limits) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::is_regular_file(status) && !std::filesystem::is_fifo(status)) {
    const char* what = std::filesystem::exists(status) ? "not a file" : "no such file";
    reject(name, "", error && std::filesystem::exists(status) ? error.message() : what,
           kExpectedFormats);
  }
  std::ifstream in(path, std::ios::binary);
  if (!in) reject(name, "", "the file cannot be opened", "permission to read it");
  constexpr size_t kPiece = size_t{1} << 20;
  std::string bytes;
  while (in) {
    check_going(name, limits);
    const size_t size = bytes.size();
    bytes.resize(size + kPiece);
    in.read(bytes.data() + size, static_cast<std::streamsize>(kPiece));
    bytes.resize(size + static_cast<size_t>(in.gcount()));
    if (bytes.size() > limits.max_input_bytes) refuse_bytes(name, "more than is read", limits);
  }
  if (in.bad()) {
    reject(name, "byte " + std::to_string(bytes.size()), "the file cannot be read",
           "a readable file");
  }
  return bytes;
}

// The reader of a file and what it reads; throws InputError if none fits.
struct RecognisedFile {
  Parse parse;
  MeshSource source;
};

RecognisedFile recognise_format(const MeshSource& file) {
  constexpr size_t kHead = 4096;  // enough to recognise the format
  check_going(file.name, file.limits);
  const std::string start = head_of(file, kByteOrderMark.size() + kHead);
  reject_known_strangers(file, start);
  const MeshSource source = without_byte_order_mark(file, start);
  const std::string_view head = std::string_view(start).substr(file.size() - source.size(), kHead);
  const std::string extension = extension_of(source.name);
  const bool points = source.limits.points;
  Parse parse = points ? parser_of_points(extension, head) : nullptr;
  if (!parse) parse = parser_by_content(head, source.size());
  // Other formats are zip archives, too.
  if (parse == parse_3mf) refuse_stranger(source.name, stranger_by_extension(extension));
  if (!parse) parse = parser_by_extension(extension);
  if (!parse && looks_like_obj(head)) parse = parse_obj;
  if (!parse) refuse_stranger(source.name, stranger_by_extension(extension));
  const bool is_text = extension == ".txt" || extension == ".csv";
  if (!parse && points && (is_text || looks_like_xyz(head))) parse = parse_xyz;
  if (!parse && looks_like_xyz(head))
    reject(source.name, "byte 0", "rows of numbers (points, no faces)", kAMesh);
  if (!parse)
    reject(source.name, "byte 0", "neither content nor name tells what it is",
           points ? kExpectedPoints : kExpectedFormats);
  if (points) refuse_without_points(parse, source.name);
  return {parse, source};
}

std::string folder_beside(const std::filesystem::path& path) {
  return path.has_parent_path() ? name_of(path.parent_path()) : ".";
}

}  // namespace

ReadMesh parse_mesh(const MeshSource& file) {
  const FloatEnvironment ours;
  const RecognisedFile recognised = recognise_format(file);
  ReadMesh mesh = recognised.parse(recognised.source);
  mesh.has_all_bodies = file.limits.bodies == Bodies::kAll;
  return mesh;
}

bool has_mesh_extension(const std::filesystem::path& path) {
  return parser_by_extension(lower_case(name_of(path.extension()))) != nullptr;
}

bool has_points_extension(const std::filesystem::path& path) {
  constexpr std::array<std::string_view, 7> kKnown = {".ply", ".obj", ".off", ".xyz",
                                                      ".pts", ".asc", ".las"};
  const std::string extension = lower_case(name_of(path.extension()));
  return std::find(kKnown.begin(), kKnown.end(), extension) != kKnown.end();
}

ReadMesh read_mesh(const std::filesystem::path& path, const ReadLimits& limits) {
  const std::string name = name_of(path);
  const InputFile file(path);
  const std::string folder = folder_beside(path);
  if (!file.is_open()) {
    const std::string bytes = read_pipe(path, name, limits);
    return parse_mesh({.name = name, .bytes = bytes, .limits = limits, .folder = folder});
  }
  if (file.size() > limits.max_input_bytes)
    refuse_bytes(name, counted(file.size(), "byte"), limits);
  return parse_mesh({.name = name, .bytes = {}, .limits = limits, .file = &file, .folder = folder});
}

std::vector<FileBeneath> files_beneath(const std::filesystem::path& path,
                                       const ReadLimits& limits) {
  const FloatEnvironment ours;
  const InputFile file(path);
  if (!file.is_open() || file.size() > limits.max_input_bytes) return {};
  const std::string name = name_of(path);
  try {
    const RecognisedFile recognised = recognise_format({.name = name,
                                                        .bytes = {},
                                                        .limits = limits,
                                                        .file = &file,
                                                        .folder = folder_beside(path)});
    if (recognised.parse != &parse_gltf) return {};
    return files_of_gltf(recognised.source);
  } catch (const InputError&) {  // read_mesh reports it, too
    return {};
  }
}

std::vector<double> read_face_property(const std::filesystem::path& path, std::string_view name) {
  const FloatEnvironment ours;
  const InputFile file(path);
  if (!file.is_open()) reject(name_of(path), "", "no file to be read", "a PLY file");
  const MeshSource source = {.name = name_of(path), .bytes = {}, .file = &file};
  return parse_face_property(
      without_byte_order_mark(source, head_of(source, kByteOrderMark.size())), name);
}

void note_rest(TextScanner& scanner, std::vector<Note>& notes) {
  std::string first;
  while (scanner.next_full_line()) {
    if (first.empty()) first = scanner.place();
    double number = 0;
    if (parse_number(scanner.word(), number)) {
      scanner.fail("a row more than announced", "as many rows as the header says");
    }
  }
  if (!first.empty())
    notes.push_back(note_of(NoteCode::kUnread, "what follows the last row ignored, from " + first));
}

}  // namespace vkh
