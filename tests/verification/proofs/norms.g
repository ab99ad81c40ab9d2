#@ theorem sqrt_up, norm_up and length_up are not under the root or length, sqrt_down and norm_down not over it
#@ quote certified.h: VKH_FN float root(float x) { return sqrt(max(x, kLeastNormal)); }
#@ quote certified.h: return x * (1.0f + (n + {up}f) * kUlp) + kTiny;
#@ quote certified.h: return max(x * (1.0f - (n + {down}f) * kUlp) - kTiny, 0.0f);
#@ quote certified.h: VKH_FN float sqrt_up(float x) { return round_up(root(x), {sqrt_up}f); }
#@ quote certified.h: VKH_FN float sqrt_down(float x) { return round_down(root(x), {sqrt_down}f); }
#@ quote certified.h: VKH_FN float norm_up(vec3 v) { return round_up(root(dot3(v, v)), {norm_up}f); }
#@ quote certified.h: VKH_FN float length_up(float square) { return round_up(root(square), {length_up}f); }
#@ quote certified.h: VKH_FN float norm_down(vec3 v) { return round_down(root(dot3(v, v)), {norm_down}f); }
#@ quote dot.h: return (a.x * b.x + a.y * b.y) + a.z * b.z;
#@ weakest sqrt_up: holds at 5.001, fails at 5
#@ weakest sqrt_down: holds at 5.001, fails at 5
#@ weakest norm_up: holds at 6.502, fails at 6.49
#@ weakest length_up: holds at 6.502, fails at 6.49
#@ weakest norm_down: holds at 6.502, fails at 6.49
#@ weakest kTiny: holds at 6e-19, fails at 4e-19
# By hand. A square of v is a sum of squares, each times 1 + D: the first case. Flushes add five times 2^-126 at most: the
# root of what is left is short by 2^-61 at most, since roots are subadditive; root() adds under 2^-62 where x is flushed.
# Over 2^-38 that is nothing beside D. The sum with kTiny rounds to no less than the product; under 2^-38 not even that is
# used. R is the root's own error (the second case), T the product's, U the sum's, C what flushes cost.
#@ case dot3
{ A in @{both(ulp)} /\ B in @{both(ulp)} /\ C in @{both(ulp)} -> (1 + A) * (1 + B) * (1 + C) - 1 in @{both(3.001 * ulp)} }
#@ case root: 1 / inversesqrt(x), a quotient of 2.5 ulp of an inverse root of 2, and a rounding
{ I in @{both(2 * ulp)} /\ Q in @{both(2.5 * ulp)} /\ T in @{both(ulp)} -> (1 + Q) * (1 + T) / (1 + I) - 1 in @{both(6 * ulp)} }
(1 + Q) * (1 + T) / (1 + I) - 1 -> (Q + T + Q * T - I) / (1 + I) { 1 + I <> 0 };
#@ case sqrt_up, over 2^-38
{ R in @{both(6 * ulp)} /\ T in @{both(ulp)} -> (1 + R) * @{1 + (sqrt_up + up) * kUlp} * (1 + T) >= 1 }
#@ case sqrt_down, over 2^-38
{ R in @{both(6 * ulp)} /\ T in @{both(ulp)} -> (1 + R) * @{1 - (sqrt_down + down) * kUlp} * (1 + T) <= 1 }
#@ case norm_up, over 2^-38
{ D in @{both(3.001 * ulp)} /\ R in @{both(6 * ulp)} /\ T in @{both(ulp)}
  -> sqrt(1 + D) * (1 + R) * @{1 + (norm_up + up) * kUlp} * (1 + T) >= 1 }
#@ case length_up, over 2^-38
{ D in @{both(3.001 * ulp)} /\ R in @{both(6 * ulp)} /\ T in @{both(ulp)}
  -> sqrt(1 + D) * (1 + R) * @{1 + (length_up + up) * kUlp} * (1 + T) >= 1 }
#@ case norm_down, over 2^-38
{ D in @{both(3.001 * ulp)} /\ R in @{both(6 * ulp)} /\ T in @{both(ulp)}
  -> sqrt(1 + D) * (1 + R) * @{1 - (norm_down + down) * kUlp} * (1 + T) <= 1 }
#@ case upwards, under 2^-38
factor = (1 + R) * @{1 + (min(norm_up, length_up, sqrt_up + 1.5) + up) * kUlp} * (1 + T);
{ L in [0,1b-38] /\ C in [0,1b-61] /\ D in @{both(3.001 * ulp)} /\ R in @{both(6 * ulp)} /\ T in @{both(ulp)} /\ U in @{both(ulp)}
  -> ((L * sqrt(1 + D) - C) * factor + @{kTiny}) * (1 + U) - L >= 0 }
((L * sqrt(1 + D) - C) * factor + @{kTiny}) * (1 + U) - L
  -> L * (sqrt(1 + D) * factor * (1 + U) - 1) + (@{kTiny} - C * factor) * (1 + U);
#@ case downwards, under 2^-38
factor = (1 + R) * @{1 - (min(norm_down, sqrt_down + 1.5) + down) * kUlp} * (1 + T);
{ L in [0,1b-38] /\ C in [0,1b-61] /\ D in @{both(3.001 * ulp)} /\ R in @{both(6 * ulp)} /\ T in @{both(ulp)} /\ U in @{both(ulp)}
  -> ((L * sqrt(1 + D) + C) * factor - @{kTiny}) * (1 + U) - L <= 0 }
((L * sqrt(1 + D) + C) * factor - @{kTiny}) * (1 + U) - L
  -> L * (sqrt(1 + D) * factor * (1 + U) - 1) + (C * factor - @{kTiny}) * (1 + U);
