// Runs the cascade of bounds (wave/bound.glsl) over every child of the wave. In: the refined
// candidates, their splits and queried points; the admitted faces of A; survivors and centroids if
// there is a filter. Out: frontier's writing half; every closed child's u is kept
// (kMaxClosed), every open one's too (kMaxNext); samples are offered as witnesses. If the wave is
// fused, the last workgroup to end plans the next one (wave/plan.glsl): control; sizes.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shaders/base/switches.glsl"

layout(local_size_x = kGroupSize) in;
layout(scalar, binding = 0) buffer ControlBlock { Control control; };
layout(scalar, binding = 1) coherent buffer Frontier { Candidate frontier[]; };
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
layout(scalar, binding = 14) writeonly buffer Sizes { WaveSizes sizes; };
layout(scalar, binding = 15) buffer GroupsDone { uint groups_done; };

#include "shaders/wave/bound.glsl"
#include "shaders/base/last_group.glsl"

#include "shaders/wave/plan.glsl"

// This kernel has none.
Verdict bound_besides(uint i, uint child, Child c, Verdict v, float threshold) { return v; }

void main() {
  bound_children();
  if (is_fused() && is_last_group()) plan_wave();
}
