#include "host/read/mesh_io.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>

#include "host/base/float_environment.h"
#include "host/base/text_scanner.h"
#include "host/read/readers.h"
#include "host/system/system.h"

namespace vkh {
namespace {

constexpr const char* kExpectedFormats = "an OBJ, STL, PLY, OFF, glTF or 3MF file";
constexpr const char* kLessInput = "a smaller file, or a greater limit (--max-input)";

// What people pass by mistake, so that they are told more than that a keyword is missing.
void reject_known_strangers(const MeshSource& source) {
  struct Stranger {
    std::string_view magic;
    const char* what;
    const char* expected;
  };
  constexpr std::array<Stranger, 4> kStrangers = {{
      {"\x1f\x8b", "gzip-compressed data", "the file unpacked (gunzip)"},
      {"version https://git-lfs", "a Git LFS pointer", "the file itself (git lfs pull)"},
      {"\xfe\xff", "UTF-16 text", "ASCII or UTF-8"},
      {"\xff\xfe", "UTF-16 text", "ASCII or UTF-8"},
  }};
  if (source.bytes.empty()) reject(source.name, "byte 0", "the file is empty", kExpectedFormats);
  for (const Stranger& stranger : kStrangers) {
    if (source.bytes.starts_with(stranger.magic) && !is_exact_binary_stl(source.bytes)) {
      reject(source.name, "byte 0", stranger.what, stranger.expected);
    }
  }
}

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return lower;
}

using Parse = Mesh (*)(const MeshSource&);

Parse parser_by_extension(const std::string& name) {
  const std::string extension = lower_case(name_of(path_of(name).extension()));
  if (extension == ".obj") return parse_obj;
  if (extension == ".stl") return parse_stl;
  if (extension == ".ply") return parse_ply;
  if (extension == ".off") return parse_off;
  if (extension == ".gltf" || extension == ".glb") return parse_gltf;
  if (extension == ".3mf") return parse_3mf;
  return nullptr;
}

Parse parser_by_content(std::string_view bytes) {
  if (is_exact_binary_stl(bytes)) return parse_stl;
  if (bytes.starts_with("glTF")) return parse_gltf;
  if (bytes.starts_with("PK\x03\x04")) return parse_3mf;
  TextScanner scanner(bytes.substr(0, 4096), "", '#', MixedLineEnds::kIgnored);
  scanner.next_full_line();
  const std::string_view word = scanner.word();
  if (word == "ply") return parse_ply;
  if (word.size() >= 3 && word.size() <= 8 && word.ends_with("OFF")) return parse_off;
  if (lower_case(word) == "solid") return parse_stl;
  if (word.starts_with('{')) return parse_gltf;
  return nullptr;
}

// For pipes and files without a telling name: OBJ has no magic, only keywords.
bool looks_like_obj(std::string_view bytes) {
  constexpr std::array<std::string_view, 10> kKeywords = {"v", "vt", "vn",     "f",      "o",
                                                          "g", "s",  "mtllib", "usemtl", "l"};
  TextScanner scanner(bytes.substr(0, 4096), "", '#', MixedLineEnds::kIgnored);
  scanner.next_full_line();
  return std::find(kKeywords.begin(), kKeywords.end(), scanner.word()) != kKeywords.end();
}

// Windows editors put one before UTF-8 text, where it hides the first word.
std::string_view without_byte_order_mark(std::string_view bytes) {
  constexpr std::string_view kMark = "\xef\xbb\xbf";
  return bytes.starts_with(kMark) ? bytes.substr(kMark.size()) : bytes;
}

[[noreturn]] void refuse_bytes(const std::string& name, const std::string& what,
                               const ReadLimits& limits) {
  reject(name, "byte " + std::to_string(limits.max_input_bytes),
         what + ", beyond the limit of " + counted(limits.max_input_bytes, "byte"), kLessInput);
}

// In pieces, so that it can be called off; a pipe is read until it ends.
std::string read_bytes(const std::filesystem::path& path, const std::string& name,
                       const ReadLimits& limits) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  const bool regular = std::filesystem::is_regular_file(status);
  if (!regular && !std::filesystem::is_fifo(status)) {
    const char* what = std::filesystem::exists(status) ? "not a file" : "no such file";
    reject(name, "byte 0", error && std::filesystem::exists(status) ? error.message() : what,
           kExpectedFormats);
  }
  std::ifstream in(path, std::ios::binary);
  if (!in) reject(name, "byte 0", "the file cannot be opened", "permission to read it");
  const uintmax_t known = regular ? std::filesystem::file_size(path, error) : 0;
  if (known > limits.max_input_bytes) refuse_bytes(name, counted(known, "byte"), limits);
  constexpr size_t kPiece = size_t{1} << 24, kPipePiece = size_t{1} << 20;
  std::string bytes;
  if (known > 0) bytes.reserve(static_cast<size_t>(known));
  while (in && (!regular || bytes.size() != known)) {
    check_going(name, limits);
    const size_t size = bytes.size();
    bytes.resize(size + (known > size ? std::min<size_t>(kPiece, known - size) : kPipePiece));
    in.read(bytes.data() + size, static_cast<std::streamsize>(bytes.size() - size));
    bytes.resize(size + static_cast<size_t>(in.gcount()));
    if (bytes.size() > limits.max_input_bytes) refuse_bytes(name, "more than is read", limits);
  }
  if (in.bad()) {
    reject(name, "byte " + std::to_string(bytes.size()), "the file cannot be read",
           "a readable file");
  }
  return bytes;
}

}  // namespace

Mesh parse_mesh(const MeshSource& file) {
  const FloatEnvironment ours;
  reject_known_strangers(file);
  MeshSource source = file;
  source.bytes = without_byte_order_mark(file.bytes);
  Parse parse = parser_by_content(source.bytes);
  if (!parse) parse = parser_by_extension(source.name);
  if (!parse && looks_like_obj(source.bytes)) parse = parse_obj;
  if (!parse) reject(source.name, "byte 0", "neither content nor name tells", kExpectedFormats);
  return parse(source);
}

Mesh read_mesh(const std::filesystem::path& path, const ReadLimits& limits) {
  const std::string name = name_of(path);
  const std::string bytes = read_bytes(path, name, limits);
  const std::string folder = path.has_parent_path() ? name_of(path.parent_path()) : ".";
  return parse_mesh({.name = name, .bytes = bytes, .limits = limits, .folder = folder});
}

uint64_t mesh_bytes(uint64_t vertex_count, uint64_t face_count) {
  return sizeof(glm::dvec3) * vertex_count + sizeof(glm::uvec3) * face_count;
}

void check_going(const std::string& name, const ReadLimits& limits) {
  if (limits.keep_going && !limits.keep_going())
    throw Interrupted(name + ": called off while it was read");
}

std::string counted(uint64_t count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

void note_rest(TextScanner& scanner, std::vector<std::string>& notes) {
  std::string first;
  while (scanner.next_full_line()) {
    if (first.empty()) first = scanner.place();
    double number = 0;
    if (parse_number(scanner.word(), number)) {
      scanner.fail("a row more than announced", "as many rows as the header says");
    }
  }
  if (!first.empty()) notes.push_back("what follows the last row ignored, from " + first);
}

void MeshBuilder::reserve(uint64_t vertex_count, uint64_t face_count) {
  if (mesh_bytes(vertex_count, face_count) > limits_.max_input_bytes)
    refuse_size(vertex_count, face_count);
  vertices_.reserve(vertex_count);
  faces_.reserve(face_count);
}

void MeshBuilder::refuse_size(uint64_t vertex_count, uint64_t face_count) const {
  const std::string place = face_count > 0 ? "face " + std::to_string(face_count - 1)
                                           : "vertex " + std::to_string(vertex_count - 1);
  reject(name_, place,
         "a mesh of " + std::to_string(vertex_count) + " vertices and " +
             counted(face_count, "face") + " takes " +
             counted(mesh_bytes(vertex_count, face_count), "byte") + ", beyond the limit of " +
             counted(limits_.max_input_bytes, "byte"),
         kLessInput);
}

void MeshBuilder::add_face(std::span<const uint32_t> corners) {
  if (corners.size() < 3) {
    ++short_faces_;
    return;
  }
  if (corners.size() > 3) ++polygons_;
  const size_t count = corners.size() - 2;
  make_room(0, count);
  // A large polygon by what it takes, not by twice what there was.
  if (faces_.capacity() - faces_.size() < count && count > faces_.size())
    faces_.reserve(faces_.size() + count);
  for (size_t i = 2; i < corners.size(); ++i) {
    faces_.emplace_back(corners[0], corners[i - 1], corners[i]);
  }
}

Mesh MeshBuilder::finish(const std::string& place) && {
  if (faces_.empty()) {
    reject(name_, place,
           short_faces_ == 0 ? "the file ends without a face"
                             : "the file ends without a face of three corners",
           "at least one face: a distance between no surfaces is undefined");
  }
  Mesh mesh = make_mesh(name_, std::move(vertices_), std::move(faces_));
  mesh.counts.polygons = polygons_;
  mesh.notes = std::move(notes);
  if (polygons_ > 0) {
    mesh.notes.push_back(counted(polygons_, "polygon") +
                         " fanned into triangles from the first corner; the fan of a concave "
                         "polygon leaves its outline");
  }
  if (short_faces_ > 0) {
    mesh.notes.push_back(counted(short_faces_, "face") + " of fewer than three corners ignored");
  }
  return mesh;
}

}  // namespace vkh
