// Finds what A's faces show before any query. First, the vertices that they use: other vertices are
// no part of the mesh and must not raise the lower bound. Second, the faces that are also faces of
// B, in any order of their corners: their h is 0, their corners lie on B, and this needs no query
// (docs/method.md, section 7). In: A; B's triangles by their codes; vertex_state all 0. Out:
// face_shared; vertex_state: kVertexUsed, or kVertexOnB + a triangle that has it for a corner.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shaders/base/switches.glsl"
#include "shaders/base/invocation.glsl"

layout(local_size_x = kGroupSize) in;
layout(scalar, binding = 0) readonly buffer Faces { uvec3 faces[]; };
layout(scalar, binding = 1) buffer VertexState { uint vertex_state[]; };
layout(scalar, binding = 2) readonly buffer ControlBlock { Control control; };
layout(scalar, binding = 3) readonly buffer Vertices { Vertex vertices[]; };
layout(scalar, binding = 4) readonly buffer Triangles { uvec4 triangles[]; };
layout(scalar, binding = 5) readonly buffer TriangleLows { TriangleLow triangle_lows[]; };
layout(scalar, binding = 6) readonly buffer Codes { uint codes[]; };
layout(scalar, binding = 7) readonly buffer BoxBlock { CentroidBox box; };
layout(scalar, binding = 8) writeonly buffer FaceShared { uint face_shared[]; };
layout(scalar, push_constant) uniform PushBlock { FacesPush push; };

#include "shaders/base/face_code.glsl"
#include "shaders/base/root.glsl"
#include "shaders/base/surface.glsl"

// Triangles of one code that are examined: more share a cell only if B is all but piled up, and a
// face that is not found is bounded like any other.
const uint kMostOfOneCode = 256u;

// Whether the first n of the sorted codes are under `code`.
bool are_under(uint n, uint code) {
  return codes[min(n, push.triangle_count) - 1u] < code && n <= push.triangle_count;
}

// The number of codes under `code`: three places are probed at a time, whose loads do not wait for
// each other, as in bvh_hierarchy.
uint first_with(uint code) {
  uint first = 0u;
  uint span = push.triangle_count + 1u;  // it is under first + span
  while (span > 1u) {
    span = (span + 3u) >> 2;
    uint beyond = 0u;
    for (uint k = 1u; k < 4u; ++k) beyond += are_under(first + k * span, code) ? span : 0u;
    first += beyond;
  }
  return first;
}

// The triangle of B that has the corners of face f, or kNone.
uint same_triangle(uvec3 f) {
  Two3 p = vertex_at(f.x);
  Two3 q = vertex_at(f.y);
  Two3 r = vertex_at(f.z);
  uint code = face_code(face_middle(p.hi, q.hi, r.hi), box, push.triangle_count);
  uint first = first_with(code);
  uint end = min(push.triangle_count, first + kMostOfOneCode);
  for (uint i = first; i < end && codes[i] == code; ++i) {
    if (lies_in(p, q, r, i)) return i;
  }
  return kNone;
}

void main() {
  uint i = item_index();
  if (i >= push.face_count) return;
  uvec3 f = faces[i];
  uint triangle = (kSwitches & kUseSharedFaces) != 0u ? same_triangle(f) : kNone;
  face_shared[i] = triangle != kNone ? 1u : 0u;
  uint state = triangle != kNone ? kVertexOnB + triangle : kVertexUsed;
  // Keeps the largest of several triangles, so that the order does not matter; few faces change
  // what others have written.
  for (uint k = 0u; k < 3u; ++k) {
    if (vertex_state[f[k]] < state) atomicMax(vertex_state[f[k]], state);
  }
}
