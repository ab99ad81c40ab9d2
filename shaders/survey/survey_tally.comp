// Adds up the figures of the cells of the plan's classes: areas within the plan's edges, means and
// mean squares. In: cells, bounds, classes, agreements, weights, plan. In and out: table. A
// workgroup goes over many cells.
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
layout(scalar, binding = 5) readonly buffer Classes { uint classes[]; };
layout(scalar, binding = 6) readonly buffer Agreements { CellAgreement agreements[]; };
layout(scalar, push_constant) uniform PushBlock { SurveyPush push; };

#include "shaders/survey/score.h"

shared float edges_down[kSurveyEdges];
shared float edges_up[kSurveyEdges];
shared uint sums_low[kSurveySums];
shared uint sums_high[kSurveySums];
shared uint highest, not_lowest, reached, not_far;

// Every addition that wraps the low word carries, so their order does not matter.
void add(uint at, uvec2 x) {
  uint before = atomicAdd(sums_low[at], x.x);
  uint carried = x.y + (before + x.x < before ? 1u : 0u);
  if (carried > 0u) atomicAdd(sums_high[at], carried);
}

// The first edge whose upper end is not below a distance.
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

// Visits the edges that cut the cell, and the first edge within which it lies entirely. An edge's
// lower end is not above its upper end: so none before the first is surely not below any point.
void add_within(TallyBounds b, CellWeight w) {
  bool is_surely_all = false, is_perhaps_all = false;
  for (uint k = first_up(b.below.least); k < plan.edge_count; ++k) {
    float down = edges_down[k];
    if (!is_surely_all && down >= b.above.least) {
      is_surely_all = down >= b.highest;
      add((is_surely_all ? kSurelyWhole : kSurelyPart) + k, part_down(w, surely_within(b, down)));
    }
    if (!is_perhaps_all) {
      float up = edges_up[k];
      is_perhaps_all = up >= b.below.most;
      add((is_perhaps_all ? kPerhapsWhole : kPerhapsPart) + k, part_up(w, perhaps_within(b, up)));
    }
    if (is_surely_all && is_perhaps_all) break;
  }
}

struct Moments {
  uvec2 mean_lower, mean_upper, square_lower, square_upper;
};

void add_moments(TallyBounds b, CellWeight w, inout Moments m) {
  m.mean_lower = wide_sum(m.mean_lower, weighed_down(w, mean_over_down(b.lower), push.unit));
  m.mean_upper = wide_sum(m.mean_upper, weighed_up(w, b.mean_upper, push.unit));
  m.square_lower =
      wide_sum(m.square_lower, weighed_down(w, square_over_down(b.lower), push.square_unit));
  m.square_upper = wide_sum(m.square_upper, weighed_up(w, b.square_upper, push.square_unit));
}

TallyBounds bounds_of(uint i) {
  TallyBounds b = tally_bounds(bounds[i]);
  if (plan.of_normals != 0u) return with_normals(b, agreements[i], classes[i]);
  return b;
}

void begin_sums() {
  uint lane = gl_LocalInvocationID.x;
  for (uint k = lane; k < kSurveySums; k += kGroupSize) sums_low[k] = sums_high[k] = 0u;
  for (uint k = lane; k < plan.edge_count; k += kGroupSize) {
    edges_down[k] = plan.edges[k].down;
    edges_up[k] = plan.edges[k].up;
  }
  if (lane == 0u) highest = not_lowest = reached = not_far = 0u;
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
    atomicMax(table.reached, reached);
    atomicMax(table.not_far, not_far);
  }
}

void main() {
  begin_sums();
  Moments sums;
  sums.mean_lower = sums.mean_upper = sums.square_lower = sums.square_upper = uvec2(0u);
  uint most = 0u, not_least = 0u, farthest = 0u, not_first = 0u;
  uint stride = kGroupSize * push.groups;
  for (uint i = push.first + item_index(); i < push.end; i += stride) {
    if (!is_among(classes[i], plan.classes)) continue;
    Cell cell = cells[i];
    Wide of_face = weights[cell.face];
    CellWeight w =
        cell_weight(uvec2(of_face.low, of_face.high), halvings_of(unpack_corners(cell.corners)));
    TallyBounds b = bounds_of(i);
    if (plan.moments != 0u) add_moments(within_most(b, plan.most), w, sums);
    most = max(most, bits_of(counts_to(b)));
    not_least = max(not_least, ~bits_of(counts_from(b)));
    farthest = max(farthest, bits_of(bounds[i].reached));
    if (bounds[i].reached >= plan.far) not_first = max(not_first, ~i);
    add_within(b, w);
  }
  atomicMax(highest, most);
  atomicMax(not_lowest, not_least);
  atomicMax(reached, farthest);
  atomicMax(not_far, not_first);
  if (plan.moments != 0u) {
    add(kMeanLower, sums.mean_lower);
    add(kMeanUpper, sums.mean_upper);
    add(kSquareLower, sums.square_lower);
    add(kSquareUpper, sums.square_upper);
  }
  end_sums();
}
