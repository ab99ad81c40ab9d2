// Which of a wave's samples becomes the witness. Several may be at the new lower bound, in an order
// that depends on scheduling: the one with the smallest key is taken, and the key is a hash of all
// that the report says of a witness, so that two samples with one key are one to the report.
// Samples at what was the lower bound when they were looked at are offered (wave_filter,
// wave_bound); a workgroup then adopts one (wave_plan), before the wave's streams are
// overwritten. Include after `control`, `frontier`, `splits`, `points`, `survivors` and `centroids`
// are declared and lib/child.glsl is included.
#ifndef VKH_SHADERS_LIB_WITNESS_GLSL
#define VKH_SHADERS_LIB_WITNESS_GLSL

#include "shaders/lib/hash.h"

float distance_of_sample(uint s) {
  if ((s & kCentroidSample) != 0u) return centroids[s & ~kCentroidSample].distance;
  return points[s].distance;
}

bool is_new_lower(float distance) {
  return distance == uintBitsToFloat(control.maximum[kMaxLower]) &&
         distance > control.witness.distance;
}

void offer_sample(uint s) {
  if (!is_new_lower(distance_of_sample(s))) return;
  uint slot = atomicAdd(control.offer_count, 1u);
  if (slot < kMaxOffers) control.offers[slot] = s;
}

// A child's share in offering the new points: of a candidate's children all but the last have one.
void offer_point(uint code) {
  uint which = code % children_each();
  if (!is_root(code) && which < points_each())
    offer_sample(points_each() * parent_of(code) + which);
}

Witness witness_from(Point asked, uint root, uvec2 at) {
  return Witness(asked.position, asked.distance, root, at.x, at.y, asked.nearest);
}

// A sample as the witness that it would be.
Witness witness_at(uint s) {
  if ((s & kCentroidSample) != 0u) {
    uint c = s & ~kCentroidSample;
    Child child = load_child(survivors[c]);
    return witness_from(centroids[c], child.root, centroid_of(child.at));
  }
  Split split = splits[s / points_each()];  // uncertified: integers
  Candidate parent = frontier[reading(split.parent)];
  Bary6 six = split_points(unpack_corners(parent.corners), split.code);
  uint which = s % points_each();
  if (kMaySplitTwice && which >= 3u) {  // a child's
    uint child = (which - 3u) / 3u;     // uncertified: integers
    six = split_points(child_of(six, child_points(split.code, child)), inner_split(split, child));
  }
  return witness_from(points[s], parent.root, corner_of(six.fresh, which % 3u));
}

uint key_of_witness(Witness w) {
  return mixed(mixed(mixed(mixed(0u, w.root), w.j), w.k), w.nearest);
}

#endif
