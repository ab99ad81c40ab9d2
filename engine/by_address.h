// Buffers larger than a binding. A device binds maxStorageBufferRange bytes of a buffer, often no
// more than 128 MiB. A context for large meshes gives its kernels addresses of the buffers that
// hold a mesh or its BVH, behind the push constants. The other buffers are bound. The
// kernels' words are rewritten for it when the context is created, so that a shader is written
// once.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "engine/command.h"

namespace vkh {

// The place of the addresses among the push constants: in the order of the bindings, 8 bytes each.
constexpr uint32_t kAddressOffset = kMaxPushBytes;
constexpr uint32_t kMaxAddresses = 8;  // 128 bytes of push constants are on every device

// The bindings, as bits, that become addresses: those of more than 4 bytes per face of a mesh.
constexpr uint32_t bindings_by_address(std::span<const Binding> bindings) {
  constexpr std::array<std::string_view, 13> large{
      "vertex_words", "index_words", "low_words",     "vertices", "indices",  "faces", "b_vertices",
      "b_faces",      "triangles",   "triangle_lows", "nodes",    "branches", "boxes"};
  uint32_t bits = 0;
  for (const Binding& b : bindings) {
    if (std::find(large.begin(), large.end(), b.name) != large.end()) bits |= 1u << b.binding;
  }
  return bits;
}

// Returns the kernel with those bindings as addresses. The words are of SPIR-V 1.5 and keep the
// convention of tools/kernels/embed_shaders.py: one block a binding, each with one member; one
// struct of push constants. Throws std::bad_alloc.
std::vector<uint32_t> by_address(std::span<const uint32_t> words, uint32_t bindings);

}  // namespace vkh
