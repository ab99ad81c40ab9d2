// Chooses the witness among a wave's samples. Several may be at the new lower bound, in an
// order that depends on scheduling: the one with the smallest key is taken, and the key is a hash
// of all that the report contains about a witness, so that two samples with the same key give the
// same report, except with a chance of 2^-32 for each pair of samples. wave_bound offers samples
// after all are measured; the plan adopts one (wave/adopt.glsl). The kernel declares `survivors`,
// `centroids`, and what wave/child.glsl needs.
#ifndef VKH_SHADERS_WAVE_WITNESS_GLSL
#define VKH_SHADERS_WAVE_WITNESS_GLSL

#include "shaders/base/invocation.glsl"
#include "shaders/wave/child.glsl"
#include "shaders/math/hash.h"

// Samples of the wave: its new points, then survivors' centroids.
uint sample_count() { return query_count(); }

float distance_of_sample(uint s) {
  uint points_asked = point_count();
  if ((kSwitches & kUseCentroid) != 0u && s >= points_asked)
    return centroids[s - points_asked].distance;
  return points[s].distance;
}

bool is_new_lower(float distance) {
  return distance == uintBitsToFloat(control.maximum[kMaxLower]) &&
         distance > control.witness.distance;
}

Witness witness_from(Point asked, uint root, uvec2 at) {
  vec3 position = position_of(root_at(root), at).hi;
  return Witness(position, asked.distance, root, at.x, at.y, asked.nearest);
}

// Makes a witness of a sample.
Witness witness_at(uint s) {
  if ((kSwitches & kUseCentroid) != 0u && s >= point_count()) {
    uint c = s - point_count();
    Child child = load_child(survivors[c]);
    return witness_from(centroids[c], child.root, centroid_of(child.at));
  }
  Split split = splits[s / points_each()];
  Candidate parent = frontier[reading(split.parent)];
  Bary6 six = split_points(unpack_corners(parent.corners), split.code);
  uint which = s % points_each();
  if (kMaySplitTwice && which >= 3u) {  // a child's
    uint child = (which - 3u) / 3u;
    six = split_points(child_of(six, child_points(split.code, child)), child_split(split, child));
  }
  return witness_from(points[s], parent.root, corner_of(six.fresh, which % 3u));
}

uint key_of_witness(Witness w) {
  uint key = mixed(mixed(mixed(root_hash(w.root), w.j), w.k), w.nearest);
  return min(key, kNone - 1u);
}

// Keeps a sample if its key is the smallest so far: of a million samples some 20 are kept, in any
// order, and the smallest of all is among them.
void offer(Witness w) {
  uint key = key_of_witness(w);
  if (key >= atomicMin(control.offer_key, key)) return;
  uint slot = atomicAdd(control.offer_count, 1u);
  if (slot >= kMaxOffers) return;
  uvec3 at = floatBitsToUint(w.position);
  atomicExchange(control.offers[slot].key, key);
  atomicExchange(control.offers[slot].x, at.x);
  atomicExchange(control.offers[slot].y, at.y);
  atomicExchange(control.offers[slot].z, at.z);
  atomicExchange(control.offers[slot].root, w.root);
  atomicExchange(control.offers[slot].j, w.j);
  atomicExchange(control.offers[slot].k, w.k);
  atomicExchange(control.offers[slot].nearest, w.nearest);
}

// The invocations of a dispatch go over all samples (groups_for_children).
void offer_samples() {
  uint step = gl_NumWorkGroups.x * gl_NumWorkGroups.y * kGroupSize;
  for (uint s = item_index(); s < sample_count(); s += step) {
    if (is_new_lower(distance_of_sample(s))) offer(witness_at(s));
  }
}

#endif
