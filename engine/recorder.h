// Records kernels into the caller's command buffer, or onto a track. It alone writes timestamps; a
// global barrier stands before every command unless the caller states that the command is
// independent of the one before (engine/command.cpp).
#pragma once

#include <algorithm>
#include <cstring>

#include "engine/descriptors.h"
#include "engine/kernels.h"

namespace vkh {

// Invocations of a dispatch, one per item, in workgroups of gpu::kGroupSize that continue on y
// after kMaxGroupsX.
struct Items {
  uint32_t count;
};
struct Groups {
  uint32_t count;
};

class Recorder {
 public:
  // A label that lasts as long as the object: auto scope = rec.scope("wave").
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
  // Keeps the commands on a track instead, without labels and timestamps.
  Recorder(const VkhContext_T& context, Track& track)
      : context_(context), binder_(context, VK_NULL_HANDLE), track_(&track) {}

  // `given` is any struct whose members have the names of the kernel's buffers, with a member
  // `push` if the kernel has push constants. A missing name does not compile.
  template <class K, class Given>
  void run(const Given& given, Items items, Order order = Order::kAfterAll) {
    const uint32_t groups = (items.count + K::kLocalSize[0] - 1) / K::kLocalSize[0];
    run<K>(given, Groups{groups}, order);
  }
  template <class K, class Given>
  void run(const Given& given, Groups groups, Order order = Order::kAfterAll) {
    Command command = command_of<K>(given);
    command.order = order;
    command.groups = groups.count;
    put(command);
  }
  // `size` holds one gpu::Dispatch.
  template <class K, class Given>
  void run_indirect(const Given& given, const Slice<gpu::Dispatch>& size) {
    Command command = command_of<K>(given);
    command.kind = Command::Kind::kDispatchIndirect;
    command.size = size;
    put(command);
  }
  // Every 4-byte word of the slice becomes `word`.
  template <class T>
  void fill(const Slice<T>& slice, uint32_t word, Order order = Order::kAfterAll) {
    Command command;
    command.kind = Command::Kind::kFill;
    command.order = order;
    command.slices[0] = as<uint32_t>(slice);
    command.word = word;
    put(command);
  }
  // `to` is at least as large as `from`.
  template <class T>
  void copy(const Slice<T>& from, const Slice<T>& to, Order order = Order::kAfterAll) {
    Command command;
    command.kind = Command::Kind::kCopy;
    command.order = order;
    command.slices[0] = as<uint32_t>(from);
    command.slices[1] = as<uint32_t>(to);
    put(command);
  }
  // Writes the tracks in step (engine/command.h).
  void put_in_step(const std::vector<Track>& tracks) { barriers_.write_in_step(tracks); }
  bool is_wide() const { return context_.limits.wide; }
  bool checks_input() const {
    return gpu::checks_input(context_.limits.switches, context_.limits.wide);
  }
  // Ends a stage: the work since the last call is timed under this name (a static string).
  void stage(const char* name);

 private:
  void begin_label(const char* name);
  void end_label();

  // The kernel's bindings that it may write, as bits.
  template <class K>
  static constexpr uint32_t written_by() {
    uint32_t written = 0;
    for (const Binding& b : K::kBindings) written |= b.read_only ? 0u : 1u << b.binding;
    return written;
  }

  template <class K, class Given>
  Command command_of(const Given& given) const {
    constexpr uint32_t count = sizeof(K::kBindings) / sizeof(Binding);
    const typename K::Args args = K::named(given);
    static_assert(sizeof(args) == count * sizeof(Slice<uint32_t>) && count <= kMaxBindings);
    Command command;
    command.kernel = &context_.kernels[IndexOf<K>::value];
    // Args is `count` slices in the order of the bindings, which are 0, 1, 2, ...
    std::copy_n(reinterpret_cast<const Slice<uint32_t>*>(&args), count, command.slices.begin());
    command.slice_count = count;
    command.written = written_by<K>();
    if constexpr (!std::is_same_v<typename K::Push, NoPush>) {
      const typename K::Push& push = given.push;
      static_assert(sizeof(push) <= kMaxPushBytes);
      std::memcpy(command.push.data(), &push, sizeof(push));
      command.push_bytes = sizeof(push);
    }
    return command;
  }
  void put(const Command& command) {
    if (track_ != nullptr) {
      track_->push_back(command);
    } else {
      barriers_.write(command);
    }
  }

  const VkhContext_T& context_;
  Binder binder_;
  Barriers barriers_{binder_};
  VkhProfile* profile_ = nullptr;
  Track* track_ = nullptr;
};

}  // namespace vkh
