// The walk through B's hierarchy. It steers: whichever triangle it returns gives a true upper bound
// (algorithm.md §2.4), and no lower bound rests on it (report_lower.comp visits every triangle), so
// it needs no rounding analysis. Include after `nodes` and `triangles` are declared.
#ifndef VKH_SHADERS_LIB_BVH_GLSL
#define VKH_SHADERS_LIB_BVH_GLSL

#include "shaders/lib/triangle.h"

Corners triangle_corners(uint i) {
  Corners t;
  t.a = triangles[i].a;
  t.b = triangles[i].b;
  t.c = triangles[i].c;
  return t;
}

// Corners of triangle i in the frame at `origin`; each is off by one rounding.
Corners local_triangle(uint i, vec3 origin) {
  Corners t = triangle_corners(i);
  t.a -= origin;
  t.b -= origin;
  t.c -= origin;
  return t;
}

float box_distance2(vec3 p, vec3 lo, vec3 hi) {
  vec3 d = max(max(lo - p, p - hi), vec3(0.0));
  return dot(d, d);
}

struct Nearest {
  uint triangle;
  float distance2;
};

void try_triangle(vec3 p, uint i, inout Nearest best) {
  float d2 = closest_point(vec3(0.0), local_triangle(i, p)).distance2;
  if (d2 < best.distance2) best = Nearest(i, d2);
}

// The triangle closest to p, starting from `start` if that is one. Depth first, near child first; a
// node is pushed at most once a level, so kStackDepth entries suffice.
Nearest nearest_triangle(vec3 p, uint start) {
  Nearest best = Nearest(kNone, 3.0e38);
  if (start != kNone) try_triangle(p, start, best);
  uint stack[kStackDepth];
  float stack_distance2[kStackDepth];
  uint top = 0u;
  uint at = 0u;
  while (true) {
    bool descend = false;
    if ((at & kLeafFlag) != 0u) {
      uint first = at & (kMaxTriangles - 1u);
      uint last = first + ((at >> 28) & 7u);
      for (uint i = first; i <= last; ++i) try_triangle(p, i, best);
    } else {
      Node node = nodes[at];
      float d0 = box_distance2(p, node.lo0, node.hi0);
      float d1 = box_distance2(p, node.lo1, node.hi1);
      bool swap = d1 < d0;
      float near_d = swap ? d1 : d0;
      float far_d = swap ? d0 : d1;
      if (near_d < best.distance2) {
        at = swap ? node.child1 : node.child0;
        descend = true;
        if (far_d < best.distance2) {
          stack[top] = swap ? node.child0 : node.child1;
          stack_distance2[top] = far_d;
          ++top;
        }
      }
    }
    if (descend) continue;
    bool found = false;
    while (top > 0u && !found) {
      --top;
      found = stack_distance2[top] < best.distance2;
    }
    if (!found) return best;
    at = stack[top];
  }
  return best;
}

#endif
