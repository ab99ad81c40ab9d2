// A limit for each face of a mesh, from a file.
#pragma once

#include <string>
#include <vector>

#include "vkhausdorff/length.h"
#include "vkhausdorff/mesh.h"

namespace vkh {

/// Returns for each triangle the limit of the file's face that it belongs to. Reads rows of
/// `face,max`, or by semicolons: faces from 0, as the mesh's file and answers number them; lengths
/// as parse_length takes them, or a number alone in the files' unit. A first row of those two words
/// is a header; empty lines and lines that begin with # are ignored. A face that no row names has
/// `otherwise`. The file may also be a PLY of as many faces, whose property `max` is that number.
/// Throws InputError with file and line or face, also for a face that is named twice or does not
/// exist.
std::vector<Limit> read_face_limits(const std::string& path, const Mesh& mesh,
                                    const Limit& otherwise, const std::string& file_unit,
                                    const Diagonal& of_a);

}  // namespace vkh
