// Splits each chosen cell into two or four: the first part takes its place, the others follow the
// cells that there were, in the order of the cells that they come from. In: parents, wave; A. Out:
// cells, bounds, classes, with what is known of the parts. An invocation for each chosen cell.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shaders/base/invocation.glsl"

layout(local_size_x = kGroupSize) in;
layout(scalar, binding = 0) readonly buffer Vertices { Vertex vertices[]; };
layout(scalar, binding = 1) readonly buffer Faces { uvec3 faces[]; };
layout(scalar, binding = 2) buffer Cells { Cell cells[]; };
layout(scalar, binding = 3) buffer Bounds { CellBounds bounds[]; };
layout(scalar, binding = 4) readonly buffer Parents { uint parents[]; };
layout(scalar, binding = 5) buffer Classes { uint classes[]; };
layout(scalar, binding = 6) readonly buffer WaveBlock { SurveyWave wave; };

#include "shaders/base/root.glsl"
#include "shaders/survey/score.h"

void main() {
  uint rank = item_index();
  if (rank >= wave.above + wave.ties) return;
  uint i = parents[rank];
  Cell cell = cells[i];
  Bary3 at = unpack_corners(cell.corners);
  uint code = cell_split(load_root(cell.face), at);
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
