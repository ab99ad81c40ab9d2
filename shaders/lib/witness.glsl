// Which of a wave's samples becomes the witness. Several may be at the new lower bound, in an order
// that depends on scheduling: the one with the smallest key is taken, and the key is a hash of all
// that the report says of a witness, so that two samples with one key are one to the report. First
// every sample at the new lower bound offers its key (wave_filter, wave_bound), then those with the
// smallest key offer their index (wave_witness), then one invocation adopts it (wave_plan,
// report_begin), before the wave's streams are overwritten. Include after `control`, `frontier`,
// `splits`, `points`, `survivors` and `centroids` are declared and lib/child.glsl is included.
#ifndef VKH_SHADERS_LIB_WITNESS_GLSL
#define VKH_SHADERS_LIB_WITNESS_GLSL

#include "shaders/lib/hash.h"

bool is_new_lower(float distance) {
  return distance == uintBitsToFloat(control.maximum[kMaxLower]) &&
         distance > control.witness.distance;
}

uint witness_key(uint root, uvec2 at, uint nearest) {
  return mixed(mixed(mixed(mixed(0u, root), at.x), at.y), nearest);
}

struct Sample {
  uint root;
  uvec2 at;
};

Sample sample_of_point(uint p) {
  uint parent_index = p / 3u;  // uncertified: integers
  Split split = splits[parent_index];
  Candidate parent = frontier[reading(split.parent)];
  Bary6 six = split_points(unpack_corners(parent.corners), split.code);
  return Sample(parent.root, corner_of(six.fresh, p % 3u));
}

Sample sample_of_centroid(uint c) {
  Child child = load_child(survivors[c]);
  return Sample(child.root, centroid_of(child.at));
}

uint key_of_point(uint p) {
  Sample at = sample_of_point(p);
  return witness_key(at.root, at.at, points[p].nearest);
}

uint key_of_centroid(uint c) {
  Sample at = sample_of_centroid(c);
  return witness_key(at.root, at.at, centroids[c].nearest);
}

void adopt(Point asked, Sample at) {
  control.witness =
      Witness(asked.position, asked.distance, at.root, at.at.x, at.at.y, asked.nearest);
}

void adopt_witness() {
  uint c = control.witness_centroid;
  uint p = control.witness_point;
  if (c != kNone) {
    adopt(centroids[c], sample_of_centroid(c));
  } else if (p != kNone) {
    adopt(points[p], sample_of_point(p));
  }
  control.witness_point_key = kNone;
  control.witness_point = kNone;
  control.witness_centroid_key = kNone;
  control.witness_centroid = kNone;
}

#endif
