// Splits each chosen cell into two or four (report/split.h): the first part takes its place, the
// others follow the cells that there were, in the order of the cells that they come from. In:
// parents, near_corners, wave; A and B. Out: cells, bounds, classes, with what is known of the
// parts. An invocation for each chosen cell.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shaders/base/invocation.glsl"

layout(local_size_x = kGroupSize) in;
layout(scalar, binding = 0) readonly buffer ControlBlock { Control control; };
layout(scalar, binding = 1) readonly buffer Triangles { uvec4 triangles[]; };
layout(scalar, binding = 2) readonly buffer TriangleLows { TriangleLow triangle_lows[]; };
layout(scalar, binding = 3) readonly buffer Vertices { Vertex vertices[]; };
layout(scalar, binding = 4) readonly buffer Faces { uvec3 faces[]; };
layout(scalar, binding = 5) buffer Cells { Cell cells[]; };
layout(scalar, binding = 6) buffer Bounds { CellBounds bounds[]; };
layout(scalar, binding = 7) readonly buffer Parents { uint parents[]; };
layout(scalar, binding = 8) buffer Classes { uint classes[]; };
layout(scalar, binding = 9) readonly buffer NearCorners { CornerTriangles near_corners[]; };
layout(scalar, binding = 10) readonly buffer WaveBlock { SurveyWave wave; };

#include "shaders/base/root.glsl"
#include "shaders/base/surface.glsl"
#include "shaders/report/split.h"
#include "shaders/survey/score.h"

// Three points' distances from four triangles.
Distances distances_of(Corners at, CellFrame t, uvec4 of) {
  Distances d;
  for (uint k = 0u; k < 4u; ++k)
    d.from[k] = distances_from(load_surface(of[k], cell_view(t)), at, t);
  return d;
}

// The code of a cell's split. Where no triangle is known, or nothing is to gain, its longest edges
// are halved.
uint split_for(CellFrame t, CornerTriangles corners, CellBounds b) {
  uvec4 of = uvec4(corners.a, corners.b, corners.c, b.triangle);
  bool is_known = max3(upper_of(b) - lower_of(b)) < kLeastGain;
  if (is_known || any(equal(of, uvec4(kNone)))) return split_as_shaped(t.at);
  Distances at_corners = distances_of(t.at, t, of);
  Distances at_middles = distances_of(middles_of(t.at), t, of);
  uint x = edge_to_halve(t.at, at_corners, at_middles);
  return split_from(x, t.at, at_corners, at_middles, distances_of(fresh_middles(t.at, x), t, of));
}

void main() {
  uint rank = item_index();
  if (rank >= wave.above + wave.ties) return;
  uint i = parents[rank];
  Cell cell = cells[i];
  Bary3 at = unpack_corners(cell.corners);
  uint code = split_for(make_cell(load_root(cell.face), at), near_corners[i], bounds[i]);
  Bary6 points = split_points(at, code);
  CellBounds known = bounds_of_parts(bounds[i]);
  uint of_class = class_of_parts(classes[i]);
  for (uint k = 0u; k < wave.parts; ++k) {
    uint to = k == 0u ? i : wave.live + (wave.parts - 1u) * rank + k - 1u;
    uvec3 part = wave.parts == 2u ? half_points(code, k) : child_points(code, k);
    cell.corners = pack_corners(child_of(points, part));
    cells[to] = cell;
    bounds[to] = known;
    classes[to] = of_class;
  }
}
