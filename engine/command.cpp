#include "engine/command.h"

#include <algorithm>

#include "engine/descriptors.h"

namespace vkh {
namespace {

struct Scope {
  VkPipelineStageFlags2 stages;
  VkAccessFlags2 accesses;
};
constexpr VkAccessFlags2 kShaderAccess = VK_ACCESS_2_SHADER_READ_BIT | VK_ACCESS_2_SHADER_WRITE_BIT;
constexpr Scope kComputeWrites = {VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                                  VK_ACCESS_2_SHADER_WRITE_BIT};
constexpr Scope kTransferWrites = {VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT,
                                   VK_ACCESS_2_TRANSFER_WRITE_BIT};
constexpr Scope kCompute = {VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, kShaderAccess};
constexpr Scope kTransfers = {VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT,
                              VK_ACCESS_2_TRANSFER_READ_BIT | VK_ACCESS_2_TRANSFER_WRITE_BIT};
constexpr Scope kSizes = {VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT,
                          VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT};

constexpr Scope operator|(const Scope& a, const Scope& b) {
  return {a.stages | b.stages, a.accesses | b.accesses};
}

void write_memory_barrier(const Binder& binder, const Scope& from, const Scope& to) {
  VkMemoryBarrier2 memory{};
  memory.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2;
  memory.srcStageMask = from.stages;
  memory.srcAccessMask = from.accesses;
  memory.dstStageMask = to.stages;
  memory.dstAccessMask = to.accesses;
  VkDependencyInfo dependency{};
  dependency.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
  dependency.memoryBarrierCount = 1;
  dependency.pMemoryBarriers = &memory;
  binder.vk().CmdPipelineBarrier2(binder.commands(), &dependency);
}

bool is_transfer(const Command& c) { return c.kernel == nullptr; }

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

bool Barriers::is_fresh(const Slice<gpu::Dispatch>& size) const {
  return std::any_of(written_.begin(), written_.end(), [&](const Slice<uint32_t>& w) {
    return w.buffer == size.buffer && w.offset < size.offset + size.size &&
           size.offset < w.offset + w.size;
  });
}

Barriers::Needs Barriers::needs_of(const Command& c) const {
  return {is_transfer(c), c.kind == Command::Kind::kDispatchIndirect && is_fresh(c.size)};
}

// The first scope of a barrier from compute shaders includes the stages that come before them
// (Vulkan 1.3, "Execution and Memory Dependencies"): the device reads a size before a later kernel
// writes it again.
void Barriers::write_barrier(const Needs& needs) {
  const bool for_all = waits_for_all_ || needs.transfers;
  if (for_all) {
    write_memory_barrier(binder_, kComputeWrites | kTransferWrites, kCompute | kTransfers | kSizes);
  } else {
    write_memory_barrier(binder_, kComputeWrites, needs.fresh_sizes ? kCompute | kSizes : kCompute);
  }
  if (for_all || needs.fresh_sizes) written_.clear();
  transfers_wait_ = for_all;
  waits_for_all_ = false;
}

// Writes the command, and remembers what the next barriers depend on.
void Barriers::write_after_barrier(const Command& c) {
  write_without_barrier(binder_, c);
  waits_for_all_ = waits_for_all_ || is_transfer(c);
  try {
    for (uint32_t i = 0; i < c.slice_count; ++i)
      if ((c.written >> i & 1) != 0) written_.push_back(c.slices[i]);
  } catch (...) {  // no memory to keep it in
    waits_for_all_ = true;
  }
}

void Barriers::write(const Command& c) {
  const Needs needs = needs_of(c);
  const bool lacks_its_barrier = needs.fresh_sizes || (needs.transfers && !transfers_wait_);
  if (c.order == Order::kAfterAll || lacks_its_barrier) write_barrier(needs);
  write_after_barrier(c);
}

void Barriers::write_in_step(const std::vector<Track>& tracks) {
  std::vector<size_t> next(tracks.size(), 0), ends(tracks.size(), 0);
  const auto step_ends = [&](size_t t) {
    size_t end = std::min(next[t] + 1, tracks[t].size());
    while (end < tracks[t].size() && tracks[t][end].order == Order::kIndependent) ++end;
    return end;
  };
  const auto is_done = [&](size_t t) { return next[t] == tracks[t].size(); };
  size_t done = 0;
  while (done < tracks.size()) {
    Needs needs;
    for (size_t t = 0; t < tracks.size(); ++t) {
      ends[t] = step_ends(t);
      for (size_t i = next[t]; i < ends[t]; ++i) needs.add(needs_of(tracks[t][i]));
    }
    write_barrier(needs);
    done = 0;
    for (size_t t = 0; t < tracks.size(); ++t) {
      while (next[t] < ends[t]) write_after_barrier(tracks[t][next[t]++]);
      done += is_done(t) ? 1 : 0;
    }
  }
}

}  // namespace vkh
