// Finds the last workgroup of a dispatch to reach a point: it sees everything that the others have
// written before, by atomics or to coherent buffers, if it reads in the same way. The kernel
// declares `groups_done`, which counts them.
#ifndef VKH_SHADERS_BASE_LAST_GROUP_GLSL
#define VKH_SHADERS_BASE_LAST_GROUP_GLSL

shared bool last_group;

// Called once, by every invocation of every workgroup.
bool is_last_group() {
  memoryBarrierBuffer();
  barrier();
  if (gl_LocalInvocationID.x == 0u) {
    uint groups = gl_NumWorkGroups.x * gl_NumWorkGroups.y;
    memoryBarrierBuffer();
    last_group = atomicAdd(groups_done, 1u) == groups - 1u;
    if (last_group) groups_done = 0u;
  }
  barrier();
  memoryBarrierBuffer();
  return last_group;
}

#endif
