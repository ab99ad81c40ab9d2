// Binding a command's buffers: by push descriptors, or, on devices without them, by descriptor sets
// that live until the caller releases the command buffer.
#pragma once

#include <mutex>
#include <unordered_map>
#include <vector>

#include "engine/command.h"

namespace vkh {

// The sets that one command buffer binds.
struct CommandSets {
  std::vector<VkDescriptorPool> pools;
  uint32_t left = 0;  // sets of the last pool
  bool complete = true;
};

// The descriptor sets of a context's command buffers. Several threads may record at once, each its
// own.
class SetStore {
 public:
  explicit SetStore(const VkhContext_T& context) : context_(context) {}
  ~SetStore();
  SetStore(const SetStore&) = delete;
  SetStore& operator=(const SetStore&) = delete;

  // Returns null if the host has no memory for it.
  CommandSets* sets_of(VkCommandBuffer commands);
  // Returns false if a set could not be allocated.
  bool is_complete(VkCommandBuffer commands);
  void release(VkCommandBuffer commands);

 private:
  void destroy(const CommandSets& sets) const;

  const VkhContext_T& context_;
  std::mutex mutex_;
  std::unordered_map<VkCommandBuffer, CommandSets> sets_;  // an element stays where it is
  bool turned_away_ = false;                               // a command buffer found no room
};

// The sets of one call of the API: a set is written once for all of its commands that bind the
// same.
class Binder {
 public:
  Binder(const VkhContext_T& context, VkCommandBuffer commands);

  // Binds pipeline, buffers and push constants. Returns false if there was no memory for a set, now
  // or before: the command must not run.
  bool bind(const Command& command);

  const DeviceFunctions& vk() const { return context_.vk; }
  VkCommandBuffer commands() const { return commands_; }

 private:
  struct Written {
    const KernelPipeline* kernel;
    std::array<Slice<uint32_t>, kMaxBindings> slices;
    VkDescriptorSet set;
  };

  bool bind_set(const Command& command);
  void push_addresses(const Command& command) const;
  VkDescriptorSet find(const Command& command) const;
  VkDescriptorSet allocate(const Command& command);
  bool add_pool();

  const VkhContext_T& context_;
  VkCommandBuffer commands_;
  CommandSets* sets_ = nullptr;
  std::vector<Written> written_;
};

}  // namespace vkh
