// The targets of hill climbs: every certified bound of the shared headers, each as the excess of
// its result over the bound. Include after VKH_TEST_VULKAN_MODEL is defined, first.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "tests/verification/model/lib_device.h"
#include "tests/verification/oracle/wide.h"

namespace vkh::test {

inline constexpr Wide kUlpWide = 0x1p-23L;

inline Wide exact(math::Real x) { return static_cast<Wide>(static_cast<float>(x)); }
inline Wide exact(const math::Two& x) { return exact(x.hi) + exact(x.lo); }
inline WideVector exact(const math::vec3& v) { return {exact(v.x), exact(v.y), exact(v.z)}; }
inline WideVector exact(const math::Two3& v) { return exact(v.hi) + exact(v.lo); }

/// The inputs of a target, read in order.
class Inputs {
 public:
  explicit Inputs(const std::vector<float>& values) : values_(values) {}
  float next() { return values_[at_++]; }
  float non_negative() { return std::abs(next()); }
  float weight() { return std::min(std::abs(next()), 1.0f); }
  math::vec3 vector() {
    const float x = next(), y = next();
    return {x, y, next()};
  }
  /// A low part is at most half an ulp of its high part.
  math::Two3 two3() {
    math::Two3 out;
    out.hi = vector();
    const math::vec3 lo = vector();
    out.lo = {low(out.hi.x, lo.x), low(out.hi.y, lo.y), low(out.hi.z, lo.z)};
    return out;
  }

 private:
  static float low(math::Real hi, math::Real lo) {
    const float h = static_cast<float>(hi), l = static_cast<float>(lo);
    if (h == 0.0f) return 0.0f;
    const float half_ulp = std::ldexp(1.0f, std::ilogb(h) - 24);
    return l == 0.0f ? 0.0f : std::copysign(half_ulp * std::abs(std::frexp(l, &ignored_)), l);
  }
  inline static int ignored_ = 0;
  const std::vector<float>& values_;
  size_t at_ = 0;
};

/// The excess of a result over its bound, in units of the bound's own error term: > 0 is a
/// violation.
using Excess = Wide (*)(Inputs&);
struct Target {
  const char* name;
  size_t inputs;
  Excess excess;
};

inline Wide below(Wide bound, Wide value) {
  return value > 0 ? (value - bound) / (value * kUlpWide) : 0;
}
inline Wide above(Wide bound, Wide value) {
  return value > 0 ? (bound - value) / (value * kUlpWide) : 0;
}
inline Wide over(Wide error, Wide allowed) { return allowed > 0 ? error / allowed - 1 : -1; }

inline Wide attack_norm_up(Inputs& in) {
  const math::vec3 v = in.vector();
  return below(exact(math::norm_up(v)), size(exact(v)));
}
inline Wide attack_norm_down(Inputs& in) {
  const math::vec3 v = in.vector();
  return above(exact(math::norm_down(v)), size(exact(v)));
}
inline Wide attack_length_up(Inputs& in) {
  const math::vec3 v = in.vector();
  return below(exact(math::length_up(math::dot3(v, v))), size(exact(v)));
}
inline Wide attack_sqrt_up(Inputs& in) {
  const float x = in.non_negative();
  return below(exact(math::sqrt_up(x)), std::sqrt(static_cast<Wide>(x)));
}
inline Wide attack_sqrt_down(Inputs& in) {
  const float x = in.non_negative();
  return above(exact(math::sqrt_down(x)), std::sqrt(static_cast<Wide>(x)));
}
inline Wide attack_sharp_norm(Inputs& in) {
  const math::Two3 v = in.two3();
  return below(exact(math::sharp_norm_up(v)), size(exact(v)));
}
/// The base is next to |v| or anything.
inline math::Real base_for(Inputs& in, Wide length) {
  const float any = in.non_negative();
  const float near = static_cast<float>(length * (1 - static_cast<Wide>(any) * 0x1p-10L));
  return in.next() < 0 ? any : std::max(near, 0.0f);
}
inline Wide term_above(Wide length, Wide base) {
  return std::abs(length - base) * kUlpWide + 0x1p-44L * (length + base);
}
inline Wide attack_norm_above(Inputs& in) {
  const math::Two3 v = in.two3();
  const Wide length = size(exact(v));
  const math::Real base = base_for(in, length);
  const Wide got = exact(base) + exact(math::sharp_norm_above_up(v, base));
  return (length - got) / term_above(length, exact(base));
}
inline Wide attack_quotient_above(Inputs& in) {
  const math::Two3 r = math::scaled(in.two3());
  const math::Two3 other = in.two3();
  math::Two reach;
  reach.hi = math::abs(other.hi.x);
  reach.lo = other.hi.x < 0.0f ? -other.lo.x : other.lo.x;
  const math::Real off = in.non_negative() * 0x1p-30f;
  const Wide length = size(exact(r));
  if (length < 1) return -100;
  const Wide quotient = std::max<Wide>((exact(reach) - exact(off)) / length, 0);
  const math::Real base = base_for(in, quotient);
  const Wide got = exact(base) + exact(math::quotient_above_down(reach, off, r, base));
  return (got - quotient) / term_above(quotient, exact(base));
}
inline Wide attack_quotient(Inputs& in) {
  const float a = in.non_negative(), b = in.non_negative();
  return above(exact(math::quotient_down(a, b)), static_cast<Wide>(a) / static_cast<Wide>(b));
}
/// One sum of two, rounded: one ulp, which round_up(., 1) must take.
inline Wide attack_round_up(Inputs& in) {
  const float a = in.non_negative(), b = in.non_negative();
  const math::Real sum = math::Real(a) + math::Real(b);
  return below(exact(math::round_up(sum, 1.0f)), static_cast<Wide>(a) + static_cast<Wide>(b));
}
inline Wide attack_round_down(Inputs& in) {
  const float a = in.non_negative(), b = in.non_negative();
  const math::Real sum = math::Real(a) + math::Real(b);
  return above(exact(math::round_down(sum, 1.0f)), static_cast<Wide>(a) + static_cast<Wide>(b));
}

inline Wide attack_two_sum(Inputs& in) {
  const float a = in.next(), b = in.next();
  const Wide error = static_cast<Wide>(a) + static_cast<Wide>(b) - exact(math::two_sum(a, b));
  return over(
      std::abs(error),
      exact(math::kUlp2) / 2 * (std::abs(static_cast<Wide>(a)) + std::abs(static_cast<Wide>(b))));
}
inline Wide attack_two_product(Inputs& in) {
  const float a = in.next(), b = in.next();
  const Wide product = static_cast<Wide>(a) * static_cast<Wide>(b);
  return over(std::abs(product - exact(math::two_product(a, b))),
              exact(math::kUlp2) / 2 * std::abs(product));
}
inline Wide attack_difference(Inputs& in) {
  const math::Two3 a = in.two3(), b = in.two3();
  const WideVector error = exact(a) - exact(b) - exact(math::two_difference(a, b));
  return over(size(error), exact(math::kUlp2) * (size(exact(a)) + size(exact(b))));
}
inline Wide attack_combination(Inputs& in) {
  const math::Two3 base = in.two3(), u = in.two3(), v = in.two3();
  const float x = in.next(), y = in.next();
  const Wide wx = static_cast<Wide>(x), wy = static_cast<Wide>(y);
  const WideVector whole = exact(base) + wx * exact(u) + wy * exact(v);
  const WideVector error = whole - exact(math::two_combination(base, x, u, y, v));
  const Wide sizes =
      size(exact(base)) + std::abs(wx) * size(exact(u)) + std::abs(wy) * size(exact(v));
  return over(size(error), 4 * exact(math::kUlp2) * sizes);
}
inline Wide attack_dot(Inputs& in) {
  const math::Two3 a = in.two3(), b = in.two3();
  const Wide error = dot(exact(a), exact(b)) - exact(math::two_dot(a, b));
  return over(std::abs(error), 8 * exact(math::kUlp2) * size(exact(a)) * size(exact(b)));
}

inline Wide attack_placement(Inputs& in) {
  const math::Two3 a = in.two3(), b = in.two3(), c = in.two3();
  const auto bary = [&] {
    const auto j = static_cast<uint32_t>(in.weight() * static_cast<float>(gpu::kBaryOne));
    const auto k = static_cast<uint32_t>(in.weight() * static_cast<float>(gpu::kBaryOne - j));
    return glm::uvec2(j, k);
  };
  math::Bary3 t;
  t.a = bary();
  t.b = bary();
  t.c = t.a;
  const math::LocalCorners p = math::local_corners(math::make_root(a, b, c), t);
  const auto at = [&](const glm::uvec2& q) {
    return exact(a) + (static_cast<Wide>(q.x) * 0x1p-20L) * (exact(b) - exact(a)) +
           (static_cast<Wide>(q.y) * 0x1p-20L) * (exact(c) - exact(a));
  };
  // A cut between the two, as bound_pair makes it.
  const float cut = in.weight();
  const math::Two3 none = math::two(math::vec3(0.0f, 0.0f, 0.0f));
  const math::Two3 q =
      math::two_combination(none, cut, math::two_difference(p.b, none), 0.0f, none);
  const WideVector between = at(t.a) + static_cast<Wide>(cut) * (at(t.b) - at(t.a));
  const Wide corner = size(exact(p.origin) + exact(p.b) - at(t.b));
  return over(std::max(corner, size(exact(p.origin) + exact(q) - between)), exact(p.slack));
}

inline math::Surface surface_of(Inputs& in, math::Two3& origin, math::Two3& p, float reach_factor,
                                float enough = 0.0f) {
  const math::Two3 a = in.two3(), b = in.two3(), c = in.two3();
  origin = in.two3();
  p = in.two3();
  math::View from{};
  from.origin = origin;
  const Wide reach = std::max(size(exact(origin)), size(exact(p)));
  from.reach = float_up(static_cast<double>(reach) * (1 + 0x1p-50)) * reach_factor;
  from.sharp = true;
  from.enough = enough;
  return math::make_surface(a, b, c, from);
}

inline Wide attack_offset(Inputs& in) {
  Inputs again = in;
  math::Two3 origin, p;
  const math::Surface s = surface_of(in, origin, p, 1.0f);
  const WideVector a = exact(again.two3()), b = exact(again.two3()), c = exact(again.two3());
  const float v = in.weight(), w = std::min(in.weight(), 1.0f - v);
  math::Closest at;
  at.feature = math::kInside;
  at.v = v;
  at.w = std::max(w, 0.0f);
  const WideVector point = a + exact(at.v) * (b - a) + exact(at.w) * (c - a);
  const WideVector offset = exact(origin) + exact(p) - point;
  return over(size(offset - exact(math::offset_from(p, s, at))), exact(s.slack));
}

inline Wide attack_plain(Inputs& in) {
  Inputs again = in;
  math::Two3 origin, p;
  const math::Surface s = surface_of(in, origin, p, 1.0f, 1e30f);
  const std::array<WideVector, 3> t = {exact(again.two3()), exact(again.two3()),
                                       exact(again.two3())};
  const Wide square = exact(math::plain_distance2(math::rounded(p), s.at));
  const Wide got = std::sqrt(static_cast<long double>(square)) * (1 + 7 * kUlpWide);
  return over(std::max<Wide>(distance(exact(origin) + exact(p), t) - got, 0), exact(s.slack));
}

inline math::Corners corners_of(Inputs& in) {
  math::Corners t;
  t.a = in.vector();
  t.b = in.vector();
  t.c = in.vector();
  return t;
}

inline Wide attack_radius(Inputs& in) {
  const math::Corners t = corners_of(in);
  const WideVector ab = exact(t.b) - exact(t.a), ac = exact(t.c) - exact(t.a);
  const Wide longest = std::max({size(ab), size(ac), size(ac - ab)});
  return below(exact(math::enclosing_radius_up(t)), longest / 2);  // of any ball that holds it
}
inline Wide attack_u1(Inputs& in) {
  const math::Corners t = corners_of(in);
  math::Patch patch;
  patch.at = t;
  const math::vec3 d(in.non_negative(), in.non_negative(), in.non_negative());
  const Wide ab = size(exact(t.b) - exact(t.a)), ac = size(exact(t.c) - exact(t.a)),
             bc = size(exact(t.c) - exact(t.b));
  const Wide bound = std::min({exact(d.x) + std::max(ab, ac), exact(d.y) + std::max(ab, bc),
                               exact(d.z) + std::max(bc, ac)});
  return below(exact(math::bound_u1(patch, d)), bound);
}
inline Wide attack_u2(Inputs& in) {
  const math::Corners t = corners_of(in);
  math::Patch patch;
  patch.at = t;
  const math::vec3 d(in.non_negative(), in.non_negative(), in.non_negative());
  const WideVector ab = exact(t.b) - exact(t.a), ac = exact(t.c) - exact(t.a);
  const Wide longest = std::max({size(ab), size(ac), size(ac - ab)});
  return below(exact(math::bound_u2(patch, d)),
               longest / 2 + std::max({exact(d.x), exact(d.y), exact(d.z)}));
}

/// The largest value of min over the corners of (p - s).r / |r|: both separations claim it.
inline Wide separation(const std::array<WideVector, 3>& s, const WideVector& r) {
  return std::min({-dot(s[0], r), -dot(s[1], r), -dot(s[2], r)}) / size(r);
}
inline Wide attack_separation(Inputs& in, bool fine) {
  Inputs again = in;
  math::Two3 origin, p;
  const math::Surface s = surface_of(in, origin, p, 1.0f);
  const std::array<WideVector, 3> corner = {exact(again.two3()) - exact(origin),
                                            exact(again.two3()) - exact(origin),
                                            exact(again.two3()) - exact(origin)};
  const math::Two3 r = in.two3();
  const math::Real got =
      fine ? math::fine_separation_down(s, r) : math::coarse_distance_down(s, r.hi);
  const Wide claim = separation(corner, fine ? exact(r) : exact(r.hi));
  const Wide radius = std::max({size(corner[0]), size(corner[1]), size(corner[2])});
  if (exact(got) <= 0) return -100;
  return fine ? over(exact(got) - std::max<Wide>(claim, 0) + exact(s.slack), exact(s.slack))
              : (exact(got) - std::max<Wide>(claim, 0)) / (radius * kUlpWide);
}
inline Wide attack_fine(Inputs& in) { return attack_separation(in, true); }
inline Wide attack_coarse(Inputs& in) { return attack_separation(in, false); }

inline constexpr Target kTargets[] = {{"norm_up", 3, attack_norm_up},
                                      {"norm_down", 3, attack_norm_down},
                                      {"length_up", 3, attack_length_up},
                                      {"sqrt_up", 1, attack_sqrt_up},
                                      {"sqrt_down", 1, attack_sqrt_down},
                                      {"sharp_norm_up", 6, attack_sharp_norm},
                                      {"quotient_down", 2, attack_quotient},
                                      {"round_up", 2, attack_round_up},
                                      {"sharp_norm_above_up", 8, attack_norm_above},
                                      {"quotient_above_down", 15, attack_quotient_above},
                                      {"round_down", 2, attack_round_down},
                                      {"two_sum", 2, attack_two_sum},
                                      {"two_product", 2, attack_two_product},
                                      {"two_difference", 12, attack_difference},
                                      {"two_combination", 20, attack_combination},
                                      {"two_dot", 12, attack_dot},
                                      {"local_corners", 24, attack_placement},
                                      {"offset_from", 33, attack_offset},
                                      {"plain_distance2", 31, attack_plain},
                                      {"enclosing_radius_up", 9, attack_radius},
                                      {"bound_u1", 12, attack_u1},
                                      {"bound_u2", 12, attack_u2},
                                      {"fine_separation_down", 36, attack_fine},
                                      {"coarse_distance_down", 36, attack_coarse}};

}  // namespace vkh::test
