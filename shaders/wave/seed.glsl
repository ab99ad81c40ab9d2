// The points that the seed queries: A's vertices and, behind them in a warm run, the last run's
// witness at its present position. The last run's data may be anything: starts are checked, and the
// witness is moved into A, so that it costs time at worst. First, vertex_distance holds the states
// from seed_faces; then the distance, and vertex_nearest the triangle, kNone if no face uses the
// vertex. The seed also queries the witness alone, after a plan that has moved the base. The kernel
// declares `vertices`, `faces`, `vertex_nearest`, `vertex_distance`, `push` (QueryPush), and what
// traversal/query.glsl needs.
#ifndef VKH_SHADERS_WAVE_SEED_GLSL
#define VKH_SHADERS_WAVE_SEED_GLSL

#include "shaders/wave/base.glsl"
#include "shaders/wave/subroot.glsl"
#include "shaders/traversal/query.glsl"

// The last run's witness, or this one's if it is measured again.
bool is_witness(uint i) { return i == push.vertex_count && push.warm != 0u; }

uint seed_count() { return push.vertex_count + (push.warm != 0u ? 1u : 0u); }

Two3 seed_point(uint i) {
  if (i < push.vertex_count) return vertex_at(i);
  return position_of(root_at(control.witness.root), uvec2(control.witness.j, control.witness.k));
}

// The triangle to start from: the last run's, if it is one of B.
uint start_of(uint i) {
  if (push.warm == 0u) return kNone;
  uint start = i < push.vertex_count ? vertex_nearest[i] : control.witness.nearest;
  return start < push.triangle_count ? start : kNone;
}

// Makes the witness a sample of A, if it was none; one in a subroot of the last run, which still
// lies where it was, becomes a corner.
void clamp_witness() {
  if (is_subroot(control.witness.root)) {
    uint i = min(control.witness.root - control.face_count, most_subroots() - 1u);
    Candidate c = frontier[subroot_place(i)];
    uvec2 corner = unpack_corners(c.corners).a;
    control.witness.root = c.root;
    control.witness.j = corner.x;
    control.witness.k = corner.y;
  }
  control.witness.root = min(control.witness.root, control.face_count - 1u);
  control.witness.j = min(control.witness.j, kBaryOne);
  control.witness.k = min(control.witness.k, kBaryOne - control.witness.j);
}

// Whether a vertex needs no query: it is on B, or of no face.
void settle(uint i, uint state) {
  vertex_nearest[i] = state >= kVertexOnB ? state - kVertexOnB : kNone;
  vertex_distance[i] = 0u;
}

Item no_item() { return Item(false, false, kNone, 0.0, Query(two(vec3(0.0)), 0.0, false, false)); }

// `mine`: the item belongs to this invocation alone; other invocations may read the state after it
// is written.
Item first_item(uint i, bool mine) {
  Item item = no_item();
  if (!mine) return item;
  uint state = i < push.vertex_count ? vertex_distance[i] : 0u;
  item.asked = state == kVertexUsed || is_witness(i);
  item.exists = item.asked;
  if (!item.asked) {
    settle(i, state);
    return item;
  }
  if (is_witness(i)) clamp_witness();
  item.nearest = start_of(i);
  item.query.p = seed_point(i);
  if (is_witness(i)) control.witness.position = item.query.p.hi;
  return item;
}

// The distance in plain floats; a tight run measures again if that is over 0.
Item known_item(uint i, bool mine) {
  Item item = no_item();
  float base = max(base_of_run(), control.base);  // 0 before the first plan
  bool is_vertex = i < push.vertex_count && vertex_nearest[i] != kNone;
  item.exists = mine && (is_vertex || is_witness(i));
  if (!item.exists) return item;
  item.nearest = is_vertex ? vertex_nearest[i] : control.witness.nearest;
  float distance = is_vertex ? uintBitsToFloat(vertex_distance[i]) : control.witness.distance;
  item.distance = max(distance - base, 0.0);
  item.query = Query(seed_point(i), base, is_tight(base) || control.tight != 0u, is_fine(base));
  item.asked = item.query.tight && item.distance > 0.0;
  return item;
}

void answer_vertex(uint i, Item item) {
  if (i < push.vertex_count) {
    vertex_nearest[i] = item.nearest;
    vertex_distance[i] = bits_of(item.distance);
  } else {
    control.witness.nearest = item.nearest;
    control.witness.distance = item.distance;
  }
}

#endif
