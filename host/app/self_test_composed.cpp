// The host's side of the self-test's composed expressions, in Float128 (113 bits): each is held to
// the bound that the certificate assumes for it (two_float.h, certified.h).
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>

#include "host/app/self_test.h"
#include "host/base/float128.h"
#include "host/base/hypot3.h"

namespace vkh {
namespace {

using Operands = gpu::SelfTestOperands;
using Composed = gpu::SelfTestComposed;

constexpr double kUlp = 0x1p-23;
constexpr double kUlp2 = 0x1p-44;
constexpr double kTiny = 0x1p-60;
constexpr double kOwnRounding = 1 - 0x1p-50;  // rounding of lengths in double that bounds use

Float128 as_float128(float x) { return float128(static_cast<double>(x)); }
double number(Float128 x) { return static_cast<double>(x); }

Float128Vector pair(const gpu::vec3& hi, const gpu::vec3& lo) {
  return {as_float128(hi.x) + as_float128(lo.x), as_float128(hi.y) + as_float128(lo.y),
          as_float128(hi.z) + as_float128(lo.z)};
}

/// The length, off by at most 2^-50 of itself.
double rough_length(const Float128Vector& v) {
  return hypot3(number(v.x), number(v.y), number(v.z));
}

/// w times the power of two that brings its largest component into [1, 2).
Float128Vector scaled(const Float128Vector& w, const gpu::vec3& hi) {
  const float largest = std::max({std::abs(hi.x), std::abs(hi.y), std::abs(hi.z)});
  return float128(std::ldexp(1.0, -std::ilogb(largest))) * w;
}

/// A random low part of at most half an ulp of hi.
float low_part(uint64_t& state, float hi) {
  const float most = std::ldexp(1.0f, std::ilogb(hi) - 24);
  return std::clamp(hard_float(state, -3, 0) * most, -most, most);
}

gpu::vec3 low_parts(uint64_t& state, const gpu::vec3& hi) {
  return {low_part(state, hi.x), low_part(state, hi.y), low_part(state, hi.z)};
}

void draw_vector(uint64_t& state, gpu::vec3& hi, gpu::vec3& lo) {
  hi = {hard_float(state, -12, 0), hard_float(state, -12, 0), hard_float(state, -12, 0)};
  lo = low_parts(state, hi);
}

/// A random base just under `value`, or 0.
float base_under(uint64_t& state, double value) {
  const uint64_t way = draw(state) & 3u;
  return way == 0 ? 0.0f
                  : static_cast<float>(value * (1 - std::ldexp(1.0, -10 * static_cast<int>(way))));
}

class ComposedJudge {
 public:
  ComposedJudge(const Operands& q, const Composed& c, SelfTestResult& result)
      : q_(q),
        c_(c),
        result_(result),
        u_(pair(q.u_hi, q.u_lo)),
        v_(pair(q.v_hi, q.v_lo)),
        w_(pair(q.w_hi, q.w_lo)) {}

  void all() {
    sums();
    lengths();
    quotients();
  }

 private:
  void sums() {
    const Float128Vector difference = u_ - v_;
    const double sizes = rough_length(u_) + rough_length(v_);
    near("two_difference(u, v)",
         rough_length(difference - pair(c_.difference_hi, c_.difference_lo)), kUlp2 * sizes);
    const Float128Vector combination = u_ + (as_float128(q_.x) * v_ + as_float128(q_.y) * w_);
    near("two_combination(u, x, v, y, w)",
         rough_length(combination - pair(c_.combination_hi, c_.combination_lo)),
         4 * kUlp2 *
             (rough_length(u_) + std::abs(q_.x) * rough_length(v_) +
              std::abs(q_.y) * rough_length(w_)));
    near("two_dot(u, v)",
         number(magnitude(dot(u_, v_) - (as_float128(c_.dot_hi) + as_float128(c_.dot_lo)))),
         8 * kUlp2 * rough_length(u_) * rough_length(v_));
    const Float128Vector coarse = pair(c_.coarse, {});
    near("coarse_difference(u, v)", rough_length(difference - coarse),
         2 * kUlp * rough_length(difference) + kUlp2 * sizes);
  }

  /// Compares squares: no root is taken in Float128.
  void lengths() {
    const Float128 square = dot(u_, u_);
    const Float128 norm = as_float128(c_.norm),
                   above = as_float128(q_.norm_base) + as_float128(c_.norm_above);
    promise(norm >= 0 && norm * norm >= square, "sharp_norm_up(u)", number(norm));
    promise(above >= 0 && above * above >= square, "sharp_norm_above_up(u, base)", number(above));
    // The lengths are no looser than they are specified to be.
    const double size = rough_length(u_);
    near("sharp_norm_up(u)", number(norm) - size, 8 * kUlp * size);
    near("sharp_norm_above_up(u, base)", number(above - float128(size)),
         12 * kUlp * std::abs(size - static_cast<double>(q_.norm_base)) +
             64 * kUlp2 * (size + static_cast<double>(q_.norm_base)) + 4 * kTiny);
  }

  void quotients() {
    const Float128 down = as_float128(c_.quotient);
    promise(down >= 0 && down * magnitude(as_float128(q_.x)) <= as_float128(q_.reach_hi),
            "quotient_down(a, b)", number(down));
    // base + above <= reach / |r|, whose sides are positive or the left one is not.
    const Float128Vector r = scaled(w_, q_.w_hi);
    const Float128 above = as_float128(q_.quotient_base) + as_float128(c_.quotient_above);
    const Float128 reach = as_float128(q_.reach_hi) + as_float128(q_.reach_lo);
    promise(above <= 0 || above * above * dot(r, r) <= reach * reach,
            "quotient_above_down(reach, 0, r, base)", number(above));
    promise(above >= float128(-kTiny * 4), "quotient_above_down(reach, 0, r, base)", number(above));
  }

  void near(const char* what, double off, double allowed) {
    promise(off <= allowed / kOwnRounding + 0x1p-100, what, off);  // NaN fails
  }

  void promise(bool kept, const char* what, double got) {
    if (kept || !result_.fault.empty()) return;
    char text[48];
    std::snprintf(text, sizeof text, "%a", got);
    result_.fault = std::string(what) + " is off: " + text +
                    "; so it is where a driver regroups sums that are decorated NoContraction";
  }

  const Operands& q_;
  const Composed& c_;
  SelfTestResult& result_;
  Float128Vector u_, v_, w_;
};

}  // namespace

std::vector<Operands> composed_questions(uint64_t seed, uint32_t count) {
  std::vector<Operands> questions(count);
  uint64_t state = seed ^ 0x636f6d706f736564u;
  for (Operands& q : questions) {
    draw_vector(state, q.u_hi, q.u_lo);
    draw_vector(state, q.v_hi, q.v_lo);
    draw_vector(state, q.w_hi, q.w_lo);
    // Next to u, so that the difference cancels.
    if ((draw(state) & 3u) == 0) {
      q.v_hi = q.u_hi;
      q.v_lo = low_parts(state, q.v_hi);
    }
    q.x = hard_float(state, -20, 0);
    q.y = hard_float(state, -20, 0);
    q.reach_hi = std::abs(hard_float(state, -12, 0));
    q.reach_lo = low_part(state, q.reach_hi);
    q.norm_base = base_under(state, rough_length(pair(q.u_hi, q.u_lo)));
    const double r = rough_length(scaled(pair(q.w_hi, q.w_lo), q.w_hi));
    q.quotient_base = base_under(state, static_cast<double>(q.reach_hi) / r);
  }
  return questions;
}

void judge_composed(std::span<const Operands> operands, std::span<const Composed> results,
                    SelfTestResult& result) {
  for (size_t i = 0; i < operands.size(); ++i) ComposedJudge(operands[i], results[i], result).all();
  result.composed += operands.size();
}

}  // namespace vkh
