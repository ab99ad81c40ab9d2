// The floating-point environment that the host's arithmetic needs, in place of the caller's.
#pragma once

#include <cfenv>
#include <cfloat>
#include <limits>
#if defined(__SSE2__) || defined(_M_X64)
#define VKH_SSE 1
#include <xmmintrin.h>
#endif

namespace vkh {

#ifdef __FAST_MATH__
#error "not with -ffast-math: the bounds rest on every operation as it is written"
#endif
static_assert(FLT_EVAL_METHOD == 0, "a double operation is rounded to double, and once");
static_assert(std::numeric_limits<double>::is_iec559 && std::numeric_limits<float>::is_iec559);

/// While this object lives, its thread rounds to nearest, flushes nothing to zero and traps
/// nothing. The destructor restores the caller's state, with its exception flags. Libraries that
/// are linked with -ffast-math leave threads that flush. Every public boundary has one.
class FloatEnvironment {
 public:
  FloatEnvironment() { enter(); }
  ~FloatEnvironment() { leave(); }
  FloatEnvironment(const FloatEnvironment&) = delete;
  FloatEnvironment& operator=(const FloatEnvironment&) = delete;

  /// Calls the caller's f in the caller's environment; f's changes to it are kept.
  template <class F>
  auto outside(const F& f) {
    const Outside guard(*this);
    return f();
  }

 private:
  struct Outside {
    explicit Outside(FloatEnvironment& environment) : inside(environment) { inside.leave(); }
    ~Outside() { inside.enter(); }
    Outside(const Outside&) = delete;
    Outside& operator=(const Outside&) = delete;
    FloatEnvironment& inside;
  };

  // C libraries differ in whether their default environment flushes, and mingw-w64's (10.0) leaves
  // the control register of SSE as it was, its rounding too: so that register is set here. On
  // AArch64 the default is a control register of 0, which flushes nothing.
  void enter() {
    std::fegetenv(&callers_);
#ifdef VKH_SSE
    constexpr unsigned kDefaultControl = 0x1f80;  // to nearest; all traps masked; no flag raised
    callers_control_ = _mm_getcsr();
    std::fesetenv(FE_DFL_ENV);
    _mm_setcsr(kDefaultControl);
#else
    std::fesetenv(FE_DFL_ENV);
#endif
  }

  void leave() {
    std::fesetenv(&callers_);
#ifdef VKH_SSE
    _mm_setcsr(callers_control_);
#endif
  }

  std::fenv_t callers_{};
#ifdef VKH_SSE
  unsigned callers_control_ = 0;
#endif
};

}  // namespace vkh
