(** For the proofs that gappa -Bcoq writes: identities that it takes as given, and a fact about
    directed rounding that libcoq-gappa 1.5 lacks. *)
From Coq Require Import Lia ZArith.
From Coq Require Export Reals Lra.
Require Import Gappa.Gappa_library.
From Flocq Require Import Core.
Open Scope R_scope.

(** An identity of real numbers, as in a hint. *)
Ltac identity :=
  intros; unfold float2R, Float1, F2R; cbn; field; repeat split; first [ assumption | lra ].

#[export] Instance precision_is_positive : Prec_gt_0 24 := eq_refl.

(** A directed rounding is off by at most 2^e where abs(x) <= 2^(e + 24). *)
Lemma rounded_within rnd (V : Valid_rnd rnd) x e : (-149 <= e)%Z ->
  Rabs x <= bpow radix2 (e + 24) ->
  Rabs (round radix2 (FLT_exp (-149) 24) rnd x - x) <= bpow radix2 e.
Proof.
  intros E [H | H].
  - refine (Rle_trans _ _ _ (error_le_ulp radix2 (FLT_exp (-149) 24) rnd x) _).
    destruct (Req_dec x 0) as [Z | N].
    + subst x. rewrite ulp_FLT_0; [ now apply bpow_le | exact precision_is_positive ].
    + rewrite ulp_neq_0 by assumption. apply bpow_le. unfold cexp, FLT_exp.
      assert (mag radix2 x <= e + 24)%Z by now apply mag_le_bpow. lia.
  - assert (F : generic_format radix2 (FLT_exp (-149) 24) x).
    { apply generic_format_abs_inv. rewrite H. apply generic_format_FLT_bpow; [ reflexivity | lia ]. }
    rewrite round_generic by assumption. rewrite Rminus_diag_eq by reflexivity.
    rewrite Rabs_R0. apply bpow_ge_0.
Qed.

Lemma rounded_up x e : (-149 <= e)%Z -> Rabs x <= bpow radix2 (e + 24) ->
  0 <= round radix2 (FLT_exp (-149) 24) Zceil x - x <= bpow radix2 e.
Proof.
  intros E H. pose proof (rounded_within Zceil _ x e E H) as B.
  destruct (round_UP_pt radix2 (FLT_exp (-149) 24) x) as (_ & U & _).
  apply Rabs_le_inv in B. lra.
Qed.

Lemma rounded_down x e : (-149 <= e)%Z -> Rabs x <= bpow radix2 (e + 24) ->
  - bpow radix2 e <= round radix2 (FLT_exp (-149) 24) Zfloor x - x <= 0.
Proof.
  intros E H. pose proof (rounded_within Zfloor _ x e E H) as B.
  destruct (round_DN_pt radix2 (FLT_exp (-149) 24) x) as (_ & U & _).
  apply Rabs_le_inv in B. lra.
Qed.

(** Makes a bound of an interval a number that lra reads. *)
Ltac plain f :=
  let m := eval cbv in (Gappa_definitions.Fnum f) in let e := eval cbv in (Gappa_definitions.Fexp f) in
  change f with (Float2 m e) in *.

(** Gappa's float_absolute_wide: the error of a directed rounding, from the bounds of its operand.
    The fact is one of the two above, and the side is where the error's bound is not 0. *)
Ltac absolute_wide fact side :=
  lazymatch goal with
  | H : BND ?x ?from |- BND _ ?to =>
    let e := eval cbv in (Gappa_definitions.Fexp (side to)) in
    let E := fresh in
    pose proof (fact x e) as E; unfold BND in *;
    plain (lower from); plain (upper from); plain (lower to); plain (upper to);
    unfold float2R, F2R in *; cbn in *;
    lapply E; [ clear E; intros E; lapply E; [ lra | apply Rabs_le; lra ] | lia ]
  end.
