#@ theorem in doubles, the bounds of triangle.h, bounds.h and lower.h absorb the roundings of what they are made of
#@ quote certified.h: inline double length_up(double square) { return round_up(root(square), {length_up}); }
#@ quote certified.h: inline constexpr double kUlp = 0x1p-{bits};
#@ quote triangle.h: return round_up({coarse}f * kUlp * radius_up(at) + 8.0f * kUlp2 * reach, 4.0f);
#@ quote triangle.h: return (a.hi - origin.hi) + (a.lo - origin.lo);
#@ quote triangle.h: return raised(round_up(d + s.slack, {sum}f) - s.base);
#@ quote triangle.h: return round_up(r, {radius}f);
#@ quote bounds.h: return round_up(max(farther, 0.0f), {u1}f);
#@ quote bounds.h: return round_up(max(enclosing_radius_up(t.at) + max3(d), 0.0f), {u2}f);
#@ quote bounds.h: return round_up(max(bound + shift, 0.0f), {kept}f);
#@ quote lower.h: float off = round_up({separation}f * kUlp * radius_up(s.at) * norm_up(r) + s.slack * norm_up(r), 8.0f);
#@ let u = 2 ** (0 - 53)
#@ let kUlp = 2 ** (0 - bits)
#@ weakest coarse: holds at 5.01, fails at 4.99
#@ weakest separation: holds at 1.51, fails at 1.49
#@ weakest u1: holds at -0.4, fails at -0.6
#@ weakest u2: holds at -0.9, fails at -1.1
#@ weakest kept: holds at -0.9, fails at -1.1
#@ weakest radius: holds at 0.1, fails at -0.1
# By hand. The distance D = 1 from a triangle of radius R. Its corners are rounded twice, once for each part of the origin:
# 2 u R. plain_distance2 leaves u (3 D + 4 L), by its own count with u for kUlp, and L <= 2 R: 10 u R in all, with a little
# for second orders. What is a part of D, and what is a part of R, are shown apart. K is length_up's factor, its squares' V
# and its root's W; S a sum's, T a product's rounding, X and Y those of the slack.
#@ case a coarse distance: the part of the distance
{ V in @{both(3.001 * u)} /\ W in @{both(u)} /\ K in @{both(u)} /\ S in @{both(u)} /\ T in @{both(u)}
  -> @{1 - 3.001 * u} * sqrt(1 + V) * (1 + W) * @{1 + (length_up + 2) * kUlp} * (1 + K) * (1 + S) * @{1 + (sum + 2) * kUlp} * (1 + T) >= 1 }
#@ case a coarse distance: the part of the radius
{ X in @{both(3 * u)} /\ Y in @{both(3 * u)} -> @{coarse * kUlp} * (1 + X) - @{10.001 * u} * (1 + 9 * (1 + Y) * @{u}) >= 0 }
#@ case kept_bound, and u2's sum
{ S in @{both(u)} /\ T in @{both(u)} -> (1 + S) * @{1 + (min(kept, u2) + 2) * kUlp} * (1 + T) >= 1 }
#@ case u1: the difference of corners, whose norm is rounded up, and a sum
{ E in @{both(u)} /\ S in @{both(u)} /\ T in @{both(u)} -> (1 + E) * (1 + S) * @{1 + (u1 + 2) * kUlp} * (1 + T) >= 1 }
#@ case the enclosing radius: edges of 2 r, and their difference from the centre
{ E in @{both(3.001 * u)} /\ T in @{both(u)} -> (1 + E) * @{1 + (radius + 2) * kUlp} * (1 + T) >= 1 }
#@ case a separating plane: products of size R |r|
{ P in @{both(3.001 * u)} /\ X in @{both(3 * u)} -> @{separation * kUlp} * (1 + X) - P * (1 + @{u}) >= 0 }
