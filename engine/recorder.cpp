#include "engine/recorder.h"

#include <algorithm>

namespace vkh {

Recorder::Recorder(const VkhContext_T& context, VkCommandBuffer commands, VkhProfile* profile)
    : context_(context), commands_(commands), profile_(profile) {
  stage(nullptr);
}

void Recorder::push_descriptors(VkPipelineLayout layout, const Slice<uint32_t>* slices,
                                uint32_t count) {
  std::array<VkDescriptorBufferInfo, kMaxBindings> infos;
  std::array<VkWriteDescriptorSet, kMaxBindings> writes;
  for (uint32_t i = 0; i < count; ++i) {
    infos[i] = {slices[i].buffer, slices[i].offset, slices[i].size};
    writes[i] = {};
    writes[i].sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
    writes[i].dstBinding = i;
    writes[i].descriptorCount = 1;
    writes[i].descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    writes[i].pBufferInfo = &infos[i];
  }
  context_.vk.CmdPushDescriptorSetKHR(commands_, VK_PIPELINE_BIND_POINT_COMPUTE, layout, 0, count,
                                      writes.data());
}

void Recorder::dispatch(uint32_t groups) {
  if (groups == 0) return;
  const uint32_t x = std::min(groups, gpu::kMaxGroupsX);
  context_.vk.CmdDispatch(commands_, x, (groups + x - 1) / x, 1);
}

void Recorder::barrier() {
  constexpr VkPipelineStageFlags2 stages =
      VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;
  VkMemoryBarrier2 memory{};
  memory.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2;
  memory.srcStageMask = stages;
  memory.srcAccessMask = VK_ACCESS_2_SHADER_WRITE_BIT | VK_ACCESS_2_TRANSFER_WRITE_BIT;
  memory.dstStageMask = stages | VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT;
  memory.dstAccessMask = VK_ACCESS_2_SHADER_READ_BIT | VK_ACCESS_2_SHADER_WRITE_BIT |
                         VK_ACCESS_2_TRANSFER_READ_BIT | VK_ACCESS_2_TRANSFER_WRITE_BIT |
                         VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT;
  VkDependencyInfo dependency{};
  dependency.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
  dependency.memoryBarrierCount = 1;
  dependency.pMemoryBarriers = &memory;
  context_.vk.CmdPipelineBarrier2KHR(commands_, &dependency);
}

void Recorder::begin_label(const char* name) {
  if (context_.vk.CmdBeginDebugUtilsLabelEXT == nullptr) return;
  VkDebugUtilsLabelEXT label{};
  label.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_LABEL_EXT;
  label.pLabelName = name;
  context_.vk.CmdBeginDebugUtilsLabelEXT(commands_, &label);
}

void Recorder::end_label() {
  if (context_.vk.CmdEndDebugUtilsLabelEXT != nullptr)
    context_.vk.CmdEndDebugUtilsLabelEXT(commands_);
}

void Recorder::stage(const char* name) {
  if (profile_ == nullptr || profile_->count == profile_->capacity) return;
  context_.vk.CmdWriteTimestamp2KHR(commands_, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, profile_->pool,
                                    profile_->count);
  profile_->names[profile_->count++] = name;
}

}  // namespace vkh
