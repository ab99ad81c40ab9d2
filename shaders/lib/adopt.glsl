// A whole workgroup adopts the wave's witness. Include after lib/witness.glsl; kAdoptGroup is the
// workgroup's size.
#ifndef VKH_SHADERS_LIB_ADOPT_GLSL
#define VKH_SHADERS_LIB_ADOPT_GLSL

shared uint smallest_key;
shared uint chosen_sample;
shared Witness chosen;

// Where the list of offers did not hold them all, every sample of the wave is looked at.
uint samples_at_hand() {
  if (control.offer_count <= kMaxOffers) return control.offer_count;
  return point_count() + control.count[kCountSurvivors];
}

uint sample_at_hand(uint i) {
  if (control.offer_count <= kMaxOffers) return control.offers[i];
  uint points_asked = point_count();
  return i < points_asked ? i : (i - points_asked) | kCentroidSample;
}

// First the smallest key, then a sample that has it: several with the same key are one to the
// report, and the first to come is taken. One loop for both, since what it calls is long.
void choose_sample(uint count) {
  for (uint turn = 0u; turn < 2u; ++turn) {
    for (uint i = gl_LocalInvocationID.x; i < count; i += kAdoptGroup) {
      uint s = sample_at_hand(i);
      if (!is_new_lower(distance_of_sample(s))) continue;
      Witness w = witness_at(s);
      if (turn == 0u) {
        atomicMin(smallest_key, key_of_witness(w));
      } else if (key_of_witness(w) == smallest_key &&
                 atomicCompSwap(chosen_sample, kNone, s) == kNone) {
        chosen = w;
      }
    }
    barrier();
  }
}

// Called by every invocation; control is changed by the first one alone.
void adopt_witness() {
  bool first = gl_LocalInvocationID.x == 0u;
  if (first) {
    smallest_key = kNone;
    chosen_sample = kNone;
  }
  barrier();
  choose_sample(samples_at_hand());
  if (!first) return;
  if (chosen_sample != kNone) control.witness = chosen;
  control.offer_count = 0u;
}

#endif
