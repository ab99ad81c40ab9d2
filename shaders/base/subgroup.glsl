// Subgroup operations composed of others, since a driver fails on the built-in ones.
// RADV of Mesa 22.3.6 compiles no subgroupBallotFindLSB where subgroups are 64 wide ("Unimplemented
// NIR instr bit size: find_lsb"), and still returns VK_SUCCESS.
#ifndef VKH_SHADERS_BASE_SUBGROUP_GLSL
#define VKH_SHADERS_BASE_SUBGROUP_GLSL

// The first lane of a ballot that is not empty. Subgroups are at most 128 wide, four words.
uint first_lane(uvec4 lanes) {
  if (lanes.x != 0u) return uint(findLSB(lanes.x));
  if (lanes.y != 0u) return 32u + uint(findLSB(lanes.y));
  if (lanes.z != 0u) return 64u + uint(findLSB(lanes.z));
  return 96u + uint(findLSB(lanes.w));
}

#endif
