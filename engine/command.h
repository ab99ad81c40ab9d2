// A command that a stage records: it is written into a command buffer at once, or kept on a track,
// so that several problems' commands can stand side by side.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/context.h"
#include "shaders/gpu_types.h"

namespace vkh {

// kAfterAll: a memory barrier stands before the command and waits for everything recorded before
// it.
enum class Order { kAfterAll, kIndependent };

constexpr uint32_t kMaxBindings = 16;
constexpr uint32_t kMaxPushBytes = 64;
static_assert(kMaxPushBytes <= kAddressOffset);

struct Command {
  enum class Kind { kDispatch, kDispatchIndirect, kFill, kCopy };
  Kind kind = Kind::kDispatch;
  Order order = Order::kAfterAll;
  const KernelPipeline* kernel = nullptr;  // null: a fill or a copy
  // The bindings 0, 1, 2, ...; the slice to fill; the source and target of a copy.
  std::array<Slice<uint32_t>, kMaxBindings> slices;
  uint32_t slice_count = 0;
  uint32_t written = 0;  // the slices that the kernel may write, as bits (SPIR-V's NonWritable)
  std::array<std::byte, kMaxPushBytes> push;
  uint32_t push_bytes = 0;
  uint32_t groups = 0;        // of a dispatch
  uint32_t word = 0;          // of a fill
  Slice<gpu::Dispatch> size;  // of an indirect dispatch: one element
};

class Binder;  // engine/descriptors.h

// Commands in their order. A step reaches from one that is kAfterAll to the next.
using Track = std::vector<Command>;

// The barriers of one call, each as narrow as its step allows. The first one waits for everything,
// and so does one beside a transfer. Between dispatches a barrier is of compute shaders alone. It
// also covers the indirect sizes that the device reads, if a kernel may have written one since the
// last barrier that covered them.
class Barriers {
 public:
  explicit Barriers(Binder& binder) : binder_(binder) {}

  // Writes the command, with the barrier that its order requires. An independent transfer needs a
  // barrier if the step's own was of compute shaders alone: put it first in its step.
  void write(const Command& command);

  // Writes the tracks in step: one barrier, then the next step of each. No track may use what
  // another one writes.
  void write_in_step(const std::vector<Track>& tracks);

 private:
  // The needs of a step other than compute.
  struct Needs {
    bool transfers = false;
    bool fresh_sizes = false;  // it reads one that was written since the last barrier for sizes

    void add(const Needs& other) {
      transfers = transfers || other.transfers;
      fresh_sizes = fresh_sizes || other.fresh_sizes;
    }
  };
  Needs needs_of(const Command& command) const;
  bool is_fresh(const Slice<gpu::Dispatch>& size) const;
  void write_barrier(const Needs& needs);
  void write_after_barrier(const Command& command);

  Binder& binder_;
  bool waits_for_all_ = true;             // the next barrier does
  bool transfers_wait_ = false;           // the last barrier was one for transfers, too
  std::vector<Slice<uint32_t>> written_;  // by kernels, since the last barrier for sizes
};

}  // namespace vkh
