// What: settles the wave's witness (lib/witness.glsl). In: the samples of the wave and the smallest
// key among those at the new lower bound. Out: control.witness_point, .witness_centroid.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shaders/lib/invocation.glsl"
#include "shaders/gpu_types.h"

layout(local_size_x = kGroupSize) in;
layout(scalar, binding = 0) buffer ControlBlock { Control control; };
layout(scalar, binding = 1) readonly buffer Frontier { Candidate frontier[]; };
layout(scalar, binding = 2) readonly buffer Vertices { Vertex vertices[]; };
layout(scalar, binding = 3) readonly buffer Faces { uvec3 faces[]; };
layout(scalar, binding = 4) readonly buffer VertexNearest { uint vertex_nearest[]; };
layout(scalar, binding = 5) readonly buffer Splits { Split splits[]; };
layout(scalar, binding = 6) readonly buffer Points { Point points[]; };
layout(scalar, binding = 7) readonly buffer Survivors { uint survivors[]; };
layout(scalar, binding = 8) readonly buffer Centroids { Point centroids[]; };

#include "shaders/lib/candidate.glsl"
#include "shaders/lib/child.glsl"
#include "shaders/lib/witness.glsl"

void settle_witness(uint i) {
  if (i < 3u * control.parents && is_new_lower(points[i].distance) &&
      key_of_point(i) == control.witness_point_key) {
    atomicMin(control.witness_point, i);
  }
  if (i < control.count[kCountSurvivors] && is_new_lower(centroids[i].distance) &&
      key_of_centroid(i) == control.witness_centroid_key) {
    atomicMin(control.witness_centroid, i);
  }
}

void main() { settle_witness(item_index()); }
