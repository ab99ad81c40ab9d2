#pragma once

namespace vkh::test {

/// Whether the sanitizers see this program. Their code is ten times as slow and its numbers are
/// the same: of tests that repeat a thing with other numbers they get a few cases of each kind.
#ifdef VKH_SANITIZED
inline constexpr bool kIsSanitized = true;
#else
inline constexpr bool kIsSanitized = false;
#endif

}  // namespace vkh::test
