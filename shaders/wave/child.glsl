// A child in a wave: one of the four children of a refined candidate, or of its sixteen if the wave
// splits twice, or a whole face of A that was admitted. Children are not stored: a code names them,
// and this file derives their corners and the triangles of B that are known to be near. The kernel
// declares `splits`, `points`, `vertex_nearest`, and what wave/candidate.glsl needs.
#ifndef VKH_SHADERS_WAVE_CHILD_GLSL
#define VKH_SHADERS_WAVE_CHILD_GLSL

#include "shaders/wave/candidate.glsl"
#include "shaders/wave/split_counts.glsl"

struct Child {
  uint root;
  Bary3 at;
  uvec3 nearest;  // closest triangles of the three corners
  float upper;    // the parent's u, which bounds the child too; huge for a face of A
};

bool is_root(uint code) { return code >= children_each() * control.parents; }

// The refined candidate that a child, or a new point, comes from.
uint parent_of(uint code) { return splits_twice() ? code >> 4 : code >> 2; }

// The face of A that a code names, if it names an admitted face; undefined for others.
uint root_of(uint code) {
  return control.root_cursor - control.roots + (code - children_each() * control.parents);
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

// One of the six points of a candidate's split.
uint nearest_of(Candidate parent, uint parent_index, uint point) {
  if (point < 3u) return parent.nearest[point];
  return points[points_each() * parent_index + point - 3u].nearest;
}

Child child_of_candidate(Candidate parent, uint index, uint split, uint which) {
  uvec3 corner = child_points(split, which);
  Child c;
  c.root = parent.root;
  c.at = child_of(split_points(unpack_corners(parent.corners), split), corner);
  c.nearest = uvec3(nearest_of(parent, index, corner.x), nearest_of(parent, index, corner.y),
                    nearest_of(parent, index, corner.z));
  c.upper = upper_of(parent);
  return c;
}

// A child's child, number `which` of four; `first_point`: the first of the child's own new points.
Child child_of_child(Child c, uint split, uint which, uint first_point) {
  uvec3 corner = child_points(split, which);
  Child inner = c;
  inner.at = child_of(split_points(c.at, split), corner);
  for (uint i = 0u; i < 3u; ++i) {
    inner.nearest[i] =
        corner[i] < 3u ? c.nearest[corner[i]] : points[first_point + corner[i] - 3u].nearest;
  }
  return inner;
}

Child split_child(uint code) {
  uint index = parent_of(code);
  Split split = splits[index];
  Candidate parent = frontier[reading(split.parent)];
  uint which = (splits_twice() ? code >> 2 : code) & 3u;
  Child c = child_of_candidate(parent, index, split.code, which);
  if (!splits_twice()) return c;
  uint inner = child_split(split, which);
  if (inner == kSplitNone) return c;
  return child_of_child(c, inner, code & 3u, 15u * index + 3u + 3u * which);
}

// Whether a code names a child: its candidate was split, and so was the child if that is split
// again; otherwise the first of its four codes names the child itself.
bool is_child(uint code) {
  if (is_root(code)) return true;
  Split split = splits[parent_of(code)];
  if (split.code == kSplitNone) return false;
  if (!splits_twice() || (code & 3u) == 0u) return true;
  return child_split(split, (code >> 2) & 3u) != kSplitNone;
}

Child load_child(uint code) {
  if (is_root(code)) return root_child(code);
  return split_child(code);
}

#endif
