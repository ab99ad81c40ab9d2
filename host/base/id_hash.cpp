#include "host/base/id_hash.h"

namespace vkh {

uint64_t hash_of_id(std::string_view id) {
  uint64_t hash = 0xcbf29ce484222325;
  for (const char c : id) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  hash = (hash ^ (hash >> 33)) * 0xff51afd7ed558ccd;  // MurmurHash3's finalizer
  return hash ^ (hash >> 33);
}

}  // namespace vkh
