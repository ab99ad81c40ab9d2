#include "host/base/large_pages.h"

namespace vkh {

// They need a privilege there.
void prefer_large_pages(void*, size_t) {}

}  // namespace vkh
