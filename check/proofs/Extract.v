(** The check as an OCaml program over Zarith. What stands here is trusted: each operation of Coq's
    integers is Zarith's, by integers.ml. Triangles' numbers are OCaml's int: under 2^62. *)
From Coq Require Import ZArith Extraction ExtrOcamlBasic.
From VkhCheck Require Import Checker.

Extract Inductive positive => "int" [ "(fun p -> 2 * p + 1)" "(fun p -> 2 * p)" "1" ]
  "(fun one zero last p -> if p = 1 then last () else
    if p land 1 = 1 then one (p lsr 1) else zero (p lsr 1))".
Extract Inlined Constant Pos.succ => "succ".

Extract Inductive Z => "Integers.t" [ "Integers.zero" "Integers.of_int"
  "(fun p -> Integers.of_int (- p))" ]
  "(fun zero positive negative z -> let s = Integers.sign z in
    if s = 0 then zero () else if s > 0 then positive (Integers.to_int z)
    else negative (Integers.to_int (Integers.neg z)))".
Extract Inlined Constant Z.add => "Integers.add".
Extract Inlined Constant Z.sub => "Integers.sub".
Extract Inlined Constant Z.mul => "Integers.mul".
Extract Inlined Constant Z.min => "Integers.min".
Extract Inlined Constant Z.eqb => "Integers.equal".
Extract Inlined Constant Z.leb => "Integers.leq".
Extract Inlined Constant Z.ltb => "Integers.lt".
Extract Inlined Constant Z.shiftl => "Integers.shiftl".
Extract Inlined Constant Z.div => "Integers.quotient".
Extract Inlined Constant Z.sqrt => "Integers.root".
Extract Inlined Constant negb => "not".

Extraction "proven.ml" check_given.
