// Alg. 2 of the paper: one walk through B's hierarchy for the three new points of a candidate, each
// a bit of a mask. It finds for each what nearest_triangle finds. Include after lib/bvh.glsl.
#ifndef VKH_SHADERS_LIB_PACKET_GLSL
#define VKH_SHADERS_LIB_PACKET_GLSL

const uint kPacket = 3u;
const float kUnasked = 3.3e38;  // a tight walk's first reach is 3.00001e38

struct Packet {
  Query query[kPacket];
  Nearest best[kPacket];
  vec3 reach;  // squared; what is as far does not matter
};

vec3 box_distances2(Packet p, vec3 lo, vec3 hi) {
  return vec3(box_distance2(p.query[0].p.hi, lo, hi), box_distance2(p.query[1].p.hi, lo, hi),
              box_distance2(p.query[2].p.hi, lo, hi));
}

// Which points a box at these distances may still improve.
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

void try_leaf(uint leaf, uint mask, inout Packet p) {
  uint first = leaf & (kMaxTriangles - 1u);
  uint last = first + ((leaf >> 28) & 7u);
  for (uint i = first; i <= last; ++i) {
    for (uint k = 0u; k < kPacket; ++k) {
      if ((mask & (1u << k)) != 0u) try_query(p.query[k], i, p.best[k]);
    }
  }
  for (uint k = 0u; k < kPacket; ++k) {
    if ((mask & (1u << k)) != 0u) p.reach[k] = reach_of(p.query[k], p.best[k]);
  }
}

// `mask`: the points that are asked for. Near child first; the far one is pushed with its
// distances, from which the mask is taken anew when it is popped: meanwhile points may have come
// nearer. At most one push a level, so kStackDepth entries suffice.
void walk_packet(uint mask, inout Packet p) {
  uint stack[kStackDepth];
  vec3 stack_distance2[kStackDepth];
  uint top = 0u;
  uint at = 0u;
  for (uint k = 0u; k < kPacket; ++k) p.reach[k] = reach_of(p.query[k], p.best[k]);
  // Farther than any reach, so that what is pushed leaves these out.
  vec3 unasked = vec3((mask & 1u) != 0u ? 0.0 : kUnasked, (mask & 2u) != 0u ? 0.0 : kUnasked,
                      (mask & 4u) != 0u ? 0.0 : kUnasked);
  while (true) {
    if ((at & kLeafFlag) != 0u) {
      try_leaf(at, mask, p);
      mask = 0u;
    } else {
      Node node = nodes[at];
      vec3 d0 = max(box_distances2(p, node.lo0, node.hi0), unasked);
      vec3 d1 = max(box_distances2(p, node.lo1, node.hi1), unasked);
      uint mask0 = mask & mask_of(d0, p.reach);
      uint mask1 = mask & mask_of(d1, p.reach);
      bool swap = least_of(d1, mask1) < least_of(d0, mask0);
      uint far_mask = swap ? mask0 : mask1;
      if (far_mask != 0u) {
        stack[top] = swap ? node.child0 : node.child1;
        stack_distance2[top] = swap ? d0 : d1;
        ++top;
      }
      mask = swap ? mask1 : mask0;
      at = swap ? node.child1 : node.child0;
    }
    while (mask == 0u && top > 0u) {
      --top;
      at = stack[top];
      mask = mask_of(stack_distance2[top], p.reach);
    }
    if (mask == 0u) return;
  }
}

#endif
