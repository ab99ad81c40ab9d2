// A workgroup adopts the wave's witness. The kernel declares `group_words`, `control`.
#ifndef VKH_SHADERS_WAVE_ADOPT_GLSL
#define VKH_SHADERS_WAVE_ADOPT_GLSL

#include "shaders/wave/plan_words.glsl"

// Called by every invocation; only the first one changes control. Offers are read by atomics, as
// they were written, perhaps by other workgroups of this dispatch.
void adopt_witness() {
  uint lane = gl_LocalInvocationID.x;
  if (lane == 0u) group_words[kWordAdopted + 3u] = kNone;
  barrier();
  uint count = min(atomicOr(control.offer_count, 0u), kMaxOffers);  // <= kGroupSize
  uint key = atomicOr(control.offer_key, 0u);
  if (lane < count && atomicOr(control.offers[lane].key, 0u) == key) {
    group_words[kWordAdopted] = atomicOr(control.offers[lane].x, 0u);
    group_words[kWordAdopted + 1u] = atomicOr(control.offers[lane].y, 0u);
    group_words[kWordAdopted + 2u] = atomicOr(control.offers[lane].z, 0u);
    group_words[kWordAdopted + 3u] = atomicOr(control.offers[lane].root, 0u);
    group_words[kWordAdopted + 4u] = atomicOr(control.offers[lane].j, 0u);
    group_words[kWordAdopted + 5u] = atomicOr(control.offers[lane].k, 0u);
    group_words[kWordAdopted + 6u] = atomicOr(control.offers[lane].nearest, 0u);
  }
  barrier();
  if (lane > 0u || count == 0u) return;
  control.offer_count = 0u;
  control.offer_key = kNone;
  // If the list had no room for the new witness, the old one stays: it is still a sample.
  if (group_words[kWordAdopted + 3u] == kNone) return;
  vec3 position = uintBitsToFloat(uvec3(group_words[kWordAdopted], group_words[kWordAdopted + 1u],
                                        group_words[kWordAdopted + 2u]));
  control.witness = Witness(position, uintBitsToFloat(control.maximum[kMaxLower]),
                            group_words[kWordAdopted + 3u], group_words[kWordAdopted + 4u],
                            group_words[kWordAdopted + 5u], group_words[kWordAdopted + 6u]);
}

#endif
