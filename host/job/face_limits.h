// A limit for each face of a mesh, from a file.
#pragma once

#include <string>
#include <vector>

#include "host/answer/length.h"

namespace vkh {

/// Reads rows of `face,max`: faces from 0, as answers number them; lengths as parse_length has
/// them, or a number alone in the files' unit. A first row of those two words is a header; empty
/// lines and those that begin with # are ignored. A face that no row names has `otherwise`. Throws
/// InputError with file and line, also for a face that is named twice or is not there.
std::vector<Limit> read_face_limits(const std::string& path, size_t face_count,
                                    const Limit& otherwise, const std::string& file_unit,
                                    double diagonal_a);

}  // namespace vkh
