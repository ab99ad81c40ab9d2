// A mesh's faces as positions, and their SHA-256, by which a certificate names its mesh.
#pragma once

#include <string>

#include "vkhausdorff/mesh.h"

namespace vkh {

/// Nine doubles a face, little-endian, -0 as 0, for at most `faces` faces from `first` on.
std::string corner_bytes(const Mesh& mesh, size_t first, size_t faces);

/// The hash of all corner_bytes: 64 hexadecimal digits. Empty: no library.
std::string sha256_of_corners(const Mesh& mesh);

}  // namespace vkh
