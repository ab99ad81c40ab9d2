#include "engine/command.h"

#include <algorithm>

#include "engine/descriptors.h"

namespace vkh {
namespace {

void write_barrier(const Binder& binder) {
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
  binder.vk().CmdPipelineBarrier2(binder.commands(), &dependency);
}

void write_copy(const DeviceFunctions& vk, VkCommandBuffer commands, const Slice<uint32_t>& from,
                const Slice<uint32_t>& to) {
  const VkBufferCopy region{from.offset, to.offset, from.size};
  vk.CmdCopyBuffer(commands, from.buffer, to.buffer, 1, &region);
}

void write_without_barrier(Binder& binder, const Command& c) {
  if (c.kernel != nullptr && !binder.bind(c)) return;
  const DeviceFunctions& vk = binder.vk();
  const VkCommandBuffer commands = binder.commands();
  const Slice<uint32_t>& filled = c.slices[0];
  const uint32_t x = std::min(c.groups, gpu::kMaxGroupsX);
  switch (c.kind) {
    case Command::Kind::kDispatch:
      if (x > 0) vk.CmdDispatch(commands, x, (c.groups + x - 1) / x, 1);
      break;
    case Command::Kind::kDispatchIndirect:
      vk.CmdDispatchIndirect(commands, c.size.buffer, c.size.offset);
      break;
    case Command::Kind::kFill:
      vk.CmdFillBuffer(commands, filled.buffer, filled.offset, filled.size, c.word);
      break;
    case Command::Kind::kCopy:
      write_copy(vk, commands, c.slices[0], c.slices[1]);
      break;
  }
}

}  // namespace

void write(Binder& binder, const Command& command) {
  if (command.order == Order::kAfterAll) write_barrier(binder);
  write_without_barrier(binder, command);
}

void write_in_step(Binder& binder, const std::vector<Track>& tracks) {
  std::vector<size_t> next(tracks.size(), 0);
  const auto is_done = [&](size_t t) { return next[t] == tracks[t].size(); };
  size_t done = 0;
  while (done < tracks.size()) {
    write_barrier(binder);
    done = 0;
    for (size_t t = 0; t < tracks.size(); ++t) {
      bool first = true;
      while (!is_done(t) && (first || tracks[t][next[t]].order == Order::kIndependent)) {
        write_without_barrier(binder, tracks[t][next[t]++]);
        first = false;
      }
      done += is_done(t) ? 1 : 0;
    }
  }
}

}  // namespace vkh
