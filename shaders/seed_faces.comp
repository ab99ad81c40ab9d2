// What: what the seed says of the faces of A. Which corner is the witness of the first lower bound:
// the smallest face and corner whose distance is the maximum, so that the choice does not depend on
// scheduling. And which faces are faces of B too, whatever the order of their corners: their h is
// 0, and no query need be asked to find that out (algorithm.md §4.7). In: vertex_distance from
// seed_lower; B's triangles by their codes. Out: control.seed_witness = 3 * face + corner;
// face_shared.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shaders/gpu_types.h"
#include "shaders/lib/invocation.glsl"

layout(constant_id = 0) const uint kSwitches = kUseAll;
layout(local_size_x = kGroupSize) in;
layout(scalar, binding = 0) readonly buffer Faces { uvec3 faces[]; };
layout(scalar, binding = 1) readonly buffer VertexDistance { float vertex_distance[]; };
layout(scalar, binding = 2) buffer ControlBlock { Control control; };
layout(scalar, binding = 3) readonly buffer Vertices { Vertex vertices[]; };
layout(scalar, binding = 4) readonly buffer Triangles { uvec4 triangles[]; };
layout(scalar, binding = 5) readonly buffer TriangleLows { TriangleLow triangle_lows[]; };
layout(scalar, binding = 6) readonly buffer Codes { uint codes[]; };
layout(scalar, binding = 7) readonly buffer BoxBlock { CentroidBox box; };
layout(scalar, binding = 8) writeonly buffer FaceShared { uint face_shared[]; };
layout(scalar, push_constant) uniform PushBlock { FacesPush push; };

#include "shaders/lib/face_code.glsl"
#include "shaders/lib/root.glsl"
#include "shaders/lib/surface.glsl"

// Triangles of one code that are looked at: more share a cell only where B is all but piled up, and
// a face that is not found is bounded as any other.
const uint kMostOfOneCode = 256u;

// What plain floats make of a distance that is 0, in a frame of order 1: 1.04e-6 seen.
const float kNextToB = 4.0e-6;

uint first_with(uint code) {
  uint from = 0u;
  uint to = push.triangle_count;
  while (from < to) {
    uint middle = (from + to) >> 1;
    if (codes[middle] < code) {
      from = middle + 1u;
    } else {
      to = middle;
    }
  }
  return from;
}

bool is_face_of_b(uvec3 f) {
  Two3 p = vertex_at(f.x);
  Two3 q = vertex_at(f.y);
  Two3 r = vertex_at(f.z);
  uint code = face_code(face_middle(p.hi, q.hi, r.hi), box);
  uint first = first_with(code);
  uint end = min(push.triangle_count, first + kMostOfOneCode);
  for (uint i = first; i < end && codes[i] == code; ++i) {
    if (lies_in(p, q, r, i)) return true;
  }
  return false;
}

void offer_corner(uint i, vec3 d) {
  float lower = uintBitsToFloat(control.maximum[kMaxLower]);
  uint corner = d.x == lower ? 0u : d.y == lower ? 1u : d.z == lower ? 2u : kNone;
  if (corner != kNone) atomicMin(control.seed_witness, 3u * i + corner);
}

void main() {
  uint i = item_index();
  if (i >= push.face_count) return;
  uvec3 f = faces[i];
  vec3 d = vec3(vertex_distance[f.x], vertex_distance[f.y], vertex_distance[f.z]);
  offer_corner(i, d);
  bool may_be = (kSwitches & kUseSharedFaces) != 0u && max(d.x, max(d.y, d.z)) <= kNextToB;
  face_shared[i] = may_be && is_face_of_b(f) ? 1u : 0u;
}
