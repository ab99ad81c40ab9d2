#@ theorem quotient_down(a, b) is at most a / b, for a > 0 and b >= 2^-50
#@ quote certified.h: float q = a / b; Two back = two_product(q, b); float remainder = (a - back.hi) - back.lo; return max(next_down(next_down(q + remainder / b)) - kTiny, 0.0f);
#@ quote certified.h: return x > kTiny ? uintBitsToFloat(floatBitsToUint(x) - 1u) : 0.0f;
#@ let quotient = 2.5 * ulp
# By hand. Let q = 1 and b = 1, as units. back is 1 + P and -P exactly, so a / b = 1 + (a - 1). The sum with the remainder
# is rounded up to the next float at most: the first next_down makes up for it. The second takes half a kUlp at least.
# Where a is under 2^-100 its remainder may be flushed. Then q is off by 2.5 ulp of under 2^-50: kTiny takes that. It is
# needed there: counterexamples.py.
#@ case the remainder is off by less than half an ulp
r1 := A - (1 + P);
r2 := r1 - -P;
d :quotient= r2 * 1;
{ A - 1 in @{both(2.501 * ulp)} /\ P in @{both(ulp)} -> d - (A - 1) in @{both(16 * ulp * ulp)} /\ @{ulp / 2 * (1 - 16 * ulp) - 16 * ulp * ulp} >= 0 }
d - (A - 1) -> (d - d_exact) + (r2 - r2_exact) + (r1 - r1_exact);
A - (1 + P) -> (A - 1) - P;
r2_exact -> (r1 - r1_exact) + (A - 1);
#@ case a quotient that is off by 3 ulp, under 2^-50
{ Q in [0,1b-50] -> @{kTiny} * 0.999 - Q * @{3 * ulp} >= 0 }
