#include <sys/mman.h>

#include <cstdint>

#include "host/base/large_pages.h"

namespace vkh {

#if defined(MADV_HUGEPAGE)
void prefer_large_pages(void* begin, size_t bytes) {
  constexpr uintptr_t kPage = uintptr_t{1} << 21;
  const auto at = reinterpret_cast<uintptr_t>(begin);
  const uintptr_t first = (at + kPage - 1) / kPage * kPage, end = (at + bytes) / kPage * kPage;
  if (first >= end) return;
  (void)madvise(static_cast<std::byte*>(begin) + (first - at), end - first, MADV_HUGEPAGE);
}
#else
void prefer_large_pages(void*, size_t) {}
#endif

}  // namespace vkh
