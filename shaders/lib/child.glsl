// A child in a wave: one of the four of a refined candidate, or a face of A admitted whole.
// Children are not stored: a code names them, and this page derives their corners and the triangles
// of B that are known to be near. Include after lib/candidate.glsl and the wave's buffers.
#ifndef VKH_SHADERS_LIB_CHILD_GLSL
#define VKH_SHADERS_LIB_CHILD_GLSL

// At most: three own, three more of the parent's six points, the parent's centroid, the child's own
// centroid.
const uint kMaxKnown = 8u;

struct Child {
  uint root;
  Bary3 at;
  uvec3 nearest;  // closest triangles of the three corners
  float upper;    // the parent's u, which bounds the child too; huge for a face of A
};

struct Known {
  uint triangle[kMaxKnown];
  uint count;
};

void know(inout Known known, uint triangle) {
  bool fresh = triangle != kNone && known.count < kMaxKnown;
  for (uint i = 0u; i < known.count; ++i) fresh = fresh && known.triangle[i] != triangle;
  if (!fresh) return;
  known.triangle[known.count] = triangle;
  ++known.count;
}

bool is_root(uint code) { return code >= 4u * control.parents; }

// The face of A that a code of an admitted one names; anything for others.
uint root_of(uint code) {
  return control.root_cursor - control.roots + (code - 4u * control.parents);
}

Child root_child(uint code) {
  Child c;
  c.root = root_of(code);
  c.at = whole_root();
  uvec3 f = faces[c.root];
  c.nearest = uvec3(vertex_nearest[f.x], vertex_nearest[f.y], vertex_nearest[f.z]);
  c.upper = 3.0e38;
  return c;
}

uint nearest_of(Candidate parent, uint parent_index, uint point) {
  if (point < 3u) return parent.nearest[point];
  return points[3u * parent_index + point - 3u].nearest;
}

Child split_child(uint code) {
  uint index = code >> 2;
  uint split = splits[index].code;
  Candidate parent = frontier[reading(splits[index].parent)];
  uvec3 corner = child_points(split, code & 3u);
  Child c;
  c.root = parent.root;
  c.at = child_of(split_points(unpack_corners(parent.corners), split), corner);
  c.nearest = uvec3(nearest_of(parent, index, corner.x), nearest_of(parent, index, corner.y),
                    nearest_of(parent, index, corner.z));
  c.upper = upper_of(parent);
  return c;
}

Child load_child(uint code) {
  if (is_root(code)) return root_child(code);
  return split_child(code);
}

// The parent's samples are free: its other corners, its other new points, its centroid.
void know_parent_samples(uint code, inout Known known) {
  if (is_root(code)) return;
  Candidate parent = frontier[reading(splits[code >> 2].parent)];
  for (uint i = 0u; i < 6u; ++i) know(known, nearest_of(parent, code >> 2, i));
  know(known, parent.nearest_centroid);
}

#endif
