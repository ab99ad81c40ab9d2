// Computes the box of the middles of B's faces. In: vertices, faces. Out: box, as ordered bits; it
// must start empty (all ones). It takes only minima, so the result does not depend on scheduling.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#include "shaders/base/invocation.glsl"
#include "shaders/base/face_code.glsl"

layout(local_size_x = kBoxGroup) in;
layout(scalar, binding = 0) readonly buffer Vertices { Vertex vertices[]; };
layout(scalar, binding = 1) readonly buffer Faces { uvec3 faces[]; };
layout(scalar, binding = 2) buffer BoxBlock { CentroidBox box; };
layout(scalar, push_constant) uniform PushBlock { CountPush push; };

const uint kMaxSubgroups = kBoxGroup / kNarrowestSubgroup;
shared float sides[6][kMaxSubgroups];  // lo, and hi with its sign turned

vec3 middle_of(uint face) {
  uvec3 f = faces[min(face, push.count - 1u)];  // past the end, the last face again
  return face_middle(vertices[f.x].hi, vertices[f.y].hi, vertices[f.z].hi);
}

// There is one atomic per workgroup for each side: all of them go to the same few words, one after
// the other.
void widen(uint side) {
  float least = sides[side][0];
  for (uint s = 1u; s < gl_NumSubgroups; ++s) least = min(least, sides[side][s]);
  uint bits = ordered_bits(floatBitsToUint(least));
  if (side < 3u) {
    atomicMin(box.lo[side], bits);
  } else {
    atomicMin(box.minus_hi[side - 3u], bits);
  }
}

void main() {
  uint first = workgroup_index() * (kBoxGroup * kBoxFaces) + gl_LocalInvocationID.x;
  vec3 lo = middle_of(first);
  vec3 hi = lo;
  for (uint k = 1u; k < kBoxFaces; ++k) {
    vec3 middle = middle_of(first + k * kBoxGroup);
    lo = min(lo, middle);
    hi = max(hi, middle);
  }
  lo = subgroupMin(lo);
  hi = subgroupMax(hi);
  if (subgroupElect()) {
    for (uint axis = 0u; axis < 3u; ++axis) {
      sides[axis][gl_SubgroupID] = lo[axis];
      sides[3u + axis][gl_SubgroupID] = -hi[axis];
    }
  }
  barrier();
  if (gl_LocalInvocationID.x < 6u) widen(gl_LocalInvocationID.x);
}
