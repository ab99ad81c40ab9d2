#@ theorem coarse_distance_down and fine_separation_down are at most the distance less the base
#@ quote lower.h: float off = round_up({corners}f * kUlp * radius_up(s.at) * norm_up(r) + s.slack * norm_up(r), {rounding}f); float reach = round_down(farthest, {step}f) - off;
#@ quote lower.h: return lowered(quotient_down(reach, length) - s.base);
#@ quote lower.h: float off = s.slack * norm_up(r.hi); return quotient_above_down(reach, off, r, s.base);
#@ quote lower.h: Two3 back = two_difference(two(vec3(0.0f, 0.0f, 0.0f)), r); Two reach = smaller(two_dot(s.a, back), smaller(two_dot(s.b, back), two_dot(s.c, back)));
#@ quote lower.h: m.lo = min((x.hi - m.hi) + x.lo, (y.hi - m.hi) + y.lo);
#@ quote triangle.h: s.slack = round_up(kUlp2 * ({reach}f * from.reach + {radius}f * radius_up(s.at)), {slack_rounding}f);
#@ quote certified.h: return x * (1.0f + (n + {up}f) * kUlp) + kTiny;
#@ quote certified.h: return max(x * (1.0f - (n + {down}f) * kUlp) - kTiny, 0.0f);
#@ weakest corners: holds at 4.01, fails at 3.99
#@ weakest rounding: holds at 0, fails at none
#@ weakest step: holds at 0, fails at -1.5
#@ weakest radius: holds at 8.1, fails at 7.9
# By hand. R is the surface's radius, |r| the direction's length. coarse: (-s).r of a rounded corner: dot3 is off by 3 kUlp
# R |r| (norms.g), the corner's rounding by one, and its own error is under the slack (slack.g). fine: two_dot of each
# corner, and `smaller`, twice: what it picks is a difference of 2 ulp at most and a low part, off by 3 kUlp^2. The negative
# of r is exact. The corners are off by two differences' origin and one of themselves (linear_proofs.py). norm_up and
# radius_up are no less than what they bound. Flushes: each round_up has kTiny, and so has the slack, where r.hi's largest
# component is in [1, 2); two_dots are flushed by under 2^-116. coarse_distance_down's slack: counterexamples.py.
#@ case coarse: dot and corner, over R |r|
{ A in @{both(3 * ulp)} /\ T in @{both(ulp)}
  -> @{corners * kUlp} * (1 + A) * @{1 + (rounding + up) * kUlp} * (1 + T) >= @{4.0001 * ulp} }
#@ case coarse: what is left of the slack, over what corners are off by: the origin, the radius
{ A in @{both(2 * ulp)} /\ B in @{both(2 * ulp)} /\ T in @{both(ulp)}
  -> @{reach * kUlp2} * (1 + A) * (1 + B) * (1 + T) >= @{2.001 * two_difference_a * ulp * ulp} /\
     @{radius * kUlp2} * (1 + A) * (1 + B) * (1 + T) >= @{1.001 * two_difference_a * ulp * ulp} }
#@ case coarse: the step, over the farthest: one rounding of a difference, significands from 2^23
@up = float<24,-149,up>;
{ X in [8388609,16777215] /\ @FIX(X,0) -> up(X * @{1 - (step + down) * kUlp}) - X <= -1 }
up(X * @{1 - (step + down) * kUlp}) - X
  -> (up(X * @{1 - (step + down) * kUlp}) - X * @{1 - (step + down) * kUlp}) - X * @{(step + down) * kUlp};
#@ case fine: products and corners, over R |r|
{ A in @{both(3 * ulp)} /\ B in @{both(3 * ulp)}
  -> @{radius * kUlp2} * (1 + A) * (1 + B) >= @{(two_dot + 1 + 6 + 1.001 * two_difference_a) * ulp * ulp} }
#@ case fine: corners, over reach |r|
{ A in @{both(2 * ulp)} /\ B in @{both(3 * ulp)} -> @{reach * kUlp2} * (1 + A) * (1 + B) >= @{2.001 * two_difference_a * ulp * ulp} }
#@ case fine: flushes, under the kTiny of the slack
{ A in @{both(4 * ulp)} -> @{kTiny} * (1 + A) >= 1b-116 }
