// Large pages beneath large arrays.
#pragma once

#include <cstddef>

namespace vkh {

/// Asks the system for large pages in memory that is filled next. Each page of 4 KiB is a fault as
/// it is first written to, and a tenth of the time of reading a large file. Only a hint: does
/// nothing where there are none, nor for arrays smaller than one, 2 MiB.
void prefer_large_pages(void* begin, size_t bytes);

}  // namespace vkh
