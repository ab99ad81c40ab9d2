// What: the sizes of the wave's second half, once the filter has counted its survivors. One
// invocation.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shaders/gpu_types.h"

layout(local_size_x = 1) in;
layout(scalar, binding = 0) readonly buffer ControlBlock { Control control; };
layout(scalar, binding = 1) writeonly buffer Dispatches { Dispatch dispatches[]; };

void main() {
  uint items = control.status == kStatusRunning ? control.count[kCountSurvivors] : 0u;
  uint groups = (items + kGroupSize - 1u) / kGroupSize;  // uncertified: integers
  uint x = min(groups, kMaxGroupsX);
  Dispatch size = Dispatch(x, x == 0u ? 0u : (groups + x - 1u) / x, 1u);  // uncertified: integers
  dispatches[kDispatchQueryCentroids] = size;
  dispatches[kDispatchBound] = size;
}
