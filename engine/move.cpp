// Moves a run into a workspace with more room: copies the state between two waves, but nothing that
// a wave computes again.
#include <bit>
#include <cstddef>

#include "engine/record.h"

namespace vkh {
namespace {

struct Move {
  Recorder& rec;
  uint32_t from_capacity, to_capacity;

  template <class T>
  void keep(const Slice<T>& from, const Slice<T>& to) const {
    rec.copy(from, to, Order::kIndependent);
  }
  // The streams beside the frontier have two halves: each goes to the start of the new half.
  template <class T>
  void keep_halves(const Slice<T>& from, const Slice<T>& to) const {
    const VkDeviceSize bytes = from_capacity * sizeof(T), shift = to_capacity * sizeof(T);
    keep(Slice<T>{from.buffer, from.offset, bytes}, to);
    keep(Slice<T>{from.buffer, from.offset + bytes, bytes},
         Slice<T>{to.buffer, to.offset + shift, bytes});
  }
};

// The subroots.
Slice<gpu::Candidate> behind_halves(const Slice<gpu::Candidate>& frontier, const Workspace& w) {
  const VkDeviceSize halves = 2ull * w.capacity * sizeof(gpu::Candidate);
  return {frontier.buffer, frontier.offset + halves, frontier.size - halves};
}

void record_copies(Recorder& rec, const Problem& p, const Workspace& to) {
  const Workspace& from = p.ws;
  const Move move{rec, from.capacity, to.capacity};
  rec.copy(from.control, to.control);
  move.keep(from.sizes, to.sizes);
  move.keep(from.vertices, to.vertices);
  move.keep(from.faces, to.faces);
  move.keep(from.vertex_nearest, to.vertex_nearest);
  move.keep(from.vertex_distance, to.vertex_distance);
  move.keep(from.face_shared, to.face_shared);
  move.keep(from.lower_bits, to.lower_bits);
  move.keep(from.groups_done, to.groups_done);
  move.keep_halves(from.frontier, to.frontier);
  if (gpu::has_subroots(p.switches, p.wide))
    move.keep(behind_halves(from.frontier, from), behind_halves(to.frontier, to));
  if (gpu::asks_centroids(p.switches, p.wide))
    move.keep_halves(from.centroid_nearest, to.centroid_nearest);
}

Slice<uint32_t> word_of(const Slice<gpu::Control>& control, size_t offset) {
  return {control.buffer, control.offset + offset, sizeof(uint32_t)};
}

}  // namespace

void record_move(Recorder& rec, const Problem& from, const Problem& to) {
  const auto scope = rec.scope("move");
  const Slice<gpu::Control>& control = to.ws.control;
  const bool stays =
      control.buffer == from.ws.control.buffer && control.offset == from.ws.control.offset;
  if (!stays) record_copies(rec, from, to.ws);
  rec.fill(word_of(control, offsetof(gpu::Control, capacity)), to.ws.capacity);
  rec.fill(word_of(control, offsetof(gpu::Control, pauses)),
           to.options.pauseWhenFull != VK_FALSE ? 1u : 0u, Order::kIndependent);
  rec.fill(word_of(control, offsetof(gpu::Control, known_lower)),
           std::bit_cast<uint32_t>(to.options.knownLower), Order::kIndependent);
  rec.stage("move");
}

}  // namespace vkh
