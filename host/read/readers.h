// What the readers share. The bytes of a file come in, a checked mesh goes out.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>

#include "host/mesh/mesh.h"
#include "host/read/read_limits.h"

namespace vkh {

class TextScanner;

struct MeshSource {
  std::string name;        ///< starts every error line; its extension decides where content cannot
  std::string_view bytes;  ///< the whole file
  ReadLimits limits = {};
  /// Beneath which a file may name others that hold its data; empty: nowhere.
  std::string folder = {};
};

/// Tells the format and calls its reader. All of these throw InputError and nothing else but
/// std::bad_alloc, whatever the bytes are, and Interrupted if keep_going says so.
Mesh parse_mesh(const MeshSource& source);
Mesh parse_obj(const MeshSource& source);
Mesh parse_stl(const MeshSource& source);
Mesh parse_ply(const MeshSource& source);
Mesh parse_off(const MeshSource& source);
Mesh parse_gltf(const MeshSource& source);  ///< host/gltf; GLB, too
Mesh parse_3mf(const MeshSource& source);   ///< host/threemf

/// True if the bytes are exactly as long as the triangle count at byte 80 says. No text passes: its
/// bytes there would announce more than 6 GB.
bool is_exact_binary_stl(std::string_view bytes);

/// "1 face", "2 faces": for notes and errors.
std::string counted(uint64_t count, const std::string& noun);

/// Reads what follows the last row that a text announced, and notes it. A line that begins with a
/// number is a row more than announced and is refused: measuring only those counted would certify a
/// part of the model.
void note_rest(TextScanner& scanner, std::vector<std::string>& notes);

/// Throws Interrupted if whoever waits for the file has called it off.
void check_going(const std::string& name, const ReadLimits& limits);

/// Collects a file's vertices and faces, within the source's limits.
class MeshBuilder {
 public:
  explicit MeshBuilder(const MeshSource& source) : name_(source.name), limits_(source.limits) {}

  const std::string& name() const { return name_; }
  const std::vector<glm::dvec3>& vertices() const { return vertices_; }

  std::vector<std::string> notes;

  /// What a header announces, checked against the limits before anything is allocated.
  void reserve(uint64_t vertex_count, uint64_t face_count);
  void add_vertex(const glm::dvec3& position) {
    make_room(1, 0);
    vertices_.push_back(position);
  }
  /// The one added last.
  void drop_vertex() { vertices_.pop_back(); }
  void add_triangle(const glm::uvec3& face) {
    make_room(0, 1);
    faces_.push_back(face);
  }
  /// Fans a polygon from its first corner; one of fewer than three corners is ignored and noted.
  void add_face(std::span<const uint32_t> corners);
  void add_short_faces(uint64_t count) { short_faces_ += count; }
  /// `place` is where the file ended, for the error if no face was there.
  Mesh finish(const std::string& place) &&;

 private:
  /// Before so many more are added.
  void make_room(size_t vertex_count, size_t face_count) {
    constexpr uint64_t kRowsOfTick = 1 << 14;  // about 1 ms
    if (mesh_bytes(vertices_.size() + vertex_count, faces_.size() + face_count) >
        limits_.max_input_bytes) {
      refuse_size(vertices_.size() + vertex_count, faces_.size() + face_count);
    }
    if (++rows_ % kRowsOfTick == 0) check_going(name_, limits_);
  }
  [[noreturn]] void refuse_size(uint64_t vertex_count, uint64_t face_count) const;

  std::string name_;
  const ReadLimits& limits_;
  std::vector<glm::dvec3> vertices_;
  std::vector<glm::uvec3> faces_;
  uint64_t rows_ = 0;
  uint64_t polygons_ = 0;
  uint64_t short_faces_ = 0;
};

/// A value of type T stored at `at` in the given byte order.
template <class T, std::endian kOrder = std::endian::little>
T load(const char* at) {
  std::array<char, sizeof(T)> bytes;
  std::memcpy(bytes.data(), at, sizeof(T));
  if constexpr (kOrder != std::endian::native) std::reverse(bytes.begin(), bytes.end());
  return std::bit_cast<T>(bytes);
}

}  // namespace vkh
