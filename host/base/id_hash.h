// A hash of names, for shards and files' names.
#pragma once

#include <cstdint>
#include <string_view>

namespace vkh {

/// FNV-1a of the id's bytes, mixed: the same on every machine.
uint64_t hash_of_id(std::string_view id);

}  // namespace vkh
