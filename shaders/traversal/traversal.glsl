// The traversal of B's BVH. It steers: whichever triangle it returns gives a true upper bound
// (docs/method.md, section 6), and no lower bound rests on it (report_write.comp visits every
// triangle), so it needs no rounding analysis. The kernel declares `nodes`, `triangles`,
// `triangle_lows`, `control`.
#ifndef VKH_SHADERS_TRAVERSAL_TRAVERSAL_GLSL
#define VKH_SHADERS_TRAVERSAL_TRAVERSAL_GLSL

#include "shaders/base/surface.glsl"
#include "shaders/math/lower.h"

// The largest distance at which a sample's distance is also bounded from below, see measured():
// beyond it, a closest point that is 1.2e-7 off costs under 1e-8, or under 1e-10 in a tight run.
float next_to_surface(bool tight) { return tight ? 1.0e-4 : 1.0e-6; }

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
  return dot3(d, d);
}

struct Nearest {
  uint triangle;
  float distance2;  // in plain floats
  float above;      // the distance above the base: to 48 bits in a tight traversal
};

Nearest nothing_near() { return Nearest(kNone, 3.0e38, 3.0e38); }

float triangle_distance2(vec3 p, uint i) {
  return plain_distance2(vec3(0.0), local_triangle(i, p));
}

// Takes the first of equally far triangles, in whichever order they are tried.
void keep_nearer(uint i, float d2, inout Nearest best) {
  if (d2 < best.distance2 || (d2 == best.distance2 && i < best.triangle))
    best = Nearest(i, d2, 0.0);
}

void try_triangle(vec3 p, uint i, inout Nearest best) {
  keep_nearer(i, triangle_distance2(p, i), best);
}

// Plain floats cannot tell triangles apart whose distances differ by an ulp, and the farthest point
// of A is equally far from several: a tight traversal compares those next to the best to 48 bits.
float reach_of(Nearest best) {
  float d = 1.000001 * root(best.distance2) + 5.0e-7;  // uncertified: steers
  return d * d;
}

// The largest error of a distance in plain floats, in a frame of order 1: 1.04e-6 seen.
const float kPlainDoubt = 4.0e-6;

struct Query {
  Two3 p;
  float base;
  bool tight;
  bool fine;  // View::fine
};

void try_tight(Query q, uint i, inout Nearest best) {
  Surface s = load_surface(i, view_from(q.p, q.base, q.fine));
  float above = surface_distance_up(two(vec3(0.0)), s);
  bool closer = above < best.above || (above == best.above && i < best.triangle);
  if (closer) best = Nearest(i, best.distance2, above);
}

// Triangles that a tight traversal cannot tell from the nearest so far wait here. They are measured
// when there are many, and at the end, so that the invocations of a subgroup do it at the same
// time.
const uint kTied = 16u;  // a leaf more than may wait
uint tied[kTied];
float tied_distance2[kTied];
uint tied_count;

void keep_query(Query q, uint i, float d2, inout Nearest best) {
  if (!q.tight) {
    keep_nearer(i, d2, best);
    return;
  }
  if (d2 > reach_of(best)) return;
  best.distance2 = min(best.distance2, d2);
  tied[tied_count] = i;
  tied_distance2[tied_count] = d2;
  ++tied_count;
}

void try_query(Query q, uint i, inout Nearest best) {
  keep_query(q, i, triangle_distance2(q.p.hi, i), best);
}

// Takes the last one first: it is surely within reach if a driver ends the loops of a long
// traversal.
void measure_tied(Query q, inout Nearest best) {
  while (tied_count > 0u) {
    --tied_count;
    if (tied_distance2[tied_count] <= reach_of(best)) try_tight(q, tied[tied_count], best);
  }
}

float reach_of(Query q, Nearest best) { return q.tight ? reach_of(best) : best.distance2; }

// The better of two results of parts of a traversal; of equally near triangles the first.
bool is_nearer(Query q, Nearest x, Nearest than) {
  if (x.triangle == kNone) return false;
  float d = q.tight ? x.above - than.above : x.distance2 - than.distance2;
  return than.triangle == kNone || d < 0.0 || (d == 0.0 && x.triangle < than.triangle);
}

// A traversal's result as a sample: its distance to 48 bits, if a plain traversal left that out.
// Next to B it must not be too large: a closest point computed from float32 barycentrics, of 24
// bits, is 2^-24 of its triangle off, so there the distance is bounded from below. If it is not
// above `than`, it does not matter.
Nearest measured(Query q, Nearest best, float than) {
  if (best.triangle == kNone) return best;
  if (!q.tight) {
    // The distance in plain floats, if that is surely under `than`: most samples are.
    best.above = root(best.distance2) - q.base;  // uncertified: steers
    if (best.above < than - kPlainDoubt) return best;
  }
  float next = next_to_surface(q.tight) - q.base;
  if (q.tight && best.above > next) return best;
  Surface s = load_surface(best.triangle, view_from(q.p, q.base, q.fine));
  Closest c = closest_point(vec3(0.0), s.at);
  if (!q.tight) best.above = distance_to_up(two(vec3(0.0)), s, c);
  bool matters = best.above > than;
  if (matters && best.above <= next) best.above = distance_down(s, c, 3.0e38);
  return best;
}

// The state of a traversal: the boxes still to be visited, deeper ones above others. A node leaves
// at most three behind, and the tree of nodes is half as deep as that of branches.
const uint kTraversalStack = 3u * kStackDepth / 2u;

// Each invocation has its own stack. It is no struct that functions pass on, since drivers copy
// those (lavapipe: 8 times slower).
uint left_child[kTraversalStack];
float left_distance2[kTraversalStack];
uint left_count;

// The next child that is within reach; kNone, which reads as a leaf, if there is none.
uint pop(float reach) {
  while (left_count > 0u) {
    --left_count;
    if (left_distance2[left_count] < reach) return left_child[left_count];
  }
  return kNone;
}

// A child of a node, and its distance, squared.
struct Near {
  uint child;
  float distance2;
};

Near child_at(uint at, uint k, vec3 p) {
  uvec4 lo = nodes[kNodeWords * at + 2u * k];
  uvec4 hi = nodes[kNodeWords * at + 2u * k + 1u];
  return Near(lo.w, box_distance2(p, uintBitsToFloat(lo.xyz), uintBitsToFloat(hi.xyz)));
}

// The nearer of the two becomes `nearest`, the other is left for later if it is within reach.
void leave_farther(Near other, inout Near nearest, float reach) {
  bool nearer = other.distance2 < nearest.distance2;
  uint left = choose(nearer, nearest.child, other.child);
  float distance2 = choose(nearer, nearest.distance2, other.distance2);
  nearest.child = choose(nearer, other.child, nearest.child);
  nearest.distance2 = choose(nearer, other.distance2, nearest.distance2);
  if (distance2 >= reach) return;
  left_child[left_count] = left;
  left_distance2[left_count] = distance2;
  ++left_count;
}

// Goes from a node to its nearest child within reach, and leaves the others within reach for later;
// if there is none, goes to the next one that was left. Sorting the others would cost what it
// saves. A loop would index vector components by a variable, which is slow on CPU devices.
uint step_down(uint at, vec3 p, float reach) {
  Near a = child_at(at, 0u, p);
  Near b = child_at(at, 1u, p);
  Near c = child_at(at, 2u, p);
  Near nearest = child_at(at, 3u, p);
  leave_farther(a, nearest, reach);
  leave_farther(b, nearest, reach);
  leave_farther(c, nearest, reach);
  if (nearest.distance2 < reach) return nearest.child;
  return pop(reach);
}

// The node or leaf that the traversal is at; kNone: it is done.
uint traversal_at;

// Starts a traversal at the root. `start`: a triangle to begin with, or kNone.
Nearest begin_traversal(Query q, uint start) {
  Nearest best = nothing_near();
  tied_count = 0u;
  if (start != kNone) try_query(q, start, best);
  left_count = 0u;
  traversal_at = 0u;
  return best;
}

// Traverses to the end. Depth first, near children first. Invocations go down until each is at a
// leaf, then all try triangles ([AL09] of docs/method.md).
void traverse(Query q, inout Nearest best) {
  float reach = reach_of(q, best);
  while (traversal_at != kNone) {
    while (traversal_at != kNone && tied_count + kLeafTriangles <= kTied) {
      while ((traversal_at & kLeafFlag) == 0u)
        traversal_at = step_down(traversal_at, q.p.hi, reach);
      if (traversal_at == kNone) break;
      uint first = traversal_at & (kMaxTriangles - 1u);
      uint last = first + ((traversal_at >> 28) & 7u);
      // Two at a time, so that they are loaded at once.
      for (uint i = first; i <= last; i += 2u) {
        uint next = min(i + 1u, last);
        float d2 = triangle_distance2(q.p.hi, i);
        float next_d2 = triangle_distance2(q.p.hi, next);
        keep_query(q, i, d2, best);
        if (next > i) keep_query(q, next, next_d2, best);
      }
      reach = reach_of(q, best);
      traversal_at = pop(reach);
    }
    measure_tied(q, best);
  }
}

// The triangle closest to q.p, to 48 bits in a tight traversal.
Nearest nearest_triangle(Query q, uint start) {
  Nearest best = begin_traversal(q, start);
  traverse(q, best);
  return best;
}

#endif
