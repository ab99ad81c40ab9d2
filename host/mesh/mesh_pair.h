// Two meshes, one of which is measured against the other.
#pragma once

#include "vkhausdorff/mesh.h"

namespace vkh {

struct MeshPair {
  Mesh a, b;
};

}  // namespace vkh
