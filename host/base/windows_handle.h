// Windows handles, which our own headers keep as integers.
#pragma once

#include <windows.h>

#include <cstdint>

namespace vkh {

inline HANDLE handle_of(std::intptr_t value) { return reinterpret_cast<HANDLE>(value); }

}  // namespace vkh
