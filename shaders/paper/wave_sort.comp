// Computes the sort keys of the frontier, defer | mode | morton30 of the centroid (docs/method.md,
// eq. 4), and the places of its candidates. In: the frontier's reading half, the plan's selection.
// Out: keys[i], values[i] = i. Once sorted, the wave's parents come first: candidates that are
// split at midpoints, and then thin ones, with neighbours next to each other. Candidates that wait
// for a later wave come last.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shaders/base/invocation.glsl"
#include "shaders/base/switches.glsl"

layout(local_size_x = kGroupSize) in;
layout(scalar, binding = 0) readonly buffer ControlBlock { Control control; };
layout(scalar, binding = 1) readonly buffer Frontier { Candidate frontier[]; };
layout(scalar, binding = 2) readonly buffer Vertices { Vertex vertices[]; };
layout(scalar, binding = 3) readonly buffer Faces { uvec3 faces[]; };
layout(scalar, binding = 4) readonly buffer Nodes { uvec4 nodes[]; };
layout(scalar, binding = 5) writeonly buffer Keys { uint keys[]; };
layout(scalar, binding = 6) writeonly buffer Values { uint values[]; };

#include "shaders/wave/candidate.glsl"
#include "shaders/base/face_code.glsl"

// The code is within the box of B, since traversals end there.
uint morton_of(vec3 p) {
  vec3 lo = vec3(3.0e38);
  vec3 hi = vec3(-3.0e38);
  for (uint k = 0u; k < 4u; ++k) {
    lo = min(lo, uintBitsToFloat(nodes[2u * k].xyz));
    hi = max(hi, uintBitsToFloat(nodes[2u * k + 1u].xyz));
  }
  return code_in_box(p, lo, hi);
}

void main() {
  uint i = item_index();
  if (i >= control.count[kCountFrontier]) return;
  Candidate c = frontier[reading(i)];
  Bary3 corners = unpack_corners(c.corners);
  Root root = root_at(c.root);
  uint key = morton_of(position_of(root, centroid_of(corners)).hi);
  if ((kSwitches & kUseThin) != 0u && quality(plain_corners(root, corners)) < kPaperThinQuality)
    key |= kKeyThin;
  bool waits = control.deferred > 0u && !not_after(key_of(c, control.select_largest != 0u),
                                                   Key(control.select_key, control.select_tie));
  if (waits) key |= kKeyDeferred;
  keys[i] = key;
  values[i] = i;
}
