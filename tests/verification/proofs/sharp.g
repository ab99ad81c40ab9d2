#@ theorem sharp_norm_above_up(v, base) is at least abs(v) - base
#@ quote certified.h: if (!(x.hi > 1e-30f)) return raised(round_up(norm_up(v.hi) + norm_up(v.lo), {short}f) - base);
#@ quote certified.h: VKH_FN float sharp_norm_above_up(Two3 v, float base) { Two x = two_dot(v, v);
#@ quote certified.h: float s = root(x.hi); Two square = two_product(s, s); float e = ((x.hi - square.hi) - square.lo) + x.lo;
#@ quote certified.h: return raised((s - base) + ({half}f * ratio(e, s) + {length}f * kUlp2 * s));
#@ quote certified.h: VKH_FN float ratio(float a, float b) { float quotient = a / b;
#@ quote certified.h: VKH_FN float raised(float x) { return x + ({raised}f * kUlp * abs(x) + kTiny); }
#@ weakest length: holds at 15, fails at 14.8
#@ weakest kUlp2: holds at 2^-44, fails at 2^-45
#@ weakest raised: holds at 3.01, fails at 2.9
#@ let quotient = 2.5 * ulp
#@ let G = raised * kUlp * (1 - 4 * ulp) - 2.001 * ulp
# By hand. For any s > 0, abs(v) = sqrt(N) <= s + (N - s^2) / (2 s). Lengths are in units of s, so s = 1: every operation but
# a flush is relative. XH and XL are x's parts, N = XH + XL + X (two_dot's claim, and its own low times low), PH = 1 + P and
# -P square's (two_product is exact), b the base. W is what raised is given, before its rounding; raised(W (1 + T)) >= W +
# G abs(W), with G from moved.g's factors less that rounding, T. So W + G abs(W) >= abs(v) - base is to be shown. Where s and
# the base are within a factor of 2, s - base is exact (Sterbenz). Elsewhere it is s / 2 at least: over it, all else is small.
# Flushes: x is off by under 2^-116, over 2 s that is under 2^-66 and under the kTiny / 2 of raised.
#@ case the quotient: within 52 kUlp^2 of (N - s^2) / (2 s), and small
e1 := XH - (1 + P);
e2 := e1 - -P;
e := e2 + XL;
d :quotient= e * 1;
{ XH - 1 in @{both(12.001 * ulp)} /\ XL in @{both(1.001 * ulp)} /\ P in @{both(ulp)} /\ X in @{both((two_dot + 1.01) * ulp * ulp * 1.001)}
  -> d * @{half} - ((XH + XL + X) - 1) * 1b-1 in @{both(52 * ulp * ulp)} /\ d * @{half} in @{both(7.6 * ulp)} }
d * @{half} - ((XH + XL + X) - 1) * 1b-1
  -> ((d - d_exact) + (e - e_exact) + (e2 - e2_exact) + (e1 - e1_exact) - X) * 1b-1;
XH - (1 + P) -> (XH - 1) - P;
#@ case s - base is exact
inner := H + @{length * kUlp2};
{ H in @{both(7.6 * ulp)} /\ OFF in @{both(52 * ulp * ulp)} -> (inner - inner_exact) + OFF + @{length * kUlp2} >= 0 }
#@ case it is not: all over abs(s - base), at least s / 2. S is its rounding
{ S in @{both(ulp)} /\ IN in @{both(15.3 * ulp)} /\ OFF in @{both(104 * ulp * ulp)} /\ R1 in @{both(ulp)}
  -> S + R1 * IN + OFF + @{G} * (1 - 20 * @{ulp}) >= 0 }
