#@ theorem in doubles, round_up and round_down absorb n kUlp, n <= 64; raised and lowered leave 3 kUlp
#@ quote certified.h: inline double round_up(double x, double n) { return x * (1.0 + (n + {up}) * kUlp) + kTiny; }
#@ quote certified.h: return max(x * (1.0 - (n + {down}) * kUlp) - kTiny, 0.0);
#@ quote certified.h: inline double raised(double x) { return x + ({raising} * kUlp * abs(x) + kTiny); }
#@ quote certified.h: inline double lowered(double x) { return x - ({lowering} * kUlp * abs(x) + kTiny); }
#@ quote certified.h: inline constexpr double kUlp = 0x1p-{bits};
#@ let u = 2 ** (0 - 53)
#@ let kUlp = 2 ** (0 - bits)
#@ weakest up: holds at 0.51, fails at 0.49
#@ weakest down: holds at 0.5, fails at 0.49
#@ weakest raising: holds at 3.6, fails at 3.4
#@ weakest lowering: holds at 3.6, fails at 3.4
# By hand. As rounding.g of the floats: T is the product's rounding; the sum with kTiny rounds to no less than the product,
# a double itself. In raised, x is 1 or -1 as a unit, P the product's rounding and S the sum's.
#@ case round_up
{ N in [0,64] /\ T in @{both(u)} -> (1 + (N + @{up}) * @{kUlp}) * (1 + T) * (1 - N * @{kUlp}) - 1 >= 0 }
(1 + (N + @{up}) * @{kUlp}) * (1 + T) * (1 - N * @{kUlp}) - 1
  -> (@{up} * @{kUlp} - (N + @{up}) * N * @{kUlp * kUlp}) * (1 + T) + T;
#@ case round_down
{ N in [0,64] /\ T in @{both(u)} -> (1 - (N + @{down}) * @{kUlp}) * (1 + T) * (1 + N * @{kUlp}) - 1 <= 0 }
(1 - (N + @{down}) * @{kUlp}) * (1 + T) * (1 + N * @{kUlp}) - 1
  -> (0 - @{down} * @{kUlp} - (N + @{down}) * N * @{kUlp * kUlp}) * (1 + T) + T;
#@ case raised, lowered: away from 0
{ P in @{both(u)} /\ S in @{both(u)} -> (1 + @{min(raising, lowering) * kUlp} * (1 + P)) * (1 + S) - 1 >= @{3 * kUlp} }
#@ case raised, lowered: towards 0
{ P in @{both(u)} /\ S in @{both(u)} -> (1 - @{min(raising, lowering) * kUlp} * (1 + P)) * (1 + S) - 1 <= @{0 - 3 * kUlp} }
