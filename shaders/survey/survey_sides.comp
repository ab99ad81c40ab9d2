// Finds the side of B on which cells lie, which have none yet (report/side.h). A cell that was
// split hands its side on. In: cells, bounds, face_kinds, of each face of B as given; A and B's
// BVH. Out: classes. Each result depends on its cell alone. An invocation for each cell.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shaders/base/invocation.glsl"

layout(local_size_x = kGroupSize) in;
layout(scalar, binding = 0) readonly buffer ControlBlock { Control control; };
layout(scalar, binding = 1) readonly buffer Nodes { uvec4 nodes[]; };
layout(scalar, binding = 2) readonly buffer Triangles { uvec4 triangles[]; };
layout(scalar, binding = 3) readonly buffer TriangleLows { TriangleLow triangle_lows[]; };
layout(scalar, binding = 4) readonly buffer Vertices { Vertex vertices[]; };
layout(scalar, binding = 5) readonly buffer Faces { uvec3 faces[]; };
layout(scalar, binding = 6) readonly buffer Cells { Cell cells[]; };
layout(scalar, binding = 7) readonly buffer Bounds { CellBounds bounds[]; };
layout(scalar, binding = 8) readonly buffer FaceKinds { uint face_kinds[]; };
layout(scalar, binding = 9) buffer Classes { uint classes[]; };
layout(scalar, push_constant) uniform PushBlock { SurveySidesPush push; };

#include "shaders/base/root.glsl"
#include "shaders/base/surface.glsl"
#include "shaders/report/cell_search.glsl"
#include "shaders/report/side.h"
#include "shaders/survey/score.h"

Search search_along(CellFrame t, uint axis) {
  float margin = 8.0 * kUlp * (t.reach + t.radius);
  vec3 p = t.origin.hi + inner_point(t, axis);
  vec3 ray = vec3(axis == 0u, axis == 1u, axis == 2u);
  return Search(axis, p - margin, p + (margin + 3.0e37 * ray), p, 0.0);
}

// The results of the triangles so far.
struct Told {
  uint of_class;  // by their planes: kClassUnseen if none was looked at
  int winding;
  bool is_sure;  // of the winding number
  uint count;    // of triangles that may be closest
};

Told told;
Above above;

uint face_of(uint triangle) {
  return triangles[kTriangleWords * min(triangle, push.triangle_count - 1u)].w;
}

bool look_at_crossing(uint triangle, CellFrame t, uint axis) {
  Crossing c = crossing_along(t, load_surface(triangle, cell_view(t)), axis);
  told.winding += c.winding;
  told.is_sure = told.is_sure && c.is_sure;
  return told.is_sure;
}

bool look_at_plane(uint triangle, CellFrame t) {
  Surface s = load_surface(triangle, cell_view(t));
  uint kind = face_kinds[face_of(triangle)];
  if ((kind & kFaceCovered) != 0u || !may_be_closest(t, s, above, push.moved)) return true;
  ++told.count;
  told.of_class = told.count > kCellTriangles
                      ? kClassMany
                      : class_with(told.of_class, kind, side_of_cell(t, s, push.moved));
  return has_side(told.of_class);
}

bool look_at(uint triangle, Search s, CellFrame t) {
  if (s.axis != kNoAxis) return look_at_crossing(triangle, t, s.axis);
  return look_at_plane(triangle, t);
}

void find_told(Search s, CellFrame t) {
  told = Told(kClassUnseen, 0, true, 0u);
  if (look_through(s, t) == kSeenSome) told = Told(kClassMany, 0, false, 0u);
}

// The class by rays along the three axes; kClassUnseen: each meets an edge of B, or starts where
// the cell may touch it.
uint class_by_winding(CellFrame t, vec3 lower, bool off) {
  for (uint axis = 0u; axis < 3u; ++axis) {
    if (!off && !is_off_inside(lower, axis, push.moved)) continue;
    find_told(search_along(t, axis), t);
    if (told.is_sure) return told.winding == push.front ? kClassOver : kClassUnder;
  }
  return kClassUnseen;
}

uint class_by_planes(CellFrame t, CellBounds b, bool off) {
  above = Above(upper_of(b), b.highest);
  find_told(search_near(t, b.highest, push.moved), t);
  uint found = told.of_class;
  return found == kClassEdge && !off ? kClassMeets : found;
}

void main() {
  uint i = push.first + item_index();
  if (i >= push.end || classes[i] != kClassUnseen) return;
  CellBounds b = bounds[i];
  if (!(b.highest > push.above)) return;
  Cell cell = cells[i];
  uint face = min(cell.face, push.face_count - 1u);
  CellFrame t = make_cell(load_root(face), unpack_corners(cell.corners));
  bool off = is_off(lowest_of(b), push.moved);
  bool has_one = off || is_off_but_near(lower_of(b), upper_of(b), push.moved, push.near);
  uint found = push.is_solid != 0u && !has_one ? kClassMeets : class_by_planes(t, b, off);
  if (push.is_solid != 0u && has_one && !has_side(found)) {
    uint by_winding = class_by_winding(t, lower_of(b), off);
    found = by_winding == kClassUnseen ? found : by_winding;
  }
  classes[i] = found;
}
