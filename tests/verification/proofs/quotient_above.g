#@ theorem quotient_above_down(reach, off, r, base) is at most (reach - off) / abs(r) - base, or at most -base
#@ quote certified.h: VKH_FN float quotient_above_down(Two reach, float off, Two3 r, float base) { Two square = two_dot(r, r); float l = root(square.hi); if (!(reach.hi > 0.0f) || l < 0.5f) return lowered(-base);
#@ quote certified.h: Two back = two_product(l, l); float e = ((square.hi - back.hi) - back.lo) + square.lo; float extra = {half}f * ratio(e, l); float q = reach.hi / l; Two product = two_product(q, l);
#@ quote certified.h: float rest = (((reach.hi - product.hi) - product.lo) + reach.lo) - q * extra;
#@ quote certified.h: float less = round_up(off / l, {off}f) + {ratio}f * kUlp2 * q; return lowered((q - base) + (rest / l - less));
#@ quote certified.h: VKH_FN float lowered(float x) { return x - ({lowered}f * kUlp * abs(x) + kTiny); }
#@ quote certified.h: return x * (1.0f + (n + {up}f) * kUlp) + kTiny;
#@ weakest ratio: holds at 59, fails at 58
#@ weakest off: holds at 12.2, fails at 12
#@ weakest kUlp2: holds at 2^-44, fails at 2^-45
#@ weakest lowered: holds at 3.01, fails at 2.9
#@ let quotient = 2.5 * ulp
#@ let G = lowered * kUlp * (1 - 4 * ulp) - 2.001 * ulp
# By hand. Let l = 1 and q = 1, as units: every operation but a flush is relative. abs(r) <= l + X, X = (N - l^2) / (2 l);
# extra is X but for 52 kUlp^2 (sharp.g). RH and RL are reach's parts, product is 1 + P and -P. So
# (reach - off) / abs(r) >= 1 + (RH + RL - 1 - X) / (1 + X) - off / (1 + X) where it is positive; else -base is the bound to
# be under, and the same sum says so with X = 0. W is what lowered is given before its rounding: with G as in sharp.g,
# W - G abs(W) <= (reach - off) / abs(r) - base is to be shown; q - base is exact, or rounded and q / 2 at least. off is of
# any size: its own terms are the second case.
# Flushes: under 2^-66, as there; lowered's kTiny.
#@ case the rest: (RH + RL - 1 - X) / (1 + X), within 220 kUlp^2, and small
e1 := RH - (1 + P);
e2 := e1 - -P;
e3 := e2 + RL;
m := 1 * E;
e := e3 - m;
d :quotient= e * 1;
{ RH - 1 in @{both(2.501 * ulp)} /\ RL in @{both(1.001 * ulp)} /\ P in @{both(ulp)} /\ X in @{both(7.6 * ulp)} /\ E - X in @{both(52 * ulp * ulp)}
  /\ E in @{both(7.7 * ulp)}
  -> d - (RH + RL - 1 - X) / (1 + X) in @{both(220 * ulp * ulp)} /\ d in @{both(12.3 * ulp)} }
d - (RH + RL - 1 - X) / (1 + X)
  -> (d - d_exact) + (e - e_exact) - (m - m_exact) + (e3 - e3_exact) + (e2 - e2_exact) + (e1 - e1_exact) - (E - X)
     + (RH + RL - 1 - X) * X / (1 + X) { 1 + X <> 0 };
RH - (1 + P) -> (RH - 1) - P;
e3_exact -> (e2 - e2_exact) + (e1 - e1_exact) + (RH - 1) + RL;
RH + RL - 1 - X -> (RH - 1) + RL - X;
#@ case off: what is taken off for it, by round_up, over off / (1 + X), with three roundings of sums that it is in
{ T1 in @{both(quotient)} /\ T2 in @{both(ulp)} /\ T3 in @{both(3.001 * ulp)}
  -> (1 + T1) * @{1 + (off + up) * kUlp} * (1 + T2) * (1 + T3) * @{1 - 7.6 * ulp} >= 1 }
#@ case q - base is exact
inner := H - @{ratio * kUlp2};
{ H in @{both(12.3 * ulp)} /\ OFF in @{both(220 * ulp * ulp)} -> (inner - inner_exact) + OFF - @{ratio * kUlp2} * (1 - @{ulp}) <= 0 }
#@ case it is not: all over abs(q - base), at least q / 2. S is its rounding
{ S in @{both(ulp)} /\ IN in @{both(26 * ulp)} /\ OFF in @{both(440 * ulp * ulp)} /\ R1 in @{both(ulp)}
  -> S + R1 * IN + OFF - @{G} * (1 - 30 * @{ulp}) <= 0 }
#@ case flushes, under the kTiny of round_up(off / l): lowered needs none
{ A in @{both(4 * ulp)} -> @{kTiny} * (1 + A) >= 1b-66 }
