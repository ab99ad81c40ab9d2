// Records kernels into the caller's command buffer. It alone writes barriers and timestamps: a
// global barrier stands before every command unless it is told that the command is independent of
// the one before.
#pragma once

#include <array>
#include <cstdint>

#include "engine/kernels.h"
#include "shaders/gpu_types.h"

namespace vkh {

enum class Order { kAfterAll, kIndependent };

// Invocations of a dispatch, one an item, in workgroups of gpu::kGroupSize that continue on y after
// kMaxGroupsX.
struct Items {
  uint32_t count;
};
struct Groups {
  uint32_t count;
};

class Recorder {
 public:
  // A label for as long as the object lives: auto scope = rec.scope("wave").
  class Scope {
   public:
    Scope(Recorder& rec, const char* name) : rec_(rec) { rec_.begin_label(name); }
    ~Scope() { rec_.end_label(); }
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;

   private:
    Recorder& rec_;
  };
  [[nodiscard]] Scope scope(const char* name) { return {*this, name}; }

  Recorder(const VkhContext_T& context, VkCommandBuffer commands, VkhProfile* profile);

  template <class K>
  void run(const typename K::Args& args, const typename K::Push& push, Items items,
           Order order = Order::kAfterAll) {
    bind<K>(args, push, order);
    const uint32_t groups = (items.count + K::kLocalSize[0] - 1) / K::kLocalSize[0];
    dispatch(groups);
  }
  template <class K>
  void run(const typename K::Args& args, const typename K::Push& push, Groups groups,
           Order order = Order::kAfterAll) {
    bind<K>(args, push, order);
    dispatch(groups.count);
  }
  // `size` holds one gpu::Dispatch.
  template <class K>
  void run_indirect(const typename K::Args& args, const typename K::Push& push,
                    const Slice<gpu::Dispatch>& size) {
    bind<K>(args, push, Order::kAfterAll);
    context_.vk.CmdDispatchIndirect(commands_, size.buffer, size.offset);
  }
  // Every 4-byte word of the slice becomes `word`.
  template <class T>
  void fill(const Slice<T>& slice, uint32_t word, Order order = Order::kAfterAll) {
    if (order == Order::kAfterAll) barrier();
    context_.vk.CmdFillBuffer(commands_, slice.buffer, slice.offset, slice.size, word);
  }
  uint32_t switches() const { return context_.limits.switches; }
  // Ends a stage: what ran since the last call is timed under this name (a static string).
  void stage(const char* name);

 private:
  static constexpr uint32_t kMaxBindings = 16;
  void begin_label(const char* name);
  void end_label();

  template <class K>
  void bind(const typename K::Args& args, const typename K::Push& push, Order order) {
    constexpr uint32_t count = sizeof(K::kBindings) / sizeof(Binding);
    static_assert(sizeof(args) == count * sizeof(Slice<uint32_t>) && count <= kMaxBindings);
    if (order == Order::kAfterAll) barrier();
    const KernelPipeline& kernel = context_.kernels[IndexOf<K>::value];
    context_.vk.CmdBindPipeline(commands_, VK_PIPELINE_BIND_POINT_COMPUTE, kernel.pipeline);
    // Args is `count` slices in the order of the bindings, which are 0, 1, 2, ...
    push_descriptors(kernel.layout, reinterpret_cast<const Slice<uint32_t>*>(&args), count);
    if constexpr (!std::is_same_v<typename K::Push, NoPush>) {
      context_.vk.CmdPushConstants(commands_, kernel.layout, VK_SHADER_STAGE_COMPUTE_BIT, 0,
                                   sizeof(push), &push);
    }
  }
  void push_descriptors(VkPipelineLayout layout, const Slice<uint32_t>* slices, uint32_t count);
  void dispatch(uint32_t groups);
  void barrier();

  const VkhContext_T& context_;
  VkCommandBuffer commands_;
  VkhProfile* profile_;
};

}  // namespace vkh
