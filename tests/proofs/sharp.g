#@ theorem sharp_norm_above_up(v, base) is at least abs(v) - base
#@ quote certified.h: if (!(x.hi > 1e-30f)) return raised(round_up(norm_up(v.hi) + norm_up(v.lo), {short}f) - base);
#@ quote certified.h: VKH_FN float sharp_norm_above_up(Two3 v, float base) { Two x = two_dot(v, v);
#@ quote certified.h: float s = root(x.hi); Two square = two_product(s, s); float e = ((x.hi - square.hi) - square.lo) + x.lo; Two t = two_sum(s, -base);
#@ quote certified.h: return raised(t.hi + (t.lo + ({half}f * ratio(e, s) + kUlp2 * ({length}f * s + base))));
#@ quote certified.h: VKH_FN float ratio(float a, float b) { float quotient = a / b;
#@ quote certified.h: VKH_FN float raised(float x) { return x + ({raised}f * kUlp * abs(x) + kTiny); }
#@ weakest length: holds at 17.5, fails at 16
#@ weakest kUlp2: holds at 2^-44, fails at 2^-45
#@ weakest raised: holds at 3.02, fails at 2.9
#@ weakest base: holds at 0, fails at none
# By hand. For any s > 0, abs(v) = sqrt(N) <= s + (N - s^2) / (2 s). Lengths are in units of s, so s = 1: every operation but
# a flush is relative. XH and XL are x's parts, N = XH + XL + X (two_dot's claim, and its own low times low), PH = 1 + P and
# -P square's (two_product is exact), b the base, N2 two_sum's own error. W is what raised is given, before its rounding;
# raised(W (1 + T)) >= W + G abs(W), with G from moved.g's factors less that rounding, T. So W + G abs(W) >= abs(v) - base is to be
# shown. Where the base is under 2 s, the terms of the length do it. Where it is over, G abs(W) does, W being about s - base.
# Flushes: x is off by under 2^-116, over 2 s that is under 2^-66 and under the kTiny / 2 of raised.
#@ let base = 1
#@ let quotient = 2.5 * ulp
#@ let G = raised * kUlp * (1 - 4 * ulp) - 2.001 * ulp
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
#@ case the base under 2 s
k1 := @{length} * 1;
k2 := k1 + @{base} * B;
inner := H + @{kUlp2} * k2;
outer := TL + inner;
{ B in [0,2] /\ H in @{both(7.6 * ulp)} /\ OFF in @{both(52 * ulp * ulp)} /\ TL in @{both(1.001 * ulp)} /\ N2 in @{both(1.5 * ulp * ulp)}
  -> N2 + (outer - outer_exact) + (inner - inner_exact) + OFF + @{kUlp2} * k2 >= 0 }
#@ case the base over 2 s: all over the base. S = s / base, IN is what inner is before its rounding
{ S in [0,0.5] /\ N2 in @{both(0.75 * ulp * ulp)} /\ IN in @{both(3.9 * ulp)} /\ TL in @{both(1.001 * ulp)}
  /\ OFF in @{both(26.1 * ulp * ulp)} /\ R1 in @{both(ulp)} /\ R2 in @{both(ulp)}
  -> N2 + R1 * IN + R2 * (TL + IN * (1 + R1)) + OFF + @{G} * (1 - S - 6 * @{ulp}) >= 0 }
#@ case without t.lo: where s and base are within a factor of 2 it is 0 (Sterbenz); else all over abs(s - base), at least s / 2
{ TL in @{both(1.001 * ulp)} /\ IN in @{both(16 * ulp)} /\ OFF in @{both(104 * ulp * ulp)} /\ R1 in @{both(ulp)} /\ N2 in @{both(1.5 * ulp * ulp)}
  -> N2 - TL + R1 * IN + OFF + @{G} * (1 - 20 * @{ulp}) >= 0 }
#@ case a rounding more of the result, as distance_to_up's sum with the slack has: the base under 2 s, where the rest is nothing to G
{ T in [0,0] -> @{G - 1.001 * ulp} + T >= 0 }
#@ case and the base over 2 s
{ S in [0,0.5] /\ N2 in @{both(0.75 * ulp * ulp)} /\ IN in @{both(3.9 * ulp)} /\ TL in @{both(1.001 * ulp)}
  /\ OFF in @{both(26.1 * ulp * ulp)} /\ R1 in @{both(ulp)} /\ R2 in @{both(ulp)}
  -> N2 + R1 * IN + R2 * (TL + IN * (1 + R1)) + OFF + @{G - 1.001 * ulp} * (1 - S - 6 * @{ulp}) >= 0 }
