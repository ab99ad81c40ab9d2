// The selection of the candidates that a wave refines where there is no room for all: those with
// the smallest keys (lib/candidate.glsl), by digits of 8 bits from the top. A boundary that leaves
// at least half of the room used will do. Include after `control` and `frontier` are declared and
// lib/candidate.glsl is included; the workgroup has kPlanGroup invocations.
#ifndef VKH_SHADERS_LIB_SELECT_GLSL
#define VKH_SHADERS_LIB_SELECT_GLSL

shared uint histogram[256];
shared Key prefix;    // of the keys that are still undecided
shared uint decided;  // digits of it
shared uint before;   // keys under it
shared bool selecting;
shared uint read_from;           // where the half of the frontier that the wave reads starts
shared bool largest_first;       // control.select_largest
shared uint room_for;            // candidates that can be refined
shared uint held_in_short_room;  // candidates, where not all can be refined

uint digit_of(Key k, uint d) {
  return ((d < 4u ? k.first : k.second) >> (24u - 8u * (d & 3u))) & 255u;
}

bool has_prefix(Key k) {
  for (uint d = 0u; d < decided; ++d) {
    if (digit_of(k, d) != digit_of(prefix, d)) return false;
  }
  return true;
}

void with_digit(inout Key k, uint d, uint value) {
  uint shift = 24u - 8u * (d & 3u);
  if (d < 4u) {
    k.first = (k.first & ~(255u << shift)) | (value << shift);
  } else {
    k.second = (k.second & ~(255u << shift)) | (value << shift);
  }
}

void count_digits(uint held) {
  uint lane = gl_LocalInvocationID.x;
  histogram[lane] = 0u;
  barrier();
  for (uint i = lane; i < held; i += kPlanGroup) {
    Key k = key_of(frontier[read_from + i], largest_first);
    if (has_prefix(k)) atomicAdd(histogram[digit_of(k, decided)], 1u);
  }
  barrier();
}

// Goes on with the first digit whose keys do not all fit `room`, or stops under it.
void narrow(uint room) {
  uint digit = 0u;
  while (digit < 255u && before + histogram[digit] <= room) {
    before += histogram[digit];
    ++digit;
  }
  with_digit(prefix, decided, digit);
  ++decided;
  bool all_fit = before + histogram[digit] <= room;
  if (all_fit) before += histogram[digit];
  selecting = !all_fit && 2u * before < room + 1u && decided < 8u;
  if (selecting) return;
  // Keys under the prefix were counted: the largest of them, or the prefix itself if it was, too.
  for (uint d = decided; d < 8u; ++d) with_digit(prefix, d, all_fit ? 255u : 0u);
  control.select_key = prefix.first;
  control.select_tie = prefix.second;
  if (!all_fit && before > 0u) {
    control.select_tie = prefix.second - 1u;
    if (prefix.second == 0u) control.select_key = prefix.first - 1u;
  }
  uint refined = max(before, 1u);
  control.deferred += room_for - refined;
  control.parents = refined;
}

void select_smallest(uint held) {
  if (gl_LocalInvocationID.x == 0u) {
    prefix = Key(0u, 0u);
    decided = 0u;
    before = 0u;
    selecting = true;
  }
  barrier();
  while (selecting) {
    count_digits(held);
    if (gl_LocalInvocationID.x == 0u) narrow(room_for);
    barrier();
  }
}

#endif
