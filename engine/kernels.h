// The way from a kernel's generated type to its pipeline.
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

// Creates the pipelines that the context's switches and kind of device need. On failure the
// pipelines made so far stay in the context, for destroy_kernels.
VkResult create_kernels(VkhContext_T& context, VkPipelineCache cache);
void destroy_kernels(VkhContext_T& context);

}  // namespace vkh
