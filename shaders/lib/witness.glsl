// Adopting the wave's best sample as witness. Include after `control`, `frontier`, `splits`,
// `points`, `survivors` and `centroids` are declared and lib/child.glsl is included; call it from
// one invocation, before the wave's streams are overwritten.
#ifndef VKH_SHADERS_LIB_WITNESS_GLSL
#define VKH_SHADERS_LIB_WITNESS_GLSL

void adopt(Point sample_point, uint root, uvec2 at) {
  control.witness =
      Witness(sample_point.position, sample_point.distance, root, at.x, at.y, sample_point.nearest);
}

void adopt_witness() {
  float lower = uintBitsToFloat(control.maximum[kMaxLower]);
  if (lower > control.witness.distance) {
    uint c = control.witness_centroid;
    uint p = control.witness_point;
    if (c != kNone) {
      Child child = load_child(survivors[c]);
      adopt(centroids[c], child.root, centroid_of(child.at));
    } else if (p != kNone) {
      uint parent_index = p / 3u;  // uncertified: integers
      Candidate parent = frontier[parent_at(parent_index)];
      Bary6 six = split_points(unpack_corners(parent.corners), splits[parent_index]);
      adopt(points[p], parent.root, corner_of(six.fresh, p % 3u));
    }
  }
  control.witness_point = kNone;
  control.witness_centroid = kNone;
}

#endif
