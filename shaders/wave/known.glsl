// Triangles of B that are known to be near a child, for the children that a workgroup bounds. The
// kernel declares kKnowers, the number of these children, wave/centroid.glsl, and what
// wave/child.glsl needs.
#ifndef VKH_SHADERS_WAVE_KNOWN_GLSL
#define VKH_SHADERS_WAVE_KNOWN_GLSL

#include "shaders/wave/child.glsl"
#include "shaders/wave/dispatch.glsl"

// The most triangles: three own, three more of the parent's six points, the parent's centroid, the
// child's own centroid.
const uint kMaxKnown = 8u;
// Without the centroid's triangle and the parent's, only the three corners' are known.
const uint kMostKnown = kKnowsMore ? kMaxKnown : 3u;

shared uint known_triangle[kKnowers * kMostKnown];
shared uint known_count[kKnowers];

uint known_to(uint child, uint k) { return known_triangle[child * kMostKnown + k]; }

void know(uint child, uint triangle) {
  uint count = known_count[child];
  bool fresh = triangle != kNone && count < kMostKnown;
  for (uint k = 0u; k < count; ++k) fresh = fresh && known_to(child, k) != triangle;
  if (!fresh) return;
  known_triangle[child * kMostKnown + count] = triangle;
  known_count[child] = count + 1u;
}

void know_corners(uint child, Child c) {
  know(child, c.nearest.x);
  know(child, c.nearest.y);
  know(child, c.nearest.z);
}

// The parent's samples are free: its other corners, its other new points, its centroid.
void know_parent_samples(uint child, uint code) {
  if ((kSwitches & kUseParentSamples) == 0u || is_root(code)) return;
  uint slot = reading(splits[parent_of(code)].parent);
  Candidate parent = frontier[slot];
  for (uint i = 0u; i < 6u; ++i) know(child, nearest_of(parent, parent_of(code), i));
  know(child, nearest_to_centroid(slot));
}

#endif
