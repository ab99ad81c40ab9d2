// EXT_meshopt_compression, by meshoptimizer if it was there when this was built.
#pragma once

#include <string_view>
#include <vector>

#include "host/read/gltf_model.h"

namespace vkh::gltf {

inline uint64_t unpacked_bytes(const Packed& packed) {
  return uint64_t{packed.count} * packed.stride;
}

/// Returns null, or the error in its description: before anything is allocated.
const char* unpack_problem(const Packed& packed);

/// Returns false if the data are not whole.
bool unpack(const Packed& packed, std::string_view from, std::vector<char>& out);

}  // namespace vkh::gltf
