#@ theorem Surface::slack holds p - q for p = 0; with LocalCorners::slack it holds all that upper bounds leave out
#@ quote triangle.h: s.slack = round_up(kUlp2 * ({reach}f * from.reach + {radius}f * radius_up(s.at)), {rounding}f);
#@ quote bary.h: p.reach = round_up(norm_up(r.origin.hi) + norm_up(r.ab.hi) + norm_up(r.ac.hi), {sums}f); p.slack = round_up({corners}f * kUlp2 * p.reach, {local}f);
#@ quote certified.h: return x * (1.0f + (n + {up}f) * kUlp) + kTiny;
#@ weakest reach: holds at 7.4, fails at 7.3
#@ weakest radius: holds at 14.3, fails at 14.2
#@ weakest corners: holds at 22.4, fails at 22.2
#@ weakest rounding: holds at 0, fails at none
#@ weakest local: holds at 0, fails at none
#@ weakest sums: holds at 0, fails at none
#@ weakest kUlp2: holds at 2^-44, fails at 2^-45
# By hand. In kUlp^2, by linear_proofs.py: offset_from is off by offset_o of the origin, offset_p of p and offset_radius of
# the surface's radius; T's corners by position and step, cuts between two by cut_from and cut_to. With reach = o + ab + ac,
# the root's origin and edges: the local origin is under reach, p and cuts are under ab + ac. What is left out of an upper
# bound is under both slacks together, since kept_bound adds the local one to each. Lower bounds have p = 0.
# K takes what is second to these: the radius and reach are taken of rounded parts, within 2 kUlp; their norms round up.
#@ let K = 1 + 16 * ulp
#@ case Surface::slack, the origin
{ A in @{both(2 * ulp)} /\ T in @{both(ulp)}
  -> @{reach * kUlp2} * (1 + A) * @{1 + (rounding + up) * kUlp} * (1 + T) >= @{offset_o * ulp * ulp * K} }
#@ case Surface::slack, the radius
{ A in @{both(3 * ulp)} /\ T in @{both(ulp)}
  -> @{radius * kUlp2} * (1 + A) * @{1 + (rounding + up) * kUlp} * (1 + T) >= @{offset_radius * ulp * ulp * K} }
#@ case both slacks, the root's origin
reached = (1 + B) * @{1 + (sums + up) * kUlp} * (1 + C);
{ A in @{both(2 * ulp)} /\ B in @{both(2 * ulp)} /\ C in @{both(ulp)} /\ T in @{both(ulp)} /\ U in @{both(ulp)}
  -> (@{reach * kUlp2} * (1 + A) * @{1 + (rounding + up) * kUlp} * (1 + T)
     + @{corners * kUlp2} * @{1 + (local + up) * kUlp} * (1 + U)) * reached
  >= @{(position_o + step_o + offset_o) * ulp * ulp * K} }
#@ case both slacks, its edges
reached = (1 + B) * @{1 + (sums + up) * kUlp} * (1 + C);
{ A in @{both(2 * ulp)} /\ B in @{both(2 * ulp)} /\ C in @{both(ulp)} /\ T in @{both(ulp)} /\ U in @{both(ulp)}
  -> (@{reach * kUlp2} * (1 + A) * @{1 + (rounding + up) * kUlp} * (1 + T)
     + @{corners * kUlp2} * @{1 + (local + up) * kUlp} * (1 + U)) * reached
  >= @{(position_ab + step_ab + cut_from + cut_to + offset_o + offset_p) * ulp * ulp * K} }
