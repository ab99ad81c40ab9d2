// Buffers larger than a binding. A device binds maxStorageBufferRange bytes of a buffer, often no
// more than 128 MiB. A context for large meshes gives its kernels addresses of the buffers that
// hold a mesh or its BVH, behind the push constants. The other buffers are bound. The build makes
// those kernels of the same shaders (tools/kernels/by_address.py), and embeds them as edits.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace vkh {

// Returns the words after the edits. Each edit is the number of words to keep, the number to drop
// and the number to insert, followed by the inserted words. After the last edit the rest is kept.
// Throws std::bad_alloc.
std::vector<uint32_t> edited(std::span<const uint32_t> words, std::span<const uint32_t> edits);

}  // namespace vkh
