// The frontier is refined in its own order, and thin is what pays here; paper/sorted.glsl has
// another.
#ifndef VKH_SHADERS_WAVE_UNSORTED_GLSL
#define VKH_SHADERS_WAVE_UNSORTED_GLSL

#include "shaders/gpu_types.h"

const float kThin = kThinQuality;

bool is_sorted() { return false; }
uint slot_of_item(uint item) { return item; }

#endif
