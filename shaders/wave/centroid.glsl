// The closest triangle of B to a candidate's centroid: a stream beside the frontier, with the same
// slots, that exists only if centroids are queried. wave/no_centroid.glsl does without.
// The kernel declares `centroid_nearest`.
#ifndef VKH_SHADERS_WAVE_CENTROID_GLSL
#define VKH_SHADERS_WAVE_CENTROID_GLSL

#include "shaders/base/switches.glsl"

uint nearest_to_centroid(uint slot) { return asks_centroids() ? centroid_nearest[slot] : kNone; }

void keep_nearest_to_centroid(uint slot, uint triangle) {
  if (asks_centroids()) centroid_nearest[slot] = triangle;
}

#endif
