// A mesh as a file of positions and triangles alone.
#pragma once

#include <optional>
#include <string>

#include "vkhausdorff/mesh.h"

namespace vkh {

enum class MeshFormat { kPly, kStl, kObj, kGlb };

/// The format by a file's extension, in letters of any size; nothing for other extensions.
std::optional<MeshFormat> mesh_format_of(const std::string& path);
const char* format_name(MeshFormat format);  ///< "PLY", "STL", "OBJ", "GLB"
/// Whether the format holds any double. The others hold float32.
bool holds_doubles(MeshFormat format);

/// The bytes of the file: binary PLY, of float32 if each coordinate is one; binary STL; OBJ; GLB.
/// PLY, OBJ and GLB have each vertex once. Coordinates are written as they are, rounded to the
/// nearest float32 if the format has only those. Throws OutputError for a mesh that the format
/// cannot hold.
std::string to_mesh_file(const Mesh& mesh, MeshFormat format);

}  // namespace vkh
