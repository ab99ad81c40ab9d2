// The size of an indirect dispatch with one invocation an item.
#ifndef VKH_SHADERS_LIB_DISPATCH_GLSL
#define VKH_SHADERS_LIB_DISPATCH_GLSL

Dispatch groups_for(uint items) {
  uint groups = (items + kGroupSize - 1u) / kGroupSize;  // uncertified: integers
  uint x = min(groups, kMaxGroupsX);
  return Dispatch(x, x == 0u ? 0u : (groups + x - 1u) / x, 1u);  // uncertified: integers
}

#endif
