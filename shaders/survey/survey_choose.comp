// Chooses what a wave splits into four: the cells of the highest bins, as many as there is room
// for. The last bin may not fit whole; its first cells are taken. In: histogram. In and out: wave.
// One workgroup.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shaders/gpu_types.h"

layout(local_size_x = kSortGroup) in;
layout(scalar, binding = 0) readonly buffer ControlBlock { Control control; };
layout(scalar, binding = 1) readonly buffer BFault { uint b_fault; };
layout(scalar, binding = 2) readonly buffer Histogram { uint histogram[]; };
layout(scalar, binding = 3) buffer WaveBlock { SurveyWave wave; };
layout(scalar, push_constant) uniform PushBlock { SurveyChoosePush push; };

const uint kBinsOfLane = kScoreBins / kSortGroup;

shared uint counts[kSortGroup];
shared uint key, above, ties;

// The bins that score, from the highest one down: bin 0 counts cells that no split helps.
uint bin_at(uint place) { return kScoreBins - 1u - place; }
uint open_at(uint place) { return bin_at(place) == 0u ? 0u : histogram[bin_at(place)]; }

// Counts the cells of the lane's bins, and returns the number of cells of the lanes before it.
uint count_before(uint lane) {
  uint own = 0u;
  for (uint k = 0u; k < kBinsOfLane; ++k) own += open_at(lane * kBinsOfLane + k);
  counts[lane] = own;
  barrier();
  for (uint reach = 1u; reach < kSortGroup; reach *= 2u) {
    uint before = lane >= reach ? counts[lane - reach] : 0u;
    barrier();
    counts[lane] += before;
    barrier();
  }
  return counts[lane] - own;
}

// The one bin that does not fit whole is found by the invocation that counts it.
void find_last_bin(uint lane, uint before, uint room) {
  uint sum = before;
  for (uint k = 0u; k < kBinsOfLane; ++k) {
    uint place = lane * kBinsOfLane + k;
    uint here = open_at(place);
    if (sum <= room && sum + here > room) {
      key = bin_at(place);
      above = sum;
      ties = room - sum;
    }
    sum += here;
  }
}

uint status_of(uint open, uint room) {
  if (control.input_fault != kNone || b_fault != kNone) return kStatusInput;
  if (open > 0u) return room > 0u ? kStatusRunning : kStatusMemory;
  return histogram[0] > 0u ? kStatusPrecision : kStatusDecided;
}

void main() {
  uint lane = gl_LocalInvocationID.x;
  uint before = count_before(lane);
  uint open = counts[kSortGroup - 1u];
  uint cells = wave.cells;
  uint room = min(push.most, (push.capacity - min(cells, push.capacity)) / 3u);
  uint status = status_of(open, room);
  if (push.splits == 0u || status != kStatusRunning) room = 0u;
  if (lane == 0u) {
    key = 0u;  // all that score
    above = open;
    ties = 0u;
  }
  barrier();
  find_last_bin(lane, before, room);
  barrier();
  if (lane > 0u) return;
  uint chosen = above + ties;
  uint waves = wave.waves + (chosen > 0u ? 1u : 0u);
  wave = SurveyWave(status, waves, cells + 3u * chosen, open, cells, key, ties, above, 4u,
                    4u * chosen);
}
