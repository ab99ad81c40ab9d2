// What: the certified lower bound: the smallest distance of the witness from any face of B,
// each rounded down. Every triangle is visited, so nothing rests on the hierarchy or on the walks
// that found the witness. In: control.witness, B as given. Out: lower_bits[0], what the bound is
// above the base.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#include "shaders/lib/invocation.glsl"
#include "shaders/lib/bary.h"
#include "shaders/lib/lower.h"
#include "shaders/lib/morton.h"

layout(local_size_x = kGroupSize) in;
layout(scalar, binding = 0) readonly buffer ControlBlock { Control control; };
layout(scalar, binding = 1) readonly buffer BVertices { Vertex b_vertices[]; };
layout(scalar, binding = 2) buffer LowerBits { uint lower_bits[]; };
layout(scalar, binding = 3) readonly buffer Vertices { Vertex vertices[]; };
layout(scalar, binding = 4) readonly buffer Faces { uvec3 faces[]; };
layout(scalar, binding = 5) readonly buffer BFaces { uvec3 b_faces[]; };
layout(scalar, push_constant) uniform PushBlock { CountPush push; };

#include "shaders/lib/root.glsl"

// A corner of B by the parts that the run works with.
Two3 b_corner(uint v) {
  Two3 p = two(b_vertices[v].hi);
  if (control.two_float != 0u) p.lo = b_vertices[v].lo;
  return p;
}

void main() {
  // Invocations past the end repeat the last triangle: every one takes part in the subgroup's
  // minimum.
  uint i = min(item_index(), push.count - 1u);
  Witness w = control.witness;
  Root root = load_root(w.root);
  Two3 p = place(root, uvec2(w.j, w.k));
  uvec3 f = b_faces[i];
  Surface s = make_surface(b_corner(f.x), b_corner(f.y), b_corner(f.z),
                           View(p, norm_up(p.hi), control.base, true, false, 0.0));
  // A triangle farther than the steering distance by a margin does not decide the minimum.
  float enough = w.distance + 1.0e-4 * (control.base + w.distance);
  float d = subgroupMin(triangle_distance_down(s, enough));
  if (subgroupElect()) atomicMin(lower_bits[0], ordered_bits(floatBitsToUint(d)));
}
