// The traversal by a whole workgroup for one query, if a wave has too few queries to fill the
// device: level by level down the pyramid of boxes, all children of a level's boxes at once, then
// all triangles of the runs that are left. It finds the same as nearest_triangle. The workgroup has
// kQueryGroup invocations. The kernel declares `boxes`, `push` (QueryPush), and what
// traversal/traversal.glsl needs.
#ifndef VKH_SHADERS_TRAVERSAL_GROUP_TRAVERSAL_GLSL
#define VKH_SHADERS_TRAVERSAL_GROUP_TRAVERSAL_GLSL

#include "shaders/traversal/traversal.glsl"

shared uint level_boxes[2][kGroupTraversalBoxes];
shared uint level_count[2];
shared uint nearest_bits;  // a squared distance within which a triangle lies
shared Nearest nearest_of_lane[kQueryGroup];

// The level above the runs of kPyramidFan triangles is 1; level 0 is the runs.
struct Level {
  uint start;  // in boxes
  uint count;
};

Level level_at(uint level) {
  uint count = (push.triangle_count + kPyramidFan - 1u) / kPyramidFan;
  Level at = Level(0u, count);
  for (uint l = 0u; l < level; ++l) {
    at.start += at.count;
    at.count = (at.count + kPyramidFan - 1u) / kPyramidFan;
  }
  return at;
}

uint level_total() {
  uint total = 1u;
  for (uint n = push.triangle_count; n > kPyramidFan; ++total) {
    n = (n + kPyramidFan - 1u) / kPyramidFan;
  }
  return total;
}

float farthest_distance2(vec3 p, vec3 lo, vec3 hi) {
  vec3 d = max(abs(p - lo), abs(p - hi));
  return dot3(d, d);
}

// The largest distance, squared, at which a box still matters: (d + 1e-6)^2, for coordinates of
// order 1. Every triangle that may be as near as the nearest in plain floats is tried, no matter
// what other invocations have found before, so that the result does not depend on their order.
float group_reach() {
  float d = 1.000001 * root(uintBitsToFloat(nearest_bits)) + 1.0e-6;  // uncertified: steers
  return d * d;
}

// The k-th of all children of the boxes on `side`.
uint entry_of(uint side, uint k) {
  uint parent = level_boxes[side][k / kPyramidFan];
  return parent * kPyramidFan + k % kPyramidFan;
}

// Goes from the boxes of one level, on `side`, to the boxes of the level below that matter, on the
// other side.
void descend(Query q, Level below, uint side) {
  uint lane = gl_LocalInvocationID.x;
  if (lane == 0u) level_count[1u - side] = 0u;
  barrier();
  for (uint k = lane; k < level_count[side] * kPyramidFan; k += kQueryGroup) {
    uint child = entry_of(side, k);
    if (child >= below.count) continue;
    Box b = boxes[below.start + child];
    if (box_distance2(q.p.hi, b.lo, b.hi) > group_reach()) continue;
    uint slot = atomicAdd(level_count[1u - side], 1u);
    if (slot < kGroupTraversalBoxes) level_boxes[1u - side][slot] = child;
    float within = 1.000002 * farthest_distance2(q.p.hi, b.lo, b.hi);
    atomicMin(nearest_bits, bits_of(within));
  }
  barrier();
}

Nearest try_runs(Query q, uint side) {
  Nearest best = Nearest(kNone, uintBitsToFloat(nearest_bits), 3.0e38);
  tied_count = 0u;
  uint total = level_count[side] * kPyramidFan;
  uint k = gl_LocalInvocationID.x;
  while (k < total) {
    for (; k < total && tied_count < kTied; k += kQueryGroup) {
      uint i = entry_of(side, k);
      if (i < push.triangle_count) try_query(q, i, best);
    }
    // The other invocations' results save measuring ties; which ones they save does not change the
    // result.
    if (q.tight) {
      atomicMin(nearest_bits, bits_of(best.distance2));
      best.distance2 = uintBitsToFloat(nearest_bits);
      measure_tied(q, best);
    }
  }
  return best;
}

// Joins halves of the lanes at a time; the result is in lane 0.
void join_lanes(Query q) {
  uint lane = gl_LocalInvocationID.x;
  for (uint reach = kQueryGroup / 2u; reach > 0u; reach /= 2u) {
    barrier();
    if (lane >= reach) continue;
    if (is_nearer(q, nearest_of_lane[lane + reach], nearest_of_lane[lane]))
      nearest_of_lane[lane] = nearest_of_lane[lane + reach];
  }
}

// Called by every invocation of the workgroup with the same query, after the first has set the
// start: level_count[0], level_boxes[0][0], and nearest_bits. The result is nearest_of_lane[0], for
// the first invocation. Returns false if too many boxes matter.
bool traverse_by_group(Query q) {
  uint lane = gl_LocalInvocationID.x;
  uint side = 0u;
  for (uint level = level_total() - 1u; level > 0u; --level) {
    descend(q, level_at(level - 1u), side);
    // The number of boxes that passed depends on how fast others brought them nearer: if they are
    // too many, they are traversed again, now that no box comes nearer.
    if (level_count[1u - side] > kGroupTraversalBoxes) {
      barrier();  // all have read it
      descend(q, level_at(level - 1u), side);
    }
    side = 1u - side;
    if (level_count[side] > kGroupTraversalBoxes) return false;
  }
  nearest_of_lane[lane] = try_runs(q, side);
  join_lanes(q);
  return true;
}

shared Query query_of_group;
shared bool group_asked;

// Finds the same as nearest_triangle. Called by every invocation of the workgroup, each with a
// query of its own if it has one (`asked`); or, if `by_group`, at most the first with one for all.
Nearest find_nearest(Query q, uint start, bool asked, bool by_group) {
  Nearest best = nothing_near();
  traversal_at = kNone;
  left_count = tied_count = 0u;
  if (asked) best = begin_traversal(q, start);
  if (by_group) {
    bool first = gl_LocalInvocationID.x == 0u;
    if (first) {
      query_of_group = q;
      group_asked = asked;
      nearest_bits = bits_of(best.distance2);
      level_count[0] = 1u;
      level_boxes[0][0] = 0u;
    }
    barrier();
    if (group_asked && traverse_by_group(query_of_group) && first) {
      best = nearest_of_lane[0];
      traversal_at = kNone;
    }
  }
  traverse(q, best);
  return best;
}

#endif
