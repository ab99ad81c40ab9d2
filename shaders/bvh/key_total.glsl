// The number of keys: the host's, or, if only the device knows it, a buffer's. The
// kernel declares `push` (SortPush), `key_count`.
#ifndef VKH_SHADERS_BVH_KEY_TOTAL_GLSL
#define VKH_SHADERS_BVH_KEY_TOTAL_GLSL

#include "shaders/gpu_types.h"

uint key_total() {
  uint total = push.count;
  if (total == kNone) total = key_count;
  return total;
}

#endif
