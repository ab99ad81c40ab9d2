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
#include "shaders/report/cell_boxes.glsl"
#include "shaders/report/side.h"
#include "shaders/survey/score.h"

const uint kNoAxis = 3u;

// The boxes that a search goes through: those that a ray meets, or those that are near a point.
struct Search {
  uint axis;  // of the ray
  vec3 least,
      most;  // a box that the ray meets does not end before the one, nor begin behind the other
  vec3 centre;
  float reach;  // squared
};

Search search_along(CellFrame t, uint axis) {
  float margin = 8.0 * kUlp * (t.reach + t.radius);
  vec3 p = t.origin.hi + inner_point(t, axis);
  vec3 ray = vec3(axis == 0u, axis == 1u, axis == 2u);
  return Search(axis, p - margin, p + (margin + 3.0e37 * ray), p, 0.0);
}

Search search_near(CellFrame t, float highest) {
  float reach = cell_reach(highest + 2.0 * push.moved, t);
  return Search(kNoAxis, vec3(0.0), vec3(0.0), t.origin.hi, reach);
}

bool may_hold(Search s, vec3 lo, vec3 hi) {
  if (s.axis != kNoAxis)
    return all(greaterThanEqual(hi, s.least)) && all(lessThanEqual(lo, s.most));
  vec3 d = max(max(lo - s.centre, s.centre - hi), vec3(0.0));
  return dot3(d, d) < s.reach;
}

// What triangles have told so far.
struct Told {
  uint of_class;  // by their planes: kClassUnseen if none was looked at
  int winding;
  bool is_sure;  // of the winding number
  uint count;    // of triangles that may be closest
};

uint face_of(uint triangle) {
  return triangles[kTriangleWords * min(triangle, push.triangle_count - 1u)].w;
}

Told told_by_crossing(Told told, CellFrame t, uint triangle, uint axis) {
  Crossing c = crossing_along(t, load_surface(triangle, cell_view(t)), axis);
  told.winding += c.winding;
  told.is_sure = told.is_sure && c.is_sure;
  return told;
}

Told told_by_plane(Told told, CellFrame t, uint triangle, Above above) {
  Surface s = load_surface(triangle, cell_view(t));
  uint kind = face_kinds[face_of(triangle)];
  if ((kind & kFaceCovered) != 0u || !may_be_closest(t, s, above, push.moved)) return told;
  ++told.count;
  told.of_class = told.count > kCellTriangles
                      ? kClassMany
                      : class_with(told.of_class, kind, side_of_cell(t, s, push.moved));
  return told;
}

bool is_open(Told told, Search s) {
  if (s.axis != kNoAxis) return told.is_sure;
  return told.of_class == kClassUnseen || has_side(told.of_class);
}

const uint kSideStack = 3u * kStackDepth / 2u + 1u;
uint waiting[kSideStack];

// Goes through all that a search may hold, unless a triangle makes it vain. Drivers may end a loop
// early (docs/certificate.md, 'Loops that a driver ends'): the loop's work is counted, and not by
// the variable that ends it, which compilers take as known behind it.
Told told_by(Search s, CellFrame t, Above above) {
  Told told = Told(kClassUnseen, 0, true, 0u);
  uint promised = 1u;
  uint done = 0u;
  uint left = 1u;
  waiting[0] = 0u;
  while (left > 0u && is_open(told, s)) {
    uint at = waiting[--left];
    ++done;
    if ((at & kLeafFlag) != 0u) {
      uint first = at & (kMaxTriangles - 1u);
      uint last = first + ((at >> 28) & 7u);
      promised += last - first + 1u;
      for (uint i = first; i <= last; ++i) {
        if (s.axis != kNoAxis) told = told_by_crossing(told, t, i, s.axis);
        if (s.axis == kNoAxis && is_open(told, s)) told = told_by_plane(told, t, i, above);
        ++done;
      }
      continue;
    }
    for (uint k = 0u; k < 4u; ++k) {
      uvec4 lo = nodes[kNodeWords * at + 2u * k];
      uvec4 hi = nodes[kNodeWords * at + 2u * k + 1u];
      if (!may_hold(s, uintBitsToFloat(lo.xyz), uintBitsToFloat(hi.xyz))) continue;
      waiting[left++] = lo.w;
      ++promised;
    }
  }
  if (!is_open(told, s)) return told;
  if (done != promised) return Told(kClassMany, 0, false, 0u);
  return told;
}

// The class by rays along the three axes; kClassUnseen: each meets an edge of B.
uint class_by_winding(CellFrame t) {
  for (uint axis = 0u; axis < 3u; ++axis) {
    Told told = told_by(search_along(t, axis), t, Above(vec3(0.0), 0.0));
    if (told.is_sure) return told.winding == push.front ? kClassOver : kClassUnder;
  }
  return kClassUnseen;
}

uint class_by_planes(CellFrame t, CellBounds b, bool off) {
  Above above = Above(vec3(b.upper_a, b.upper_b, b.upper_c), b.highest);
  uint found = told_by(search_near(t, b.highest), t, above).of_class;
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
  uint found = push.is_solid != 0u && !off ? kClassMeets : class_by_planes(t, b, off);
  if (push.is_solid != 0u && off && !has_side(found)) {
    uint by_winding = class_by_winding(t);
    found = by_winding == kClassUnseen ? found : by_winding;
  }
  classes[i] = found;
}
