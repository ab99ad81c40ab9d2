// Selects the candidates that a wave refines if there is no room for all: the candidates with the
// smallest keys (wave/candidate.glsl), by digits of 8 bits from the top. The selection may stop as
// soon as at least half of the room is used. The workgroup has kGroupSize invocations. The kernel
// declares `group_words`, and what wave/candidate.glsl needs.
#ifndef VKH_SHADERS_WAVE_SELECT_GLSL
#define VKH_SHADERS_WAVE_SELECT_GLSL

#include "shaders/wave/candidate.glsl"
#include "shaders/wave/plan_words.glsl"

const uint kAtOnce = 8u;  // candidates of an invocation that are loaded together

uint digit_of(Key k, uint d) {
  return ((d < 4u ? k.first : k.second) >> (24u - 8u * (d & 3u))) & 255u;
}

Key prefix() { return Key(group_words[kWordPrefix], group_words[kWordPrefix + 1u]); }

bool has_prefix(Key k, uint decided) {
  for (uint d = 0u; d < decided; ++d) {
    if (digit_of(k, d) != digit_of(prefix(), d)) return false;
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

// Counts by the first word of a key, u. Only that is loaded, for several candidates at once, since
// one workgroup goes over all of them.
void count_first_digits(uint decided) {
  uint shift = 24u - 8u * decided;
  uint held = group_words[kWordHeld];
  bool largest = group_words[kWordLargest] != 0u;
  for (uint start = gl_LocalInvocationID.x; start < held; start += kAtOnce * kGroupSize) {
    uint first[kAtOnce];
    for (uint n = 0u; n < kAtOnce; ++n) {
      uint i = min(start + n * kGroupSize, held - 1u);
      first[n] = first_of_key(frontier[group_words[kWordReadFrom] + i].upper, largest);
    }
    for (uint n = 0u; n < kAtOnce; ++n) {
      bool counts = start + n * kGroupSize < held && has_prefix(Key(first[n], 0u), decided);
      if (counts) atomicAdd(group_words[(first[n] >> shift) & 255u], 1u);
    }
  }
}

// Counts the candidates with the same u, which are few.
void count_last_digits(uint decided) {
  bool largest = group_words[kWordLargest] != 0u;
  for (uint i = gl_LocalInvocationID.x; i < group_words[kWordHeld]; i += kGroupSize) {
    Candidate c = frontier[group_words[kWordReadFrom] + i];
    if (!has_prefix(Key(first_of_key(c.upper, largest), 0u), 4u)) continue;
    Key k = key_of(c, largest);
    if (has_prefix(k, decided)) atomicAdd(group_words[digit_of(k, decided)], 1u);
  }
}

void count_digits() {
  uint lane = gl_LocalInvocationID.x;
  for (uint i = lane; i < kSelectDigits; i += kGroupSize) group_words[i] = 0u;
  barrier();
  uint decided = group_words[kWordDecided];
  if (decided < 4u) {
    count_first_digits(decided);
  } else {
    count_last_digits(decided);
  }
  barrier();
}

// Goes on with the first digit whose keys do not all fit the room, or stops under it.
void narrow() {
  uint room = group_words[kWordRoom];
  uint before = group_words[kWordBefore];
  uint decided = group_words[kWordDecided];
  Key last = prefix();
  uint digit = 0u;
  while (digit < kSelectDigits - 1u && before + group_words[digit] <= room) {
    before += group_words[digit];
    ++digit;
  }
  with_digit(last, decided, digit);
  ++decided;
  bool all_fit = before + group_words[digit] <= room;
  if (all_fit) before += group_words[digit];
  bool goes_on = !all_fit && 2u * before < room + 1u && decided < 8u;
  group_words[kWordSelecting] = goes_on ? 1u : 0u;
  group_words[kWordPrefix] = last.first;
  group_words[kWordPrefix + 1u] = last.second;
  group_words[kWordBefore] = before;
  group_words[kWordDecided] = decided;
  if (goes_on) return;
  // The largest of the keys under the prefix, which were counted, or the prefix itself if it was,
  // too.
  for (uint d = decided; d < 8u; ++d) with_digit(last, d, all_fit ? 255u : 0u);
  control.select_key = last.first;
  control.select_tie = last.second;
  if (!all_fit && before > 0u) {
    control.select_tie = last.second - 1u;
    if (last.second == 0u) control.select_key = last.first - 1u;
  }
  uint refined = max(before, 1u);
  control.deferred += room - refined;
  control.parents = refined;
}

// Called by every invocation, after the first has set kWordHeld, kWordRoom, kWordReadFrom and
// kWordLargest.
void select_smallest() {
  bool first = gl_LocalInvocationID.x == 0u;
  if (first) {
    group_words[kWordPrefix] = 0u;
    group_words[kWordPrefix + 1u] = 0u;
    group_words[kWordDecided] = 0u;
    group_words[kWordBefore] = 0u;
    group_words[kWordSelecting] = 1u;
  }
  barrier();
  while (group_words[kWordSelecting] != 0u) {
    count_digits();
    if (first) narrow();
    barrier();
  }
}

#endif
