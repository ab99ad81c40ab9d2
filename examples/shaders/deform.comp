// Moves the vertices of one level of detail to their positions at `time`. Level k takes every
// 2^k-th parameter of the finest, so its vertices lie on the same surface.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "examples/shaders/surface.glsl"
#include "examples/shaders/vertex.glsl"

layout(local_size_x = 64) in;
layout(scalar, binding = 0) writeonly buffer Vertices { SceneVertex vertices[]; };
layout(scalar, push_constant) uniform Push {
  uint first, cells_u, cells_v;
  float time;
};

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= cells_u * cells_v) return;
  float u = kTau * float(i % cells_u) / float(cells_u);
  float v = kTau * float(i / cells_u) / float(cells_v);
  vec3 p = surface_point(u, v, time);
  vec3 along_u = surface_point(u + 1e-2, v, time) - p;
  vec3 along_v = surface_point(u, v + 1e-2, time) - p;
  vertices[first + i] = SceneVertex(p, normalize(cross(along_u, along_v)), vec2(0.0));
}
