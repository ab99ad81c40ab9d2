// The cascade for some children at once, by a whole workgroup: who holds what, and how the
// distances are shared out. Include after lib/surface.glsl, lib/candidate.glsl and lib/child.glsl;
// kSwitches is declared, the workgroup has kGroupSize invocations.
#ifndef VKH_SHADERS_LIB_BOUND_GROUP_GLSL
#define VKH_SHADERS_LIB_BOUND_GROUP_GLSL

const uint kKnowers = kMostChildren;
#include "shaders/lib/known.glsl"

const uint kMostPairs = kMostKnown * (kMostKnown - 1u) / 2u;  // uncertified: integers

// A child as all invocations need it, each word beside the same one of other children: invocations
// of a subgroup read those at once, and as structs they would be in few of the banks of shared
// memory. With it, 13 KiB of that at most.
const uint kHeldB = 0u;  // corners around the first
const uint kHeldC = 6u;
const uint kHeldOrigin = 12u;
const uint kHeldReach = 18u;
const uint kHeldSlack = 19u;
const uint kHeldUpper = 20u;  // u so far
const uint kHeldWords = 21u;

shared float held[kHeldWords][kMostChildren];
shared uint first_pair[kMostChildren];
shared uint pairs_of[kMostChildren];
shared float corner_distance[kMostChildren * kMostKnown * 3u];
shared uint measures[kMostChildren * kMostKnown];  // kMostKnown * child + k: triangle k of a child
shared uint measure_count;
shared uint pairs[kMostChildren * kMostPairs];  // (child * kMaxKnown + i) * kMaxKnown + j
shared uint pair_bits[kMostChildren * kMostPairs];
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

void hold_point(uint word, uint child, Two3 p) {
  held[word][child] = p.hi.x;
  held[word + 1u][child] = p.hi.y;
  held[word + 2u][child] = p.hi.z;
  held[word + 3u][child] = p.lo.x;
  held[word + 4u][child] = p.lo.y;
  held[word + 5u][child] = p.lo.z;
}

Two3 held_point(uint word, uint child) {
  return Two3(vec3(held[word][child], held[word + 1u][child], held[word + 2u][child]),
              vec3(held[word + 3u][child], held[word + 4u][child], held[word + 5u][child]));
}

View view_of_child(uint child) {
  Placement p;
  p.origin = held_point(kHeldOrigin, child);
  p.reach = held[kHeldReach][child];
  return view_of(p, (kSwitches & kUseCertificate) == 0u);
}

Patch patch_of_child(uint child) {
  return make_patch(two(vec3(0.0)), held_point(kHeldB, child), held_point(kHeldC, child));
}

Surface surface_of(uint child, uint k) {
  return load_surface(known_to(child, k), view_of_child(child));
}

vec3 distances_of(uint child, uint k) {
  uint at = 3u * (child * kMostKnown + k);
  return vec3(corner_distance[at], corner_distance[at + 1u], corner_distance[at + 2u]);
}

// Of a child whose known triangles are there already.
void hold(uint child, Child c) {
  Placement placed = place_corners(load_root(c.root), c.at);
  hold_point(kHeldB, child, placed.b);
  hold_point(kHeldC, child, placed.c);
  hold_point(kHeldOrigin, child, placed.origin);
  held[kHeldReach][child] = placed.reach;
  held[kHeldSlack][child] = placed.slack;
  held[kHeldUpper][child] = c.upper;
  pairs_of[child] = 0u;
  uint first = atomicAdd(measure_count, known_count[child]);
  for (uint k = 0u; k < known_count[child]; ++k) measures[first + k] = child * kMostKnown + k;
}

// Every child's corners against the triangles known to it; where `fine`, an invocation a corner.
void measure_corners(bool fine) {
  uint step = fine ? 3u : 1u;
  for (uint n = gl_LocalInvocationID.x; n < measure_count * step; n += kGroupSize) {
    uint at = measures[n / step];  // uncertified: integers
    uint child = at / kMostKnown;  // uncertified: integers
    Surface s = surface_of(child, at % kMostKnown);
    for (uint corner = n % step; corner < 3u; corner += step) {
      Two3 p = two(vec3(0.0));
      if (corner == 1u) p = held_point(kHeldB, child);
      if (corner == 2u) p = held_point(kHeldC, child);
      corner_distance[3u * at + corner] = surface_distance_up(p, s);
    }
  }
}

// What single triangles give: u1, u2 and ha, and the exact case, ha of the only one.
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
  held[kHeldUpper][child] = min(held[kHeldUpper][child], min(ha, min(u1, u2)));
  return Verdict(held[kHeldUpper][child], by);
}

// Pairs of triangles that may bound a child better, for measure_cuts: a pair cannot beat the better
// of its two distances at the worst corner. Which are tried does not depend on what others found,
// or the bound would depend on their order.
void list_pairs(uint child) {
  uint worth = 0u;  // a bit a pair
  uint bit = 1u;
  for (uint i = 1u; i < known_count[child]; ++i) {
    for (uint j = 0u; j < i; ++j) {
      vec3 di = distances_of(child, i);
      vec3 dj = distances_of(child, j);
      float at_best = kept_bound(bound_nearer(di, dj), held[kHeldSlack][child]);
      if (!cut_by(di - dj).none && at_best < held[kHeldUpper][child]) worth |= bit;
      bit <<= 1;
    }
  }
  pairs_of[child] = uint(bitCount(worth));
  uint next = atomicAdd(pair_count, pairs_of[child]);
  first_pair[child] = next;
  for (uint i = 1u; i < known_count[child]; ++i) {
    for (uint j = 0u; j < i; ++j) {
      if ((worth & 1u) != 0u) {
        pairs[next] = (child * kMaxKnown + i) * kMaxKnown + j;
        pair_bits[next] = 0u;
        ++next;
      }
      worth >>= 1;
    }
  }
}

// u3 of the listed pairs: two cuts, each against two surfaces; where `fine`, an invocation each.
void measure_cuts(bool fine) {
  uint step = fine ? 4u : 1u;
  for (uint n = gl_LocalInvocationID.x; n < pair_count * step; n += kGroupSize) {
    uint at = n / step;                                // uncertified: integers
    uint child = pairs[at] / (kMaxKnown * kMaxKnown);  // uncertified: integers
    uint i = (pairs[at] / kMaxKnown) % kMaxKnown;      // uncertified: integers
    uint j = pairs[at] % kMaxKnown;
    vec3 di = distances_of(child, i);
    vec3 dj = distances_of(child, j);
    Cut cut = cut_by(di - dj);
    float u3 = bound_nearer(di, dj);
    Two3 p = two(vec3(0.0));
    for (uint part = n % step; part < 4u; part += step) {
      if (step == 4u || (part & 1u) == 0u)
        p = cut_point(patch_of_child(child), cut, part >> 1, di - dj);
      u3 = max(u3, surface_distance_up(p, surface_of(child, (part & 1u) == 0u ? i : j)));
    }
    atomicMax(pair_bits[at], floatBitsToUint(kept_bound(u3, held[kHeldSlack][child])));
  }
}

Verdict bound_in_pairs(uint child, Verdict v) {
  for (uint n = 0u; n < pairs_of[child]; ++n) {
    float u3 = uintBitsToFloat(pair_bits[first_pair[child] + n]);
    if (u3 < v.upper) v = Verdict(u3, kCullU3);
  }
  return v;
}

#endif
