(** One certificate that the check accepts, and four that it refuses: the theorem is about
    something. *)
From Coq Require Import Reals List ZArith Lra.
From VkhCheck Require Import Statement Checker Main.
Import ListNotations.

(** A triangle, and the same one unit above it, in inches: 127 / 5 mm. *)
Definition at_height (z : Z) : given :=
  Given 0 [ITriangle (IPoint 0 0 z) (IPoint 4 0 z) (IPoint 0 4 z)] (Placement 127 5 None).

Definition one_leaf_of (delta_a delta_b low high : dyadic) : certificate :=
  Certificate delta_a delta_b 16 (Direction low high 0 1 1 0 [Leaf 1]) None.

Definition one_leaf : dyadic -> dyadic -> certificate := one_leaf_of (Dyadic 0 0) (Dyadic 0 0).

(** 25.25 and 25.5, on either side of 25.4. *)
Example accepted :
  check_given 0 (one_leaf (Dyadic 101 (-2)) (Dyadic 51 (-1))) (at_height 1) (at_height 0) = true.
Proof. reflexivity. Qed.

Example upper_is_too_small :
  check_given 0 (one_leaf (Dyadic 101 (-2)) (Dyadic 101 (-2))) (at_height 1) (at_height 0) = false.
Proof. reflexivity. Qed.

Example lower_is_too_large :
  check_given 0 (one_leaf (Dyadic 51 (-1)) (Dyadic 51 (-1))) (at_height 1) (at_height 0) = false.
Proof. reflexivity. Qed.

(** A negative delta, however small, is refused where 0 is accepted. *)
Example delta_a_is_negative :
  check_given 0 (one_leaf_of (Dyadic (-1) (-9)) (Dyadic 0 0) (Dyadic 101 (-2)) (Dyadic 51 (-1)))
    (at_height 1) (at_height 0) = false.
Proof. reflexivity. Qed.

Example delta_b_is_negative :
  check_given 0 (one_leaf_of (Dyadic 0 0) (Dyadic (-1) (-9)) (Dyadic 101 (-2)) (Dyadic 51 (-1)))
    (at_height 1) (at_height 0) = false.
Proof. reflexivity. Qed.

Example what_it_proves :
  at_most (mesh_of (at_height 1)) (mesh_of (at_height 0)) 25.5 /\
  at_least (mesh_of (at_height 1)) (mesh_of (at_height 0)) 25.25.
Proof.
  destruct (check_given_itself _ _ _ _ accepted) as [[U L] _]; cbn in *; unfold value in *;
    cbn in *.
  split.
  - replace 25.5%R with (51 * / (2 * 1))%R by lra. assumption.
  - replace 25.25%R with (101 * / (2 * (2 * 1)))%R by lra. assumption.
Qed.
