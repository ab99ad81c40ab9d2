// The frontier is refined in its own order, with the measured threshold for thin candidates;
// paper/sorted.glsl has other ones.
#ifndef VKH_SHADERS_WAVE_UNSORTED_GLSL
#define VKH_SHADERS_WAVE_UNSORTED_GLSL

#include "shaders/gpu_types.h"

const float kThin = kThinQuality;

bool is_sorted() { return false; }
uint slot_of_item(uint item) { return item; }

#endif
