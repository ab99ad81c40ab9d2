// The arithmetics in which the shared headers must keep their bounds: Vulkan leaves the rounding
// direction of + - * undefined and lets results below 2^-126 be flushed to zero.
// The file that uses this is compiled with -frounding-math.
#pragma once

#include <xmmintrin.h>

#include <array>
#include <cstdint>
#include <cstdlib>
#include <type_traits>

namespace vkh::test {

struct Arithmetic {
  const char* name;
  uint32_t rounding;  ///< _MM_ROUND_*
  bool flush;         ///< denormal inputs and results are 0

  bool nearest() const { return rounding == _MM_ROUND_NEAREST; }
};

inline constexpr std::array<Arithmetic, 8> kArithmetics = {{
    {"nearest", _MM_ROUND_NEAREST, false},
    {"up", _MM_ROUND_UP, false},
    {"down", _MM_ROUND_DOWN, false},
    {"toward zero", _MM_ROUND_TOWARD_ZERO, false},
    {"nearest, flushed", _MM_ROUND_NEAREST, true},
    {"up, flushed", _MM_ROUND_UP, true},
    {"down, flushed", _MM_ROUND_DOWN, true},
    {"toward zero, flushed", _MM_ROUND_TOWARD_ZERO, true},
}};

/// A function of its own, with its inputs in memory: no operation of f moves across the change of
/// mode (GCC lets them, -frounding-math or not: bug 34678).
template <class F>
[[gnu::noinline]] auto behind_a_barrier(const F& f) {
  asm volatile("" ::: "memory");
  auto result = f();
  asm volatile("" : : "r"(&result) : "memory");
  return result;
}

/// f() in that arithmetic; the caller's own comes back after it.
template <class F>
auto under(const Arithmetic& arithmetic, const F& f) {
  constexpr uint32_t kDenormalsAreZero = 0x40;
  const uint32_t before = _mm_getcsr();
  const uint32_t kept = before & ~(_MM_ROUND_MASK | _MM_FLUSH_ZERO_MASK | kDenormalsAreZero);
  _mm_setcsr(kept | arithmetic.rounding |
             (arithmetic.flush ? _MM_FLUSH_ZERO_ON | kDenormalsAreZero : 0u));
  auto result = behind_a_barrier(f);
  _mm_setcsr(before);
  return result;
}

/// Cases of each test: VKH_CASES, or 100,000; under sanitizers, 10 times slower, a tenth of them.
inline uint64_t case_count() {
  const char* given = std::getenv("VKH_CASES");
  const uint64_t count = given ? std::strtoull(given, nullptr, 10) : 0;
#ifdef VKH_SANITIZED
  constexpr uint64_t kUsual = 10'000;
#else
  constexpr uint64_t kUsual = 100'000;
#endif
  return count > 0 ? count : kUsual;
}

}  // namespace vkh::test
