// A whole workgroup adopts the wave's witness. Include after lib/witness.glsl; kAdoptGroup is the
// workgroup's size.
#ifndef VKH_SHADERS_LIB_ADOPT_GLSL
#define VKH_SHADERS_LIB_ADOPT_GLSL

shared uint smallest_key;
shared uint chosen_sample;

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

void find_smallest_key(uint count) {
  for (uint i = gl_LocalInvocationID.x; i < count; i += kAdoptGroup) {
    uint s = sample_at_hand(i);
    if (is_new_lower(distance_of_sample(s))) atomicMin(smallest_key, key_of_sample(s));
  }
}

// Several with the same key are one to the report: any of them.
void choose_by_key(uint count) {
  for (uint i = gl_LocalInvocationID.x; i < count; i += kAdoptGroup) {
    uint s = sample_at_hand(i);
    if (is_new_lower(distance_of_sample(s)) && key_of_sample(s) == smallest_key) chosen_sample = s;
  }
}

// Called by every invocation; control is changed by the first one alone.
void adopt_witness() {
  bool first = gl_LocalInvocationID.x == 0u;
  uint count = samples_at_hand();
  if (first) {
    smallest_key = kNone;
    chosen_sample = kNone;
  }
  barrier();
  find_smallest_key(count);
  barrier();
  choose_by_key(count);
  barrier();
  if (!first) return;
  if (chosen_sample != kNone) adopt_sample(chosen_sample);
  control.offer_count = 0u;
}

#endif
