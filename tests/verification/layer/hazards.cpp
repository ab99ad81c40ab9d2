#include "tests/verification/layer/hazards.h"

#include <algorithm>
#include <array>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tests/verification/layer/rules.h"
#include "tests/verification/layer/settings.h"
#include "tests/verification/layer/spirv.h"

// Parameters are as many as Vulkan has.
// NOLINTBEGIN(readability-function-size)
namespace vkh::layer {
namespace {

constexpr VkAccessFlags2 kAnyRead = VK_ACCESS_2_MEMORY_READ_BIT;
constexpr VkAccessFlags2 kAnyWrite = VK_ACCESS_2_MEMORY_WRITE_BIT;

/// A way of reaching a buffer: its stages, and what it is called as an access.
struct Kind {
  const char* name;
  VkPipelineStageFlags2 stages;
  VkAccessFlags2 reads, writes;
};
enum KindIndex : uint32_t { kShader, kTransfer, kSize };
constexpr std::array<Kind, 3> kKinds = {
    {{"shader", VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
      VK_ACCESS_2_SHADER_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_READ_BIT | kAnyRead,
      VK_ACCESS_2_SHADER_WRITE_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT | kAnyWrite},
     {"transfer",
      VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT | VK_PIPELINE_STAGE_2_COPY_BIT |
          VK_PIPELINE_STAGE_2_CLEAR_BIT | VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
      VK_ACCESS_2_TRANSFER_READ_BIT | kAnyRead, VK_ACCESS_2_TRANSFER_WRITE_BIT | kAnyWrite},
     {"size", VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT | VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
      VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT | kAnyRead, 0}}};
constexpr uint32_t kAllKinds = (1u << kKinds.size()) - 1;

struct Range {
  uint64_t buffer = 0;
  VkDeviceSize begin = 0, end = 0;
  auto operator<=>(const Range&) const = default;
};

/// `open`: the kinds, as bits, that may overlap it from now on, since a barrier stands between.
struct Access {
  Range range;
  KindIndex kind = kShader;
  bool writes = false;
  uint64_t command = 0;
  uint32_t open = 0;
};

/// A command's accesses, or a barrier.
struct Event {
  std::vector<Access> accesses;
  std::optional<MemoryBarrier> barrier;
};

struct Recording {
  std::map<uint32_t, Range> bound;  // by binding, of set 0
  uint64_t pipeline = 0;
  std::vector<Event> events;
};

struct Followed {
  std::mutex mutex;
  std::map<uint64_t, VkDeviceSize> buffers;
  std::map<uint64_t, std::map<uint32_t, bool>> modules, pipelines;  // bindings: whether written
  std::map<uint64_t, std::map<uint32_t, Range>> sets;
  std::map<uint64_t, Recording> recordings;
};

Followed& followed() {
  static Followed* one = new Followed;  // never destroyed: threads may still be at work at the end
  return *one;
}

bool overlap(const Range& a, const Range& b) {
  return a.buffer == b.buffer && a.begin < b.end && b.begin < a.end;
}

/// Call with the lock held.
Range range_of(VkBuffer buffer, VkDeviceSize offset, VkDeviceSize size) {
  const uint64_t number = number_of(buffer);
  const bool is_whole = size == VK_WHOLE_SIZE;
  return {number, offset, is_whole ? followed().buffers[number] : offset + size};
}

std::string words_of(const Access& access) {
  return std::string(kKinds.at(access.kind).name) + (access.writes ? " write" : " read") +
         " of command " + std::to_string(access.command);
}

bool conflict(const Access& before, const Access& access) {
  return before.command != access.command && (before.writes || access.writes) &&
         (before.open >> access.kind & 1) == 0 && overlap(before.range, access.range);
}

std::string hazard_between(const Access& before, const Access& access) {
  return "hazard: no barrier between the " + words_of(before) + " and the " + words_of(access) +
         ", bytes " + std::to_string(std::max(before.range.begin, access.range.begin)) +
         " and up of buffer " + std::to_string(access.range.buffer);
}

void add_shader_accesses(VkCommandBuffer commands, std::vector<Access>& accesses) {
  const Recording& recording = followed().recordings[number_of(commands)];
  for (const auto& [binding, writes] : followed().pipelines[recording.pipeline]) {
    const auto bound = recording.bound.find(binding);
    if (bound != recording.bound.end())
      accesses.push_back({.range = bound->second, .kind = kShader, .writes = writes});
  }
}

/// The kinds that go on behind a barrier to this scope: all of their accesses stand in it.
uint32_t kinds_behind(const BarrierScope& to) {
  uint32_t kinds = 0;
  for (uint32_t k = 0; k < kKinds.size(); ++k) {
    const Kind& kind = kKinds.at(k);
    const bool names_writes = kind.writes == 0 || (to.accesses & kind.writes) != 0;
    if ((to.stages & kind.stages) != 0 && (to.accesses & kind.reads) != 0 && names_writes)
      kinds |= 1u << k;
  }
  return kinds;
}

/// Whether a barrier from this scope waits for the access. A stage's scope includes the stages
/// before it: sizes are read before a compute shader runs.
bool waits_for(const BarrierScope& from, const Access& access) {
  VkPipelineStageFlags2 stages = from.stages;
  if ((stages & VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT) != 0)
    stages |= VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT;
  const Kind& kind = kKinds.at(access.kind);
  return (stages & kind.stages) != 0 && (!access.writes || (from.accesses & kind.writes) != 0);
}

/// The accesses that some kind must still wait for, as events come.
class Following {
 public:
  /// Returns a hazard in words, empty if there is none.
  std::string go_on(const Event& event) {
    std::string hazard;
    if (event.barrier) {
      pass(*event.barrier);
      return hazard;
    }
    for (const Access& access : event.accesses) {
      for (const Access& before : accesses_) {
        if (conflict(before, access)) hazard = hazard_between(before, access);
      }
      accesses_.push_back(access);
    }
    return hazard;
  }

 private:
  void pass(const MemoryBarrier& barrier) {
    const uint32_t kinds = kinds_behind(barrier.to);
    for (Access& access : accesses_) access.open |= waits_for(barrier.from, access) ? kinds : 0;
    std::erase_if(accesses_, [](const Access& access) { return access.open == kAllKinds; });
  }

  std::vector<Access> accesses_;
};

/// The barrier without one kind in one of its scopes.
MemoryBarrier without(MemoryBarrier barrier, const Kind& kind, bool is_from) {
  BarrierScope& scope = is_from ? barrier.from : barrier.to;
  scope.stages &= ~kind.stages;
  scope.accesses &= ~(kind.reads | kind.writes);
  return barrier;
}

bool has(const BarrierScope& scope, const Kind& kind) { return (scope.stages & kind.stages) != 0; }

/// Whether a hazard follows if the barrier at `place` lacks a kind.
bool is_needed(Following following, std::span<const Event> events, const MemoryBarrier& left) {
  following.go_on({{}, left});
  return std::any_of(events.begin() + 1, events.end(),
                     [&](const Event& event) { return !following.go_on(event).empty(); });
}

void count_needed(const Following& following, std::span<const Event> events) {
  const MemoryBarrier& barrier = *events.front().barrier;
  const Kind& transfers = kKinds[kTransfer];
  const bool is_narrow = !has(barrier.from, transfers) && !has(barrier.to, transfers);
  for (const bool is_from : {true, false}) {
    for (const Kind& kind : kKinds) {
      if (!has(is_from ? barrier.from : barrier.to, kind)) continue;
      const std::string name = std::string("accesses ") + (is_narrow ? "narrow " : "") +
                               (is_from ? "from " : "to ") + kind.name + "s";
      count_call(name);
      if (is_needed(following, events, without(barrier, kind, is_from)))
        count_call(name + " needed");
    }
  }
}

void look_for_hazards(std::span<const Event> events) {
  Following following;
  for (size_t i = 0; i < events.size(); ++i) {
    if (events[i].barrier) count_needed(following, events.subspan(i));
    const std::string hazard = following.go_on(events[i]);
    if (!hazard.empty()) violation(hazard);
  }
}

void add_command(VkCommandBuffer commands, std::vector<Access> accesses) {
  Recording& recording = followed().recordings[number_of(commands)];
  for (Access& access : accesses) access.command = recording.events.size();
  std::erase_if(accesses, [](const Access& a) { return a.range.begin >= a.range.end; });
  recording.events.push_back({std::move(accesses), std::nullopt});
}

std::map<uint32_t, Range> ranges_of(std::span<const VkWriteDescriptorSet> writes) {
  std::map<uint32_t, Range> ranges;
  for (const VkWriteDescriptorSet& write : writes) {
    if (write.descriptorType != VK_DESCRIPTOR_TYPE_STORAGE_BUFFER) continue;
    for (uint32_t i = 0; i < write.descriptorCount; ++i) {
      const VkDescriptorBufferInfo& b = write.pBufferInfo[i];
      ranges[write.dstBinding + i] = range_of(b.buffer, b.offset, b.range);
    }
  }
  return ranges;
}

}  // namespace

void follow_buffer(VkBuffer buffer, VkDeviceSize size) {
  const std::lock_guard lock(followed().mutex);
  followed().buffers[number_of(buffer)] = size;
}

void follow_module(VkShaderModule module, std::span<const uint32_t> words) {
  if (!settings().finds_hazards) return;
  const auto writes = writes_of(words);
  if (!writes) violation("vkCreateShaderModule: this layer cannot read the shader");
  const std::lock_guard lock(followed().mutex);
  followed().modules[number_of(module)] = writes.value_or(std::map<uint32_t, bool>());
}

void follow_pipelines(std::span<const VkComputePipelineCreateInfo> infos, const VkPipeline* made) {
  const std::lock_guard lock(followed().mutex);
  for (size_t i = 0; i < infos.size(); ++i)
    followed().pipelines[number_of(made[i])] = followed().modules[number_of(infos[i].stage.module)];
}

void follow_sets(std::span<const VkWriteDescriptorSet> writes) {
  const std::lock_guard lock(followed().mutex);
  for (const VkWriteDescriptorSet& write : writes) {
    for (const auto& [binding, range] : ranges_of({&write, 1}))
      followed().sets[number_of(write.dstSet)][binding] = range;
  }
}

void follow_push(VkCommandBuffer commands, std::span<const VkWriteDescriptorSet> writes) {
  const std::lock_guard lock(followed().mutex);
  Recording& recording = followed().recordings[number_of(commands)];
  for (const auto& [binding, range] : ranges_of(writes)) recording.bound[binding] = range;
}

void follow_dispatch(VkCommandBuffer commands) {
  if (!settings().finds_hazards) return;
  const std::lock_guard lock(followed().mutex);
  std::vector<Access> accesses;
  add_shader_accesses(commands, accesses);
  add_command(commands, std::move(accesses));
}

void follow_barrier(VkCommandBuffer commands, const MemoryBarrier& barrier) {
  if (!settings().finds_hazards) return;
  const std::lock_guard lock(followed().mutex);
  followed().recordings[number_of(commands)].events.push_back({{}, barrier});
}

void made(fn::BeginCommandBuffer, Table&, VkCommandBuffer commands,
          const VkCommandBufferBeginInfo*) {
  const std::lock_guard lock(followed().mutex);
  followed().recordings[number_of(commands)] = {};
}

void made(fn::EndCommandBuffer, Table&, VkCommandBuffer commands) {
  std::vector<Event> events;
  {
    const std::lock_guard lock(followed().mutex);
    events = std::move(followed().recordings[number_of(commands)].events);
  }
  look_for_hazards(events);
}

bool allowed(fn::CmdBindPipeline, Table&, VkCommandBuffer commands, VkPipelineBindPoint,
             VkPipeline pipeline) {
  const std::lock_guard lock(followed().mutex);
  followed().recordings[number_of(commands)].pipeline = number_of(pipeline);
  return true;
}

bool allowed(fn::CmdBindDescriptorSets, Table&, VkCommandBuffer commands, VkPipelineBindPoint,
             VkPipelineLayout, uint32_t, uint32_t count, const VkDescriptorSet* sets, uint32_t,
             const uint32_t*) {
  const std::lock_guard lock(followed().mutex);
  for (const VkDescriptorSet set : std::span(sets, count))
    followed().recordings[number_of(commands)].bound = followed().sets[number_of(set)];
  return true;
}

bool allowed(fn::CmdDispatchIndirect, Table&, VkCommandBuffer commands, VkBuffer sizes,
             VkDeviceSize offset) {
  if (!settings().finds_hazards) return true;
  const std::lock_guard lock(followed().mutex);
  const Range size = range_of(sizes, offset, sizeof(VkDispatchIndirectCommand));
  std::vector<Access> accesses = {{.range = size, .kind = kSize}};
  add_shader_accesses(commands, accesses);
  add_command(commands, std::move(accesses));
  return true;
}

bool allowed(fn::CmdFillBuffer, Table&, VkCommandBuffer commands, VkBuffer buffer,
             VkDeviceSize offset, VkDeviceSize size, uint32_t) {
  if (!settings().finds_hazards) return true;
  const std::lock_guard lock(followed().mutex);
  add_command(commands,
              {{.range = range_of(buffer, offset, size), .kind = kTransfer, .writes = true}});
  return true;
}

bool allowed(fn::CmdCopyBuffer, Table&, VkCommandBuffer commands, VkBuffer from, VkBuffer to,
             uint32_t count, const VkBufferCopy* regions) {
  if (!settings().finds_hazards) return true;
  const std::lock_guard lock(followed().mutex);
  std::vector<Access> accesses;
  for (const VkBufferCopy& r : std::span(regions, count)) {
    accesses.push_back({.range = range_of(from, r.srcOffset, r.size), .kind = kTransfer});
    accesses.push_back(
        {.range = range_of(to, r.dstOffset, r.size), .kind = kTransfer, .writes = true});
  }
  add_command(commands, std::move(accesses));
  return true;
}

}  // namespace vkh::layer
// NOLINTEND(readability-function-size)
