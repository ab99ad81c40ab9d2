// Replaces wave/centroid.glsl if a wave is fused: then no centroid is known.
#ifndef VKH_SHADERS_WAVE_NO_CENTROID_GLSL
#define VKH_SHADERS_WAVE_NO_CENTROID_GLSL

#include "shaders/gpu_types.h"

uint nearest_to_centroid(uint slot) { return kNone; }
void keep_nearest_to_centroid(uint slot, uint triangle) {}

#endif
