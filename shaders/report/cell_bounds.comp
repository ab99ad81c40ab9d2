// Bounds d(x, B) over cells of A, one item per cell: sub-triangles of its faces; faces push.first
// and after; or a survey's new cells, of which wave tells the places. In: cells, wave; A and B's
// BVH. Out: bounds[cell], and of a survey's cell its start, near_corners, and its
// face's faces_reached, a float as bits. One traversal finds the triangle nearest to the cell's
// middle; another examines the triangles that may be closest somewhere on the cell (report/cell.h),
// at most kCellTriangles of them; boxes stand for the rest. Each result depends on its cell alone.
// If A or B is no mesh, or if there is no run (push.triangle_count is 0), bounds are NaN.
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
layout(scalar, binding = 6) readonly buffer VertexNearest { uint vertex_nearest[]; };
layout(scalar, binding = 7) buffer Cells { Cell cells[]; };
layout(scalar, binding = 8) buffer Bounds { CellBounds bounds[]; };
layout(scalar, binding = 9) readonly buffer BFault { uint b_fault; };
layout(scalar, binding = 10) readonly buffer Parents { uint parents[]; };
layout(scalar, binding = 11) buffer FacesReached { uint faces_reached[]; };
layout(scalar, binding = 12) readonly buffer WaveBlock { SurveyWave wave; };
layout(scalar, binding = 13) writeonly buffer NearCorners { CornerTriangles near_corners[]; };
layout(scalar, push_constant) uniform PushBlock { CellPush push; };

#include "shaders/base/root.glsl"
#include "shaders/report/cell_boxes.glsl"
#include "shaders/traversal/traversal.glsl"

// The place of an item. A survey's parts of one cell follow each other, since they look at the same
// triangles.
uint place_of(uint i) {
  if (push.given != kSurveyCells) return i;
  uint item = push.first + i;
  if (wave.parts <= 1u) return item;
  uint rank = item / wave.parts;
  uint part = item - rank * wave.parts;
  return part == 0u ? parents[rank] : wave.live + (wave.parts - 1u) * rank + part - 1u;
}

bool is_asked(uint i) {
  return i < push.count && (push.given != kSurveyCells || push.first + i < wave.fresh);
}

Cell cell_at(uint i) {
  if (push.given != kFacesOfA) {
    Cell c = cells[place_of(i)];
    c.face = min(c.face, push.face_count - 1u);
    return c;
  }
  uint face = min(push.first + i, push.face_count - 1u);
  return Cell(pack_corners(whole_root()), face, vertex_nearest[faces[face].x]);
}

// A distance that surely lies between the centre and a box at this distance, squared, or farther.
float box_distance_down(CellFrame t, float distance2) {
  float d = root(min(distance2, 1.0e37));
  return max(round_down(d, 8.0) - box_doubt(t, d), 0.0);
}

// Adds the triangles of a leaf.
Gathered with_leaf(Gathered g, CellFrame t, uint leaf, inout uint looked_at) {
  uint first = leaf & (kMaxTriangles - 1u);
  uint last = first + ((leaf >> 28) & 7u);
  for (uint i = first; i <= last; ++i) {
    g = gathered(g, t, load_surface(i, cell_view(t)), i);
    ++looked_at;
  }
  return g;
}

// Adds the boxes that are left.
Gathered with_boxes(Gathered g, CellFrame t, float reach, inout uint to_go) {
  for (uint k = 0u; k < left_count; ++k) {
    if (left_distance2[k] < reach) g = without(g, t, box_distance_down(t, left_distance2[k]));
    --to_go;
  }
  return g;
}

// Goes over all triangles that may be closest somewhere on the cell. Bounds from below need all
// that is within reach, and drivers may end a loop early (docs/certificate.md, 'Loops that a driver
// ends'): the loops' work is counted, and not by the variable that ends them, which compilers take
// as known behind them.
Gathered gather(CellFrame t, uint start) {
  Query middle = Query(t.origin, 0.0, false, false);
  if (start != kNone) start = min(start, push.triangle_count - 1u);
  uint nearest = min(nearest_triangle(middle, start).triangle, push.triangle_count - 1u);
  Gathered g = begin_gathering(t, load_surface(nearest, cell_view(t)), nearest);
  float reach = cell_reach(g.highest, t);
  uint not_leaves = 0u;
  uint found = 0u;
  uint looked_at = 0u;
  left_count = 0u;
  traversal_at = 0u;
  while (traversal_at != kNone && looked_at < kCellTriangles) {
    while ((traversal_at & kLeafFlag) == 0u)
      traversal_at = step_down(traversal_at, t.origin.hi, reach);
    if (traversal_at == kNone) break;
    not_leaves += 1u - (traversal_at >> 31);
    found += ((traversal_at >> 28) & 7u) + 1u;
    g = with_leaf(g, t, traversal_at, looked_at);
    reach = min(reach, cell_reach(g.highest, t));
    traversal_at = pop(reach);
  }
  if (traversal_at != kNone) ++left_count;  // the box taken from the top is left, too
  uint to_go = left_count;
  g = with_boxes(g, t, reach, to_go);
  if (not_leaves != 0u || looked_at != found || to_go != 0u) g = without(g, t, 0.0);
  return g;
}

// Adds the triangles nearest to the corners, two at a time, if they are not the same.
Gathered with_pairs(Gathered g, CellFrame t) {
  if (g.of_corners.x == kNone || g.of_corners.y == kNone || g.of_corners.z == kNone) return g;
  for (uint k = 0u; k < 3u; ++k) {
    uint i = choose(k == 2u, g.of_corners.y, g.of_corners.x);
    uint j = choose(k == 0u, g.of_corners.y, g.of_corners.z);
    if (i == j || (k == 2u && i == g.of_corners.x)) continue;
    Surface s = load_surface(i, cell_view(t));
    Surface r = load_surface(j, cell_view(t));
    g = cut_between(g, t, s, cell_distances(t, s), r, cell_distances(t, r));
  }
  return g;
}

// The face of B as given.
uint face_of(uint triangle) {
  return triangles[kTriangleWords * min(triangle, push.triangle_count - 1u)].w;
}

CellBounds bounds_of(Gathered g, CellFrame t) {
  vec3 lower = lower_of(g, t);
  CellBounds b;
  b.lower_a = lower.x;
  b.lower_b = lower.y;
  b.lower_c = lower.z;
  b.upper_a = g.upper.x;
  b.upper_b = g.upper.y;
  b.upper_c = g.upper.z;
  b.highest = g.highest;
  b.reached = reached_of(g);
  b.mean_upper = min(g.mean, g.highest);
  b.square_upper = g.square;
  b.face_a = face_of(g.of_corners.x);
  b.face_b = face_of(g.of_corners.y);
  b.face_c = face_of(g.of_corners.z);
  b.face = face_of(g.triangle);
  b.triangle = g.triangle;
  return b;
}

// Keeps the cell's highest, which is stored before: no distance over a part of the cell is above
// it.
CellBounds kept_bounds(CellBounds b, uint place, uint face) {
  b.highest = min(b.highest, bounds[place].highest);
  b.mean_upper = min(b.mean_upper, b.highest);
  cells[place].start = b.triangle;
  atomicMax(faces_reached[face], bits_of(b.reached));
  return b;
}

bool is_of_meshes() {
  return push.triangle_count != 0u && control.input_fault == kNone && b_fault == kNone;
}

CellBounds nothing_known() {
  float nan = uintBitsToFloat(0x7fc00000u);
  return CellBounds(nan, nan, nan, nan, nan, nan, nan, nan, nan, nan, kNone, kNone, kNone, kNone,
                    kNone);
}

void main() {
  uint i = item_index();
  if (!is_asked(i)) return;
  uint place = place_of(i);
  if (!is_of_meshes()) {
    bounds[place] = nothing_known();
    return;
  }
  Cell cell = cell_at(i);
  CellFrame t = make_cell(load_root(cell.face), unpack_corners(cell.corners));
  Gathered g = with_pairs(gather(t, cell.start), t);
  CellBounds found = bounds_of(g, t);
  if (push.given == kSurveyCells) {
    found = kept_bounds(found, place, cell.face);
    near_corners[place] = CornerTriangles(g.of_corners.x, g.of_corners.y, g.of_corners.z);
  }
  bounds[place] = found;
}
