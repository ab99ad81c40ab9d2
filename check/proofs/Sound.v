(** What the check accepts is true. *)
From Coq Require Import Reals List Bool ZArith Lia Lra Psatz.
From VkhCheck Require Import Statement Geometry Checker.
Open Scope R_scope.

(** * Integer points as real ones *)

Definition real (g : R) (p : ipoint) : point :=
  Point (g * IZR (ix p)) (g * IZR (iy p)) (g * IZR (iz p)).

Definition real_triangle (g : R) (t : itriangle) : triangle :=
  Triangle (real g (i0 t)) (real g (i1 t)) (real g (i2 t)).

Definition real_mesh (g : R) : list itriangle -> list triangle := map (real_triangle g).

Ltac reals := repeat rewrite ?plus_IZR, ?minus_IZR, ?mult_IZR, ?opp_IZR in *.

Ltac fields := cbn [ix iy iz i0 i1 i2 px py pz corner0 corner1 corner2
  origin edge0 edge1 d00 d01 d11 area] in *.

Ltac integer_points := repeat match goal with
  | p : ipoint |- _ => destruct p
  | t : itriangle |- _ => destruct t
  end; fields.

Lemma shiftl_real x k : (0 <= k)%Z -> IZR (Z.shiftl x k) = IZR x * IZR (2 ^ k).
Proof. intros. rewrite Z.shiftl_mul_pow2 by assumption. apply mult_IZR. Qed.

Lemma power_positive k : (0 <= k)%Z -> 0 < IZR (2 ^ k).
Proof. intros. apply IZR_lt. apply Z.pow_pos_nonneg; lia. Qed.

Lemma shift_real g h k p : (0 <= k)%Z -> g = h * IZR (2 ^ k) -> real h (shift k p) = real g p.
Proof.
  intros K G. unfold real, shift; cbn [ix iy iz].
  rewrite !shiftl_real by assumption. subst g. f_equal; ring.
Qed.

Lemma shift_triangle_real g h k t :
  (0 <= k)%Z -> g = h * IZR (2 ^ k) -> real_triangle h (shift_triangle k t) = real_triangle g t.
Proof.
  intros. unfold real_triangle, shift_triangle; cbn [i0 i1 i2]. now rewrite !(shift_real g h).
Qed.

(** * Near *)

(** The point of t with the weights x and y of its edges, and its distance from v. *)
Lemma at_weights g t v x y : 0 <= x -> 0 <= y -> x + y <= 1 ->
  let p := prepare t in
  let f := minus v (origin p) in
  exists q, covers (real_triangle g t) q /\
  square_distance (real g v) q
  = g * g * (IZR (dot f f) - 2 * x * IZR (dot f (edge0 p)) - 2 * y * IZR (dot f (edge1 p))
             + x * x * IZR (d00 p) + 2 * x * y * IZR (d01 p) + y * y * IZR (d11 p)).
Proof.
  intros Hx Hy H p f. exists (combination (1 - x - y) x y (real_triangle g t)). split.
  - exists (1 - x - y), x, y. repeat split; lra.
  - subst p f. unfold prepare, dot, minus, square_distance, combination, real_triangle, real.
    integer_points. reals. ring.
Qed.

Lemma near_edge_sound n d ff along len : (0 <= len)%Z -> near_edge n d ff along len = true ->
  exists t, 0 <= t <= 1 /\
  IZR d * (IZR ff - 2 * t * IZR along + t * t * IZR len) <= IZR n.
Proof.
  unfold near_edge. intros Hlen H.
  destruct (Z.leb_spec along 0) as [A | A].
  { exists 0. split; [ lra | ]. apply Z.leb_le, IZR_le in H. reals. lra. }
  destruct (Z.leb_spec len along) as [B | B].
  { exists 1. split; [ lra | ]. apply Z.leb_le, IZR_le in H. reals. lra. }
  apply IZR_lt in A, B. apply Z.leb_le, IZR_le in H. reals.
  assert (L : 0 < IZR len) by lra.
  assert (I : 0 < / IZR len) by now apply Rinv_0_lt_compat.
  exists (IZR along / IZR len). split.
  { split; [ apply Rlt_le, Rmult_lt_0_compat; assumption | ].
    apply (Rmult_le_reg_r (IZR len)); [ assumption | ]. unfold Rdiv.
    rewrite Rmult_assoc, Rinv_l by lra. lra. }
  apply (Rmult_le_reg_r (IZR len)); [ assumption | ].
  replace (IZR d * (IZR ff - 2 * (IZR along / IZR len) * IZR along
             + IZR along / IZR len * (IZR along / IZR len) * IZR len) * IZR len)
    with ((IZR ff * IZR len - IZR along * IZR along) * IZR d) by (field; lra).
  assumption.
Qed.

Lemma dot_positive a : (0 <= dot a a)%Z.
Proof. unfold dot. nia. Qed.

Lemma near_sound n d g t v : near n d (prepare t) v = true ->
  exists q, covers (real_triangle g t) q /\
  IZR d * square_distance (real g v) q <= g * g * IZR n.
Proof.
  unfold near. set (p := prepare t). set (f := minus v (origin p)).
  set (ff := dot f f). set (f0 := dot f (edge0 p)). set (f1 := dot f (edge1 p)).
  assert (Scale : forall x y, 0 <= x -> 0 <= y -> x + y <= 1 ->
    IZR d * (IZR ff - 2 * x * IZR f0 - 2 * y * IZR f1 + x * x * IZR (d00 p)
             + 2 * x * y * IZR (d01 p) + y * y * IZR (d11 p)) <= IZR n ->
    exists q, covers (real_triangle g t) q /\
              IZR d * square_distance (real g v) q <= g * g * IZR n).
  { intros x y Hx Hy Hxy H. destruct (at_weights g t v x y Hx Hy Hxy) as (q & C & E).
    exists q. split; [ exact C | ]. fold p in E. fold f in E. fold ff f0 f1 in E. rewrite E.
    apply (Rmult_le_compat_l (g * g)) in H; [ lra | nra ]. }
  assert (L0 : (0 <= d00 p)%Z) by apply dot_positive.
  assert (L1 : (0 <= d11 p)%Z) by apply dot_positive.
  assert (L2 : (0 <= d00 p - 2 * d01 p + d11 p)%Z).
  { assert (E : (d00 p - 2 * d01 p + d11 p)%Z
                = dot (minus (edge1 p) (edge0 p)) (minus (edge1 p) (edge0 p))).
    { subst p. unfold prepare, dot, minus. cbn [edge0 edge1 d00 d01 d11 ix iy iz]. ring. }
    rewrite E. apply dot_positive. }
  destruct ((0 <? area p)%Z && (0 <=? d11 p * f0 - d01 p * f1)%Z
            && (0 <=? d00 p * f1 - d01 p * f0)%Z
            && (d11 p * f0 - d01 p * f1 + (d00 p * f1 - d01 p * f0) <=? area p)%Z) eqn:Inside.
  - rewrite !andb_true_iff in Inside. destruct Inside as [[[A X] Y] XY]. intros H.
    apply Z.ltb_lt, IZR_lt in A. apply Z.leb_le, IZR_le in X, Y, XY, H.
    assert (Area : IZR (area p) = IZR (d00 p) * IZR (d11 p) - IZR (d01 p) * IZR (d01 p)).
    { rewrite <- !mult_IZR, <- minus_IZR. reflexivity. }
    reals. rewrite Area in *.
    set (aa := IZR (d00 p) * IZR (d11 p) - IZR (d01 p) * IZR (d01 p)) in *.
    assert (I : 0 < / aa) by now apply Rinv_0_lt_compat.
    apply (Scale ((IZR (d11 p) * IZR f0 - IZR (d01 p) * IZR f1) * / aa)
                 ((IZR (d00 p) * IZR f1 - IZR (d01 p) * IZR f0) * / aa)).
    + apply Rmult_le_pos; lra.
    + apply Rmult_le_pos; lra.
    + rewrite <- Rmult_plus_distr_r. apply (Rmult_le_reg_r aa); [ assumption | ].
      rewrite Rmult_assoc, Rinv_l by lra. lra.
    + apply (Rmult_le_reg_r aa); [ assumption | ]. refine (Rle_trans _ _ _ _ H).
      right. unfold aa. field. fold aa. lra.
  - rewrite !orb_true_iff. intros [[H | H] | H]; apply near_edge_sound in H; try assumption;
      destruct H as (w & Hw & H).
    + apply (Scale w 0); lra.
    + apply (Scale 0 w); lra.
    + apply (Scale (1 - w) w); try lra. refine (Rle_trans _ _ _ _ H). right. reals. ring.
Qed.

(** * The upper half *)

Section Upper.

Variables (y : list itriangle) (b : tree) (g u : R) (n d bits : Z).
Hypothesis Index : forall s t, find s b = Some t -> In t y.
Hypothesis D : (0 < d)%Z.
Hypothesis U : 0 <= u.
Hypothesis Bound : g * g * IZR n <= u * u * IZR d.
Hypothesis Bits : (0 <= bits)%Z.

Lemma all_near_sound h k s points : (0 <= k)%Z -> g = h * IZR (2 ^ k) ->
  all_near b n d k s points = true ->
  exists t, In t (real_mesh g y) /\
  forall v, In v points -> exists q, covers t q /\ distance (real h v) q <= u.
Proof.
  unfold all_near. intros K G H. destruct (find s b) as [t | ] eqn:F; [ | discriminate ].
  exists (real_triangle g t). split. { apply in_map, (Index s), F. }
  intros v V. rewrite forallb_forall in H. apply H in V.
  destruct (near_sound _ _ h _ _ V) as (q & C & E).
  rewrite (shift_triangle_real g h) in C by assumption.
  exists q. split; [ exact C | ]. apply distance_at_most; [ assumption | ].
  apply IZR_lt in D. apply (Rmult_le_reg_l (IZR d)); [ assumption | ].
  rewrite shiftl_real in E by lia.
  replace (h * h * (IZR n * IZR (2 ^ (2 * k)))) with (g * g * IZR n) in E.
  - lra.
  - subst g. replace (2 * k)%Z with (k + k)%Z by lia. rewrite Z.pow_add_r, mult_IZR by lia. ring.
Qed.

Definition is_near (t : triangle) : Prop :=
  forall p, covers t p -> exists q, surface (real_mesh g y) q /\ distance p q <= u.

Lemma near_leaf h k s a b' c : (0 <= k)%Z -> g = h * IZR (2 ^ k) ->
  all_near b n d k s (a :: b' :: c :: nil) = true ->
  is_near (Triangle (real h a) (real h b') (real h c)).
Proof.
  intros K G H p C. destruct (all_near_sound h k s _ K G H) as (t & T & N).
  destruct (leaf_near (Triangle (real h a) (real h b') (real h c)) t u p) as (q & Q & E);
    try exact C; try (apply N; cbn; tauto).
  exists q. split; [ now exists t | exact E ].
Qed.

Lemma near_split o j k s : 0 <= s < 1 ->
  is_near (Triangle o (between s o j) k) -> is_near (Triangle (between s o j) j k) ->
  is_near (Triangle o j k).
Proof.
  intros S A B p C. destruct (covers_split o j k s p S C); [ now apply A | now apply B ].
Qed.

Lemma near_turned a b' c : is_near (Triangle b' c a) -> is_near (Triangle a b' c).
Proof. intros H p C. apply H. now apply covers_turned. Qed.

Lemma near_swapped a b' c : is_near (Triangle a c b') -> is_near (Triangle a b' c).
Proof. intros H p C. apply H. now apply covers_swapped. Qed.

Lemma double_real h p : real (h / 2) (shift 1 p) = real h p.
Proof. apply shift_real; [ lia | ]. change (2 ^ 1)%Z with 2%Z. lra. Qed.

Lemma middle_real h p q : real (h / 2) (plus p q) = between (1 / 2) (real h p) (real h q).
Proof.
  unfold real, plus, between; cbn [ix iy iz px py pz]. reals. f_equal; field.
Qed.

(** Two halves cover the whole. *)
Lemma halves_near h opposite v :
  is_near (real_triangle (h / 2) (fst (halves opposite v))) ->
  is_near (real_triangle (h / 2) (snd (halves opposite v))) ->
  is_near (real_triangle h v).
Proof.
  destruct v as [a b' c]. unfold real_triangle.
  destruct opposite; cbn [halves fst snd i0 i1 i2]; rewrite !double_real, !middle_real; intros A B.
  - apply near_turned. apply (near_split _ _ _ (1 / 2)); [ lra | | ].
    + now do 2 apply near_turned.
    + now do 2 apply near_turned.
  - do 2 apply near_turned. apply (near_split _ _ _ (1 / 2)); [ lra | | ].
    + now apply near_turned.
    + now apply near_turned.
  - apply (near_split _ _ _ (1 / 2)); [ lra | exact A | exact B ].
Qed.

Lemma turned_near h o v : is_near (real_triangle h (turned o v)) -> is_near (real_triangle h v).
Proof.
  destruct v, o; cbn [turned]; unfold real_triangle; fields; intros H.
  - exact H.
  - now apply near_turned.
  - now do 2 apply near_turned.
Qed.

Lemma fraction_sound p : is_fraction bits p = true -> 0 <= IZR p / IZR (2 ^ bits) < 1.
Proof.
  unfold is_fraction. rewrite andb_true_iff, Z.leb_le, Z.ltb_lt.
  rewrite Z.shiftl_mul_pow2, Z.mul_1_l by assumption. intros [P Q].
  apply IZR_le in P. apply IZR_lt in Q.
  pose proof (power_positive bits Bits) as W.
  assert (I : 0 < / IZR (2 ^ bits)) by now apply Rinv_0_lt_compat.
  split.
  - apply Rmult_le_pos; lra.
  - apply (Rmult_lt_reg_r (IZR (2 ^ bits))); [ assumption | ]. unfold Rdiv.
    rewrite Rmult_assoc, Rinv_l by lra. lra.
Qed.

Lemma on_edge_real h p o a :
  real (h / IZR (2 ^ bits)) (on_edge bits p o a)
  = between (IZR p / IZR (2 ^ bits)) (real h o) (real h a).
Proof.
  pose proof (power_positive bits Bits).
  unfold real, on_edge, plus, times, between; cbn [ix iy iz px py pz].
  rewrite Z.shiftl_mul_pow2, Z.mul_1_l by assumption. reals. f_equal; field; lra.
Qed.

(** The two pieces of a leaf that is cut cover it. *)
Lemma cut_near h k o s r p q v : (0 <= k)%Z -> g = h * IZR (2 ^ k) ->
  check_part b bits n d k v (Cut o s r p q) = true -> is_near (real_triangle h v).
Proof.
  intros K G. cbn [check_part]. intros H. apply (turned_near h o).
  destruct (turned o v) as [c x z]. rewrite !andb_true_iff in H. destruct H as [[[P Q] S] R'].
  pose proof (power_positive bits Bits) as W.
  set (h' := h / IZR (2 ^ bits)).
  assert (E : h = h' * IZR (2 ^ bits)) by (unfold h'; field; lra).
  assert (G' : g = h' * IZR (2 ^ (k + bits))).
  { rewrite Z.pow_add_r, mult_IZR by lia. rewrite G, E. ring. }
  assert (K' : (0 <= k + bits)%Z) by lia.
  destruct (all_near_sound h' _ _ _ K' G' R') as (t & T & N).
  apply (near_leaf h' _ _ _ _ _ K' G') in S.
  set (piece := on_edge bits p c x :: on_edge bits q c z
                :: shift bits x :: shift bits z :: nil) in *.
  assert (N3 : forall a b' c', In a piece -> In b' piece -> In c' piece ->
    is_near (Triangle (real h' a) (real h' b') (real h' c'))).
  { intros a b' c' A B C w Cw.
    destruct (leaf_near (Triangle (real h' a) (real h' b') (real h' c')) t u w) as (w' & Q' & E');
      try exact Cw; try (apply N; assumption).
    exists w'. split; [ now exists t | exact E' ]. }
  assert (Real : forall w, real h' (shift bits w) = real h w) by (intros; now apply shift_real).
  unfold real_triangle; cbn [i0 i1 i2].
  apply (near_split _ _ _ (IZR p / IZR (2 ^ bits))); [ now apply fraction_sound | | ].
  - apply near_swapped. apply (near_split _ _ _ (IZR q / IZR (2 ^ bits)));
    [ now apply fraction_sound | | ].
    + apply near_swapped. rewrite <- !on_edge_real, <- (Real c). exact S.
    + rewrite <- !on_edge_real, <- (Real z). apply N3; cbn; tauto.
  - rewrite <- !on_edge_real, <- (Real x), <- (Real z). apply N3; cbn; tauto.
Qed.

Lemma check_part_sound it : forall h k v, (0 <= k)%Z -> g = h * IZR (2 ^ k) ->
  check_part b bits n d k v it = true -> is_near (real_triangle h v).
Proof.
  induction it as [opposite first IH1 second IH2 | s | o s r p q]; intros h k v K G H.
  - cbn [check_part] in H. destruct (halves opposite v) as [one other] eqn:E.
    rewrite andb_true_iff in H. destruct H as [H1 H2].
    assert (G' : g = h / 2 * IZR (2 ^ (k + 1))).
    { rewrite Z.pow_add_r, mult_IZR by lia. change (2 ^ 1)%Z with 2%Z. rewrite G. field. }
    apply (halves_near h opposite); rewrite E; cbn [fst snd].
    + apply (IH1 _ (k + 1)%Z); [ lia | exact G' | exact H1 ].
    + apply (IH2 _ (k + 1)%Z); [ lia | exact G' | exact H2 ].
  - now apply (near_leaf h k s).
  - now apply (cut_near h k o s r p q).
Qed.

Lemma check_faces_sound x its : check_faces b bits n d x its = true ->
  at_most (real_mesh g x) (real_mesh g y) u.
Proof.
  revert its. induction x as [ | face others IH]; intros its H p (t & T & C).
  - destruct T.
  - destruct its as [ | it its']; [ discriminate | ]. cbn [check_faces] in H.
    rewrite andb_true_iff in H. destruct H as [H1 H2]. cbn [real_mesh map] in T.
    destruct T as [T | T].
    + subst t. apply (check_part_sound it g 0 face); [ lia | | exact H1 | exact C ].
      change (2 ^ 0)%Z with 1%Z. lra.
    + apply (IH its' H2). now exists t.
Qed.

End Upper.

(** * The lower half *)

Section Lower.

Variables (h l : R) (n d : Z).
Hypothesis D : (0 < d)%Z.
Hypothesis L : 0 <= l.
Hypothesis Bound : l * l * IZR d <= h * h * IZR n.

Lemma along_real p c r :
  (px (real h p) - px (real h c)) * px (real 1 r) + (py (real h p) - py (real h c)) * py (real 1 r)
  + (pz (real h p) - pz (real h c)) * pz (real 1 r) = h * IZR (dot (minus p c) r).
Proof. unfold real, dot, minus. integer_points. reals. ring. Qed.

Lemma separates_sound p t r : 0 < h -> separates n d p t r = true ->
  forall q, covers (real_triangle h t) q -> l <= distance (real h p) q.
Proof.
  intros H0. unfold separates. rewrite !andb_true_iff. intros [[[R0 A] B] C].
  assert (Rr : px (real 1 r) ^ 2 + py (real 1 r) ^ 2 + pz (real 1 r) ^ 2 = IZR (dot r r)).
  { unfold real, dot. integer_points. reals. ring. }
  apply Z.ltb_lt, IZR_lt in R0. apply IZR_lt in D.
  assert (K : forall c, (0 <=? dot (minus p c) r)%Z
      && (n * dot r r <=? dot (minus p c) r * dot (minus p c) r * d)%Z = true ->
    0 <= h * IZR (dot (minus p c) r) /\
    l * l * IZR (dot r r) <= (h * IZR (dot (minus p c) r)) ^ 2).
  { intros c. rewrite andb_true_iff. intros [P Q]. apply Z.leb_le, IZR_le in P, Q. reals.
    set (a := IZR (dot (minus p c) r)) in *. split; [ nra | ].
    apply (Rmult_le_reg_l (IZR d)); [ assumption | ].
    apply (Rmult_le_compat_r (IZR (dot r r))) in Bound; [ | lra ].
    apply (Rmult_le_compat_l (h * h)) in Q; [ | nra ]. lra. }
  apply (separated (real_triangle h t) (real h p) (real 1 r) l L).
  - rewrite Rr. exact R0.
  - rewrite Rr. unfold real_triangle. fields.
    intros c [E | [E | E]]; subst c; rewrite along_real; apply K; rewrite ?andb_true_iff;
      assumption.
Qed.

Lemma beyond_side reach p a b c : beyond reach p a b c = true ->
  ((p + reach <= a /\ p + reach <= b /\ p + reach <= c) \/
   (a <= p - reach /\ b <= p - reach /\ c <= p - reach))%Z.
Proof.
  unfold beyond. rewrite orb_true_iff, !andb_true_iff, !Z.leb_le. tauto.
Qed.

Lemma along_axis reach a : (0 <= reach)%Z -> (n <= reach * reach * d)%Z -> (reach <= a)%Z ->
  (0 <= a /\ n <= a * a * d)%Z.
Proof.
  intros P Q A. split; [ lia | ].
  assert (reach * reach <= a * a)%Z by nia. nia.
Qed.

Lemma beyond_separates reach p t : (0 <= reach)%Z -> (n <= reach * reach * d)%Z ->
  beyond reach (ix p) (ix (i0 t)) (ix (i1 t)) (ix (i2 t)) = true
  \/ beyond reach (iy p) (iy (i0 t)) (iy (i1 t)) (iy (i2 t)) = true
  \/ beyond reach (iz p) (iz (i0 t)) (iz (i1 t)) (iz (i2 t)) = true ->
  exists r, separates n d p t r = true.
Proof.
  intros P Q.
  assert (K : forall a, (reach <= a)%Z -> (0 <= a)%Z /\ (n <= a * a * d)%Z)
    by (intros; now apply (along_axis reach)).
  assert (S : forall r, dot r r = 1%Z -> (reach <= dot (minus p (i0 t)) r)%Z ->
    (reach <= dot (minus p (i1 t)) r)%Z -> (reach <= dot (minus p (i2 t)) r)%Z ->
    separates n d p t r = true).
  { intros r Rr A B C. unfold separates. rewrite Rr, Z.mul_1_r.
    apply K in A, B, C. rewrite !andb_true_iff, !Z.leb_le. repeat split; tauto. }
  intros [H | [H | H]]; apply beyond_side in H; destruct H as [H | H];
    [ exists (IPoint (-1) 0 0) | exists (IPoint 1 0 0) | exists (IPoint 0 (-1) 0)
    | exists (IPoint 0 1 0) | exists (IPoint 0 0 (-1)) | exists (IPoint 0 0 1) ];
    apply S; unfold dot, minus; fields; lia.
Qed.

Lemma away_sound reach p t : 0 < h -> (0 <= reach)%Z -> (n <= reach * reach * d)%Z ->
  away n d reach p t = true ->
  forall q, covers (real_triangle h t) q -> l <= distance (real h p) q.
Proof.
  intros H0 P Q H. assert (E : exists r, separates n d p t r = true).
  { unfold away in H. rewrite !orb_true_iff in H.
    destruct H as [[[H | H] | H] | [[[[[[H | H] | H] | H] | H] | H] | H]];
      try (eexists; exact H); apply (beyond_separates reach); tauto. }
  destruct E as [r E]. now apply (separates_sound p t r).
Qed.

End Lower.

Lemma pick_in x : forall i face, pick x i = Some face -> In face x.
Proof.
  induction x as [ | first others IH]; intros i face H; [ discriminate | ]. cbn in *.
  destruct (i =? 0)%Z; [ left; congruence | right; now apply (IH (i - 1)%Z) ].
Qed.

Lemma witness_real g it face : (0 <= weight_bits it)%Z ->
  let w := IZR (2 ^ weight_bits it) in
  real (g / w) (witness_of it face)
  = combination (1 - IZR (weight_j it) / w - IZR (weight_k it) / w) (IZR (weight_j it) / w)
             (IZR (weight_k it) / w) (real_triangle g face).
Proof.
  intros B w. pose proof (power_positive _ B). fold w in H.
  unfold witness_of, plus, times, combination, real_triangle. fields. unfold real. fields.
  rewrite Z.shiftl_mul_pow2, Z.mul_1_l by assumption. reals. fold w. clearbody w.
  f_equal; field; lra.
Qed.

Lemma check_lower_sound it g l n d x y : 0 < g -> (0 < d)%Z -> 0 <= l ->
  l * l * IZR d <= g * g * IZR n -> check_lower it n d x y = true ->
  at_least (real_mesh g x) (real_mesh g y) l.
Proof.
  intros G D L Bound. unfold check_lower. destruct (pick x (witness it)) as [face | ] eqn:F;
    [ | discriminate ].
  rewrite !andb_true_iff, !Z.leb_le. intros [[[[[[B J] K] S] P] Q] H].
  rewrite Z.shiftl_mul_pow2, Z.mul_1_l in S by assumption.
  set (w := IZR (2 ^ weight_bits it)). assert (W : 0 < w) by now apply power_positive.
  apply IZR_le in J, K, S. reals. fold w in S.
  assert (I : 0 < / w) by now apply Rinv_0_lt_compat.
  exists (real (g / w) (witness_of it face)). split.
  - exists (real_triangle g face). split; [ apply in_map, (pick_in x _ face F) | ].
    pose proof (witness_real g it face B) as E. cbv zeta in E. fold w in E. rewrite E.
    exists (1 - IZR (weight_j it) / w - IZR (weight_k it) / w), (IZR (weight_j it) / w),
      (IZR (weight_k it) / w).
    repeat split; unfold Rdiv; try (apply Rmult_le_pos; lra); [ | lra ].
    apply (Rmult_le_compat_r (/ w)) in S; [ | lra ]. rewrite Rinv_r in S by lra. lra.
  - intros q (t & T & C). apply in_map_iff in T. destruct T as (s & E & T). subst t.
    rewrite forallb_forall in H. apply H in T.
    assert (G' : g = g / w * w) by (field; lra).
    rewrite <- (shift_triangle_real g (g / w) (weight_bits it)) in C by assumption.
    refine (away_sound (g / w) l _ d D L _ _ _ _ _ P Q T q C).
    + rewrite shiftl_real by lia. replace (2 * weight_bits it)%Z
        with (weight_bits it + weight_bits it)%Z by lia.
      rewrite Z.pow_add_r, mult_IZR by lia. fold w.
      replace (g / w * (g / w) * (IZR n * (w * w))) with (g * g * IZR n) by (field; lra).
      exact Bound.
    + apply Rmult_lt_0_compat; assumption.
Qed.
