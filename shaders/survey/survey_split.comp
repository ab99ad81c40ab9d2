// Splits the chosen cells into four: the first part takes the cell's place, the others follow the
// cells that there were, in the order of the cells that they come from. In: keys, blocks; A. Out:
// cells, bounds, with what is known of the parts; parents, the places of the first parts. A
// workgroup for each block.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shaders/base/invocation.glsl"

layout(local_size_x = kGroupSize) in;
layout(scalar, binding = 0) readonly buffer Vertices { Vertex vertices[]; };
layout(scalar, binding = 1) readonly buffer Faces { uvec3 faces[]; };
layout(scalar, binding = 2) buffer Cells { Cell cells[]; };
layout(scalar, binding = 3) buffer Bounds { CellBounds bounds[]; };
layout(scalar, binding = 4) readonly buffer Keys { uint keys[]; };
layout(scalar, binding = 5) readonly buffer Blocks { SurveyCounts blocks[]; };
layout(scalar, binding = 6) writeonly buffer Parents { uint parents[]; };
layout(scalar, push_constant) uniform PushBlock { SurveySplitPush push; };

#include "shaders/base/root.glsl"
#include "shaders/survey/chosen.glsl"
#include "shaders/survey/score.h"

shared uint above[kGroupSize];
shared uint ties[kGroupSize];

// Counts what is chosen before the invocation's cells.
SurveyCounts counts_before() {
  uint lane = gl_LocalInvocationID.x;
  SurveyCounts own = counts_of_lane();
  above[lane] = own.above;
  ties[lane] = own.ties;
  barrier();
  for (uint reach = 1u; reach < kGroupSize; reach *= 2u) {
    uint above_before = lane >= reach ? above[lane - reach] : 0u;
    uint ties_before = lane >= reach ? ties[lane - reach] : 0u;
    barrier();
    above[lane] += above_before;
    ties[lane] += ties_before;
    barrier();
  }
  SurveyCounts of_block = blocks[workgroup_index()];
  return SurveyCounts(of_block.above + above[lane] - own.above,
                      of_block.ties + ties[lane] - own.ties);
}

void split(uint i, uint rank) {
  Cell cell = cells[i];
  Bary3 at = unpack_corners(cell.corners);
  uint code = cell_split(load_root(cell.face), at);
  Bary6 points = split_points(at, code);
  CellBounds known = bounds_of_parts(bounds[i]);
  parents[rank] = i;
  for (uint k = 0u; k < 4u; ++k) {
    uint to = k == 0u ? i : push.cells + 3u * rank + k - 1u;
    cell.corners = pack_corners(child_of(points, child_points(code, k)));
    cells[to] = cell;
    bounds[to] = known;
  }
}

void main() {
  SurveyCounts before = counts_before();
  uint first = first_of_lane();
  for (uint k = 0u; k < kCellsOfLane; ++k) {
    uint i = first + k;
    if (is_above(i)) split(i, before.above++);
    if (is_tie(i) && before.ties < push.ties) split(i, push.above + before.ties);
    if (is_tie(i)) ++before.ties;
  }
}
