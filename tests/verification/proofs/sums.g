#@ theorem two_sum is off by at most kUlp2 / 8 of abs(a) + abs(b), however + - are rounded, but for what is flushed
#@ quote two_float.h: VKH_PRECISE float s = a + b; VKH_PRECISE float from_b = s - a; VKH_PRECISE float from_a = s - from_b;
#@ quote two_float.h: VKH_PRECISE float e = (a - from_a) + (b - from_b); Two r; r.hi = s; r.lo = e;
#@ quote two_float.h: VKH_PRECISE vec3 s = a + b; VKH_PRECISE vec3 from_b = s - a; VKH_PRECISE vec3 from_a = s - from_b;
#@ quote two_float.h: VKH_PRECISE vec3 e = (a - from_a) + (b - from_b); Two3 r; r.hi = s; r.lo = e;
# By hand: which cases there are, and why they are all. By Gappa: what each says. By exhaustion: all of it, for floats of
# three to six bits and every choice of rounding (rounding_lemmas.py).
#
# Powers of two and signs do not matter: the one with the larger exponent is in [2^23, 2^24), an integer. Write S = a + b +
# D, FB = S - a + D2. A sum is exact where it is a float; else it is next to it, by less than a step between floats.
#
# Lemma: with X in [2^23, 2^24) and abs(Y) < 2^24, S next to X + Y, S - X is a float (L1 to L6, by the size of Y and of S). So if a has the larger exponent, FB = S - a and FA = S - FB = a: e is b - FB = -D, rounded.
#
# Else b has it. Where S has a smaller exponent than a, S = a + b: both are multiples of a's last bit. All is exact. Where
# not, the lemma with S for X and -a for Y says that FB - S is a float. So FA = S - FB is exact, a - FA = D2, and b - FB =
# -D - D2 is a float (case 3). So e is D2, rounded, less D + D2, rounded: two roundings. One of them is exact:
# - abs(a) >= 1: D2 is a multiple of a's last bit, and a float (case 4).
# - abs(a) >= 1/2, b = 2^23: so it is, as D2 is under 1 there (case 5).
# - Else abs(a) is under the steps g and h from b to its neighbours, g on a's side; both are 1/2 or 1. S is b or b + g.
#   S = b + g: S - a lies between b and b + g. So FB is b, and b - FB = 0; or b + g, and a - FA = a.
#   S = b: FB is b, and FA = 0; or b - h, and a - FA is a - h. That is a float where a >= h / 2 (Sterbenz). Under that it is
#   rounded to a multiple of h 2^-24, and its sum with b - FB = h is a float (case 6, a < 0).
# The other is of D, or of D2 under 1: it is at most 2^-47 of abs(a) + abs(b) (cases 1 and 2).
#
# A flush adds at most 2^-126 to each of the four results that e is made of.
#@ case L1, Y under 2^22: S - X is a float
{ X in [8388608,16777215] /\ Y in [-4194304,4194304] /\ @FIX(X,0) /\ @FIX(S,-1) /\ S - (X + Y) in [-2,2] -> @FLT(S - X,24) }
S - X -> (S - (X + Y)) + Y;
#@ case L2, Y over 2^22 and X + Y under 2^23: the sum is a float
{ @FIX(X,0) /\ @FIX(Y,-1) /\ X + Y in [-16777215b-1,16777215b-1] -> @FLT(X + Y,24) }
#@ case L3, S in [2^23, 2^24]
{ Y in [-16777215,16777215] /\ @FIX(X,0) /\ @FIX(S,0) /\ S - (X + Y) in [-1,1]
  -> S - X in [-16777216,16777216] }
S - X -> (S - (X + Y)) + Y;
#@ case L4, S over 2^24, Y under 2^23
{ X in [8388608,16777215] /\ Y in [-8388608,8388608] /\ @FIX(X,0) /\ @FIX(S,1) /\ S - (X + Y) in [-2,2] -> @FLT(S - X,24) }
S - X -> (S - (X + Y)) + Y;
#@ case L5, S over 2^24, Y an integer: X + Y is one, an even S 1 away
{ Y in [-16777215,16777215] /\ @FIX(X,0) /\ @FIX(S,1) /\ S - (X + Y) in [-1,1]
  -> S - X in [-16777216,16777216] }
S - X -> (S - (X + Y)) + Y;
#@ case L6, an integer under 2^24 is a float; 2^24 is one, too
{ @FIX(Z,0) /\ Z in [-16777215,16777215] -> @FLT(Z,24) }
#@ case 1, S at most 2^24: D, or D2, is under 1, SIZE = abs(a) + abs(b) at least 2^23
@down = float<24,-149,dn>; @up = float<24,-149,up>;
{ D in [-1,1] /\ SIZE in [8388608,33554432]
  -> (down(D) - D) / SIZE in @{both(kUlp2 / 8)} /\ (up(D) - D) / SIZE in @{both(kUlp2 / 8)} }
#@ case 2, S over 2^24: D is under 2, SIZE over 2^24
@down = float<24,-149,dn>; @up = float<24,-149,up>;
{ D in [-2,2] /\ SIZE in [16777216,33554432]
  -> (down(D) - D) / SIZE in @{both(kUlp2 / 8)} /\ (up(D) - D) / SIZE in @{both(kUlp2 / 8)} }
#@ case 3, b - FB is a float
{ @FIX(B,0) /\ @FIX(FB,-1) /\ D in [-2,2] /\ D2 in [-2,2] /\ FB - B - D - D2 in [0,0] -> @FLT(B - FB,24) }
B - FB -> -(FB - B - D - D2) - D - D2;
#@ case 4, abs(a) over 1: D2 is a float
{ @FIX(D2,-23) /\ D2 in [-16777215b-23,16777215b-23] -> @FLT(D2,24) }
#@ case 5, abs(a) over 1/2, D2 under 1: D2 is a float
{ @FIX(D2,-24) /\ D2 in [-16777215b-24,16777215b-24] -> @FLT(D2,24) }
#@ case 6, a + h, rounded, less h, for h = 1/2
@down = float<24,-149,dn>; @up = float<24,-149,up>;
{ A in [-1b-2,0] -> @FLT(down(A + 1b-1) - 1b-1,24) /\ @FLT(up(A + 1b-1) - 1b-1,24) }
