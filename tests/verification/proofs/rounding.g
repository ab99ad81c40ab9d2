#@ theorem round_up and round_down absorb n kUlp, n <= 64, and the flush of what they are given
#@ quote certified.h: VKH_FN float round_up(float x, float n) { return x * (1.0f + (n + {up}f) * kUlp) + kTiny; }
#@ quote certified.h: return max(x * (1.0f - (n + {down}f) * kUlp) - kTiny, 0.0f);
#@ weakest up: holds at 1.001, fails at 1
#@ weakest down: holds at 1, fails at 0.99
#@ weakest kUlp: holds at 2^-23, fails at 2^-24
# The factor is a float: n is whole and at most 64. T is the product's rounding. The sum with kTiny rounds to no less than
# the product, which is a float itself: so it costs nothing. Likewise downwards.
# x >= t (1 - n ulp) for the t that is meant; result >= x F (1 + T): so F (1 + T) (1 - n ulp) >= 1 is to be shown.
# Under 2^-100 a product may be flushed: there kTiny alone is enough.
#@ case round_up
{ N in [0,64] /\ T in @{both(ulp)} -> (1 + (N + @{up}) * @{kUlp}) * (1 + T) * (1 - N * @{ulp}) - 1 >= 0 }
(1 + (N + @{up}) * @{kUlp}) * (1 + T) * (1 - N * @{ulp}) - 1
  -> (@{up} * @{kUlp} + N * (@{kUlp} - @{ulp}) - (N + @{up}) * N * @{kUlp * ulp}) * (1 + T) + T;
#@ case round_down
{ N in [0,64] /\ T in @{both(ulp)} -> (1 - (N + @{down}) * @{kUlp}) * (1 + T) * (1 + N * @{ulp}) - 1 <= 0 }
(1 - (N + @{down}) * @{kUlp}) * (1 + T) * (1 + N * @{ulp}) - 1
  -> (N * (@{ulp} - @{kUlp}) - @{down} * @{kUlp} - (N + @{down}) * N * @{kUlp * ulp}) * (1 + T) + T;
#@ case round_up, under 2^-100
{ X in [0,1b-100] -> @{kTiny} - X * 2 >= 0 }
