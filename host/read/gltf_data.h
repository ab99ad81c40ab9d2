// A glTF document's numbers: buffers within the file, beside it or in its text, views of them,
// packed or not, and columns of values in views.
#pragma once

#include <filesystem>
#include <glm/vec3.hpp>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "host/read/gltf_model.h"

namespace vkh::gltf {

/// An accessor whose data was found and checked: every row lies in its view.
struct Column {
  const char* rows = nullptr;  ///< null: zeros
  uint64_t stride = 0;
  uint32_t count = 0;
  uint16_t component = 0;
  bool is_normalized = false;
  // Some rows are replaced by these.
  uint32_t sparse_count = 0;
  const char* sparse_rows = nullptr;  ///< their numbers, ascending
  uint16_t sparse_component = 0;
  const char* sparse_values = nullptr;
  std::string place;  ///< for errors

  uint32_t index(uint64_t row) const;       ///< for a SCALAR of unsigned integers
  glm::dvec3 position(uint64_t row) const;  ///< for a VEC3; normalised integers are rounded
  /// The error of a coordinate, as a fraction of itself: 2^-53 if it was divided.
  double relative_off() const { return is_normalized ? 0x1p-53 : 0; }

 private:
  const char* row(uint64_t number, uint64_t width) const;
};

/// The file that a buffer names.
struct NamedFile {
  std::string name;            ///< as it is opened, from the document's folder; empty: none
  std::filesystem::path path;  ///< empty where `wrong` has the reason why it is not opened
  std::string wrong;
};

/// Finds data as they are asked for, and keeps what had to be unpacked or read.
class Data {
 public:
  Data(const MeshSource& source, const Model& model, std::string_view binary_chunk)
      : source_(source), model_(model), chunk_(binary_chunk), input_bytes_(source.bytes.size()) {}

  Column indices(uint32_t accessor);
  Column positions(uint32_t accessor);
  bool has_data(uint32_t accessor) const;

  /// Adds the buffers that hold an accessor's numbers. Opens no file, and leaves out what is not
  /// there: the reader of the accessor reports it.
  void add_buffers(uint32_t accessor, std::set<uint32_t>& buffers) const;
  /// Finds the file of a buffer that has its data neither in the document nor in its chunk.
  NamedFile file_of(uint32_t buffer) const;

 private:
  struct Slice {
    std::string_view bytes;
    uint32_t stride = 0;
  };

  std::string_view buffer(uint32_t number);
  std::string_view embedded(uint32_t number);
  std::string_view external(uint32_t number);
  Slice view(uint32_t number, const std::string& asked_by);
  std::string_view unpacked(uint32_t view);
  std::string_view part(uint32_t buffer, uint64_t offset, uint64_t length,
                        const std::string& place);
  Column column(uint32_t accessor, uint32_t width, uint64_t row_bytes);
  void add_sparse(uint32_t accessor, uint64_t row_bytes, Column& column);
  void add_buffer_of_view(uint32_t view, std::set<uint32_t>& buffers) const;
  void check_ascending(const Column& column) const;
  const Accessor& accessor_of(uint32_t number) const;
  /// Counts what was read or unpacked against --max-input.
  void spend(uint64_t bytes, const std::string& place);
  [[noreturn]] void fail(const std::string& place, const std::string& what,
                         const std::string& expected) const;

  const MeshSource& source_;
  const Model& model_;
  std::string_view chunk_;
  uint64_t input_bytes_;
  std::map<uint32_t, std::vector<char>> buffers_, unpacked_;
  std::map<std::string, uint32_t> files_;  ///< the buffer that read each
  std::vector<bool> is_ascending_;         ///< sparse accessors whose numbers have been checked
};

/// Decodes the contents of "data:...;base64,", from text as JSON writes it; false if it is none.
bool decode_base64(std::string_view uri, std::vector<char>& out);

/// Returns whether a URI has data in itself; as JSON writes it, too.
bool is_data(std::string_view uri);

/// The names that a URI, as JSON writes it, may have of a file: its percents resolved and, where
/// that differs, as it is written. Leaves out a name that leaves the folder or names another place
/// than a file: an absolute path, "..", a scheme.
std::vector<std::string> files_beneath(std::string_view uri);

}  // namespace vkh::gltf
