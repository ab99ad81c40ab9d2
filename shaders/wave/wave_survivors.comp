// Writes the sizes of the wave's second half, once the filter has counted its survivors. It is one
// invocation.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shaders/base/switches.glsl"

layout(local_size_x = 1) in;
layout(scalar, binding = 0) readonly buffer ControlBlock { Control control; };
layout(scalar, binding = 1) writeonly buffer Sizes { WaveSizes sizes; };

#include "shaders/wave/sizes.glsl"

void main() {
  bool running = control.status == kStatusRunning;
  write_bound_sizes(running ? control.count[kCountSurvivors] : 0u, running);
}
