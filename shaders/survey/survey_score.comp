// Scores all cells by the plan. In: cells, bounds, weights, plan. Out: keys, the bins of the
// cells' scores, and histogram, how many cells each bin has. A workgroup goes over many cells.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shaders/base/invocation.glsl"

layout(local_size_x = kGroupSize) in;
layout(scalar, binding = 0) readonly buffer Cells { Cell cells[]; };
layout(scalar, binding = 1) readonly buffer Bounds { CellBounds bounds[]; };
layout(scalar, binding = 2) readonly buffer Weights { Wide weights[]; };
layout(scalar, binding = 3) readonly buffer Plan { SurveyPlan plan; };
layout(scalar, binding = 4) writeonly buffer Keys { uint keys[]; };
layout(scalar, binding = 5) buffer Histogram { uint histogram[]; };
layout(scalar, push_constant) uniform PushBlock { SurveyPush push; };

#include "shaders/survey/score.h"

shared uint counts[kScoreBins];

// The cell's share of A's area.
float area_of(Cell cell, Bary3 at) {
  Wide w = weights[cell.face];
  float of_face = (float(w.high) * 4294967296.0 + float(w.low)) * plan.of_whole;
  return of_face * uintBitsToFloat((127u - halvings_of(at)) << 23);
}

float score_of(CellBounds of_cell) {
  bool is_open = plan.mean > 0.0 || plan.square > 0.0 || plan.open_count > 0u;
  if (!is_open) return 0.0;
  TallyBounds b = tally_bounds(of_cell);
  float score = 0.0;
  if (plan.mean > 0.0) score += plan.mean * mean_width(b);
  if (plan.square > 0.0) score += plan.square * square_width(b);
  for (uint i = 0u; i < plan.open_count; ++i)
    score += plan.shares[i] * undecided_share(b, plan.open[i]);
  return score;
}

float map_score(CellBounds b, float lowest) {
  if (plan.map_step == 0.0 || lowest > plan.map_most) return 0.0;
  return max(widest(b) - plan.map_step, 0.0);
}

uint key_of(uint i) {
  CellBounds b = bounds[i];
  float lowest = max(min(b.lower_a, min(b.lower_b, b.lower_c)), 0.0);
  if (b.highest - lowest <= kScoreFloor) return 0u;
  float score = score_of(b);
  float of_map = map_score(b, lowest);
  if (!(score > 0.0) && !(of_map > 0.0)) return 0u;
  Cell cell = cells[i];
  Bary3 at = unpack_corners(cell.corners);
  if (!has_quarters(at)) return 0u;
  float area = area_of(cell, at);
  if (area > plan.map_area) score += of_map;
  return score_bin(score * area);
}

void main() {
  uint lane = gl_LocalInvocationID.x;
  for (uint bin = lane; bin < kScoreBins; bin += kGroupSize) counts[bin] = 0u;
  barrier();
  uint stride = kGroupSize * push.groups;
  for (uint i = item_index(); i < push.cells; i += stride) {
    uint key = key_of(i);
    keys[i] = key;
    if (key > 0u) atomicAdd(counts[key], 1u);
  }
  barrier();
  for (uint bin = lane; bin < kScoreBins; bin += kGroupSize) {
    uint count = counts[bin];
    if (count > 0u) atomicAdd(histogram[bin], count);
  }
}
