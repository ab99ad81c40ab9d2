#@ theorem closest_point's weights, and plain_distance2's, have 0 <= v, w and v + w <= 1 exactly
#@ quote triangle.h: Closest inner; inner.offset = normal;
#@ quote triangle.h: bool in_halves = both(v >= 0.0f, both(w >= 0.0f, v + w <= 1.0f - {guard}f * kUlp)); if (both(has_inside, in_halves)) {
#@ quote triangle.h: bool in_halves = both(v >= 0.0f, both(w >= 0.0f, v + w <= 1.0f - {plain_guard}f * kUlp)); inside = both(hh > kSmallSquare, in_halves);
#@ quote triangle.h: c.v = clamp(t, 0.0f, 1.0f); c.w = 0.0f;
#@ weakest guard: holds at 0.5, fails at 0
#@ weakest plain_guard: holds at 0.5, fails at 0
# If v + w > 1, its rounding is at least 1, in any direction, since 1 is a float. The limit is a float under 1: so the test
# refuses it. has_inside and hh take no part: whatever v and w are, the point is in the triangle.
@down = float<24,-149,dn>; @up = float<24,-149,up>;
#@ case a sum over 1
{ S in [1,2] -> down(S) >= 1 /\ up(S) >= 1 }
#@ case the limit
{ T in [0,0] -> up(1 - @{guard * kUlp} + T) <= @{1 - ulp / 2} }
#@ case plain_distance2's limit
{ T in [0,0] -> up(1 - @{plain_guard * kUlp} + T) <= @{1 - ulp / 2} }
