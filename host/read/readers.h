// The part that the readers share. The bytes of a file come in, a checked mesh goes out.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host/read/file_mesh_builder.h"
#include "host/read/source.h"
#include "vkhausdorff/mesh_io.h"

namespace vkh {

class TextScanner;

/// Finds the format and calls its reader. For any bytes all of these throw only InputError or
/// std::bad_alloc, and Interrupted if keep_going returns false.
ReadMesh parse_mesh(const MeshSource& source);
ReadMesh parse_obj(const MeshSource& source);
ReadMesh parse_stl(const MeshSource& source);
ReadMesh parse_ply(const MeshSource& source);
ReadMesh parse_off(const MeshSource& source);
ReadMesh parse_gltf(const MeshSource& source);  ///< GLB, too
ReadMesh parse_3mf(const MeshSource& source);
ReadMesh parse_las(const MeshSource& source);  ///< points, even without limits.points
ReadMesh parse_xyz(const MeshSource& source);  ///< the same; PTS, too

/// The other files that parse_gltf reads: see files_beneath. Throws what parse_gltf throws for a
/// document that is refused before its numbers are looked at.
std::vector<FileBeneath> files_of_gltf(const MeshSource& source);

/// The face property of a PLY: see read_face_property.
std::vector<double> parse_face_property(const MeshSource& source, std::string_view name);

/// The first bytes of a LAS file.
inline constexpr std::string_view kLasMagic = "LASF";

/// Returns true if a file of that beginning is exactly as long as the triangle count at byte 80
/// requires. No text passes: its bytes there would announce more than 6 GB.
bool is_exact_binary_stl(std::string_view head, uint64_t size);

/// Returns true for rows of numbers, perhaps behind comments, a count and names of columns.
bool looks_like_xyz(std::string_view head);

/// Reads what follows the last row that a text announced, and notes it. A line that begins with a
/// number is one row too many and is refused: measuring only the announced rows would certify a
/// part of the model.
void note_rest(TextScanner& scanner, std::vector<Note>& notes);

/// A value of type T stored at `at` in the given byte order.
template <class T, std::endian kOrder = std::endian::little>
T load(const char* at) {
  std::array<char, sizeof(T)> bytes;
  std::memcpy(bytes.data(), at, sizeof(T));
  if constexpr (kOrder != std::endian::native) std::reverse(bytes.begin(), bytes.end());
  return std::bit_cast<T>(bytes);
}

}  // namespace vkh
