// Decides which cells a wave splits: all with a key above wave.key, and the first wave.ties cells
// with this key. The kernel declares `keys`, `wave`.
#ifndef VKH_SHADERS_SURVEY_CHOSEN_GLSL
#define VKH_SHADERS_SURVEY_CHOSEN_GLSL

// Cells of a block that an invocation looks at, one after the other.
const uint kCellsOfLane = kSurveyBlock / kGroupSize;

uint first_of_lane() {
  return workgroup_index() * kSurveyBlock + gl_LocalInvocationID.x * kCellsOfLane;
}

bool is_above(uint i) { return i < wave.live && keys[i] > wave.key; }
bool is_tie(uint i) { return i < wave.live && keys[i] == wave.key; }

SurveyCounts counts_of_lane() {
  uint first = first_of_lane();
  SurveyCounts n = SurveyCounts(0u, 0u);
  for (uint k = 0u; k < kCellsOfLane; ++k) {
    n.above += is_above(first + k) ? 1u : 0u;
    n.ties += is_tie(first + k) ? 1u : 0u;
  }
  return n;
}

#endif
