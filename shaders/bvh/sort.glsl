// The shared parts of the radix sort's three kernels.
#ifndef VKH_SHADERS_BVH_SORT_GLSL
#define VKH_SHADERS_BVH_SORT_GLSL

#include "shaders/gpu_types.h"

// Blocks of `rounds` times kSortGroup keys.
uint sort_blocks(uint keys, uint rounds) {
  uint block = kSortGroup * rounds;
  return (keys + block - 1u) / block;
}

uint sort_blocks(uint keys) { return sort_blocks(keys, kSortRounds); }

#endif
