#include "host/solve/contexts.h"

#include <algorithm>

#include "engine/vkhausdorff_experimental.h"
#include "host/solve/pair_buffers.h"

namespace vkh {
namespace {

// Flags that add kernels, and change no other kernel.
constexpr uint32_t kAdditions = VKH_CONTEXT_CELLS | VKH_CONTEXT_CLOSEST;
// The only switches that change the kernels of BVHs and of closest points.
constexpr uint32_t kOfHierarchies = kSwitchWide | kSwitchByAddress;

}  // namespace

bool serves(uint32_t made, uint32_t asked, ContextUse use) {
  const uint32_t differ = made ^ asked;
  const bool has_kernels = (asked & kAdditions & ~made) == 0;
  const uint32_t same = use == ContextUse::kHierarchy ? kOfHierarchies : ~kAdditions;
  return has_kernels && (differ & same) == 0;
}

ContextHandle Contexts::create(uint32_t switches) const {
  const bool wide = (switches & kSwitchWide) != 0;
  VkhContextCreateInfo info{};
  info.size = sizeof(info);
  info.device = device_.engine_info();
  info.pipelineCache = cache_.handle();
  info.flags = switches & kContextFlags;
  info.deviceKind = wide ? VKH_DEVICE_KIND_WIDE : VKH_DEVICE_KIND_NARROW;
  info.switches = (switches & ~(kSwitchWide | kContextFlags)) | VKH_SWITCH_NONE;
  VkhContext context = nullptr;
  check_engine(vkhCreateContext(&info, &context), "creating the pipelines");
  return {context, vkhDestroyContext};
}

// A caller that asks for a BVH before any run may ask for closest points next, which take one more
// kernel.
VkhContext Contexts::get(uint32_t switches, ContextUse use) {
  const std::lock_guard lock(mutex_);
  const auto known = std::find_if(made_.begin(), made_.end(), [&](const Made& one) {
    return serves(one.switches, switches, use);
  });
  if (known != made_.end()) return known->context.get();
  if (use == ContextUse::kHierarchy) switches |= VKH_CONTEXT_CLOSEST;
  made_.push_back({switches, create(switches)});
  cache_.save();
  return made_.back().context.get();
}

size_t Contexts::count() const {
  const std::lock_guard lock(mutex_);
  return made_.size();
}

}  // namespace vkh
