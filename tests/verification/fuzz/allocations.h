// The peak of a scope's allocations, by the hooks of the address sanitizer; without it nothing is
// counted.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#if defined(__SANITIZE_ADDRESS__)
#define VKH_COUNTS_ALLOCATIONS
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define VKH_COUNTS_ALLOCATIONS
#endif
#endif
#ifdef VKH_COUNTS_ALLOCATIONS
// The declaration of sanitizer/allocator_interface.h, which Debian's g++ 12 does not have.
extern "C" int __sanitizer_install_malloc_and_free_hooks(void (*on_malloc)(const volatile void*,
                                                                           size_t),
                                                         void (*on_free)(const volatile void*));
extern "C" size_t __sanitizer_get_allocated_size(const volatile void* block);
#endif

namespace vkh::test {

/// Use one at a time; it counts allocations of this thread.
class AllocationCount {
 public:
  AllocationCount() {
    install();
    state() = {.counts = true};
  }
  ~AllocationCount() { state().counts = false; }
  AllocationCount(const AllocationCount&) = delete;
  AllocationCount& operator=(const AllocationCount&) = delete;

  /// Bytes in use at most, above those at the start.
  int64_t peak() const { return state().peak; }

 private:
  struct State {
    bool counts = false;
    int64_t in_use = 0, peak = 0;
  };
  static State& state() {
    thread_local State of_thread;
    return of_thread;
  }

#ifdef VKH_COUNTS_ALLOCATIONS
  static void on_malloc(const volatile void*, size_t size) {
    State& s = state();
    if (!s.counts) return;
    s.in_use += static_cast<int64_t>(size);
    s.peak = std::max(s.peak, s.in_use);
  }
  static void on_free(const volatile void* block) {
    State& s = state();
    if (!s.counts || block == nullptr) return;
    s.in_use -= static_cast<int64_t>(__sanitizer_get_allocated_size(block));
  }
  static void install() {
    static const int once = __sanitizer_install_malloc_and_free_hooks(on_malloc, on_free);
    static_cast<void>(once);
  }
#else
  static void install() {}
#endif
};

}  // namespace vkh::test
