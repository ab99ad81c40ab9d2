(** The certificate and its check, all in integers. This is what becomes a program. *)
From Coq Require Import ZArith List Bool.
Open Scope Z_scope.

(** * Numbers, points and meshes *)

(** mantissa 2^exponent *)
Record dyadic := Dyadic { mantissa : Z; exponent : Z }.

Record ipoint := IPoint { ix : Z; iy : Z; iz : Z }.

Record itriangle := ITriangle { i0 : ipoint; i1 : ipoint; i2 : ipoint }.

(** The step between integers: 2^power / scale *)
Record grid := Grid { power : Z; scale : Z }.

Definition plus (a b : ipoint) := IPoint (ix a + ix b) (iy a + iy b) (iz a + iz b).
Definition minus (a b : ipoint) := IPoint (ix a - ix b) (iy a - iy b) (iz a - iz b).
Definition times (m : Z) (a : ipoint) := IPoint (m * ix a) (m * iy a) (m * iz a).
Definition dot (a b : ipoint) := ix a * ix b + iy a * iy b + iz a * iz b.
Definition cross (a b : ipoint) :=
  IPoint (iy a * iz b - iz a * iy b) (iz a * ix b - ix a * iz b) (ix a * iy b - iy a * ix b).
Definition shift (k : Z) (a : ipoint) :=
  IPoint (Z.shiftl (ix a) k) (Z.shiftl (iy a) k) (Z.shiftl (iz a) k).
Definition shift_triangle (k : Z) (t : itriangle) :=
  ITriangle (shift k (i0 t)) (shift k (i1 t)) (shift k (i2 t)).

(** * Triangles by their numbers: a binary tree, whose paths are the bits of a number *)

Inductive tree :=
| Empty
| Node (even : tree) (here : option itriangle) (odd : tree).

Fixpoint find (i : positive) (t : tree) : option itriangle :=
  match t with
  | Empty => None
  | Node even here odd =>
    match i with xH => here | xO half => find half even | xI half => find half odd end
  end.

Definition split (t : tree) : tree * option itriangle * tree :=
  match t with Empty => (Empty, None, Empty) | Node even here odd => (even, here, odd) end.

Fixpoint put (i : positive) (x : itriangle) (t : tree) : tree :=
  let '(even, here, odd) := split t in
  match i with
  | xH => Node even (Some x) odd
  | xO half => Node (put half x even) here odd
  | xI half => Node even here (put half x odd)
  end.

(** The triangles, numbered from i. *)
Fixpoint index_from (i : positive) (faces : list itriangle) (so_far : tree) : tree :=
  match faces with
  | nil => so_far
  | face :: others => index_from (Pos.succ i) others (put i face so_far)
  end.

Definition index (faces : list itriangle) : tree := index_from 1 faces Empty.

(** * The certificate *)

Inductive corner := Corner0 | Corner1 | Corner2.

(** A part of a face. Triangles of the other mesh are counted from 1. *)
Inductive part :=
| Halved (opposite : corner) (first second : part)
| Leaf (s : positive)
| Cut (o : corner) (s r : positive) (p q : Z).

(** The parts of all faces, and a witness: its face from 0, its weights j and k, over 2^bits. *)
Record direction := Direction {
  lower : dyadic; upper : dyadic;
  witness : Z; weight_bits : Z; weight_j : Z; weight_k : Z;
  parts : list part }.

Record certificate := Certificate {
  delta_a : dyadic; delta_b : dyadic; cut_bits : Z; there : direction; back : option direction }.

(** * Near: a point of a triangle is within the root of n / d *)

Record prepared := Prepared {
  origin : ipoint; edge0 : ipoint; edge1 : ipoint; d00 : Z; d01 : Z; d11 : Z; area : Z }.

Definition prepare (t : itriangle) : prepared :=
  let u := minus (i1 t) (i0 t) in
  let v := minus (i2 t) (i0 t) in
  let uu := dot u u in
  let uv := dot u v in
  let vv := dot v v in
  Prepared (i0 t) u v uu uv vv (uu * vv - uv * uv).

(** An edge of squared length len: the point is along / len of it behind its start, and ff is the
    square of their distance. *)
Definition near_edge (n d ff along len : Z) : bool :=
  if along <=? 0 then ff * d <=? n
  else if len <=? along then (ff - 2 * along + len) * d <=? n
  else (ff * len - along * along) * d <=? n * len.

Definition near (n d : Z) (t : prepared) (v : ipoint) : bool :=
  let f := minus v (origin t) in
  let ff := dot f f in
  let f0 := dot f (edge0 t) in
  let f1 := dot f (edge1 t) in
  let x := d11 t * f0 - d01 t * f1 in
  let y := d00 t * f1 - d01 t * f0 in
  if (0 <? area t) && (0 <=? x) && (0 <=? y) && (x + y <=? area t)
  then (ff * area t - x * f0 - y * f1) * d <=? n * area t
  else near_edge n d ff f0 (d00 t) || near_edge n d ff f1 (d11 t)
       || near_edge n d (ff - 2 * f0 + d00 t) (f1 - f0 - d01 t + d00 t) (d00 t - 2 * d01 t + d11 t).

(** * The upper half *)

(** Whether points, 2^k times as large, are near triangle s. *)
Definition all_near (b : tree) (n d k : Z) (s : positive) (points : list ipoint) : bool :=
  match find s b with
  | None => false
  | Some t => let near_it := near (Z.shiftl n (2 * k)) d (prepare (shift_triangle k t)) in
              forallb near_it points
  end.

(** The two halves, 2 times as large. *)
Definition halves (opposite : corner) (t : itriangle) : itriangle * itriangle :=
  let '(ITriangle a b c) := t in
  let a' := shift 1 a in
  let b' := shift 1 b in
  let c' := shift 1 c in
  match opposite with
  | Corner0 => let m := plus b c in (ITriangle a' b' m, ITriangle a' m c')
  | Corner1 => let m := plus c a in (ITriangle m b' c', ITriangle a' b' m)
  | Corner2 => let m := plus a b in (ITriangle a' m c', ITriangle m b' c')
  end.

(** The triangle with its corner o first. *)
Definition turned (o : corner) (t : itriangle) : itriangle :=
  let '(ITriangle a b c) := t in
  match o with Corner0 => t | Corner1 => ITriangle b c a | Corner2 => ITriangle c a b end.

(** p / 2^bits of the way from o to a, 2^bits times as large. *)
Definition on_edge (bits p : Z) (o a : ipoint) : ipoint :=
  plus (times (Z.shiftl 1 bits - p) o) (times p a).

Definition is_fraction (bits p : Z) : bool := (0 <=? p) && (p <? Z.shiftl 1 bits).

(** Whether all points of a part are within the root of n / d. Its corners are 2^k times as
    large. *)
Fixpoint check_part (b : tree) (bits n d k : Z) (v : itriangle) (it : part) : bool :=
  match it with
  | Halved opposite first second =>
    let (one, other) := halves opposite v in
    check_part b bits n d (k + 1) one first && check_part b bits n d (k + 1) other second
  | Leaf s => all_near b n d k s (i0 v :: i1 v :: i2 v :: nil)
  | Cut o s r p q =>
    let '(ITriangle c x y) := turned o v in
    let cx := on_edge bits p c x in
    let cy := on_edge bits q c y in
    is_fraction bits p && is_fraction bits q
    && all_near b n d (k + bits) s (shift bits c :: cx :: cy :: nil)
    && all_near b n d (k + bits) r (cx :: cy :: shift bits x :: shift bits y :: nil)
  end.

Fixpoint check_faces (b : tree) (bits n d : Z) (faces : list itriangle)
    (its : list part) : bool :=
  match faces, its with
  | nil, nil => true
  | face :: faces', it :: its' =>
    check_part b bits n d 0 face it && check_faces b bits n d faces' its'
  | _, _ => false
  end.

(** * The lower half *)

(** Whether all of a triangle is at least the root of n / d behind p, along r. *)
Definition separates (n d : Z) (p : ipoint) (t : itriangle) (r : ipoint) : bool :=
  let rr := dot r r in
  let behind c := let along := dot (minus p c) r in
                  (0 <=? along) && (n * rr <=? along * along * d) in
  (0 <? rr) && behind (i0 t) && behind (i1 t) && behind (i2 t).

(** Whether three coordinates are at least reach away, on one side. *)
Definition beyond (reach p a b c : Z) : bool :=
  let high := p + reach in
  let low := p - reach in
  (high <=? a) && (high <=? b) && (high <=? c) || (a <=? low) && (b <=? low) && (c <=? low).

(** Whether the triangle is at least the root of n / d away from p. One of the seven directions is
    meant to be from the nearest point. No lemma says so: without it more would be refused. *)
Definition away (n d reach : Z) (p : ipoint) (t : itriangle) : bool :=
  beyond reach (ix p) (ix (i0 t)) (ix (i1 t)) (ix (i2 t))
  || beyond reach (iy p) (iy (i0 t)) (iy (i1 t)) (iy (i2 t))
  || beyond reach (iz p) (iz (i0 t)) (iz (i1 t)) (iz (i2 t))
  || (let f := minus p (i0 t) in
      let u := minus (i1 t) (i0 t) in
      let v := minus (i2 t) (i0 t) in
      let g := minus p (i1 t) in
      let w := minus (i2 t) (i1 t) in
      let normal := cross u v in
      let from_edge a along := minus (times (dot along along) a) (times (dot a along) along) in
      separates n d p t (if 0 <=? dot f normal then normal else minus (IPoint 0 0 0) normal)
      || separates n d p t (from_edge f u) || separates n d p t (from_edge f v)
      || separates n d p t (from_edge g w)
      || separates n d p t f || separates n d p t g || separates n d p t (minus p (i2 t))).

Fixpoint pick (faces : list itriangle) (i : Z) : option itriangle :=
  match faces with
  | nil => None
  | face :: others => if i =? 0 then Some face else pick others (i - 1)
  end.

(** The witness, 2^bits times as large. *)
Definition witness_of (it : direction) (t : itriangle) : ipoint :=
  plus (times (Z.shiftl 1 (weight_bits it) - weight_j it - weight_k it) (i0 t))
       (plus (times (weight_j it) (i1 t)) (times (weight_k it) (i2 t))).

Definition check_lower (it : direction) (n d : Z) (x y : list itriangle) : bool :=
  match pick x (witness it) with
  | None => false
  | Some face =>
    let p := witness_of it face in
    let m := Z.shiftl n (2 * weight_bits it) in
    let reach := Z.sqrt (m / d) + 1 in
    (0 <=? weight_bits it) && (0 <=? weight_j it) && (0 <=? weight_k it)
    && (weight_j it + weight_k it <=? Z.shiftl 1 (weight_bits it))
    && (0 <=? reach) && (m <=? reach * reach * d)
    && forallb (fun t => away m d reach p (shift_triangle (weight_bits it) t)) y
  end.

(** * Both *)

(** claim + side (a + b), in units of 2^exponent. *)
Definition claimed (claim : dyadic) (side : Z) (a b : dyadic) : dyadic :=
  let least := Z.min (exponent claim) (Z.min (exponent a) (exponent b)) in
  let aligned x := Z.shiftl (mantissa x) (exponent x - least) in
  Dyadic (aligned claim + side * (aligned a + aligned b)) least.

(** The square of a number as n / d, in units of a grid's squared step. *)
Definition squared (g : grid) (x : dyadic) : Z * Z :=
  let m := mantissa x * scale g in
  let up := exponent x - power g in
  if 0 <=? up then (Z.shiftl (m * m) (2 * up), 1) else (m * m, Z.shiftl 1 (-2 * up)).

Definition check_direction (g : grid) (bits : Z) (a b : dyadic) (it : direction)
    (x y : list itriangle) (index_of_y : tree) : bool :=
  let most := claimed (upper it) (-1) a b in
  let least := claimed (lower it) 1 a b in
  let (n, d) := squared g most in
  let (nl, dl) := squared g least in
  (0 <=? mantissa most)
  && (if mantissa (lower it) <=? 0 then negb (match x with nil => true | _ => false end)
      else (0 <=? mantissa least) && check_lower it nl dl x y)
  && check_faces index_of_y bits n d x (parts it).

(** Whether a certificate proves its claim for two meshes, whose corners are in steps of a grid.
    Deltas are not negative: with a negative one the theorem would be about no mesh at all. *)
Definition check (g : grid) (it : certificate) (a b : list itriangle) : bool :=
  (0 <? scale g) && (0 <=? cut_bits it)
  && (0 <=? mantissa (delta_a it)) && (0 <=? mantissa (delta_b it))
  && check_direction g (cut_bits it) (delta_a it) (delta_b it) (there it) a b (index b)
  && match back it with
     | None => true
     | Some it' => check_direction g (cut_bits it) (delta_a it) (delta_b it) it' b a (index a)
     end.

(** * Where the meshes lie *)

(** A turn of three rows, in units of 2^turn_power, and then a shift. *)
Record motion := Motion {
  turn_power : Z; row_x : ipoint; row_y : ipoint; row_z : ipoint;
  shift_x : dyadic; shift_y : dyadic; shift_z : dyadic }.

(** Coordinates times over / under, and then a motion, if there is one. *)
Record placement := Placement { over : Z; under : Z; moved_by : option motion }.

(** Corners as a file has them, in units of 2^own_power, and where they are put. *)
Record given := Given { own_power : Z; given_faces : list itriangle; lies : placement }.

(** A corner where it is put, in steps of 2^power / (under other). *)
Definition place (p : placement) (own power other : Z) (x : ipoint) : ipoint :=
  match moved_by p with
  | None => times (over p * other) (shift (own - power) x)
  | Some m =>
    let at_ := shift (own + turn_power m - power) x in
    let put row t := other * (over p * dot row at_
                              + under p * Z.shiftl (mantissa t) (exponent t - power)) in
    IPoint (put (row_x m) (shift_x m)) (put (row_y m) (shift_y m)) (put (row_z m) (shift_z m))
  end.

(** Whether all of them are whole numbers of these steps. *)
Definition is_whole (p : placement) (own power : Z) : bool :=
  (0 <? under p) && match moved_by p with
  | None => power <=? own
  | Some m => (power <=? own + turn_power m) && (power <=? exponent (shift_x m))
              && (power <=? exponent (shift_y m)) && (power <=? exponent (shift_z m))
  end.

Fixpoint place_onto (put : ipoint -> ipoint) (faces so_far : list itriangle) : list itriangle :=
  match faces with
  | nil => so_far
  | ITriangle a b c :: others =>
    place_onto put others (ITriangle (put a) (put b) (put c) :: so_far)
  end.

Definition place_all (m : given) (power other : Z) : list itriangle :=
  rev_append (place_onto (place (lies m) (own_power m) power other) (given_faces m) nil) nil.

(** Whether a certificate proves its claim for two meshes, where they are put. Any power does for
    which the corners are whole numbers of steps. *)
Definition check_given (power : Z) (it : certificate) (a b : given) : bool :=
  is_whole (lies a) (own_power a) power && is_whole (lies b) (own_power b) power
  && (let under_a := under (lies a) in
      let under_b := under (lies b) in
      check (Grid power (under_a * under_b)) it
            (place_all a power under_b) (place_all b power under_a)).
