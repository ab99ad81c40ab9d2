// The cascade for some children at once, by a whole workgroup: which invocation owns each value,
// and how the distances are shared out. The workgroup has kGroupSize invocations. The kernel
// declares what base/surface.glsl, wave/child.glsl and wave/centroid.glsl need.
#ifndef VKH_SHADERS_WAVE_BOUND_GROUP_GLSL
#define VKH_SHADERS_WAVE_BOUND_GROUP_GLSL

#include "shaders/base/surface.glsl"
#include "shaders/wave/candidate.glsl"
#include "shaders/wave/child.glsl"
#include "shaders/wave/dispatch.glsl"

const uint kGroupChildren = kMostChildren;
#include "shaders/wave/known.glsl"

const uint kMostPairs = kMostKnown * (kMostKnown - 1u) / 2u;

// The children, as a struct of arrays: a subgroup reads one word of many children at once; an array
// of structs would conflict in shared-memory banks. The shared memory of a workgroup decides how
// many workgroups run at once: an H200 runs four of 10 KiB on each of its processors. With 8 KiB,
// which is enough if only the corners' triangles are known, bounds take a tenth less time.
const uint kHeldB = 0u;  // corners around the first
const uint kHeldC = 3u;
const uint kHeldOrigin = 6u;
const uint kHeldOriginLow = 9u;
const uint kHeldReach = 12u;
const uint kHeldSlack = 13u;
const uint kHeldWords = 14u;

shared float held[kHeldWords][kMostChildren];
shared uint upper_bits[kMostChildren];  // u so far
// Two uses in turn. While children are bounded: the bits of the distance of corner c of a child
// from its known triangle k, at 3 (kMostKnown * child + k) + c. After the cuts: the words of the
// plan (wave/plan_words.glsl), if this workgroup plans.
shared uint group_words[kMostChildren * kMostKnown * 3u];
// Two uses in turn. Phase 1: measurements, kMostKnown * child + k for triangle k of a child. Phase
// 2: pairs, (child * kMaxKnown + i) * kMaxKnown + j and, if pairs are measured in parts, behind
// them the bits of each pair's u3: then there are at most half as many children.
const uint kMostListed = kMostChildren * kMostPairs;  // kMostPairs >= kMostKnown
const uint kPairBits = kMostListed / 2u;
shared uint listed[kMostListed];
shared uint measure_count;
shared uint pair_count;

struct Verdict {
  float upper;
  uint by;  // kCull*
};

void begin_group() {
  if (gl_LocalInvocationID.x < kMostChildren) known_count[gl_LocalInvocationID.x] = 0u;
  if (gl_LocalInvocationID.x == 0u) {
    measure_count = 0u;
    pair_count = 0u;
  }
  barrier();
}

void hold_vector(uint word, uint child, vec3 v) {
  held[word][child] = v.x;
  held[word + 1u][child] = v.y;
  held[word + 2u][child] = v.z;
}

vec3 held_vector(uint word, uint child) {
  return vec3(held[word][child], held[word + 1u][child], held[word + 2u][child]);
}

View view_of_child(uint child) {
  LocalCorners p;
  p.origin = Two3(held_vector(kHeldOrigin, child), held_vector(kHeldOriginLow, child));
  p.reach = held[kHeldReach][child];
  return view_of(p, (kSwitches & kUseUncertified) != 0u);
}

Patch patch_of_child(uint child) {
  return make_patch(two(vec3(0.0)), two(held_vector(kHeldB, child)),
                    two(held_vector(kHeldC, child)));
}

// Measures in plain floats if their error is no more than `enough`.
Surface surface_of(uint child, uint k, float enough) {
  View view = view_of_child(child);
  view.enough = enough;
  return load_surface(known_to(child, k), view);
}

vec3 distances_of(uint child, uint k) {
  uint at = 3u * (child * kMostKnown + k);
  return uintBitsToFloat(uvec3(group_words[at], group_words[at + 1u], group_words[at + 2u]));
}

// Stores a child, after its known triangles.
void hold(uint child, Child c) {
  LocalCorners placed = without_low_parts(placed_corners(c.root, c.at));
  hold_vector(kHeldB, child, placed.b.hi);
  hold_vector(kHeldC, child, placed.c.hi);
  hold_vector(kHeldOrigin, child, placed.origin.hi);
  hold_vector(kHeldOriginLow, child, placed.origin.lo);
  held[kHeldReach][child] = placed.reach;
  held[kHeldSlack][child] = placed.slack;
  upper_bits[child] = bits_of(c.upper);
  uint first = atomicAdd(measure_count, known_count[child]);
  for (uint k = 0u; k < known_count[child]; ++k) listed[first + k] = child * kMostKnown + k;
}

// Measures every child's corners against its known triangles, marked; if `fine`, one invocation per
// corner.
void measure_corners(bool fine, float enough) {
  uint step = fine ? 3u : 1u;
  for (uint n = gl_LocalInvocationID.x; n < measure_count * step; n += kGroupSize) {
    uint at = listed[n / step];
    uint child = at / kMostKnown;
    Surface s = surface_of(child, at % kMostKnown, enough);
    for (uint corner = n % step; corner < 3u; corner += step) {
      Two3 p = two(vec3(0.0));
      if (corner == 1u) p = two(held_vector(kHeldB, child));
      if (corner == 2u) p = two(held_vector(kHeldC, child));
      group_words[3u * at + corner] = floatBitsToUint(corner_distance(p, s));
    }
  }
}

// The bounds from single triangles: u1, u2 and ha, and the exact case, ha of the only one.
Verdict bound_singly(uint child, float threshold) {
  Patch t = patch_of_child(child);
  float shift = held[kHeldSlack][child];
  vec3 own = vec3(3.0e38);
  float ha = 3.0e38;
  for (uint k = 0u; k < known_count[child]; ++k) {
    vec3 d = distances_of(child, k);
    own = min(own, d);
    ha = min(ha, kept_bound(bound_single(d), shift));
  }
  float u1 = kept_bound(bound_u1(t, own), shift);
  float u2 = kept_bound(bound_u2(t, own), shift);
  uint by = known_count[child] == 1u ? kCullExact
            : u1 <= threshold        ? kCullU1
            : u2 <= threshold        ? kCullU2
            : ha <= threshold        ? kCullHa
                                     : kCullLowerRaised;
  float upper = min(uintBitsToFloat(upper_bits[child]), min(ha, min(u1, u2)));
  upper_bits[child] = bits_of(upper);
  return Verdict(upper, by);
}

// Pairs of triangles that may bound a child better than `upper`, for measure_cuts: a pair cannot
// beat the better of its two distances at the worst corner. The choice must not depend on other
// pairs' results, or the bound would depend on their order.
void list_pairs(uint child, float upper, bool fine) {
  float shift = held[kHeldSlack][child];
  uint known = known_count[child];
  for (uint i = 1u; i < known; ++i) {
    vec3 di = distances_of(child, i);
    for (uint j = 0u; j < i; ++j) {
      vec3 dj = distances_of(child, j);
      float at_best = kept_bound(bound_nearer(di, dj), shift);
      if (cut_by(di - dj).none || at_best >= upper) continue;
      uint slot = atomicAdd(pair_count, 1u);
      listed[slot] = (child * kMaxKnown + i) * kMaxKnown + j;
      if (fine) listed[kPairBits + slot] = 0u;
    }
  }
}

uint child_of_pair(uint pair) { return pair / (kMaxKnown * kMaxKnown); }

// u3 of the listed pairs: two cuts, each against two surfaces; if `fine`, one invocation each.
void measure_cuts(bool fine, float enough) {
  uint step = fine ? 4u : 1u;
  for (uint n = gl_LocalInvocationID.x; n < pair_count * step; n += kGroupSize) {
    uint pair = listed[n / step];
    uint child = child_of_pair(pair);
    uint i = (pair / kMaxKnown) % kMaxKnown;
    uint j = pair % kMaxKnown;
    vec3 di = distances_of(child, i);
    vec3 dj = distances_of(child, j);
    Cut cut = cut_by(di - dj);
    vec3 side = from_cut(di, dj, control.base);
    Patch t = patch_of_child(child);
    View view = view_of_child(child);
    view.enough = enough;
    float u3 = bound_nearer(di, dj);
    Surface s;
    for (uint part = n % step; part < 4u; part += step) {
      if (fine || (part & 1u) == 0u) s = load_surface(known_to(child, part < 2u ? i : j), view);
      Two3 p = cut_point(t, cut, part & 1u, side);
      u3 = max(u3, surface_distance_up(p, s));
    }
    uint bits = bits_of(kept_bound(u3, held[kHeldSlack][child]));
    if (fine) {
      atomicMax(listed[kPairBits + n / step], bits);
    } else {
      atomicMin(upper_bits[child], bits);
    }
  }
}

// The joint result of the invocations of a pair.
void join_cuts() {
  for (uint n = gl_LocalInvocationID.x; n < pair_count; n += kGroupSize)
    atomicMin(upper_bits[child_of_pair(listed[n])], listed[kPairBits + n]);
}

Verdict bound_in_pairs(uint child, Verdict v) {
  float u3 = uintBitsToFloat(upper_bits[child]);
  return u3 < v.upper ? Verdict(u3, kCullU3) : v;
}

#endif
