// Is a mesh part of another, face by face, as given?
#pragma once

#include "host/mesh/mesh.h"

namespace vkh {

/// Whether every face of `part`, as three positions in any order, is a face of `whole`. Then
/// h(part, whole) is 0.
bool has_faces_of(const Mesh& whole, const Mesh& part);

}  // namespace vkh
