// Triangles of B that are known to be near a child: the candidate triangles of its bounds, for each
// child that a workgroup bounds. The kernel declares kGroupChildren, the number of these children,
// wave/centroid.glsl, and what wave/child.glsl needs.
#ifndef VKH_SHADERS_WAVE_KNOWN_GLSL
#define VKH_SHADERS_WAVE_KNOWN_GLSL

#include "shaders/wave/child.glsl"
#include "shaders/wave/dispatch.glsl"

// The most triangles: three own, three more of the parent's six points, the parent's centroid, the
// child's own centroid.
const uint kMaxKnown = 8u;
// Without the centroid's triangle and the parent's, only the triangles of the three corners are
// known.
const uint kMostKnown = kKnowsMore ? kMaxKnown : 3u;

shared uint known_triangle[kGroupChildren * kMostKnown];
shared uint known_count[kGroupChildren];

uint known_to(uint child, uint k) { return known_triangle[child * kMostKnown + k]; }

void add_known(uint child, uint triangle) {
  uint count = known_count[child];
  bool fresh = triangle != kNone && count < kMostKnown;
  for (uint k = 0u; k < count; ++k) fresh = fresh && known_to(child, k) != triangle;
  if (!fresh) return;
  known_triangle[child * kMostKnown + count] = triangle;
  known_count[child] = count + 1u;
}

void add_known_corners(uint child, Child c) {
  add_known(child, c.nearest.x);
  add_known(child, c.nearest.y);
  add_known(child, c.nearest.z);
}

// Adds the triangles of the parent's samples, which cost no query: its other corners, its other new
// points, its centroid.
void add_parent_samples(uint child, uint code) {
  if ((kSwitches & kUseParentSamples) == 0u || is_root(code)) return;
  uint slot = reading(splits[parent_of(code)].parent);
  Candidate parent = frontier[slot];
  for (uint i = 0u; i < 6u; ++i) add_known(child, nearest_of(parent, parent_of(code), i));
  add_known(child, nearest_to_centroid(slot));
}

#endif
