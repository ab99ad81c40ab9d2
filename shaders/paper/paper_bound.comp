// Does the work of wave_bound, and adds two bounds of the paper: its u3, which wave_bisect has
// found, and u4. It replaces wave_bound if a switch selects one; the wave is then never fused.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shaders/base/switches.glsl"

layout(local_size_x = kGroupSize) in;
layout(scalar, binding = 0) buffer ControlBlock { Control control; };
layout(scalar, binding = 1) buffer Frontier { Candidate frontier[]; };
layout(scalar, binding = 2) readonly buffer Vertices { Vertex vertices[]; };
layout(scalar, binding = 3) readonly buffer Faces { uvec3 faces[]; };
layout(scalar, binding = 4) readonly buffer Triangles { uvec4 triangles[]; };
layout(scalar, binding = 5) readonly buffer VertexNearest { uint vertex_nearest[]; };
layout(scalar, binding = 6) readonly buffer Splits { Split splits[]; };
layout(scalar, binding = 7) readonly buffer Points { Point points[]; };
layout(scalar, binding = 8) readonly buffer Survivors { uint survivors[]; };
layout(scalar, binding = 9) readonly buffer Centroids { Point centroids[]; };
layout(scalar, binding = 10) readonly buffer TriangleLows { TriangleLow triangle_lows[]; };
layout(scalar, binding = 11) buffer Areas { Area areas[]; };
layout(scalar, binding = 12) readonly buffer FaceShared { uint face_shared[]; };
layout(scalar, binding = 13) buffer CentroidNearest { uint centroid_nearest[]; };
layout(scalar, binding = 14) readonly buffer U3Bounds { float u3_bounds[]; };

#include "shaders/wave/bound.glsl"
#include "shaders/paper/bound_u4.glsl"

Verdict bound_besides(uint i, uint child, Child c, Verdict v, float threshold) {
  if (bisects() && u3_bounds[i] < v.upper) v = Verdict(u3_bounds[i], kCullU3);
  if ((kSwitches & kUseU4) == 0u) return v;  // alone: optimisers then leave all of it out
  if (v.upper <= threshold) return v;
  float u4 =
      bound_u4(patch_of_child(child), c.nearest, view_of_child(child), held[kHeldSlack][child]);
  if (u4 < v.upper) v = Verdict(u4, kCullU4);
  return v;
}

void main() { bound_children(); }
