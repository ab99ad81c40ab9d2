#include "engine/descriptors.h"

#include <algorithm>

namespace vkh {
namespace {

constexpr uint32_t kSetsOfPool = 64;

bool is_by_address(const Command& c, uint32_t binding) {
  return (c.kernel->by_address >> binding & 1) != 0;
}

struct Writes {
  std::array<VkDescriptorBufferInfo, kMaxBindings> infos;
  std::array<VkWriteDescriptorSet, kMaxBindings> writes;
  uint32_t count = 0;

  Writes(const Command& c, VkDescriptorSet set) {
    for (uint32_t i = 0; i < c.slice_count; ++i) {
      if (is_by_address(c, i)) continue;
      infos[i] = info(c.slices[i]);
      VkWriteDescriptorSet& write = writes[count++];
      write = {};
      write.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
      write.dstSet = set;
      write.dstBinding = i;
      write.descriptorCount = 1;
      write.descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
      write.pBufferInfo = &infos[i];
    }
  }
  Writes(const Writes&) = delete;
  Writes& operator=(const Writes&) = delete;
};

bool is_same(const Slice<uint32_t>& x, const Slice<uint32_t>& y) {
  return x.buffer == y.buffer && x.offset == y.offset && x.size == y.size;
}

}  // namespace

SetStore::~SetStore() {
  for (const auto& [commands, sets] : sets_) destroy(sets);
}

void SetStore::destroy(const CommandSets& sets) const {
  for (VkDescriptorPool pool : sets.pools)
    context_.vk.DestroyDescriptorPool(context_.device, pool, nullptr);
}

CommandSets* SetStore::sets_of(VkCommandBuffer commands) try {
  const std::lock_guard lock(mutex_);
  return &sets_[commands];
} catch (...) {  // no exception may cross a C interface
  const std::lock_guard lock(mutex_);
  turned_away_ = true;
  return nullptr;
}

bool SetStore::is_complete(VkCommandBuffer commands) {
  const std::lock_guard lock(mutex_);
  const auto found = sets_.find(commands);
  return found == sets_.end() ? !turned_away_ : found->second.complete;
}

void SetStore::release(VkCommandBuffer commands) {
  const std::lock_guard lock(mutex_);
  const auto found = sets_.find(commands);
  if (found == sets_.end()) return;
  destroy(found->second);
  sets_.erase(found);
}

Binder::Binder(const VkhContext_T& context, VkCommandBuffer commands)
    : context_(context), commands_(commands) {
  if (context.sets != nullptr && commands != VK_NULL_HANDLE)
    sets_ = context.sets->sets_of(commands);
}

bool Binder::bind(const Command& c) {
  if (context_.sets != nullptr) {
    if (!bind_set(c)) return false;
  } else {
    const Writes pushed(c, VK_NULL_HANDLE);
    if (pushed.count > 0)
      context_.vk.CmdPushDescriptorSetKHR(commands_, VK_PIPELINE_BIND_POINT_COMPUTE,
                                          c.kernel->layout, 0, pushed.count, pushed.writes.data());
  }
  context_.vk.CmdBindPipeline(commands_, VK_PIPELINE_BIND_POINT_COMPUTE, c.kernel->pipeline);
  if (c.push_bytes > 0)
    context_.vk.CmdPushConstants(commands_, c.kernel->layout, VK_SHADER_STAGE_COMPUTE_BIT, 0,
                                 c.push_bytes, c.push.data());
  if (c.kernel->by_address != 0) push_addresses(c);
  return true;
}

void Binder::push_addresses(const Command& c) const {
  std::array<VkDeviceAddress, kMaxAddresses> addresses{};
  uint32_t count = 0;
  for (uint32_t i = 0; i < c.slice_count; ++i) {
    if (!is_by_address(c, i)) continue;
    VkBufferDeviceAddressInfo info{};
    info.sType = VK_STRUCTURE_TYPE_BUFFER_DEVICE_ADDRESS_INFO;
    info.buffer = c.slices[i].buffer;
    addresses[count++] =
        context_.vk.GetBufferDeviceAddress(context_.device, &info) + c.slices[i].offset;
  }
  context_.vk.CmdPushConstants(commands_, c.kernel->layout, VK_SHADER_STAGE_COMPUTE_BIT,
                               kAddressOffset, count * 8, addresses.data());
}

// A command buffer that lacks one command is wrong as a whole: after a failure nothing is bound.
bool Binder::bind_set(const Command& c) {
  if (sets_ == nullptr || !sets_->complete) return false;
  VkDescriptorSet set = find(c);
  if (set == VK_NULL_HANDLE) set = allocate(c);
  sets_->complete = set != VK_NULL_HANDLE;
  if (!sets_->complete) return false;
  context_.vk.CmdBindDescriptorSets(commands_, VK_PIPELINE_BIND_POINT_COMPUTE, c.kernel->layout, 0,
                                    1, &set, 0, nullptr);
  return true;
}

VkDescriptorSet Binder::find(const Command& c) const {
  const auto binds_the_same = [&](const Written& w) {
    return w.kernel == c.kernel && std::equal(c.slices.begin(), c.slices.begin() + c.slice_count,
                                              w.slices.begin(), is_same);
  };
  const auto found = std::find_if(written_.rbegin(), written_.rend(), binds_the_same);
  return found == written_.rend() ? VK_NULL_HANDLE : found->set;
}

VkDescriptorSet Binder::allocate(const Command& c) {
  if (sets_->left == 0 && !add_pool()) return VK_NULL_HANDLE;
  VkDescriptorSetAllocateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
  info.descriptorPool = sets_->pools.back();
  info.descriptorSetCount = 1;
  info.pSetLayouts = &c.kernel->set_layout;
  VkDescriptorSet set = VK_NULL_HANDLE;
  if (context_.vk.AllocateDescriptorSets(context_.device, &info, &set) != VK_SUCCESS)
    return VK_NULL_HANDLE;
  --sets_->left;
  const Writes writes(c, set);
  context_.vk.UpdateDescriptorSets(context_.device, writes.count, writes.writes.data(), 0, nullptr);
  try {
    written_.push_back({c.kernel, c.slices, set});
  } catch (...) {  // the next command that binds the same has one of its own
  }
  return set;
}

bool Binder::add_pool() {
  const VkDescriptorPoolSize size{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, kSetsOfPool * kMaxBindings};
  VkDescriptorPoolCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
  info.maxSets = kSetsOfPool;
  info.poolSizeCount = 1;
  info.pPoolSizes = &size;
  try {
    sets_->pools.push_back(VK_NULL_HANDLE);
  } catch (...) {
    return false;
  }
  if (context_.vk.CreateDescriptorPool(context_.device, &info, nullptr, &sets_->pools.back()) !=
      VK_SUCCESS) {
    sets_->pools.pop_back();
    return false;
  }
  sets_->left = kSetsOfPool;
  return true;
}

}  // namespace vkh
