// A generated pair of meshes to try the program on: nothing is downloaded.
#pragma once

#include "host/mesh/mesh_pair.h"

namespace vkh {

/// A: a flanged coupling hub in millimetres (bore with keyway, bolt holes, toothed rim, splines,
/// thread), closed, tessellated as CAD programs do it, with many long thin triangles. B: A
/// simplified to half of its faces. Both are the same to the last bit on every machine.
MeshPair default_pair();

}  // namespace vkh
