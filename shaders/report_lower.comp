// What: the certified lower bound: the smallest distance of the witness from any triangle of B, each rounded down. Every
// triangle is visited, so nothing rests on the hierarchy or on the walks that found the witness.
// In: control.witness, triangles. Out: lower_bits[0].
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#include "shaders/lib/invocation.glsl"
#include "shaders/lib/bary.h"
#include "shaders/lib/lower.h"

layout(local_size_x = kGroupSize) in;
layout(scalar, binding = 0) readonly buffer ControlBlock { Control control; };
layout(scalar, binding = 1) readonly buffer Triangles { Triangle triangles[]; };
layout(scalar, binding = 2) buffer LowerBits { uint lower_bits[]; };
layout(scalar, binding = 3) readonly buffer Positions { vec3 positions[]; };
layout(scalar, binding = 4) readonly buffer Faces { uvec3 faces[]; };
layout(scalar, push_constant) uniform PushBlock { CountPush push; };

Corners triangle_corners(uint i) { return Corners(triangles[i].a, triangles[i].b, triangles[i].c); }

Root load_root(uint face) {
  uvec3 f = faces[face];
  return make_root(Corners(positions[f.x], positions[f.y], positions[f.z]));
}

void main() {
  // Invocations past the end repeat the last triangle: every one takes part in the subgroup's minimum.
  uint i = min(item_index(), push.count - 1u);
  Witness w = control.witness;
  Root root = load_root(w.root);
  Two3 p = place(root, uvec2(w.j, w.k));
  float reach = norm_up(root.origin) + norm_up(root.ab.hi) + norm_up(root.ac.hi);
  Surface s = make_surface(triangle_corners(i), p, reach, true);
  // A triangle farther than the steering distance by a margin does not decide the minimum.
  float d = subgroupMin(triangle_distance_down(s, 1.0001 * w.distance));
  if (subgroupElect()) atomicMin(lower_bits[0], floatBitsToUint(d));
}
