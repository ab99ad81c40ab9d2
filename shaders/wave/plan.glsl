// The plan, which decides for a wave as a whole: adopts the last wave's witness, flips the
// frontier's halves, moves the base of distances, tests for the end, shares the room out between
// refined, deferred and newly admitted candidates, selects which ones are refined, and writes the
// sizes of the wave's dispatches. One workgroup does this, the last one of wave_bound or the one of
// wave_plan; most of it is done by one invocation. After the end it writes zeros, so that recorded
// waves cost empty dispatches only. A run that pauses for lack of room writes sizes with which only
// its next plan runs, so that it goes on once it has been moved. Invariant: deferred + 4 parents +
// roots <= capacity, or 16 parents if they are split twice, and their new points fit the stream of
// points; so no stream of the wave can overflow. The kernel declares `group_words`
// (wave/plan_words.glsl), `sizes`, and what wave/candidate.glsl needs.
#ifndef VKH_SHADERS_WAVE_PLAN_GLSL
#define VKH_SHADERS_WAVE_PLAN_GLSL

#include "shaders/wave/candidate.glsl"
#include "shaders/wave/adopt.glsl"
#include "shaders/wave/plan_words.glsl"
#include "shaders/wave/room.glsl"
#include "shaders/wave/schedule.glsl"
#include "shaders/wave/select.glsl"
#include "shaders/wave/sizes.glsl"

// The values that the wave has raised are read by atomics: the workgroups that raised them may be
// of this dispatch.
struct WaveEnd {
  uint open;            // children that are still open
  uint largest_open;    // the largest u of these, and of deferred candidates, as bits
  uint largest_closed;  // the largest u of everything closed so far
};

WaveEnd take_wave_end() {
  WaveEnd end;
  end.open = atomicExchange(control.count[kCountNext], 0u);
  end.largest_open = atomicExchange(control.maximum[kMaxNext], 0u);
  end.largest_closed = atomicOr(control.maximum[kMaxClosed], 0u);
  control.maximum[kMaxClosed] = end.largest_closed;
  return end;
}

// Adds the wave's work to the totals.
void close_wave(WaveEnd end) {
  if (control.wave == 0u) return;  // it was left to this plan
  uint w = (control.wave - 1u) % kMaxWaveRecords;
  uint candidates = child_count();
  uint queries = query_count();
  // A wave that measured its witness left the frontier as it was.
  uint open = control.measuring != 0u ? control.maximum[kMaxFrontier] : end.largest_open;
  float upper = uintBitsToFloat(max(open, max(end.largest_closed, control.maximum[kMaxLower])));
  control.waves[w] = WaveRecord(
      control.parents, candidates, queries, control.count[kCountSurvivors], control.deferred,
      control.base + uintBitsToFloat(control.maximum[kMaxLower]), control.base + upper);
  control.candidate_total += candidates;
  control.query_total += queries;
}

void flip(WaveEnd end) {
  control.parity = 1u - control.parity;
  control.count[kCountFrontier] = end.open;
  control.count[kCountSurvivors] = 0u;
  control.maximum[kMaxFrontier] = end.largest_open;
  control.peak_frontier = max(control.peak_frontier, end.open);
}

void rebase_maximum(uint which) {
  control.maximum[which] = bits_of(rebased(uintBitsToFloat(control.maximum[which])));
}

// The lower bound has risen so far above the base that an ulp of the difference matters: moves the
// base up to it, and everything kept above the old one with it. One wave then measures only the
// witness again (query.comp). The next wave moves the frontier as it reads it.
void move_base() {
  control.rebase_hi = 0.0;
  control.rebase_lo = 0.0;
  float above = uintBitsToFloat(control.maximum[kMaxLower]);
  if (!needs_sharp(above)) return;
  float from = control.base;
  control.base = from + base_under(above);
  Two by = two_sum(from, -control.base);
  control.rebase_hi = by.hi;
  control.rebase_lo = by.lo;
  control.tight = 1u;
  rebase_maximum(kMaxFrontier);
  rebase_maximum(kMaxClosed);
  rebase_maximum(kMaxSpilled);
  control.measuring = 1u;
  control.maximum[kMaxLower] = 0u;
  control.witness.distance = kUnmeasured;
}

// A candidate that is split once leaves at most four in its place. While more than the reserve is
// free, as many are refined as surely fit. Otherwise only one is, whose descendants fit the reserve
// (kReserve), so that the run always goes on.
void share_room() {
  uint held = control.count[kCountFrontier];
  uint capacity = control.capacity;
  uint room = capacity - held;
  uint parents = min(held, room > reserve() + 3u ? (room - reserve()) / 3u : 1u);
  control.parents = parents;
  control.deferred = held - parents;
  held = schedule(held, room);
  parents = control.parents;
  room = capacity - held;
  bool twice = control.deferred == 0u && may_split_twice(parents, room);
  control.split_twice = twice ? 1u : 0u;
  uint needed = (twice ? 15u : 3u) * parents;  // places besides the candidates' own
  uint roots = roots_to_admit(held, room - needed);
  control.roots = roots;
  control.root_cursor += roots;
}

// All that is left is within the tolerance: culling would find this with one more wave.
bool within_tolerance() {
  return control.root_cursor == control.face_count && control.count[kCountFrontier] > 0u &&
         uintBitsToFloat(control.maximum[kMaxFrontier]) <=
             cull_threshold(lower_with_this_wave(), true);
}

void end_if_done() {
  if (within_tolerance() && control.roots == 0u) {
    control.maximum[kMaxClosed] = max(control.maximum[kMaxClosed], control.maximum[kMaxFrontier]);
    control.status = status_decided();
    return;
  }
  if (control.parents + control.roots > 0u) return;
  if (control.count[kCountFrontier] > 0u) {
    control.maximum[kMaxSpilled] = max(control.maximum[kMaxSpilled], control.maximum[kMaxFrontier]);
    control.status = kStatusMemory;
  } else {
    control.status = status_decided();
  }
}

// A sample above the limit answers the question.
bool ends_beyond() {
  if (control.measuring != 0u) return false;
  if (!is_beyond_limit(uintBitsToFloat(control.maximum[kMaxLower]))) return false;
  control.status = kStatusBeyond;
  return true;
}

void refine_nothing() {
  control.sorted = 0u;
  control.split_twice = 0u;
  control.parents = 0u;
  control.deferred = 0u;
  control.roots = 0u;
}

// Whether the wave waits until the workspace has room for all of it.
void pause_if_short() {
  uint wanted = room_for_all(control.count[kCountFrontier]);
  bool is_short = control.pauses != 0u && wanted > control.capacity && !within_tolerance();
  control.wanted = is_short ? wanted : 0u;
}

void write_sizes() {
  bool running = control.status == kStatusRunning;
  uint parents = running ? control.parents : 0u;
  uint held = running ? parents + control.deferred : 0u;
  write_refine_sizes(parents, held, running ? control.count[kCountFrontier] : 0u);
  write_child_sizes(running ? child_count() : 0u, running);
  if (!running) return;
  control.count[kCountNext] = may_wait() ? control.deferred : 0u;
  control.count[kCountRefined] = 0u;
  control.count[kCountDeferred] = 0u;
  if (control.wanted == 0u) control.wave += 1u;
}

// Records a wave that ran.
void end_wave() {
  WaveEnd end = take_wave_end();
  close_wave(end);
  if (control.measuring != 0u) {
    control.measuring = 0u;
  } else {
    flip(end);
    move_base();
  }
}

void plan() {
  if ((kSwitches & kUseUncertified) != 0u) control.certified = 0u;
  if (control.status == kStatusRunning) {
    if (control.wanted == 0u) end_wave();
    bool ends = ends_beyond();
    if (control.measuring == 0u && !ends) pause_if_short();
    if (control.measuring != 0u || control.wanted != 0u || ends) {
      refine_nothing();
    } else {
      share_room();
      end_if_done();
    }
  }
  bool short_room = control.status == kStatusRunning && control.deferred > 0u && may_wait();
  group_words[kWordHeld] = short_room ? control.count[kCountFrontier] : 0u;
  group_words[kWordRoom] = control.parents;
  group_words[kWordReadFrom] = reading(0u);
  group_words[kWordLargest] = control.select_largest;
}

// Called by every invocation of the workgroup.
void plan_wave() {
  bool first = gl_LocalInvocationID.x == 0u;
  adopt_witness();
  if (first) plan();
  barrier();
  if (group_words[kWordHeld] > 0u) select_smallest();
  if (first) write_sizes();
}

#endif
