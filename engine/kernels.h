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

// The threads that create pipelines: the caller's, by `run`, or up to `most` of ours; 0 chooses a
// number.
struct Threads {
  uint32_t most = 0;
  VkhParallelFor run = nullptr;
  void* user = nullptr;
};

// Creates the pipelines that the context's switches and kind of device need. On failure the
// pipelines made so far stay in the context, for destroy_kernels.
VkResult create_kernels(VkhContext_T& context, VkPipelineCache cache, const Threads& threads);
void destroy_kernels(VkhContext_T& context);

}  // namespace vkh
