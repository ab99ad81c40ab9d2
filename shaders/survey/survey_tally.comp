// Adds up what all cells tell of A: areas within the plan's edges, means and mean squares. In:
// cells, bounds, weights, plan. Out: table, to which is added. A workgroup goes over many cells.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shaders/base/invocation.glsl"

layout(local_size_x = kGroupSize) in;
layout(scalar, binding = 0) readonly buffer Cells { Cell cells[]; };
layout(scalar, binding = 1) readonly buffer Bounds { CellBounds bounds[]; };
layout(scalar, binding = 2) readonly buffer Weights { Wide weights[]; };
layout(scalar, binding = 3) readonly buffer Plan { SurveyPlan plan; };
layout(scalar, binding = 4) buffer Table { SurveyTable table; };
layout(scalar, push_constant) uniform PushBlock { SurveyPush push; };

#include "shaders/survey/tally.h"

shared float edges_down[kSurveyEdges];
shared float edges_up[kSurveyEdges];
shared uint sums_low[kSurveySums];
shared uint sums_high[kSurveySums];
shared uint highest, not_lowest;

// Every addition that wraps the low word carries, whatever their order.
void add(uint at, uvec2 x) {
  uint before = atomicAdd(sums_low[at], x.x);
  uint carried = x.y + (before + x.x < before ? 1u : 0u);
  if (carried > 0u) atomicAdd(sums_high[at], carried);
}

// The first edge that is not below a distance.
uint first_down(float distance) {
  uint from = 0u;
  uint to = plan.edge_count;
  while (from < to) {
    uint middle = (from + to) / 2u;
    bool is_behind = edges_down[middle] < distance;
    from = is_behind ? middle + 1u : from;
    to = is_behind ? to : middle;
  }
  return from;
}
uint first_up(float distance) {
  uint from = 0u;
  uint to = plan.edge_count;
  while (from < to) {
    uint middle = (from + to) / 2u;
    bool is_behind = edges_up[middle] < distance;
    from = is_behind ? middle + 1u : from;
    to = is_behind ? to : middle;
  }
  return from;
}

void add_within(TallyBounds b, CellWeight w) {
  uint whole = first_down(b.highest);
  for (uint k = first_down(b.above.least); k < whole; ++k)
    add(kSurelyPart + k, share_down(w, surely_within(b, edges_down[k])));
  if (whole < plan.edge_count) add(kSurelyWhole + whole, w.down);
  whole = first_up(b.below.most);
  for (uint k = first_up(b.below.least); k < whole; ++k)
    add(kPerhapsPart + k, share_up(w, perhaps_within(b, edges_up[k])));
  if (whole < plan.edge_count) add(kPerhapsWhole + whole, w.up);
}

void begin_sums() {
  uint lane = gl_LocalInvocationID.x;
  for (uint k = lane; k < kSurveySums; k += kGroupSize) sums_low[k] = sums_high[k] = 0u;
  for (uint k = lane; k < plan.edge_count; k += kGroupSize) {
    edges_down[k] = plan.edges[k].down;
    edges_up[k] = plan.edges[k].up;
  }
  if (lane == 0u) highest = not_lowest = 0u;
  barrier();
}

void add_to_table(uint at) {
  uint low = sums_low[at];
  uint before = atomicAdd(table.sums[at].low, low);
  uint carried = sums_high[at] + (before + low < before ? 1u : 0u);
  if (carried > 0u) atomicAdd(table.sums[at].high, carried);
}

void end_sums() {
  barrier();
  for (uint k = gl_LocalInvocationID.x; k < kSurveySums; k += kGroupSize) {
    if ((sums_low[k] | sums_high[k]) != 0u) add_to_table(k);
  }
  if (gl_LocalInvocationID.x == 0u) {
    atomicMax(table.highest, highest);
    atomicMax(table.not_lowest, not_lowest);
  }
}

void main() {
  begin_sums();
  uvec2 mean_lower = uvec2(0u), mean_upper = uvec2(0u);
  uvec2 square_lower = uvec2(0u), square_upper = uvec2(0u);
  uint stride = kGroupSize * push.groups;
  for (uint i = item_index(); i < push.cells; i += stride) {
    Cell cell = cells[i];
    Wide of_face = weights[cell.face];
    CellWeight w =
        cell_weight(uvec2(of_face.low, of_face.high), halvings_of(unpack_corners(cell.corners)));
    TallyBounds b = tally_bounds(bounds[i]);
    mean_lower = wide_sum(mean_lower, weighed_down(w, mean_over_down(b.lower), push.unit));
    mean_upper = wide_sum(mean_upper, weighed_up(w, b.mean_upper, push.unit));
    square_lower =
        wide_sum(square_lower, weighed_down(w, square_over_down(b.lower), push.square_unit));
    square_upper = wide_sum(square_upper, weighed_up(w, b.square_upper, push.square_unit));
    atomicMax(highest, bits_of(b.highest));
    atomicMax(not_lowest, ~bits_of(lowest_of(b)));
    add_within(b, w);
  }
  add(kMeanLower, mean_lower);
  add(kMeanUpper, mean_upper);
  add(kSquareLower, square_lower);
  add(kSquareUpper, square_upper);
  end_sums();
}
