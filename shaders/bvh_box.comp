// What: the box of the middles of B's faces. In: vertices, indices. Out: box, as ordered bits; it
// must start empty (lo all ones, hi zero). Max and min only, so the result does not depend on
// scheduling.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#include "shaders/lib/invocation.glsl"
#include "shaders/lib/face_code.glsl"

layout(local_size_x = kGroupSize) in;
layout(scalar, binding = 0) readonly buffer Vertices { Vertex vertices[]; };
layout(scalar, binding = 1) readonly buffer Faces { uvec3 faces[]; };
layout(scalar, binding = 2) buffer BoxBlock { CentroidBox box; };
layout(scalar, push_constant) uniform PushBlock { CountPush push; };

void main() {
  // Invocations past the end repeat the last face: every one takes part in the subgroup's
  // reductions.
  uvec3 f = faces[min(item_index(), push.count - 1u)];
  vec3 middle = face_middle(vertices[f.x].hi, vertices[f.y].hi, vertices[f.z].hi);
  vec3 lo = subgroupMin(middle);
  vec3 hi = subgroupMax(middle);
  if (!subgroupElect()) return;
  for (int axis = 0; axis < 3; ++axis) {
    atomicMin(box.lo[axis], ordered_bits(floatBitsToUint(lo[axis])));
    atomicMax(box.hi[axis], ordered_bits(floatBitsToUint(hi[axis])));
  }
}
