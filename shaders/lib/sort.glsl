// What the radix sort's three kernels share.
#ifndef VKH_SHADERS_LIB_SORT_GLSL
#define VKH_SHADERS_LIB_SORT_GLSL

uint sort_blocks(uint keys) {
  return (keys + kSortBlock - 1u) / kSortBlock;  // uncertified: integers
}

#endif
