// A binary PLY that is written as it is made: its counts are known before, its rows are not kept.
#pragma once

#include <array>
#include <cstdint>
#include <cstdio>
#include <glm/vec3.hpp>
#include <memory>
#include <string>
#include <vector>

namespace vkh::pairs {

struct PlyShape {
  uint64_t vertex_count = 0, face_count = 0;
  bool is_double = false;  ///< the columns' type; float if every coordinate is one exactly
};

/// Vertices first, then faces, as many as announced. Throws OutputError if the disk does not take
/// them; an unfinished file is removed.
class PlyStream {
 public:
  PlyStream(const std::string& path, const PlyShape& shape);
  ~PlyStream();
  PlyStream(const PlyStream&) = delete;
  PlyStream& operator=(const PlyStream&) = delete;

  void add_vertex(const glm::dvec3& position);
  void add_face(uint32_t i, uint32_t j, uint32_t k);
  /// Rows that write_vertex and write_face made elsewhere, perhaps on another thread.
  void add_rows(const std::vector<char>& rows);
  /// Checks that nothing is missing, and that the disk has it all.
  void finish();

 private:
  void flush();
  [[noreturn]] void refuse(const char* what) const;

  std::string path_;
  PlyShape shape_;
  uint64_t bytes_left_ = 0;
  std::vector<char> buffer_;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
  bool is_finished_ = false;
};

/// Appends one row, little-endian.
void write_vertex(std::vector<char>& rows, const glm::dvec3& position, bool is_double);
void write_face(std::vector<char>& rows, uint32_t i, uint32_t j, uint32_t k);

/// "17 faces of 12 vertices in PATH, float columns": for the line that a tool prints.
std::string summary(const std::string& path, const PlyShape& shape);

}  // namespace vkh::pairs
