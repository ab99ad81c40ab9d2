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

// kAfterAll: a memory barrier stands before the command, for all that was recorded before it.
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
  std::array<std::byte, kMaxPushBytes> push;
  uint32_t push_bytes = 0;
  uint32_t groups = 0;        // of a dispatch
  uint32_t word = 0;          // of a fill
  Slice<gpu::Dispatch> size;  // of an indirect one: one of them
};

class Binder;  // engine/descriptors.h

// Writes the command, with the barrier that its order requires.
void write(Binder& binder, const Command& command);

// Commands in their order. A step reaches from one that is kAfterAll to the next.
using Track = std::vector<Command>;

// Writes the tracks in step: one barrier, then the next step of each. No track may use what another
// one writes.
void write_in_step(Binder& binder, const std::vector<Track>& tracks);

}  // namespace vkh
