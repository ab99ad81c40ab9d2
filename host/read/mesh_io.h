// Mesh files in: OBJ, STL, PLY, OFF, glTF, 3MF. The format is told by the content first, by the
// extension where content cannot tell.
#pragma once

#include <filesystem>

#include "host/mesh/mesh.h"
#include "host/source/read_limits.h"

namespace vkh {

/// Reads a mesh file. Throws InputError with one line: file, line or byte or element, what is
/// wrong, what was expected. Never allocates from a header's word: counts are checked against the
/// file's size first.
Mesh read_mesh(const std::filesystem::path& path, const ReadLimits& limits = {});

}  // namespace vkh
