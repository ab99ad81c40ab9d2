// The frontier in the order of the sort, `order`, if the plan has found it worth sorting. Then
// the wave's parents come first, and one kernel serves both ways to split: at most one subgroup
// has candidates of both. A second dispatch for the thin ones would cost 3.5 us a wave on an H200,
// and a count of them. The kernel declares `control`, `order`.
#ifndef VKH_SHADERS_PAPER_SORTED_GLSL
#define VKH_SHADERS_PAPER_SORTED_GLSL

#include "shaders/gpu_types.h"

const float kThin = kPaperThinQuality;

bool is_sorted() { return control.sorted != 0u; }
uint slot_of_item(uint item) { return is_sorted() ? order[item] : item; }

#endif
