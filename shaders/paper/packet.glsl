// The packet traversal (docs/method.md, section 6): one traversal of B's BVH for the three new
// points of a candidate, each a bit of a mask. It finds the same for each as nearest_triangle does.
// The kernel declares what traversal/traversal.glsl needs.
#ifndef VKH_SHADERS_PAPER_PACKET_GLSL
#define VKH_SHADERS_PAPER_PACKET_GLSL

#include "shaders/traversal/traversal.glsl"

const uint kPacket = 3u;
const float kUnasked = 3.3e38;  // a tight traversal's first reach is 3.00001e38

struct Packet {
  Query query[kPacket];
  Nearest best[kPacket];
  vec3 reach;  // squared; equal distances do not matter
};

vec3 box_distances2(Packet p, vec3 lo, vec3 hi) {
  return vec3(box_distance2(p.query[0].p.hi, lo, hi), box_distance2(p.query[1].p.hi, lo, hi),
              box_distance2(p.query[2].p.hi, lo, hi));
}

// The points that a box at these distances may still improve.
uint mask_of(vec3 distance2, vec3 reach) {
  bvec3 nearer = lessThan(distance2, reach);
  return uint(nearer.x) | (uint(nearer.y) << 1) | (uint(nearer.z) << 2);
}

// The least distance among the points that count.
float least_of(vec3 distance2, uint mask) {
  float x = (mask & 1u) != 0u ? distance2.x : 3.0e38;
  float y = (mask & 2u) != 0u ? distance2.y : 3.0e38;
  float z = (mask & 4u) != 0u ? distance2.z : 3.0e38;
  return min(x, min(y, z));
}

// Ties are measured at once, so that the points of a packet do not wait for each other's.
void try_at_once(Query q, uint i, inout Nearest best) {
  tied_count = 0u;
  try_query(q, i, best);
  measure_tied(q, best);
}

void try_leaf(uint leaf, uint mask, inout Packet p) {
  uint first = leaf & (kMaxTriangles - 1u);
  uint last = first + ((leaf >> 28) & 7u);
  for (uint i = first; i <= last; ++i) {
    for (uint k = 0u; k < kPacket; ++k) {
      if ((mask & (1u << k)) != 0u) try_at_once(p.query[k], i, p.best[k]);
    }
  }
  for (uint k = 0u; k < kPacket; ++k) {
    if ((mask & (1u << k)) != 0u) p.reach[k] = reach_of(p.query[k], p.best[k]);
  }
}

// The invocation's own stack, as in traversal/traversal.glsl.
uint left_packet_child[kTraversalStack];
vec3 left_packet_distance2[kTraversalStack];
uint left_packets;

// The next child that may improve some point, and the mask of these points; kNone if there is none.
uint pop_packet(vec3 reach, out uint mask) {
  while (left_packets > 0u) {
    --left_packets;
    mask = mask_of(left_packet_distance2[left_packets], reach);
    if (mask != 0u) return left_packet_child[left_packets];
  }
  mask = 0u;
  return kNone;
}

// Goes from a node to the child that is nearest to a point that it may improve; the others are
// left, with their distances. When one is popped, its mask is computed again, since nearer
// triangles may have been found by then. `unasked`: farther than any reach, for points that are not
// queried.
uint step_packet(uint at, vec3 unasked, Packet p, inout uint mask) {
  uint next = kNone;
  uint next_mask = 0u;
  vec3 next_d = vec3(3.0e38);
  float least = 3.0e38;
  for (uint k = 0u; k < 4u; ++k) {
    uvec4 lo = nodes[kNodeWords * at + 2u * k];
    uvec4 hi = nodes[kNodeWords * at + 2u * k + 1u];
    vec3 d = max(box_distances2(p, uintBitsToFloat(lo.xyz), uintBitsToFloat(hi.xyz)), unasked);
    uint m = mask & mask_of(d, p.reach);
    if (m == 0u) continue;
    float own = least_of(d, m);
    bool nearer = own < least;
    if (next != kNone || !nearer) {
      left_packet_child[left_packets] = nearer ? next : lo.w;
      left_packet_distance2[left_packets] = nearer ? next_d : d;
      ++left_packets;
    }
    if (nearer) {
      next = lo.w;
      next_mask = m;
      next_d = d;
      least = own;
    }
  }
  if (next == kNone) return pop_packet(p.reach, mask);
  mask = next_mask;
  return next;
}

// `mask`: the points to query. A node leaves three children at most: kTraversalStack.
void traverse_packet(uint mask, inout Packet p) {
  left_packets = 0u;
  uint at = 0u;
  for (uint k = 0u; k < kPacket; ++k) p.reach[k] = reach_of(p.query[k], p.best[k]);
  vec3 unasked = vec3((mask & 1u) != 0u ? 0.0 : kUnasked, (mask & 2u) != 0u ? 0.0 : kUnasked,
                      (mask & 4u) != 0u ? 0.0 : kUnasked);
  while (true) {
    while ((at & kLeafFlag) == 0u) at = step_packet(at, unasked, p, mask);
    if (at == kNone) return;
    try_leaf(at, mask, p);
    at = pop_packet(p.reach, mask);
  }
}

#endif
