// The constants that specialise a context's pipelines: its switches, and the kind of its device.
// kWide is the GPU profile: the device runs many workgroups at once, so that a small wave is given
// more invocations and fewer dispatches. Kernels for CPUs are built with kWide false
// (cmake/Shaders.cmake).
#ifndef VKH_SHADERS_BASE_SWITCHES_GLSL
#define VKH_SHADERS_BASE_SWITCHES_GLSL

#include "shaders/gpu_types.h"

layout(constant_id = 0) const uint kSwitches = kUseAll;
layout(constant_id = 1) const bool kWide = true;

#include "shaders/stages.h"

#endif
