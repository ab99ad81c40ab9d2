// The SHA-256 of a mesh's faces as positions, by which a certificate names its mesh.
#pragma once

#include <string>

#include "vkhausdorff/mesh.h"

namespace vkh {

/// The hash of nine doubles a face, little-endian, -0 as 0: 64 hexadecimal digits. Empty: no
/// library.
std::string sha256_of_corners(const Mesh& mesh);

}  // namespace vkh
