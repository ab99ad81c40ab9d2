// Mesh files in: OBJ, STL, PLY, OFF, glTF, 3MF. The format is told by the content first, by the
// extension where content cannot tell.
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "host/mesh/mesh.h"
#include "host/source/read_limits.h"

namespace vkh {

/// Reads a mesh file. Throws InputError with one line: file, line or byte or element, what is
/// wrong, what was expected. Never allocates from a header's word: counts are checked against the
/// file's size first.
Mesh read_mesh(const std::filesystem::path& path, const ReadLimits& limits = {});

/// Of each face of a PLY file, as the file numbers them, the scalar property of that name. Throws
/// InputError likewise, also where there is no such property.
std::vector<double> read_face_property(const std::filesystem::path& path, std::string_view name);

}  // namespace vkh
