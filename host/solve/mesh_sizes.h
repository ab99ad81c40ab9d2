// The device memory that meshes of a size take, or the reason why the device cannot take them.
#pragma once

#include "engine/vkhausdorff.h"

namespace vkh {

struct MeshSize {
  uint32_t vertices = 0, faces = 0;
};

/// Returns whether the context's device takes a mesh of that size.
bool takes_as_a(VkhContext context, const MeshSize& a);
bool takes_as_b(VkhContext context, const MeshSize& b);

/// Throw DeviceError if a mesh of that size is too large for the context's device: the message has
/// its size, the largest possible size, and what helps.
VkhWorkspaceRequirements workspace_for(VkhContext context, const MeshSize& a);
VkhHierarchyRequirements hierarchy_for(VkhContext context, const MeshSize& b);

}  // namespace vkh
