// Scores cells by the plan. In: A, cells, bounds, classes, agreements, weights, faces_reached
// (floats as bits), plan, wave. Out: keys, the bins of the cells' scores, and histogram, the number
// of cells in each bin; bin 0 counts the cells that keep their face open although no split helps. A
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
layout(scalar, binding = 4) writeonly buffer Keys { uint keys[]; };
layout(scalar, binding = 5) buffer Histogram { uint histogram[]; };
layout(scalar, binding = 6) readonly buffer FacesReached { uint faces_reached[]; };
layout(scalar, binding = 7) readonly buffer Classes { uint classes[]; };
layout(scalar, binding = 8) readonly buffer Agreements { CellAgreement agreements[]; };
layout(scalar, binding = 9) readonly buffer WaveBlock { SurveyWave wave; };
layout(scalar, binding = 10) readonly buffer Vertices { Vertex vertices[]; };
layout(scalar, binding = 11) readonly buffer Faces { uvec3 faces[]; };
layout(scalar, push_constant) uniform PushBlock { SurveyPush push; };

#include "shaders/base/root.glsl"
#include "shaders/survey/score.h"

shared uint counts[kScoreBins];

TallyBounds bounds_of(uint i, CellBounds of_cell, uint of_class) {
  TallyBounds b = tally_bounds(of_cell);
  if (plan.of_normals != 0u) return with_normals(b, agreements[i], of_class);
  return b;
}

float score_of(uint i, CellBounds of_cell, uint of_class) {
  bool is_open = plan.mean > 0.0 || plan.square > 0.0 || plan.open_count > 0u;
  if (!is_open) return 0.0;
  TallyBounds b = bounds_of(i, of_cell, of_class);
  float score = 0.0;
  TallyBounds kept = within_most(b, plan.most);
  if (plan.mean > 0.0 && is_among(of_class, plan.mean_classes)) {
    bool is_either = is_among(of_class, plan.either_side);
    score += plan.mean * (is_either ? either_width(kept) : mean_width(kept));
  }
  if (plan.square > 0.0) score += plan.square * square_width(kept);
  for (uint i = 0u; i < plan.open_count; ++i) {
    if (is_among(of_class, plan.open_classes[i]))
      score += plan.shares[i] * undecided_share(b, plan.open[i]);
  }
  return score;
}

float score_for_face(uint i, float highest, uint of_class) {
  if (plan.faces == 0u) return 0.0;
  return face_score(highest, uintBitsToFloat(faces_reached[cells[i].face]), plan.face_tolerance,
                    plan.face_within[side_index(of_class)], plan.face_beyond);
}

bool is_seen(Cell cell, Bary3 at, float area) {
  return area > plan.map_area ||
         is_longer(plain_corners(load_root(cell.face), at), plan.map_length);
}

struct Key {
  uint bin;
  bool is_stuck;  // it keeps its face open, and no split helps
};

Key key_of(uint i) {
  CellBounds b = bounds[i];
  uint of_class = classes[i];
  float of_face = score_for_face(i, b.highest, of_class);
  Key none = Key(0u, of_face > 0.0);
  bool is_known = b.highest - lowest_of(b) <= kScoreFloor;
  if (is_known && plan.of_normals == 0u) return none;
  float score = score_of(i, b, of_class);
  float of_map = map_score(b, plan.map_step, plan.map_most);
  if (!(score > 0.0) && !(of_map > 0.0) && !(of_face > 0.0)) return none;
  Cell cell = cells[i];
  Bary3 at = unpack_corners(cell.corners);
  if (!has_quarters(at)) return none;
  float area = share_of_area(weights[cell.face], plan.of_whole, at);
  if (of_map > 0.0 && is_seen(cell, at, area)) score += of_map;
  return Key(score_bin(score * area + of_face), false);
}

void main() {
  uint lane = gl_LocalInvocationID.x;
  for (uint bin = lane; bin < kScoreBins; bin += kGroupSize) counts[bin] = 0u;
  barrier();
  uint stride = kGroupSize * push.groups;
  uint end = min(push.end, wave.cells);
  for (uint i = push.first + item_index(); i < end; i += stride) {
    Key key = key_of(i);
    keys[i] = key.bin;
    if (key.bin > 0u || key.is_stuck) atomicAdd(counts[key.bin], 1u);
  }
  barrier();
  for (uint bin = lane; bin < kScoreBins; bin += kGroupSize) {
    uint count = counts[bin];
    if (count > 0u) atomicAdd(histogram[bin], count);
  }
}
