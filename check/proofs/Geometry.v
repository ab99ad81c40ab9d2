(** Lemmas on real points and triangles. *)
From Coq Require Import Reals List Lra Psatz.
From VkhCheck Require Import Statement.
Open Scope R_scope.

(** * Squared distances *)

Definition square_distance (p q : point) : R :=
  (px p - px q) ^ 2 + (py p - py q) ^ 2 + (pz p - pz q) ^ 2.

Lemma square_distance_positive p q : 0 <= square_distance p q.
Proof.
  unfold square_distance. pose proof (pow2_ge_0 (px p - px q)).
  pose proof (pow2_ge_0 (py p - py q)). pose proof (pow2_ge_0 (pz p - pz q)). lra.
Qed.

Lemma distance_positive p q : 0 <= distance p q.
Proof. apply sqrt_pos. Qed.

Lemma distance_squared p q : distance p q * distance p q = square_distance p q.
Proof. apply sqrt_sqrt, square_distance_positive. Qed.

Lemma distance_at_most p q u : 0 <= u -> square_distance p q <= u * u -> distance p q <= u.
Proof.
  intros Hu H. rewrite <- (sqrt_square u Hu). now apply sqrt_le_1_alt.
Qed.

Lemma distance_at_least p q l : 0 <= l -> l * l <= square_distance p q -> l <= distance p q.
Proof.
  intros Hl H. rewrite <- (sqrt_square l Hl). now apply sqrt_le_1_alt.
Qed.

Lemma distance_symmetric p q : distance p q = distance q p.
Proof. unfold distance. f_equal. ring. Qed.

(** ** Cauchy-Schwarz *)

Lemma cauchy_schwarz x y z u v w :
  (x * u + y * v + z * w) ^ 2 <= (x ^ 2 + y ^ 2 + z ^ 2) * (u ^ 2 + v ^ 2 + w ^ 2).
Proof.
  assert (E : (x ^ 2 + y ^ 2 + z ^ 2) * (u ^ 2 + v ^ 2 + w ^ 2) - (x * u + y * v + z * w) ^ 2
              = (x * v - y * u) ^ 2 + (y * w - z * v) ^ 2 + (z * u - x * w) ^ 2) by ring.
  pose proof (pow2_ge_0 (x * v - y * u)). pose proof (pow2_ge_0 (y * w - z * v)).
  pose proof (pow2_ge_0 (z * u - x * w)). lra.
Qed.

Lemma from_squares a b : 0 <= b -> a ^ 2 <= b ^ 2 -> a <= b.
Proof. intros. destruct (Rle_dec a b); [ assumption | nra ]. Qed.

Lemma triangle_inequality p q r : distance p r <= distance p q + distance q r.
Proof.
  pose proof (distance_positive p q) as H1. pose proof (distance_positive q r) as H2.
  pose proof (distance_squared p q) as S1. pose proof (distance_squared q r) as S2.
  apply distance_at_most; [ lra | ].
  assert (C : (px p - px q) * (px q - px r) + (py p - py q) * (py q - py r)
              + (pz p - pz q) * (pz q - pz r) <= distance p q * distance q r).
  { apply from_squares; [ nra | ].
    replace ((distance p q * distance q r) ^ 2)
      with ((distance p q * distance p q) * (distance q r * distance q r)) by ring.
    rewrite S1, S2. apply cauchy_schwarz. }
  assert (E : square_distance p r = square_distance p q + square_distance q r
    + 2 * ((px p - px q) * (px q - px r) + (py p - py q) * (py q - py r)
           + (pz p - pz q) * (pz q - pz r))) by (unfold square_distance; ring).
  rewrite E, <- S1, <- S2. nra.
Qed.

(** * Convex combinations *)

Ltac points := repeat match goal with
  | p : point |- _ => destruct p
  | t : triangle |- _ => destruct t
  end; unfold combination, square_distance in *; cbn [px py pz corner0 corner1 corner2] in *.

Ltac same_point := points; f_equal.

(** The squares of a sum of three numbers whose weights add up to 1. *)
Lemma jensen a b c x y z : 0 <= a -> 0 <= b -> 0 <= c -> a + b + c = 1 ->
  (a * x + b * y + c * z) ^ 2 <= a * x ^ 2 + b * y ^ 2 + c * z ^ 2.
Proof.
  intros Ha Hb Hc S.
  assert (E : a * x ^ 2 + b * y ^ 2 + c * z ^ 2 - (a * x + b * y + c * z) ^ 2
              = a * b * (x - y) ^ 2 + a * c * (x - z) ^ 2 + b * c * (y - z) ^ 2).
  { replace a with (1 - b - c) by lra. ring. }
  pose proof (Rmult_le_pos _ _ (Rmult_le_pos _ _ Ha Hb) (pow2_ge_0 (x - y))).
  pose proof (Rmult_le_pos _ _ (Rmult_le_pos _ _ Ha Hc) (pow2_ge_0 (x - z))).
  pose proof (Rmult_le_pos _ _ (Rmult_le_pos _ _ Hb Hc) (pow2_ge_0 (y - z))). lra.
Qed.

(** No point of a triangle moves farther than its corners do. *)
Lemma combination_near s t delta a b c :
  corners_within delta s t -> 0 <= a -> 0 <= b -> 0 <= c -> a + b + c = 1 ->
  distance (combination a b c s) (combination a b c t) <= delta.
Proof.
  intros (H0 & H1 & H2) Ha Hb Hc S.
  assert (D : 0 <= delta) by (eapply Rle_trans; [ apply distance_positive | exact H0 ]).
  assert (Q : forall p q, distance p q <= delta -> square_distance p q <= delta * delta).
  { intros p q H. rewrite <- distance_squared. pose proof (distance_positive p q). nra. }
  apply distance_at_most; [ exact D | ].
  apply Q in H0, H1, H2.
  set (u := delta * delta) in *.
  assert (M : a * square_distance (corner0 s) (corner0 t)
              + b * square_distance (corner1 s) (corner1 t)
              + c * square_distance (corner2 s) (corner2 t) <= u).
  { apply (Rmult_le_compat_l a) in H0; [ | assumption ].
    apply (Rmult_le_compat_l b) in H1; [ | assumption ].
    apply (Rmult_le_compat_l c) in H2; [ | assumption ].
    assert (a * u + b * u + c * u = u) by (replace (a * u + b * u + c * u) with ((a + b + c) * u)
      by ring; rewrite S; ring). lra. }
  refine (Rle_trans _ _ _ _ M). clear M H0 H1 H2 Q.
  destruct s as [[x0 y0 z0] [x1 y1 z1] [x2 y2 z2]], t as [[u0 v0 w0] [u1 v1 w1] [u2 v2 w2]].
  unfold square_distance, combination; cbn [px py pz corner0 corner1 corner2].
  pose proof (jensen a b c (x0 - u0) (x1 - u1) (x2 - u2) Ha Hb Hc S).
  pose proof (jensen a b c (y0 - v0) (y1 - v1) (y2 - v2) Ha Hb Hc S).
  pose proof (jensen a b c (z0 - w0) (z1 - w1) (z2 - w2) Ha Hb Hc S).
  replace (a * x0 + b * x1 + c * x2 - (a * u0 + b * u1 + c * u2))
    with (a * (x0 - u0) + b * (x1 - u1) + c * (x2 - u2)) by ring.
  replace (a * y0 + b * y1 + c * y2 - (a * v0 + b * v1 + c * v2))
    with (a * (y0 - v0) + b * (y1 - v1) + c * (y2 - v2)) by ring.
  replace (a * z0 + b * z1 + c * z2 - (a * w0 + b * w1 + c * w2))
    with (a * (z0 - w0) + b * (z1 - w1) + c * (z2 - w2)) by ring.
  lra.
Qed.

(** A triangle is convex. *)
Lemma covers_convex t s a b c :
  covers t (corner0 s) -> covers t (corner1 s) -> covers t (corner2 s) ->
  0 <= a -> 0 <= b -> 0 <= c -> a + b + c = 1 -> covers t (combination a b c s).
Proof.
  intros (a0 & b0 & c0 & Ha0 & Hb0 & Hc0 & S0 & E0) (a1 & b1 & c1 & Ha1 & Hb1 & Hc1 & S1 & E1)
         (a2 & b2 & c2 & Ha2 & Hb2 & Hc2 & S2 & E2) Ha Hb Hc S.
  exists (a * a0 + b * a1 + c * a2), (a * b0 + b * b1 + c * b2), (a * c0 + b * c1 + c * c2).
  repeat split; try (repeat apply Rplus_le_le_0_compat; apply Rmult_le_pos; assumption).
  - replace (a * a0 + b * a1 + c * a2 + (a * b0 + b * b1 + c * b2) + (a * c0 + b * c1 + c * c2))
      with (a * (a0 + b0 + c0) + b * (a1 + b1 + c1) + c * (a2 + b2 + c2)) by ring.
    rewrite S0, S1, S2. lra.
  - destruct s as [s0 s1 s2]; cbn [corner0 corner1 corner2] in *. subst.
    unfold combination; cbn [px py pz corner0 corner1 corner2]. f_equal; ring.
Qed.

Lemma covers_corner0 t : covers t (corner0 t).
Proof. exists 1, 0, 0. repeat split; try lra. same_point; ring. Qed.

Lemma covers_turned a b c p : covers (Triangle a b c) p -> covers (Triangle b c a) p.
Proof.
  intros (x & y & z & Hx & Hy & Hz & S & E). exists y, z, x.
  repeat split; try lra. subst. same_point; ring.
Qed.
Lemma covers_swapped a b c p : covers (Triangle a b c) p -> covers (Triangle a c b) p.
Proof.
  intros (x & y & z & Hx & Hy & Hz & S & E). exists x, z, y.
  repeat split; try lra. subst. same_point; ring.
Qed.

(** The point from o towards j, by the fraction s. *)
Definition between (s : R) (o j : point) : point :=
  Point ((1 - s) * px o + s * px j) ((1 - s) * py o + s * py j) ((1 - s) * pz o + s * pz j).

(** A triangle is cut in two by a segment from a corner to a point on the edge opposite it. *)
Lemma covers_split o j k s p : 0 <= s < 1 -> covers (Triangle o j k) p ->
  covers (Triangle o (between s o j) k) p \/ covers (Triangle (between s o j) j k) p.
Proof.
  intros [Hs0 Hs1] (a & b & c & Ha & Hb & Hc & S & E).
  destruct (Rle_dec (a * s) (b * (1 - s))) as [H | H].
  - right. exists (a / (1 - s)), (b - a * s / (1 - s)), c.
    assert (I : 0 < / (1 - s)) by (apply Rinv_0_lt_compat; lra).
    assert (M : (1 - s) * / (1 - s) = 1) by (apply Rinv_r; lra).
    unfold Rdiv. repeat split; try assumption.
    + nra.
    + assert (a * s * / (1 - s) <= b * (1 - s) * / (1 - s)) by (apply Rmult_le_compat_r; lra).
      replace (b * (1 - s) * / (1 - s)) with b in * by (rewrite Rmult_assoc, M; ring). lra.
    + replace (a * / (1 - s) + (b - a * s * / (1 - s)) + c)
        with (a * ((1 - s) * / (1 - s)) + b + c) by ring. rewrite M. lra.
    + subst. unfold between. same_point; field; lra.
  - left. assert (0 < s) by nra.
    assert (I : 0 < / s) by now apply Rinv_0_lt_compat.
    assert (M : s * / s = 1) by (apply Rinv_r; lra).
    exists (a - b * (1 - s) / s), (b / s), c.
    unfold Rdiv. repeat split; try assumption.
    + assert (b * (1 - s) * / s <= a * s * / s) by (apply Rmult_le_compat_r; lra).
      replace (a * s * / s) with a in * by (rewrite Rmult_assoc, M; ring). lra.
    + nra.
    + replace (a - b * (1 - s) * / s + b * / s + c) with (a + b * (s * / s) + c) by ring.
      rewrite M. lra.
    + subst. unfold between. same_point; field; lra.
Qed.

(** * The upper half, for a leaf *)

(** Where each corner of a part has a point of a triangle within u, each point of it has one. *)
Lemma leaf_near t s u p :
  (exists q, covers s q /\ distance (corner0 t) q <= u) ->
  (exists q, covers s q /\ distance (corner1 t) q <= u) ->
  (exists q, covers s q /\ distance (corner2 t) q <= u) ->
  covers t p -> exists q, covers s q /\ distance p q <= u.
Proof.
  intros (q0 & C0 & D0) (q1 & C1 & D1) (q2 & C2 & D2) (a & b & c & Ha & Hb & Hc & S & E).
  exists (combination a b c (Triangle q0 q1 q2)). split.
  - now apply covers_convex.
  - subst p. apply combination_near; try assumption. repeat split; assumption.
Qed.

(** * The lower half, for a triangle *)

(** Where a direction r has all corners of a triangle at least l behind p, so are all its points. *)
Lemma separated t p r l :
  0 <= l -> 0 < px r ^ 2 + py r ^ 2 + pz r ^ 2 ->
  (forall c, c = corner0 t \/ c = corner1 t \/ c = corner2 t ->
     0 <= (px p - px c) * px r + (py p - py c) * py r + (pz p - pz c) * pz r /\
     l * l * (px r ^ 2 + py r ^ 2 + pz r ^ 2)
     <= ((px p - px c) * px r + (py p - py c) * py r + (pz p - pz c) * pz r) ^ 2) ->
  forall q, covers t q -> l <= distance p q.
Proof.
  intros Hl Hr H q (a & b & c & Ha & Hb & Hc & S & E).
  set (n := px r ^ 2 + py r ^ 2 + pz r ^ 2) in *.
  set (along x := (px p - px x) * px r + (py p - py x) * py r + (pz p - pz x) * pz r) in *.
  assert (N : sqrt n * sqrt n = n) by (apply sqrt_sqrt; lra).
  assert (N0 : 0 <= sqrt n) by apply sqrt_pos.
  assert (K : forall x, x = corner0 t \/ x = corner1 t \/ x = corner2 t -> l * sqrt n <= along x).
  { intros x Hx. destruct (H x Hx) as [P Q]. apply from_squares; [ exact P | ].
    replace ((l * sqrt n) ^ 2) with (l * l * (sqrt n * sqrt n)) by ring. now rewrite N. }
  assert (L : l * sqrt n <= along q).
  { pose proof (K _ (or_introl eq_refl)) as K0.
    pose proof (K _ (or_intror (or_introl eq_refl))) as K1.
    pose proof (K _ (or_intror (or_intror eq_refl))) as K2.
    apply (Rmult_le_compat_l a) in K0; [ | assumption ].
    apply (Rmult_le_compat_l b) in K1; [ | assumption ].
    apply (Rmult_le_compat_l c) in K2; [ | assumption ].
    assert (V : along q = a * along (corner0 t) + b * along (corner1 t) + c * along (corner2 t)).
    { subst q. unfold along, combination; cbn [px py pz]. replace a with (1 - b - c) by lra. ring. }
    assert (l * sqrt n = a * (l * sqrt n) + b * (l * sqrt n) + c * (l * sqrt n)).
    { replace (a * (l * sqrt n) + b * (l * sqrt n) + c * (l * sqrt n))
        with ((a + b + c) * (l * sqrt n)) by ring. rewrite S. ring. }
    lra. }
  apply distance_at_least; [ exact Hl | ].
  assert (C : along q ^ 2 <= square_distance p q * n) by apply cauchy_schwarz.
  assert (l * l * n <= along q ^ 2).
  { rewrite <- N. assert (0 <= l * sqrt n) by nra. nra. }
  apply (Rmult_le_reg_r n); [ exact Hr | lra ].
Qed.
