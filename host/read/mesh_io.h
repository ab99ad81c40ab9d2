// Mesh files in: OBJ, STL, PLY, OFF, glTF, 3MF. The format is told by the content first, by the
// extension where content cannot tell.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "host/mesh/mesh.h"
#include "host/read/read_limits.h"

namespace vkh {

/// Reads a mesh file. Throws InputError with one line: file, line or byte or element, what is
/// wrong, what was expected. Never allocates from a header's word: counts are checked against the
/// file's size first.
Mesh read_mesh(const std::filesystem::path& path, const ReadLimits& limits = {});

/// A file that holds numbers of a mesh file, such as a glTF document's buffer.
struct FileBeneath {
  std::string name;            ///< from the mesh file's folder, as it is opened
  std::filesystem::path path;  ///< empty: there is none that read_mesh would open
};

/// The files that read_mesh reads besides `path` itself, each once, in the order of their names.
/// They are found in the mesh file's own bytes: none is opened. Returns none where the mesh file
/// cannot be read or is refused, whatever lies beneath it. Throws Interrupted if limits.keep_going
/// says so.
std::vector<FileBeneath> files_beneath(const std::filesystem::path& path,
                                       const ReadLimits& limits = {});

/// Of each face of a PLY file, as the file numbers them, the scalar property of that name. Throws
/// InputError likewise, also where there is no such property.
std::vector<double> read_face_property(const std::filesystem::path& path, std::string_view name);

}  // namespace vkh
