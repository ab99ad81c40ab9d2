#include "engine/command.h"

#include <algorithm>

namespace vkh {
namespace {

void write_barrier(const VkhContext_T& context, VkCommandBuffer commands) {
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
  context.vk.CmdPipelineBarrier2KHR(commands, &dependency);
}

void bind(const VkhContext_T& context, VkCommandBuffer commands, const Command& c) {
  context.vk.CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, c.kernel->pipeline);
  std::array<VkDescriptorBufferInfo, kMaxBindings> infos;
  std::array<VkWriteDescriptorSet, kMaxBindings> writes;
  for (uint32_t i = 0; i < c.slice_count; ++i) {
    infos[i] = info(c.slices[i]);
    writes[i] = {};
    writes[i].sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
    writes[i].dstBinding = i;
    writes[i].descriptorCount = 1;
    writes[i].descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    writes[i].pBufferInfo = &infos[i];
  }
  context.vk.CmdPushDescriptorSetKHR(commands, VK_PIPELINE_BIND_POINT_COMPUTE, c.kernel->layout, 0,
                                     c.slice_count, writes.data());
  if (c.push_bytes > 0)
    context.vk.CmdPushConstants(commands, c.kernel->layout, VK_SHADER_STAGE_COMPUTE_BIT, 0,
                                c.push_bytes, c.push.data());
}

void write_without_barrier(const VkhContext_T& context, VkCommandBuffer commands,
                           const Command& c) {
  if (c.kernel != nullptr) bind(context, commands, c);
  const Slice<uint32_t>& filled = c.slices[0];
  const uint32_t x = std::min(c.groups, gpu::kMaxGroupsX);
  switch (c.kind) {
    case Command::Kind::kDispatch:
      if (x > 0) context.vk.CmdDispatch(commands, x, (c.groups + x - 1) / x, 1);
      break;
    case Command::Kind::kDispatchIndirect:
      context.vk.CmdDispatchIndirect(commands, c.size.buffer, c.size.offset);
      break;
    case Command::Kind::kFill:
      context.vk.CmdFillBuffer(commands, filled.buffer, filled.offset, filled.size, c.word);
      break;
  }
}

}  // namespace

void write(const VkhContext_T& context, VkCommandBuffer commands, const Command& command) {
  if (command.order == Order::kAfterAll) write_barrier(context, commands);
  write_without_barrier(context, commands, command);
}

void write_in_step(const VkhContext_T& context, VkCommandBuffer commands,
                   const std::vector<Track>& tracks) {
  std::vector<size_t> next(tracks.size(), 0);
  const auto is_done = [&](size_t t) { return next[t] == tracks[t].size(); };
  size_t done = 0;
  while (done < tracks.size()) {
    write_barrier(context, commands);
    done = 0;
    for (size_t t = 0; t < tracks.size(); ++t) {
      bool first = true;
      while (!is_done(t) && (first || tracks[t][next[t]].order == Order::kIndependent)) {
        write_without_barrier(context, commands, tracks[t][next[t]++]);
        first = false;
      }
      done += is_done(t) ? 1 : 0;
    }
  }
}

}  // namespace vkh
