#@ theorem sharp_norm_up(v) is at least abs(v), where no product of its halves is flushed
#@ quote certified.h: VKH_FN float sharp_norm_up(Two3 v) { Two x = two_dot(v, v); if (!(x.hi > 1e-30f)) return round_up(norm_up(v.hi) + norm_up(v.lo), {short}f); float s = root(x.hi); Two square = two_product(s, s); float e = ((x.hi - square.hi) - square.lo) + x.lo; return next_up(next_up(s + {half}f * ratio(e, s)));
#@ quote certified.h: return x > kTiny ? uintBitsToFloat(floatBitsToUint(x) + 1u) : 2.0f * kTiny;
#@ let quotient = 2.5 * ulp
#@ let low = 1
# By hand: as sharp.g, with s = 1. The sum s + e / (2 s) is rounded to no less than the float under it: the first next_up
# makes up for that. The second is worth kUlp / 2 of the result at least, and an ulp of it: what is to be shown is that this
# covers what the sum itself is off by. Not by Gappa: which terms of two_dot are flushed where lengths are under 2^-48 or so;
# kernels use sharp_norm_above_up alone, whose kTiny takes that.
#@ case the sum is off by less than half an ulp
e1 := XH - (1 + P);
e2 := e1 - -P;
e := e2 + XL;
d :quotient= e * 1;
{ XH - 1 in @{both(12.001 * ulp)} /\ XL in @{both(1.001 * ulp)} /\ P in @{both(ulp)} /\ X in @{both((two_dot + 1.01) * ulp * ulp * 1.001)}
  -> d * @{half} - ((XH + XL + X) - 1) * @{half} in @{both(52 * ulp * ulp)} /\ @{ulp / 2} * (1 - @{16 * ulp}) - @{52 * ulp * ulp} >= 0 }
d * @{half} - ((XH + XL + X) - 1) * @{half}
  -> ((d - d_exact) + (e - e_exact) + (e2 - e2_exact) + (e1 - e1_exact) - X) * @{half};
XH - (1 + P) -> (XH - 1) - P;
#@ case without x.lo, the result in [1, sqrt(2)): x.hi in [1, 2), XL under 2^-23, an ulp 2^-23; XL / (2 s), with 52 kUlp^2
{ XL in @{both(ulp)} /\ S in [1,1.41422] /\ OFF in @{both(60 * ulp * ulp)} -> XL * 1b-1 / S + OFF <= @{ulp} }
#@ case without x.lo, the result in [sqrt(2), 2): x.hi in [2, 4), XL under 2^-22
{ XL in @{both(2 * ulp)} /\ S in [1.41421,2.00001] /\ OFF in @{both(60 * ulp * ulp)} -> XL * 1b-1 / S + OFF <= @{ulp} }
