#@ theorem bound_u1, bound_u2, enclosing_radius_up and kept_bound are at least what they bound
#@ quote bounds.h: return round_up(max(bound + shift, 0.0f), {kept}f);
#@ quote bounds.h: float ab = norm_up(t.at.b - t.at.a); float bc = norm_up(t.at.c - t.at.b); float ca = norm_up(t.at.a - t.at.c); float farther = min(d.x + max(ab, ca), min(d.y + max(ab, bc), d.z + max(bc, ca))); return round_up(max(farther, 0.0f), {u1}f);
#@ quote bounds.h: return round_up(max(enclosing_radius_up(t.at) + max3(d), 0.0f), {u2}f);
#@ quote triangle.h: float r = max(norm_up(centre), max(norm_up(ab - centre), norm_up(ac - centre)));
#@ quote triangle.h: return round_up(r, {enclosing}f);
#@ quote certified.h: return x * (1.0f + (n + {up}f) * kUlp) + kTiny;
#@ quote certified.h: VKH_FN float norm_up(vec3 v) { return round_up(root(dot3(v, v)), {norm_up}f); }
#@ weakest kept: holds at 0, fails at -1.5
#@ weakest u2: holds at 0, fails at -1.5
#@ weakest u1: holds at 2.6, fails at 2.4
#@ weakest enclosing: holds at 0.6, fails at 0.4
# By hand. T's corners a = 0, b, c are rounded to `at`: b and c are off by kUlp of themselves. A difference with a is exact,
# another is rounded once. bound_u1: where bc decides a maximum, it is the longer edge, and b and c are 3 bc in sum: it is
# off by 3 kUlp and by one for the difference. enclosing_radius_up: b and c are within 2 r of a, so off by 2 kUlp r, and
# by one for the difference with the centre. D, R, T, S, U: norm_up's square, its root, its product; a sum; the product.
# A rounded sum is next to its exact value, and round_up(x, 0) is over the next float (as in distance_up.g).
#@ case bound_u1, the edge
{ D in @{both(3.001 * ulp)} /\ R in @{both(6 * ulp)} /\ T in @{both(ulp)} /\ S in @{both(ulp)} /\ U in @{both(ulp)}
  -> @{1 - 4.001 * ulp} * sqrt(1 + D) * (1 + R) * @{1 + (norm_up + up) * kUlp} * (1 + T) * (1 + S) * @{1 + (u1 + up) * kUlp} * (1 + U) >= 1 }
#@ case enclosing_radius_up
{ D in @{both(3.001 * ulp)} /\ R in @{both(6 * ulp)} /\ T in @{both(ulp)} /\ U in @{both(ulp)}
  -> @{1 - 3.001 * ulp} * sqrt(1 + D) * (1 + R) * @{1 + (norm_up + up) * kUlp} * (1 + T) * @{1 + (enclosing + up) * kUlp} * (1 + U) >= 1 }
#@ case enclosing_radius_up without a count of its own, where roots have the table's 4.5 ulp and no rounding more
{ D in @{both(3.001 * ulp)} /\ R in @{both(4.501 * ulp)} /\ T in @{both(ulp)} /\ U in @{both(ulp)}
  -> @{1 - 3.001 * ulp} * sqrt(1 + D) * (1 + R) * @{1 + (norm_up + up) * kUlp} * (1 + T) * @{1 + up * kUlp} * (1 + U) >= 1 }
#@ case bound_u1 without one, where corners have no low parts (wave_bound's): norm_up takes the difference
{ D in @{both(3.001 * ulp)} /\ R in @{both(6 * ulp)} /\ T in @{both(ulp)}
  -> @{1 - ulp} * sqrt(1 + D) * (1 + R) * @{1 + (norm_up + up) * kUlp} * (1 + T) >= 1 }
#@ case kept_bound and bound_u2: over the next float
@down = float<24,-149,dn>;
{ X in [8388608,16777212] /\ @FIX(X,0) -> down(X * @{1 + (min(kept, u2) + up) * kUlp}) - X >= 1 }
down(X * @{1 + (min(kept, u2) + up) * kUlp}) - X
  -> (down(X * @{1 + (min(kept, u2) + up) * kUlp}) - X * @{1 + (min(kept, u2) + up) * kUlp}) + X * @{(min(kept, u2) + up) * kUlp};
#@ case and next to 2^24
@down = float<24,-149,dn>;
{ X in [16777213,16777215] -> down(X * @{1 + (min(kept, u2) + up) * kUlp}) >= 16777216 }
