(* Zarith's integers as Coq's: with Coq's values where a shift is negative, a divisor 0, or a root
   of a negative number. *)

include Z

let shiftl a n =
  let n = to_int n in
  if n >= 0 then shift_left a n else shift_right a (Int.neg n)

let quotient a b = if sign b = 0 then zero else fdiv a b
let root a = if sign a < 0 then zero else sqrt a
