// Makes the next wave's plan (wave/plan.glsl) if wave_bound does not end with it: in the CPU
// profile, where a dispatch costs next to nothing, and if a switch of kUseApart is on. It is one
// workgroup. In: control, the frontier. Out: control; sizes.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shaders/base/switches.glsl"

layout(local_size_x = kGroupSize) in;
layout(scalar, binding = 0) buffer ControlBlock { Control control; };
layout(scalar, binding = 1) writeonly buffer Sizes { WaveSizes sizes; };
layout(scalar, binding = 2) readonly buffer Frontier { Candidate frontier[]; };
layout(scalar, binding = 3) readonly buffer Vertices { Vertex vertices[]; };
layout(scalar, binding = 4) readonly buffer Faces { uvec3 faces[]; };

#include "shaders/wave/plan_words.glsl"

shared uint group_words[kPlanWords];
#include "shaders/wave/plan.glsl"

void main() { plan_wave(); }
