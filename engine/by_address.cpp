#include "engine/by_address.h"

namespace vkh {

std::vector<uint32_t> edited(std::span<const uint32_t> words, std::span<const uint32_t> edits) {
  std::vector<uint32_t> out;
  out.reserve(words.size() + edits.size());
  const auto put = [&](std::span<const uint32_t> part) {
    out.insert(out.end(), part.begin(), part.end());
  };
  while (!edits.empty()) {
    const uint32_t kept = edits[0], left_out = edits[1], count = edits[2];
    put(words.first(kept));
    put(edits.subspan(3, count));
    words = words.subspan(kept + left_out);
    edits = edits.subspan(3 + count);
  }
  put(words);
  return out;
}

}  // namespace vkh
