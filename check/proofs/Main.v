(** The theorem: what the check accepts holds for all meshes whose corners are within the deltas of
    those that were given. *)
From Coq Require Import Reals List Bool ZArith Lia Lra Psatz.
From VkhCheck Require Import Statement Geometry Checker Sound.
Open Scope R_scope.

(** * The numbers of a certificate and the meshes that it is about *)

Definition value (x : dyadic) : R := IZR (mantissa x) * powerRZ 2 (exponent x).

Definition step (g : grid) : R := powerRZ 2 (power g) / IZR (scale g).

(** The mesh whose corners are these integers times the grid's step. *)
Definition mesh (g : grid) (m : list itriangle) : list triangle := real_mesh (step g) m.

Definition holds (it : direction) (a b : list triangle) : Prop :=
  at_most a b (value (upper it)) /\ at_least a b (value (lower it)).

(** * Powers of two *)

Lemma two_power_positive i : 0 < powerRZ 2 i.
Proof. apply powerRZ_lt. lra. Qed.

Lemma two_power_sum i j : powerRZ 2 (i + j) = powerRZ 2 i * powerRZ 2 j.
Proof. apply powerRZ_add. lra. Qed.

Lemma two_power_integer i : (0 <= i)%Z -> IZR (2 ^ i) = powerRZ 2 i.
Proof.
  intros. rewrite <- (Z2Nat.id i) at 1 by assumption.
  rewrite <- pow_IZR, pow_powerRZ. now rewrite Z2Nat.id.
Qed.

Lemma aligned_value x least : (least <= exponent x)%Z ->
  IZR (Z.shiftl (mantissa x) (exponent x - least)) * powerRZ 2 least = value x.
Proof.
  intros. rewrite shiftl_real, two_power_integer by lia. unfold value.
  replace (powerRZ 2 (exponent x)) with (powerRZ 2 (exponent x - least + least)) by (f_equal; lia).
  rewrite two_power_sum. ring.
Qed.

Lemma claimed_value c side a b :
  value (claimed c side a b) = value c + IZR side * (value a + value b).
Proof.
  unfold claimed. set (least := Z.min (exponent c) (Z.min (exponent a) (exponent b))).
  unfold value at 1; cbn [mantissa exponent].
  rewrite plus_IZR, mult_IZR, plus_IZR.
  rewrite <- (aligned_value c least), <- (aligned_value a least), <- (aligned_value b least)
    by (unfold least; lia). ring.
Qed.

Lemma step_positive g : (0 < scale g)%Z -> 0 < step g.
Proof.
  intros S. apply IZR_lt in S. apply Rmult_lt_0_compat; [ apply two_power_positive | ].
  now apply Rinv_0_lt_compat.
Qed.

Lemma squared_sound g x n d : (0 < scale g)%Z -> squared g x = (n, d) ->
  (0 < d)%Z /\ step g * step g * IZR n = value x * value x * IZR d.
Proof.
  intros S. unfold squared. set (up := (exponent x - power g)%Z).
  assert (Sr : 0 < IZR (scale g)) by now apply IZR_lt.
  assert (E : powerRZ 2 (exponent x) = powerRZ 2 up * powerRZ 2 (power g)).
  { rewrite <- two_power_sum. f_equal. unfold up. lia. }
  unfold value, step. rewrite E. pose proof (two_power_positive (power g)).
  destruct (Z.leb_spec 0 up); intros T; apply pair_equal_spec in T; destruct T; subst n d.
  - split; [ lia | ]. rewrite shiftl_real, two_power_integer, !mult_IZR by lia.
    replace (2 * up)%Z with (up + up)%Z by lia. rewrite two_power_sum. field. lra.
  - split; [ rewrite Z.shiftl_mul_pow2, Z.mul_1_l by lia; apply Z.pow_pos_nonneg; lia | ].
    rewrite shiftl_real, two_power_integer, !mult_IZR by lia.
    assert (U : powerRZ 2 up * powerRZ 2 up * powerRZ 2 (-2 * up) = 1).
    { rewrite <- !two_power_sum. replace (up + up + -2 * up)%Z with 0%Z by lia. reflexivity. }
    transitivity (powerRZ 2 (power g) * powerRZ 2 (power g) * IZR (mantissa x) * IZR (mantissa x)
                  * (powerRZ 2 up * powerRZ 2 up * powerRZ 2 (-2 * up))); [ | ring ].
    rewrite U. field. lra.
Qed.

Lemma value_positive x : (0 <= mantissa x)%Z -> 0 <= value x.
Proof.
  intros M. apply IZR_le in M. apply Rmult_le_pos; [ exact M | ].
  apply Rlt_le, two_power_positive.
Qed.

(** * The index *)

Lemma find_empty i : find i Empty = None.
Proof. now destruct i. Qed.

Lemma find_put x y : forall i j t, find j (put i x t) = Some y -> y = x \/ find j t = Some y.
Proof.
  intros i. induction i as [i IH | i IH | ]; intros j t; destruct t as [ | even here odd];
    destruct j as [j | j | ]; cbn [put split find]; intros H;
    try (destruct (IH _ _ H) as [E | E]; [ now left | rewrite ?find_empty in E ]);
    rewrite ?find_empty in *; try discriminate; try (now right); left; congruence.
Qed.

Lemma index_from_sound faces : forall i so_far s t,
  find s (index_from i faces so_far) = Some t -> In t faces \/ find s so_far = Some t.
Proof.
  induction faces as [ | face others IH]; intros i so_far s t H; [ now right | ].
  cbn [index_from] in H. apply IH in H. destruct H as [H | H]; [ left; now right | ].
  apply find_put in H. destruct H as [H | H]; [ left; left; congruence | now right ].
Qed.

Lemma index_sound faces s t : find s (index faces) = Some t -> In t faces.
Proof.
  intros H. apply index_from_sound in H. destruct H as [H | H]; [ exact H | ].
  rewrite find_empty in H. discriminate.
Qed.

(** * Meshes that are within the deltas *)

Lemma within_back delta m m' t' :
  within delta m m' -> In t' m' -> exists t, In t m /\ corners_within delta t t'.
Proof.
  intros W. induction W as [ | s s' r r' M W IH]; intros I; [ destruct I | ].
  destruct I as [I | I].
  - subst s'. exists s. split; [ now left | exact M ].
  - destruct (IH I) as (t & T & M'). exists t. split; [ now right | exact M' ].
Qed.

Lemma within_forth delta m m' t :
  within delta m m' -> In t m -> exists t', In t' m' /\ corners_within delta t t'.
Proof.
  intros W. induction W as [ | s s' r r' M W IH]; intros I; [ destruct I | ].
  destruct I as [I | I].
  - subst s. exists s'. split; [ now left | exact M ].
  - destruct (IH I) as (t' & T & M'). exists t'. split; [ now right | exact M' ].
Qed.

(** Moving the vertices of an array moves the faces that it has. *)
Lemma within_by_index delta v v' faces : (forall i, distance (v i) (v' i) <= delta) ->
  within delta (by_index v faces) (by_index v' faces).
Proof.
  intros H. induction faces as [ | [[i j] k] others IH]; constructor; [ | exact IH ].
  repeat split; apply H.
Qed.

Lemma surface_back delta m m' p' : within delta m m' -> surface m' p' ->
  exists p, surface m p /\ distance p p' <= delta.
Proof.
  intros W (t' & T & a & b & c & A & B & C & S & E).
  destruct (within_back _ _ _ _ W T) as (t & I & M).
  exists (combination a b c t). split.
  - exists t. split; [ exact I | ]. now exists a, b, c.
  - subst p'. now apply combination_near.
Qed.

Lemma surface_forth delta m m' p : within delta m m' -> surface m p ->
  exists p', surface m' p' /\ distance p p' <= delta.
Proof.
  intros W (t & T & a & b & c & A & B & C & S & E).
  destruct (within_forth _ _ _ _ W T) as (t' & I & M).
  exists (combination a b c t'). split.
  - exists t'. split; [ exact I | ]. now exists a, b, c.
  - subst p. now apply combination_near.
Qed.

Lemma at_most_within a b a' b' da db u :
  within da a a' -> within db b b' -> at_most a b u -> at_most a' b' (u + (da + db)).
Proof.
  intros A B H p' P'. destruct (surface_back _ _ _ _ A P') as (p & P & Dp).
  destruct (H p P) as (q & Q & E). destruct (surface_forth _ _ _ _ B Q) as (q' & Q' & Dq).
  exists q'. split; [ exact Q' | ].
  pose proof (triangle_inequality p' p q'). pose proof (triangle_inequality p q q').
  rewrite (distance_symmetric p' p) in *. lra.
Qed.

Lemma at_least_within a b a' b' da db l :
  within da a a' -> within db b b' -> at_least a b l -> at_least a' b' (l - (da + db)).
Proof.
  intros A B (p & P & H). destruct (surface_forth _ _ _ _ A P) as (p' & P' & Dp).
  exists p'. split; [ exact P' | ]. intros q' Q'.
  destruct (surface_back _ _ _ _ B Q') as (q & Q & Dq). specialize (H q Q).
  pose proof (triangle_inequality p p' q). pose proof (triangle_inequality p' q' q).
  rewrite (distance_symmetric q' q) in *. lra.
Qed.

(** * The theorem *)

Lemma check_direction_sound g bits da db it x y x' y' : (0 < scale g)%Z -> (0 <= bits)%Z ->
  check_direction g bits da db it x y (index y) = true ->
  within (value da) (mesh g x) x' -> within (value db) (mesh g y) y' -> holds it x' y'.
Proof.
  intros S Bits H X Y. unfold check_direction in H.
  set (most := claimed (upper it) (-1) da db) in *.
  set (least := claimed (lower it) 1 da db) in *.
  destruct (squared g most) as [n d] eqn:M. destruct (squared g least) as [nl dl] eqn:L.
  destruct (squared_sound _ _ _ _ S M) as [D Bound].
  destruct (squared_sound _ _ _ _ S L) as [Dl Boundl].
  rewrite !andb_true_iff, Z.leb_le in H. destruct H as [[M0 Low] Faces].
  pose proof (step_positive g S) as G.
  assert (Up : at_most x' y' (value (upper it))).
  { replace (value (upper it)) with (value most + (value da + value db))
      by (unfold most; rewrite claimed_value; lra).
    apply (at_most_within (mesh g x) (mesh g y)); try assumption.
    apply (check_faces_sound y (index y) (step g) (value most) n d bits) with (its := parts it);
      try assumption.
    - apply index_sound.
    - now apply value_positive.
    - lra. }
  split; [ exact Up | ].
  destruct (Z.leb_spec (mantissa (lower it)) 0) as [Z0 | Z0].
  - destruct x as [ | face x0]; [ discriminate | ]. inversion X as [ | s s' r r' Ms Ws]; subst.
    exists (corner0 s'). split; [ exists s'; split; [ now left | apply covers_corner0 ] | ].
    intros q _. apply Rle_trans with 0; [ | apply distance_positive ].
    apply IZR_le in Z0. unfold value. pose proof (two_power_positive (exponent (lower it))). nra.
  - rewrite andb_true_iff, Z.leb_le in Low. destruct Low as [L0 Low].
    replace (value (lower it)) with (value least - (value da + value db))
      by (unfold least; rewrite claimed_value; lra).
    apply (at_least_within (mesh g x) (mesh g y)); try assumption.
    apply (check_lower_sound it (step g) (value least) nl dl); try assumption.
    + now apply value_positive.
    + lra.
Qed.

(** What the check accepts is true of a and b, and of all meshes within the deltas of them. *)
Theorem check_sound g it a b : check g it a b = true ->
  forall a' b', within (value (delta_a it)) (mesh g a) a' ->
                within (value (delta_b it)) (mesh g b) b' ->
  holds (there it) a' b' /\ match back it with None => True | Some it' => holds it' b' a' end.
Proof.
  unfold check. rewrite !andb_true_iff, Z.ltb_lt, !Z.leb_le.
  intros [[[[[S Bits] _] _] H] Hb] a' b' A B.
  split.
  - now apply (check_direction_sound g (cut_bits it) (delta_a it) (delta_b it) _ a b).
  - destruct (back it) as [it' | ]; [ | exact I ].
    apply (check_direction_sound g (cut_bits it) (delta_b it) (delta_a it) _ b a); try assumption.
    unfold check_direction in *.
    replace (claimed (upper it') (-1) (delta_b it) (delta_a it))
      with (claimed (upper it') (-1) (delta_a it) (delta_b it)).
    replace (claimed (lower it') 1 (delta_b it) (delta_a it))
      with (claimed (lower it') 1 (delta_a it) (delta_b it)).
    assumption.
    all: unfold claimed; f_equal; try lia; rewrite (Z.min_comm (exponent (delta_a it))); lia.
Qed.

(** * Where the meshes lie *)

(** The place of a point: over / under times it, turned and shifted. *)
Definition placed (p : placement) (x : point) : point :=
  let r := IZR (over p) / IZR (under p) in
  match moved_by p with
  | None => Point (r * px x) (r * py x) (r * pz x)
  | Some m =>
    let put row t :=
      powerRZ 2 (turn_power m)
      * (IZR (ix row) * (r * px x) + IZR (iy row) * (r * py x) + IZR (iz row) * (r * pz x))
      + value t in
    Point (put (row_x m) (shift_x m)) (put (row_y m) (shift_y m)) (put (row_z m) (shift_z m))
  end.

(** The mesh that was given, where it is put. *)
Definition mesh_of (m : given) : list triangle :=
  let corner x := placed (lies m) (real (powerRZ 2 (own_power m)) x) in
  map (fun t => Triangle (corner (i0 t)) (corner (i1 t)) (corner (i2 t))) (given_faces m).

Lemma place_onto_map put faces : forall so_far,
  place_onto put faces so_far
  = rev_append (map (fun t => ITriangle (put (i0 t)) (put (i1 t)) (put (i2 t))) faces) so_far.
Proof.
  induction faces as [ | [a b c] others IH]; intros so_far; [ reflexivity | ]. cbn. now rewrite IH.
Qed.

Lemma place_all_map m power other :
  place_all m power other
  = map (fun t => let put := place (lies m) (own_power m) power other in
                  ITriangle (put (i0 t)) (put (i1 t)) (put (i2 t))) (given_faces m).
Proof.
  unfold place_all. rewrite place_onto_map, !rev_append_rev, !app_nil_r. apply rev_involutive.
Qed.

Lemma shifted_power x own power : (power <= own)%Z ->
  powerRZ 2 power * IZR (Z.shiftl x (own - power)) = powerRZ 2 own * IZR x.
Proof.
  intros. rewrite shiftl_real, two_power_integer by lia.
  replace (powerRZ 2 own) with (powerRZ 2 (own - power + power)) by (f_equal; lia).
  rewrite two_power_sum. ring.
Qed.

Lemma place_real p own power other x : is_whole p own power = true -> (0 < other)%Z ->
  real (powerRZ 2 power / (IZR (under p) * IZR other)) (place p own power other x)
  = placed p (real (powerRZ 2 own) x).
Proof.
  intros W O. apply IZR_lt in O. unfold is_whole in W. rewrite andb_true_iff, Z.ltb_lt in W.
  destruct W as [P W]. apply IZR_lt in P. unfold place, placed.
  destruct (moved_by p) as [m | ].
  - rewrite !andb_true_iff, !Z.leb_le in W. destruct W as [[[Wm Wx] Wy] Wz].
    assert (Put : forall row t, (power <= exponent t)%Z ->
      powerRZ 2 power / (IZR (under p) * IZR other)
      * IZR (other * (over p * dot row (shift (own + turn_power m - power) x)
                      + under p * Z.shiftl (mantissa t) (exponent t - power)))
      = powerRZ 2 (turn_power m)
        * (IZR (ix row) * (IZR (over p) / IZR (under p) * (powerRZ 2 own * IZR (ix x)))
           + IZR (iy row) * (IZR (over p) / IZR (under p) * (powerRZ 2 own * IZR (iy x)))
           + IZR (iz row) * (IZR (over p) / IZR (under p) * (powerRZ 2 own * IZR (iz x))))
        + value t).
    { intros row t T. rewrite <- (aligned_value t power T). unfold dot, shift. cbn [ix iy iz].
      rewrite !mult_IZR, plus_IZR, !mult_IZR, !plus_IZR, !mult_IZR.
      pose proof (shifted_power (ix x) (own + turn_power m) power Wm) as Sx.
      pose proof (shifted_power (iy x) (own + turn_power m) power Wm) as Sy.
      pose proof (shifted_power (iz x) (own + turn_power m) power Wm) as Sz.
      rewrite two_power_sum in Sx, Sy, Sz.
      set (sx := IZR (Z.shiftl (ix x) (own + turn_power m - power))) in *.
      set (sy := IZR (Z.shiftl (iy x) (own + turn_power m - power))) in *.
      set (sz := IZR (Z.shiftl (iz x) (own + turn_power m - power))) in *.
      transitivity (IZR (over p) / IZR (under p) * (IZR (ix row) * (powerRZ 2 power * sx)
          + IZR (iy row) * (powerRZ 2 power * sy) + IZR (iz row) * (powerRZ 2 power * sz))
        + IZR (Z.shiftl (mantissa t) (exponent t - power)) * powerRZ 2 power).
      - field. lra.
      - rewrite Sx, Sy, Sz. field. lra. }
    unfold real. cbn [ix iy iz px py pz]. f_equal; now apply Put.
  - rewrite Z.leb_le in W.
    assert (Put : forall c, powerRZ 2 power / (IZR (under p) * IZR other)
        * IZR (over p * other * Z.shiftl c (own - power))
      = IZR (over p) / IZR (under p) * (powerRZ 2 own * IZR c)).
    { intros c. rewrite !mult_IZR, <- (shifted_power c own power W). field. lra. }
    unfold real, times, shift. cbn [ix iy iz px py pz]. f_equal; apply Put.
Qed.

Lemma place_all_real m power other g : is_whole (lies m) (own_power m) power = true ->
  (0 < other)%Z -> step g = powerRZ 2 power / (IZR (under (lies m)) * IZR other) ->
  mesh g (place_all m power other) = mesh_of m.
Proof.
  intros W O G. unfold mesh, mesh_of, real_mesh. rewrite place_all_map, map_map, G.
  apply map_ext. intros t. unfold real_triangle. cbn [i0 i1 i2].
  now rewrite !place_real by assumption.
Qed.

(** What the check accepts is true of both meshes where they are put, and of all that are within
    the deltas of them. *)
Theorem check_given_sound power it a b : check_given power it a b = true ->
  forall a' b', within (value (delta_a it)) (mesh_of a) a' ->
                within (value (delta_b it)) (mesh_of b) b' ->
  holds (there it) a' b' /\ match back it with None => True | Some it' => holds it' b' a' end.
Proof.
  unfold check_given. rewrite !andb_true_iff. intros [[Wa Wb] H].
  assert (Ua : (0 < under (lies a))%Z) by (unfold is_whole in Wa; rewrite andb_true_iff in Wa; lia).
  assert (Ub : (0 < under (lies b))%Z) by (unfold is_whole in Wb; rewrite andb_true_iff in Wb; lia).
  set (g := Grid power (under (lies a) * under (lies b))) in *.
  rewrite <- (place_all_real a power (under (lies b)) g),
          <- (place_all_real b power (under (lies a)) g);
    try assumption; try (now apply check_sound);
    unfold step, g; cbn [Checker.power scale]; rewrite mult_IZR; f_equal; ring.
Qed.

Lemma within_itself delta m : 0 <= delta -> within delta m m.
Proof.
  intros D. assert (Z : forall p, distance p p <= delta).
  { intros p. apply distance_at_most; [ exact D | ]. unfold square_distance.
    replace (px p - px p) with 0 by ring. replace (py p - py p) with 0 by ring.
    replace (pz p - pz p) with 0 by ring. nra. }
  induction m; constructor; [ repeat split; apply Z | assumption ].
Qed.

Lemma check_given_deltas power it a b : check_given power it a b = true ->
  0 <= value (delta_a it) /\ 0 <= value (delta_b it).
Proof.
  unfold check_given, check. rewrite !andb_true_iff, !Z.leb_le.
  intros [_ [[[[_ A] B] _] _]]. split; now apply value_positive.
Qed.

(** The same of the meshes as they are given: they are always among those that the theorem is
    about. *)
Corollary check_given_itself power it a b : check_given power it a b = true ->
  holds (there it) (mesh_of a) (mesh_of b) /\
  match back it with None => True | Some it' => holds it' (mesh_of b) (mesh_of a) end.
Proof.
  intros H. destruct (check_given_deltas power it a b H).
  apply (check_given_sound power it a b H); now apply within_itself.
Qed.

(** * The same of h(A,B), as a supremum of infima *)

Lemma infimum b p : (exists q, surface b q) -> exists d, is_distance_to_surface b p d.
Proof.
  intros (q0 & Q0).
  destruct (completeness (fun r => exists q, surface b q /\ r = - distance p q))
    as (m & Up & Least).
  - exists 0. intros r (q & _ & E). pose proof (distance_positive p q). lra.
  - now exists (- distance p q0), q0.
  - exists (- m). split.
    + intros q Q. assert (- distance p q <= m) by (apply Up; now exists q). lra.
    + intros d' H. assert (m <= - d').
      { apply Least. intros r (q & Q & E). specialize (H q Q). lra. }
      lra.
Qed.

(** Neither mesh is empty. *)
Lemma holds_not_empty it a b : holds it a b ->
  (exists p, surface a p) /\ (exists q, surface b q).
Proof.
  intros [Up (p & P & _)]. split; [ now exists p | ].
  destruct (Up p P) as (q & Q & _). now exists q.
Qed.

Lemma at_most_bounds it a b : holds it a b ->
  is_upper_bound (fun d => exists p, surface a p /\ is_distance_to_surface b p d)
    (value (upper it)).
Proof.
  intros [Up _] d (p & P & D & _). destruct (Up p P) as (q & Q & E). specialize (D q Q). lra.
Qed.

Corollary interval it a b h : holds it a b -> directed_hausdorff a b h ->
  value (lower it) <= h <= value (upper it).
Proof.
  intros H [Bound Least]. split; [ | now apply Least, at_most_bounds ].
  destruct (holds_not_empty it a b H) as [_ B]. destruct H as [_ (p & P & Low)].
  destruct (infimum b p B) as (d & D).
  apply Rle_trans with d; [ now apply D | ]. apply Bound. now exists p.
Qed.

(** There is such an h. *)
Corollary interval_exists it a b : holds it a b ->
  exists h, directed_hausdorff a b h /\ value (lower it) <= h <= value (upper it).
Proof.
  intros H. destruct (holds_not_empty it a b H) as [(p & P) B].
  destruct (completeness (fun d => exists p, surface a p /\ is_distance_to_surface b p d))
    as (h & L).
  - exists (value (upper it)). now apply at_most_bounds.
  - destruct (infimum b p B) as (d & D). now exists d, p.
  - exists h. split; [ exact L | ]. now apply (interval it a b).
Qed.

Print Assumptions check_given_sound.
Print Assumptions interval.
Print Assumptions interval_exists.
