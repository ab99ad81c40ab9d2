// Computes the paper's u3 of each of the wave's survivors, for paper_bound. In: survivors. Out:
// u3_bounds[i], above the base, rounding included.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shaders/base/invocation.glsl"
#include "shaders/base/switches.glsl"

layout(local_size_x = kGroupSize) in;
layout(scalar, binding = 0) readonly buffer ControlBlock { Control control; };
layout(scalar, binding = 1) readonly buffer Frontier { Candidate frontier[]; };
layout(scalar, binding = 2) readonly buffer Vertices { Vertex vertices[]; };
layout(scalar, binding = 3) readonly buffer Faces { uvec3 faces[]; };
layout(scalar, binding = 4) readonly buffer Triangles { uvec4 triangles[]; };
layout(scalar, binding = 5) readonly buffer VertexNearest { uint vertex_nearest[]; };
layout(scalar, binding = 6) readonly buffer Splits { Split splits[]; };
layout(scalar, binding = 7) readonly buffer Points { Point points[]; };
layout(scalar, binding = 8) readonly buffer Survivors { uint survivors[]; };
layout(scalar, binding = 9) readonly buffer TriangleLows { TriangleLow triangle_lows[]; };
layout(scalar, binding = 10) writeonly buffer U3Bounds { float u3_bounds[]; };

#include "shaders/base/surface.glsl"
#include "shaders/wave/candidate.glsl"
#include "shaders/wave/child.glsl"
#include "shaders/paper/paper_u3.glsl"

void main() {
  uint i = item_index();
  if (i >= control.count[kCountSurvivors]) return;
  Child c = load_child(survivors[i]);
  LocalCorners placed = placed_corners(c.root, c.at);
  Patch t = make_patch(two(vec3(0.0)), placed.b, placed.c);
  View view = view_of(placed, (kSwitches & kUseUncertified) != 0u);
  u3_bounds[i] = kept_bound(paper_u3(t, c.nearest, view), placed.slack);
}
