// What the commands of a command buffer read and write, and whether a barrier stands between two
// that must not overlap. Unlike synchronization validation it follows the sizes of indirect
// dispatches, and takes each storage buffer that a shader binds as read whole, and as written whole
// unless the shader declares it NonWritable: reads by an index count, too.
//
// When a command buffer ends, each access of each of its barriers is taken away in turn, in
// thought: the counts "accesses KIND" and "accesses KIND needed" say how often that leaves a
// hazard. KIND is "to sizes", "to transfers" and the like, with "narrow" before it where the
// barrier has no transfers.
//
// It sees one command buffer at a time, no images, no vertex and index buffers, and no buffer that
// a shader reaches by its address. Chains of barriers do not count: each pair
// needs one barrier that names both.
#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace vkh::layer {

void follow_buffer(VkBuffer buffer, VkDeviceSize size);
void follow_module(VkShaderModule module, std::span<const uint32_t> words);
void follow_pipelines(std::span<const VkComputePipelineCreateInfo> infos, const VkPipeline* made);
void follow_sets(std::span<const VkWriteDescriptorSet> writes);
void follow_push(VkCommandBuffer commands, std::span<const VkWriteDescriptorSet> writes);
void follow_dispatch(VkCommandBuffer commands);

struct BarrierScope {
  VkPipelineStageFlags2 stages;
  VkAccessFlags2 accesses;
};
struct MemoryBarrier {
  BarrierScope from, to;
};
void follow_barrier(VkCommandBuffer commands, const MemoryBarrier& barrier);

}  // namespace vkh::layer
