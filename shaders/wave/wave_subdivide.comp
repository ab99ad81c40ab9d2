// Does the wave's first step (wave/split.glsl) if `query` does not: in the CPU profile, and if a
// switch of kUseApart is on, except for `sort` (paper_subdivide). In: the frontier's
// reading half. Out: splits; points[points_each() i + k], started from the best triangle known to
// the candidate, a negative distance if it is not to be queried; deferred candidates and
// kMaxNext.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shaders/base/switches.glsl"

layout(local_size_x = kGroupSize) in;
layout(scalar, binding = 0) buffer ControlBlock { Control control; };
layout(scalar, binding = 1) buffer Frontier { Candidate frontier[]; };
layout(scalar, binding = 2) readonly buffer Vertices { Vertex vertices[]; };
layout(scalar, binding = 3) readonly buffer Faces { uvec3 faces[]; };
layout(scalar, binding = 4) readonly buffer Nodes { uvec4 nodes[]; };
layout(scalar, binding = 5) readonly buffer Triangles { uvec4 triangles[]; };
layout(scalar, binding = 6) writeonly buffer Splits { Split splits[]; };
layout(scalar, binding = 7) writeonly buffer Points { Point points[]; };
layout(scalar, binding = 8) readonly buffer TriangleLows { TriangleLow triangle_lows[]; };
layout(scalar, binding = 9) buffer Areas { Area areas[]; };
layout(scalar, binding = 10) buffer CentroidNearest { uint centroid_nearest[]; };

#include "shaders/wave/centroid.glsl"
#include "shaders/wave/unsorted.glsl"
#include "shaders/wave/subdivide.glsl"

void main() { subdivide(); }
