// Tests whether a mesh is part of another, face by face, as given.
#pragma once

#include "vkhausdorff/mesh.h"

namespace vkh {

/// Whether every face of `part`, as three positions in any order, is a face of `whole`. Then
/// h(part, whole) is 0.
bool has_faces_of(const Mesh& whole, const Mesh& part);

/// Returns for each face of `part` a face of `whole` that is the same; kNoFace if there is none.
constexpr uint32_t kNoFace = UINT32_MAX;
std::vector<uint32_t> same_faces(const Mesh& whole, const Mesh& part);

}  // namespace vkh
