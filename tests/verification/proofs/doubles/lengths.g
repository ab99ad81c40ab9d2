#@ theorem in doubles, length_up is not under a length, quotient_down not over a quotient, and a corner is within kCornerError
#@ quote certified.h: inline double length_up(double square) { return round_up(root(square), {length_up}); }
#@ quote certified.h: inline double norm_up(const vec3& v) { return length_up(dot3(v, v)); }
#@ quote certified.h: inline double root(double x) { return std::sqrt(x); }
#@ quote certified.h: inline double quotient_down(double a, double b) { return round_down(a / b, {quotient_down}); }
#@ quote certified.h: inline constexpr double kUlp = 0x1p-{bits};
#@ quote place.h: inline constexpr double kCornerError = {corner} * kUlp;
#@ quote place.h: return (at.x * kUnit) * f.ab + (at.y * kUnit) * f.ac;
#@ quote place.h: f.slack = kCornerError * max(norm_up(f.ab), norm_up(f.ac));
#@ let u = 2 ** (0 - 53)
#@ let kUlp = 2 ** (0 - bits)
#@ weakest length_up: holds at 0, fails at -0.3
#@ weakest quotient_down: holds at -0.4, fails at -0.6
#@ weakest corner: holds at 1.51, fails at 1.49
# By hand. A square of v is a sum of squares, each times 1 + D. R is the root's rounding, Q the quotient's, A that of its
# numerator, T the last product's. A weight times an edge is off by E, the edge's rounding, P and S, the product's and the
# sum's; weights sum to 1 at most. M is the product that makes the slack, and an edge is measured rounded, by E.
#@ case dot3
{ A in @{both(u)} /\ B in @{both(u)} /\ C in @{both(u)} -> (1 + A) * (1 + B) * (1 + C) - 1 in @{both(3.001 * u)} }
(1 + A) * (1 + B) * (1 + C) - 1 -> A * (1 + B) * (1 + C) + B * (1 + C) + C;
#@ case length_up
{ D in @{both(3.001 * u)} /\ R in @{both(u)} /\ T in @{both(u)} -> sqrt(1 + D) * (1 + R) * @{1 + (length_up + 2) * kUlp} * (1 + T) >= 1 }
#@ case quotient_down
{ A in @{both(u)} /\ Q in @{both(u)} /\ T in @{both(u)} -> (1 + A) * (1 + Q) * @{1 - (quotient_down + 2) * kUlp} * (1 + T) <= 1 }
#@ case local_corner
{ E in @{both(u)} /\ P in @{both(u)} /\ S in @{both(u)} /\ M in @{both(u)}
  -> (1 + E) * (1 + P) * (1 + S) - 1 in @{both(3.001 * u)} /\ @{corner * kUlp} * (1 + M) * (1 + E) - @{3.001 * u} >= 0 }
(1 + E) * (1 + P) * (1 + S) - 1 -> E * (1 + P) * (1 + S) + P * (1 + S) + S;
