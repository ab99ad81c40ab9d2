#include "engine/kernels.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <numeric>
#include <span>
#include <system_error>
#include <thread>
#include <vector>

#include "engine/by_address.h"
#include "engine/stages.h"

namespace vkh {
namespace {

struct KernelSource {
  const char* name;
  std::span<const uint32_t> words, edits;
  std::span<const Binding> bindings;
  uint32_t push_bytes;
  uint32_t by_address;  // bindings, as bits, that the edits give by address
};

template <class Push>
constexpr uint32_t push_size() {
  return static_cast<uint32_t>(sizeof(Push));
}
template <>
constexpr uint32_t push_size<NoPush>() {
  return 0;
}

// A CPU has its own kernels, unless it is to use the GPU profile: they lack code that it would
// never run, and keep their loops. Other devices have one set, which kWide specialises.
std::array<KernelSource, kKernelCount> kernel_sources(const Limits& limits) {
  const bool for_cpu = limits.cpu && !limits.wide;
  return {{
#define VKH_SOURCE(K)                               \
  {k::K::kName,                                     \
   for_cpu ? k::K::words_for_cpu() : k::K::words(), \
   for_cpu ? k::K::edits_for_cpu() : k::K::edits(), \
   k::K::kBindings,                                 \
   push_size<k::K::Push>(),                         \
   k::K::kByAddress},
      VKH_KERNELS(VKH_SOURCE)
#undef VKH_SOURCE
  }};
}

// Names the object in captures and in messages of the validation layer. A name that cannot be set
// is no error.
template <class Handle>
void name_object(const VkhContext_T& c, VkObjectType type, Handle handle, const char* name) {
  if (c.vk.SetDebugUtilsObjectNameEXT == nullptr) return;
  VkDebugUtilsObjectNameInfoEXT info{};
  info.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT;
  info.objectType = type;
  info.objectHandle = (uint64_t)handle;  // a pointer, or a number where pointers have 32 bits
  info.pObjectName = name;
  c.vk.SetDebugUtilsObjectNameEXT(c.device, &info);
}

void name_kernel(const VkhContext_T& c, const char* name, const KernelPipeline& kernel) {
  name_object(c, VK_OBJECT_TYPE_DESCRIPTOR_SET_LAYOUT, kernel.set_layout, name);
  name_object(c, VK_OBJECT_TYPE_PIPELINE_LAYOUT, kernel.layout, name);
  name_object(c, VK_OBJECT_TYPE_PIPELINE, kernel.pipeline, name);
}

VkResult create_layouts(const VkhContext_T& c, const KernelSource& source, KernelPipeline& out) {
  std::array<VkDescriptorSetLayoutBinding, 32> bindings{};
  uint32_t count = 0;
  for (const Binding& b : source.bindings) {
    bindings[count++] = {b.binding, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1,
                         VK_SHADER_STAGE_COMPUTE_BIT, nullptr};
  }
  VkDescriptorSetLayoutCreateInfo set{};
  set.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
  if (c.limits.pushes) set.flags = VK_DESCRIPTOR_SET_LAYOUT_CREATE_PUSH_DESCRIPTOR_BIT_KHR;
  set.bindingCount = count;
  set.pBindings = bindings.data();
  VkResult result = c.vk.CreateDescriptorSetLayout(c.device, &set, nullptr, &out.set_layout);
  if (result != VK_SUCCESS) {
    out.set_layout = VK_NULL_HANDLE;  // Vulkan does not define what a failed call has written
    return result;
  }

  if (c.limits.by_address) out.by_address = source.by_address;
  const auto addresses = static_cast<uint32_t>(std::popcount(out.by_address));
  const VkPushConstantRange push{
      VK_SHADER_STAGE_COMPUTE_BIT, 0,
      addresses > 0 ? kAddressOffset + 8 * addresses : source.push_bytes};
  VkPipelineLayoutCreateInfo layout{};
  layout.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
  layout.setLayoutCount = 1;
  layout.pSetLayouts = &out.set_layout;
  layout.pushConstantRangeCount = push.size > 0 ? 1 : 0;
  layout.pPushConstantRanges = &push;
  result = c.vk.CreatePipelineLayout(c.device, &layout, nullptr, &out.layout);
  if (result != VK_SUCCESS) out.layout = VK_NULL_HANDLE;
  return result;
}

VkResult create_pipeline(const VkhContext_T& c, const KernelSource& source, VkPipelineCache cache,
                         KernelPipeline& out) {
  std::vector<uint32_t> with_addresses;
  if (out.by_address != 0) with_addresses = edited(source.words, source.edits);
  const std::span<const uint32_t> words = out.by_address != 0 ? with_addresses : source.words;
  VkShaderModuleCreateInfo module_info{};
  module_info.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
  module_info.codeSize = words.size_bytes();
  module_info.pCode = words.data();
  VkShaderModule shader = VK_NULL_HANDLE;
  VkResult result = c.vk.CreateShaderModule(c.device, &module_info, nullptr, &shader);
  if (result != VK_SUCCESS) return result;
  name_object(c, VK_OBJECT_TYPE_SHADER_MODULE, shader, source.name);  // a message about SPIR-V

  // kSwitches and kWide (base/switches.glsl).
  const std::array<uint32_t, 2> values{c.limits.switches & ~gpu::kAddsKernels,
                                       c.limits.wide ? VK_TRUE : VK_FALSE};
  const std::array<VkSpecializationMapEntry, 2> entries{{{0, 0, 4}, {1, 4, 4}}};
  const VkSpecializationInfo specialisation{2, entries.data(), sizeof(values), values.data()};
  VkComputePipelineCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
  info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
  info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
  info.stage.module = shader;
  info.stage.pName = "main";
  info.stage.pSpecializationInfo = &specialisation;
  info.layout = out.layout;
  result = c.vk.CreateComputePipelines(c.device, cache, 1, &info, nullptr, &out.pipeline);
  c.vk.DestroyShaderModule(c.device, shader, nullptr);
  return result;
}

// Runs on a thread of its own, which no exception may leave.
VkResult create_kernel(const VkhContext_T& c, const KernelSource& source, VkPipelineCache cache,
                       KernelPipeline& out) try {
  VkResult result = create_layouts(c, source, out);
  if (result == VK_SUCCESS) result = create_pipeline(c, source, cache, out);
  if (result == VK_SUCCESS) name_kernel(c, source.name, out);
  return result;
} catch (...) {
  return VK_ERROR_OUT_OF_HOST_MEMORY;
}

constexpr uint32_t kMostThreads = 8;

// The slow kernels start first, so that none of them compiles alone at the end.
std::array<uint32_t, kKernelCount> costliest_first(
    const std::array<KernelSource, kKernelCount>& sources) {
  std::array<uint32_t, kKernelCount> order{};
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&](uint32_t x, uint32_t y) {
    return sources[x].words.size() > sources[y].words.size();
  });
  return order;
}

// The kernels beside the waves that only some switches record.
struct Extra {
  uint32_t kernel;
  Need needed;
};
constexpr std::array kExtras{
    Extra{kIndexOfMeshCheck, gpu::checks_input},    Extra{kIndexOfReportOpen, gpu::covers_area},
    Extra{kIndexOfCellBounds, gpu::bounds_cells},   Extra{kIndexOfSurveyBegin, gpu::bounds_cells},
    Extra{kIndexOfSurveyScore, gpu::bounds_cells},  Extra{kIndexOfSurveyChoose, gpu::bounds_cells},
    Extra{kIndexOfSurveyCount, gpu::bounds_cells},  Extra{kIndexOfSurveyScan, gpu::bounds_cells},
    Extra{kIndexOfSurveyList, gpu::bounds_cells},   Extra{kIndexOfSurveySplit, gpu::bounds_cells},
    Extra{kIndexOfSurveyTally, gpu::bounds_cells},  Extra{kIndexOfSurveyFaces, gpu::bounds_cells},
    Extra{kIndexOfSurveySides, gpu::bounds_cells},  Extra{kIndexOfSurveyNormals, gpu::bounds_cells},
    Extra{kIndexOfClosestFaces, gpu::finds_closest}};

// Whether a run needs this kernel. Others are not created: a driver takes tens of milliseconds for
// some. A kernel that neither table names is of the BVH, the seed or the report, and always needed.
bool is_needed(uint32_t kernel, const Limits& limits) {
  bool is_named = false, is_used = false;
  const auto see = [&](const auto& row) {
    if (row.kernel != kernel) return;
    is_named = true;
    is_used = is_used || row.needed(limits.switches, limits.wide);
  };
  std::for_each(kStages.begin(), kStages.end(), see);
  std::for_each(kExtras.begin(), kExtras.end(), see);
  return !is_named || is_used;
}

// The work of create_kernels, one call of create() a kernel, from any threads. Drivers compile in
// it; a pipeline cache is internally synchronized.
struct Creation {
  VkhContext_T& context;
  VkPipelineCache cache;
  std::array<KernelSource, kKernelCount> sources;
  std::array<uint32_t, kKernelCount> order;
  std::atomic<VkResult> outcome = VK_SUCCESS;

  void create(uint32_t i) {
    if (outcome != VK_SUCCESS || !is_needed(order[i], context.limits)) return;
    KernelPipeline& kernel = context.kernels[order[i]];
    const VkResult result = create_kernel(context, sources[order[i]], cache, kernel);
    if (result != VK_SUCCESS) outcome = result;
  }
};

void create_one(void* creation, uint32_t i) { static_cast<Creation*>(creation)->create(i); }

void create_on_own_threads(Creation& creation, uint32_t most) {
  std::atomic<uint32_t> next = 0;
  const auto work = [&] {
    for (uint32_t i = next++; i < kKernelCount; i = next++) creation.create(i);
  };
  const uint32_t cores = std::clamp(std::thread::hardware_concurrency(), 1u, kMostThreads);
  const uint32_t count = most != 0 ? std::min<uint32_t>(most, kKernelCount) : cores;
  std::vector<std::thread> helpers;
  try {
    helpers.reserve(count);
    for (uint32_t i = 1; i < count; ++i) helpers.emplace_back(work);
  } catch (...) {  // no more threads are available: the running ones do the work
  }
  work();
  for (std::thread& helper : helpers) helper.join();
}

}  // namespace

VkResult create_kernels(VkhContext_T& context, VkPipelineCache cache, const Threads& threads) {
  const auto sources = kernel_sources(context.limits);
  Creation creation{context, cache, sources, costliest_first(sources)};
  if (threads.run != nullptr) {
    threads.run(threads.user, kKernelCount, create_one, &creation);
  } else {
    create_on_own_threads(creation, threads.most);
  }
  return creation.outcome;
}

void destroy_kernels(VkhContext_T& context) {
  for (KernelPipeline& kernel : context.kernels) {
    context.vk.DestroyPipeline(context.device, kernel.pipeline, nullptr);
    context.vk.DestroyPipelineLayout(context.device, kernel.layout, nullptr);
    context.vk.DestroyDescriptorSetLayout(context.device, kernel.set_layout, nullptr);
    kernel = {};
  }
}

}  // namespace vkh
