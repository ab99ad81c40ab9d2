// What: the sizes of the wave's second half, once the filter has counted its survivors. One
// invocation.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shaders/gpu_types.h"

layout(constant_id = 0) const uint kSwitches = kUseAll;
layout(local_size_x = 1) in;
layout(scalar, binding = 0) readonly buffer ControlBlock { Control control; };
layout(scalar, binding = 1) writeonly buffer Dispatches { Dispatch dispatches[]; };

#include "shaders/candidate/dispatch.glsl"

void main() {
  bool running = control.status == kStatusRunning;
  uint survivors = running ? control.count[kCountSurvivors] : 0u;
  dispatches[kDispatchQueryCentroids] = groups_for_queries(survivors);
  dispatches[kDispatchBound] = running ? groups_for_children(survivors) : groups_of(0u);
  dispatches[kDispatchBisect] = groups_for(survivors);
}
