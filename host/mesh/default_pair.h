// A generated pair of meshes to try the program on: nothing is downloaded.
#pragma once

#include "host/mesh/mesh_pair.h"

namespace vkh {

/// A: a flanged coupling hub in millimetres (bore with keyway, bolt holes, toothed rim, splines,
/// thread), closed, tessellated as CAD programs do it, with many long thin triangles. B: the same
/// hub, tessellated half as finely around its axis. Coordinates are float32, in double.
MeshPair default_pair();

}  // namespace vkh
