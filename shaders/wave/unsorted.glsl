// The frontier is refined in its own order; paper/sorted.glsl has another.
#ifndef VKH_SHADERS_WAVE_UNSORTED_GLSL
#define VKH_SHADERS_WAVE_UNSORTED_GLSL

bool is_sorted() { return false; }
uint slot_of_item(uint item) { return item; }

#endif
