// The item that this invocation of a kernel in workgroups of kGroupSize works on: a dispatch longer
// than kMaxGroupsX workgroups continues on y.
#ifndef VKH_SHADERS_BASE_INVOCATION_GLSL
#define VKH_SHADERS_BASE_INVOCATION_GLSL

#include "shaders/gpu_types.h"

uint workgroup_index() { return gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x; }
// This does not use gl_WorkGroupSize: glslang takes it for 1 where this file is included above the
// layout that sets it.
uint item_index() { return workgroup_index() * kGroupSize + gl_LocalInvocationID.x; }

#endif
