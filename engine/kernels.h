// From a kernel's generated type to its pipeline.
#pragma once

#include "engine/context.h"
#include "kernels/all_kernels.h"

namespace vkh {

enum KernelIndex : uint32_t {
#define VKH_INDEX(K) kIndexOf##K,
  VKH_KERNELS(VKH_INDEX)
#undef VKH_INDEX
      kKernelCount
};
static_assert(kKernelCount <= kMaxKernels);

template <class K>
struct IndexOf;
#define VKH_INDEX(K)                               \
  template <>                                      \
  struct IndexOf<k::K> {                           \
    static constexpr uint32_t value = kIndexOf##K; \
  };
VKH_KERNELS(VKH_INDEX)
#undef VKH_INDEX

// Whether a wave is two dispatches: kFused in shaders/candidate/dispatch.glsl.
constexpr bool is_fused(uint32_t switches) {
  return (switches & (gpu::kUseGroupWalk | gpu::kUseApart)) == gpu::kUseGroupWalk;
}

// Creates every kernel's pipeline in `context`; `switches` becomes specialisation constant 0. On
// failure what was created stays in the context, for destroy_kernels.
VkResult create_kernels(VkhContext_T& context, VkPipelineCache cache, uint32_t switches);
void destroy_kernels(VkhContext_T& context);

}  // namespace vkh
