// operator new that fails on purpose, for allocations of our own code alone: the caller, or the
// caller of the C++ library, lies in the program itself. Drivers in the same process are not hit.
// To be included once, by the test, or by the library that is loaded before the program.
#pragma once

#include <execinfo.h>
#include <link.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <new>

namespace vkh::test {

struct Range {
  uintptr_t begin = UINTPTR_MAX, end = 0;
  bool has(const void* address) const {
    const auto at = reinterpret_cast<uintptr_t>(address);
    return at >= begin && at < end;
  }
};

struct FailingNew {
  Range program, library;  // ours; the C++ library
  std::atomic<uint64_t> count = 0, first = 0;
  std::atomic<bool> counts = false, onwards = false;

  /// From now on counts, and fails the `n`-th; 0: none.
  void arm(uint64_t n, bool all_after_it) {
    if (program.end == 0) {
      dl_iterate_phdr(see, this);
      std::array<void*, 4> frames{};
      backtrace(frames.data(), 4);  // loads what it needs
    }
    count = 0;
    first = n;
    onwards = all_after_it;
    counts = true;
  }
  uint64_t disarm() {
    counts = false;
    return count;
  }

  bool is_due(const void* caller) {
    if (!counts || !is_ours(caller)) return false;
    const uint64_t n = ++count;
    return first != 0 && (onwards ? n >= first : n == first);
  }

 private:
  static int see(dl_phdr_info* info, size_t, void* self) {
    auto& failing = *static_cast<FailingNew*>(self);
    const bool is_program = info->dlpi_name[0] == '\0' && failing.program.end == 0;
    const bool is_library = std::strstr(info->dlpi_name, "libstdc++") != nullptr;
    if (!is_program && !is_library) return 0;
    Range& range = is_program ? failing.program : failing.library;
    for (int i = 0; i < info->dlpi_phnum; ++i) {
      const auto& header = info->dlpi_phdr[i];
      if (header.p_type != PT_LOAD) continue;
      const uintptr_t begin = info->dlpi_addr + header.p_vaddr;
      range.begin = begin < range.begin ? begin : range.begin;
      range.end = begin + header.p_memsz > range.end ? begin + header.p_memsz : range.end;
    }
    return 0;
  }

  bool is_ours(const void* caller) const {
    if (program.has(caller)) return true;
    if (!library.has(caller)) return false;
    std::array<void*, 16> frames{};
    const int depth = backtrace(frames.data(), static_cast<int>(frames.size()));
    int at = 0;
    while (at < depth && !library.has(frames[static_cast<size_t>(at)])) ++at;
    while (at < depth && library.has(frames[static_cast<size_t>(at)])) ++at;
    return at < depth && program.has(frames[static_cast<size_t>(at)]);
  }
};

inline FailingNew& failing_new() {
  static FailingNew one;
  return one;
}

}  // namespace vkh::test

// The operators are not inline, and every library of the process sees them.
__attribute__((visibility("default"))) void* operator new(size_t size) {
  if (vkh::test::failing_new().is_due(__builtin_return_address(0))) throw std::bad_alloc();
  void* memory = std::malloc(size == 0 ? 1 : size);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}
// The sanitizers' own allocations would not pass through here.
__attribute__((visibility("default"))) void* operator new(size_t size,
                                                          const std::nothrow_t&) noexcept {
  if (vkh::test::failing_new().is_due(__builtin_return_address(0))) return nullptr;
  return std::malloc(size == 0 ? 1 : size);
}
__attribute__((visibility("default"))) void operator delete(void* memory) noexcept {
  std::free(memory);
}
__attribute__((visibility("default"))) void operator delete(void* memory, size_t) noexcept {
  std::free(memory);
}
