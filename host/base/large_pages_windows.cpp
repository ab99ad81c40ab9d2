#include "host/base/large_pages.h"

namespace vkh {

// Does nothing: on Windows large pages need a privilege.
void prefer_large_pages(void*, size_t) {}

}  // namespace vkh
