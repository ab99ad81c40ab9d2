#@ theorem surface_distance_up(p, S) is at least d(p, S) - base, but for what make_surface leaves out
#@ quote triangle.h: return round_up({radius}f * kUlp * radius_up(at) + {reach}f * kUlp2 * reach, {rounding}f);
#@ quote triangle.h: float d = length_up(plain_distance2(rounded(p), s.at, inside)); return raised(round_up(d + s.slack, {coarse}f) - s.base);
#@ quote triangle.h: if (s.sharp) return raised(sharp_norm_above_up(offset, s.base) + s.slack);
#@ quote triangle.h: return raised(round_up(norm_up(rounded(offset)) + s.slack, {plain}f) - s.base);
#@ quote certified.h: return x * (1.0f + (n + {up}f) * kUlp) + kTiny;
#@ quote certified.h: VKH_FN float norm_up(vec3 v) { return round_up(root(dot3(v, v)), {norm_up}f); }
#@ quote certified.h: VKH_FN float length_up(float square) { return round_up(root(square), {length_up}f); }
#@ quote certified.h: VKH_FN float raised(float x) { return x + ({raised}f * kUlp * abs(x) + kTiny); }
#@ says triangle.h: its root is off by kUlp ({distance} D + {edge} L) before its own rounding
#@ weakest radius: holds at 11.1, fails at 10.9
#@ weakest reach: holds at 1.1, fails at 0.9
#@ weakest rounding: holds at 0, fails at none
#@ weakest coarse: holds at 2.6, fails at 2.4
#@ weakest plain: holds at 0, fails at none
#@ weakest raised: holds at 3.1, fails at 2.9
# By hand. A coarse surface: D is the distance from p, rounded, to the point of the rounded triangle whose distance
# plain_distance2 takes. Its root is off by kUlp (3 D + 4 L), L <= 2 R, R the radius; the rounding of p by kUlp (D + R),
# that of a corner by 2 kUlp R and kUlp2 reach (linear_proofs.py). So d <= D (1 + u) + 3 u R + kUlp2 reach, where the
# length of what was computed is at least D (1 - 3 u) - 8 u R. Shown is each factor: of D, of R, of the reach. The others are
# distances from the point, not above the base: the last sum, with the base, is raised's, which takes two roundings of it
# (moved.g). LENGTH is length_up's own factor over the root of a square: D for dot3, R its root, T the product.
#@ let spare = 1 + (length_up + up) * kUlp
#@ case a coarse distance: the factor of D
{ D in @{both(3.001 * ulp)} /\ R in @{both(6 * ulp)} /\ T in @{both(ulp)} /\ S in @{both(ulp)} /\ U in @{both(ulp)}
  -> @{1 - distance * ulp} * sqrt(1 + D) * (1 + R) * @{spare} * (1 + T) * (1 + S) * @{1 + (coarse + up) * kUlp} * (1 + U) >= @{1 + 1.001 * ulp} }
#@ case a coarse distance: the factor of R, the slack's against what is lost
lost = @{2 * edge * ulp} * (1 + 1b-18) + @{3.001 * ulp};
{ A in @{both(2 * ulp)} /\ T in @{both(ulp)} /\ S in @{both(ulp)} /\ U in @{both(ulp)}
  -> @{radius * kUlp} * (1 + A) * @{1 + (rounding + up) * kUlp} * (1 + T) * (1 + S) * @{1 + (coarse + up) * kUlp} * (1 + U) - lost >= 0 }
#@ case a coarse distance: the factor of the reach
{ A in @{both(2 * ulp)} /\ T in @{both(ulp)} /\ S in @{both(ulp)} /\ U in @{both(ulp)}
  -> @{reach * kUlp2} * (1 + A) * @{1 + (rounding + up) * kUlp} * (1 + T) * (1 + S) * @{1 + (coarse + up) * kUlp} * (1 + U) >= @{1.001 * coarse_origin * ulp * ulp} }
#@ case a distance in 48 bits, not sharp: norm_up makes up for the rounding of the offset's parts
{ D in @{both(3.001 * ulp)} /\ R in @{both(6 * ulp)} /\ T in @{both(ulp)} /\ P in @{both(ulp)}
  -> (1 + P) * sqrt(1 + D) * (1 + R) * @{1 + (norm_up + up) * kUlp} * (1 + T) >= 1 }
#@ case round_up of a sum, significands from 2^23: it is over the next float, where a sum's exact value is under that
@down = float<24,-149,dn>;
{ X in [8388608,16777212] /\ @FIX(X,0) -> down(X * @{1 + (min(plain, coarse) + up) * kUlp}) - X >= 1 }
down(X * @{1 + (min(plain, coarse) + up) * kUlp}) - X
  -> (down(X * @{1 + (min(plain, coarse) + up) * kUlp}) - X * @{1 + (min(plain, coarse) + up) * kUlp}) + X * @{(min(plain, coarse) + up) * kUlp};
#@ case and next to 2^24
@down = float<24,-149,dn>;
{ X in [16777213,16777215] -> down(X * @{1 + (min(plain, coarse) + up) * kUlp}) >= 16777216 }
#@ case the sum with the base: raised takes its rounding, and its own
{ S in @{both(ulp)} /\ T in @{both(ulp)} /\ U in @{both(ulp)}
  -> @{raised * kUlp} * (1 + T) * (1 + U) * (1 + S) - U - U * S - S >= @{ulp} }
